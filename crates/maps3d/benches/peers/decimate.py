#!/usr/bin/env python3
"""Meshes of one depth frame against the frame: ours, and those of other programs.

usage: decimate.py FRAME.raw COLUMNS,ROWS FX,FY,CX,CY FAR [OURS.ply ...] [--peers] [--vertices N,N,...]

FRAME.raw holds little-endian 32-bit floats, metres, NaN where nothing was measured. OURS.ply are
written by `driftlab mesh polyhedron`; faces that lead to the camera are left out here. With --peers,
the packages vtk, fast-simplification, pyfqmr and open3d, as far as they are installed, reduce the
full grid to each count. Every mesh is measured alike: along the ray of every measured pixel against
the nearest face on that ray, in depth; and as distance from the plane of that face. 'uncovered' are
rays that meet no face; they do not count in the distances, which flatters whoever leaves many.
"""
import sys
import time

import numpy as np


def read_ply(path):
    """vertices and triangles of a binary little-endian or ascii PLY with float/double x y z."""
    kinds = {'float': 'f4', 'float32': 'f4', 'double': 'f8', 'float64': 'f8', 'uchar': 'u1',
             'uint8': 'u1', 'char': 'i1', 'int8': 'i1', 'short': 'i2', 'ushort': 'u2', 'int': 'i4',
             'int32': 'i4', 'uint': 'u4', 'uint32': 'u4'}
    data = open(path, 'rb').read()
    end = data.index(b'end_header\n') + 11
    elements, text = [], False
    for line in data[:end].decode('ascii', 'replace').splitlines():
        word = line.split()
        if word[:1] == ['format']:
            text = word[1] == 'ascii'
        elif word[:1] == ['element']:
            elements.append((word[1], int(word[2]), []))
        elif word[:1] == ['property']:
            elements[-1][2].append(word[1:])
    vertices, faces = None, []
    if text:
        rows = iter(data[end:].decode().splitlines())
    at = end
    for name, count, properties in elements:
        for i in range(count):
            values = {}
            if text:
                words = iter(next(rows).split())
                for p in properties:
                    if p[0] == 'list':
                        values[p[3]] = [int(next(words)) for _ in range(int(next(words)))]
                    else:
                        values[p[1]] = float(next(words))
            else:
                for p in properties:
                    if p[0] == 'list':
                        n = int(np.frombuffer(data, '<' + kinds[p[1]], 1, at)[0])
                        at += np.dtype(kinds[p[1]]).itemsize
                        values[p[3]] = np.frombuffer(data, '<' + kinds[p[2]], n, at).tolist()
                        at += n * np.dtype(kinds[p[2]]).itemsize
                    else:
                        values[p[1]] = np.frombuffer(data, '<' + kinds[p[0]], 1, at)[0]
                        at += np.dtype(kinds[p[0]]).itemsize
            if name == 'vertex':
                if vertices is None:
                    vertices = np.zeros((count, 3))
                vertices[i] = values['x'], values['y'], values['z']
            elif name == 'face':
                faces.append(values.get('vertex_indices') or values.get('vertex_index'))
    faces = np.array(faces)
    camera = np.flatnonzero((np.abs(vertices) < 1e-12).all(1))
    return vertices, faces[~np.isin(faces, camera).any(1)]


def measure(depth, camera, vertices, faces):
    """rms, 95 % and largest difference of depth; 95 % of the distance from planes; share uncovered."""
    rows, columns = depth.shape
    fx, fy, cx, cy = camera
    surface = np.full(depth.shape, np.inf)
    plane = np.full(depth.shape, np.inf)
    ok = (vertices[faces][:, :, 2] > 1e-3).all(1)
    pixel = np.c_[vertices[:, 0] / vertices[:, 2] * fx + cx, vertices[:, 1] / vertices[:, 2] * fy + cy]
    for face in faces[ok]:
        (x, y), points = pixel[face].T, vertices[face]
        normal = np.cross(points[1] - points[0], points[2] - points[0])
        size = np.linalg.norm(normal)
        if size == 0:
            continue
        normal = normal / size
        offset = normal @ points[0]
        c0, c1 = max(0, int(np.ceil(x.min() - 1e-6))), min(columns - 1, int(np.floor(x.max() + 1e-6)))
        r0, r1 = max(0, int(np.ceil(y.min() - 1e-6))), min(rows - 1, int(np.floor(y.max() + 1e-6)))
        area = (y[1] - y[2]) * (x[0] - x[2]) + (x[2] - x[1]) * (y[0] - y[2])
        if c1 < c0 or r1 < r0 or abs(area) < 1e-12:
            continue
        c, r = np.meshgrid(np.arange(c0, c1 + 1), np.arange(r0, r1 + 1))
        a = ((y[1] - y[2]) * (c - x[2]) + (x[2] - x[1]) * (r - y[2])) / area
        b = ((y[2] - y[0]) * (c - x[2]) + (x[0] - x[2]) * (r - y[2])) / area
        inside = (a > -1e-6) & (b > -1e-6) & (1 - a - b > -1e-6)
        c, r = c[inside], r[inside]
        along = normal[0] * (c - cx) / fx + normal[1] * (r - cy) / fy + normal[2]
        with np.errstate(divide='ignore', invalid='ignore'):
            z = np.where(np.abs(along) > 1e-12, offset / along, np.inf)
        nearer = z < surface[r, c]
        surface[r[nearer], c[nearer]] = z[nearer]
        off = np.abs(depth[r, c] * along - offset)
        plane[r[nearer], c[nearer]] = off[nearer]
    measured = np.isfinite(depth)
    covered = np.isfinite(surface)
    both = measured & covered
    e = np.abs(surface[both] - depth[both])
    return (np.sqrt((e**2).mean()), np.percentile(e, 95), e.max(), np.percentile(plane[both], 95),
            100 * (1 - covered.mean()))


def peers(points, faces, target):
    """(name, vertices, faces, seconds) of every package that is there."""
    share = 1 - target / len(faces)
    try:
        import fast_simplification
        start = time.perf_counter()
        v, f = fast_simplification.simplify(points.astype('f4'), faces.astype('i4'), target_reduction=share)
        yield 'fast-simplification', v, f, time.perf_counter() - start
    except ImportError:
        pass
    try:
        import pyfqmr
        start = time.perf_counter()
        simplifier = pyfqmr.Simplify()
        simplifier.setMesh(points, faces)
        simplifier.simplify_mesh(target_count=target, aggressiveness=7, preserve_border=False, verbose=False)
        v, f, _ = simplifier.getMesh()
        yield 'pyfqmr', v, f, time.perf_counter() - start
    except ImportError:
        pass
    try:
        import vtk
        from vtk.util.numpy_support import numpy_to_vtk, numpy_to_vtkIdTypeArray, vtk_to_numpy
        held = vtk.vtkPoints()
        held.SetDataTypeToDouble()
        held.SetData(numpy_to_vtk(points, deep=True))
        cells = vtk.vtkCellArray()
        cells.SetCells(len(faces), numpy_to_vtkIdTypeArray(
            np.c_[np.full(len(faces), 3), faces].astype(np.int64).ravel(), deep=True))
        mesh = vtk.vtkPolyData()
        mesh.SetPoints(held)
        mesh.SetPolys(cells)
        tool = vtk.vtkQuadricDecimation()
        tool.SetInputData(mesh)
        tool.SetTargetReduction(share)
        start = time.perf_counter()
        tool.Update()
        seconds = time.perf_counter() - start
        out = tool.GetOutput()
        yield ('vtkQuadricDecimation', vtk_to_numpy(out.GetPoints().GetData()),
               vtk_to_numpy(out.GetPolys().GetData()).reshape(-1, 4)[:, 1:], seconds)
    except ImportError:
        pass
    try:
        import open3d
        mesh = open3d.geometry.TriangleMesh(open3d.utility.Vector3dVector(points),
                                            open3d.utility.Vector3iVector(faces.astype('i4')))
        start = time.perf_counter()
        out = mesh.simplify_quadric_decimation(target, boundary_weight=1.0)
        yield 'open3d quadric', np.asarray(out.vertices), np.asarray(out.triangles), time.perf_counter() - start
    except ImportError:
        pass


def main():
    words = [w for w in sys.argv[1:] if not w.startswith('--')]
    counts = '684'
    if '--vertices' in sys.argv:
        counts = sys.argv[sys.argv.index('--vertices') + 1]
        words.remove(counts)
    frame, size, camera, far, *ours = words
    columns, rows = map(int, size.split(','))
    camera = fx, fy, cx, cy = tuple(map(float, camera.split(',')))
    depth = np.fromfile(frame, '<f4').reshape(rows, columns).astype(float)
    depth[~(depth > 0)] = np.nan
    print('| mesh | vertices | faces | seconds | rms m | 95 % m | max m | plane 95 % m | uncovered % |')
    print('|---|--:|--:|--:|--:|--:|--:|--:|--:|')

    def show(name, vertices, faces, seconds):
        faces = np.asarray(faces).reshape(-1, 3)
        if len(faces) > 60_000 or len(faces) == 0:
            print(f'| {name} | | {len(faces)} | {seconds} | | | | | |')
            return
        told = measure(depth, camera, np.asarray(vertices, float), faces)
        print(f'| {name} | {len(np.unique(faces))} | {len(faces)} | {seconds} | '
              + ' | '.join(f'{x:.4f}' for x in told) + ' |', flush=True)

    for path in ours:
        show(path.rsplit('/', 1)[-1], *read_ply(path), '')
    if '--peers' in sys.argv:
        z = np.where(np.isfinite(depth), depth, float(far))
        c, r = np.meshgrid(np.arange(columns), np.arange(rows))
        points = np.c_[((c - cx) / fx * z).ravel(), ((r - cy) / fy * z).ravel(), z.ravel()]
        at = np.arange(rows * columns).reshape(rows, columns)
        a, b, d, e = (x.ravel() for x in (at[:-1, :-1], at[:-1, 1:], at[1:, :-1], at[1:, 1:]))
        faces = np.vstack([np.c_[a, e, d], np.c_[a, b, e]])
        for count in map(int, counts.split(',')):
            target = max(2, int(2 * count - 2 - 2 * np.sqrt(count)))
            for name, v, f, seconds in peers(points, faces, target):
                show(f'{name} to {count}', v, f, f'{seconds:.2f}')


if __name__ == '__main__':
    main()
