#!/usr/bin/env python3
"""Whether meshes bound volumes: another opinion than driftlab's, in whole numbers, by another method.

usage: valid.py MESH... [--most N] [--complex] [--driftlab COMMAND]

MESH are OFF, OBJ, or PLY as driftlab writes it; polygons become fans as driftlab makes them. Vertices at
one place are one; faces that lose a corner by that are left out. Of a valid mesh no face is flat, two faces
meet in common corners and edges alone, and an even number of faces is at every edge (the last not with
--complex). What is wrong is named by faces; at most N pairs that cross are listed, 10 unless told.

With --driftlab COMMAND, `COMMAND mesh tetrahedralize` has to agree on each mesh: exit code 0 for valid ones,
2 and a message on the others. The command's exit code is then 1 where they do not agree.

No predicate is shared with driftlab: bounds of boxes in a sweep, then for each pair of triangles whose boxes
meet a test by separating directions, on coordinates that were multiplied by a power of two until all are whole:
Python's integers do not round. Two convex sets are apart where a plane is
between them: for triangles it suffices to try the two planes they lie in, the planes through an edge of
each, and in a common plane those through an edge at right angles to it. Common corners and edges are taken
off first. Needs numpy.
"""
import subprocess
import sys
from collections import Counter, defaultdict

import numpy as np

from tetrahedra import read_obj, read_off, read_ply


def minus(p, q):
    return p[0] - q[0], p[1] - q[1], p[2] - q[2]


def cross(u, v):
    return u[1] * v[2] - u[2] * v[1], u[2] * v[0] - u[0] * v[2], u[0] * v[1] - u[1] * v[0]


def dot(u, v):
    return u[0] * v[0] + u[1] * v[1] + u[2] * v[2]


def normal(t):
    return cross(minus(t[1], t[0]), minus(t[2], t[0]))


def directions(s, t):
    """Those along which two triangles that are apart can be told apart."""
    n, m = normal(s), normal(t)
    yield n
    yield m
    edges = [[minus(u[(i + 1) % 3], u[i]) for i in range(3)] for u in (s, t)]
    for e in edges[0]:
        for f in edges[1]:
            yield cross(e, f)
    for e in edges[0]:
        yield cross(n, e)
    for f in edges[1]:
        yield cross(m, f)


def apart(s, t):
    """Whether two triangles have no point in common."""
    for d in directions(s, t):
        if d == (0, 0, 0):
            continue
        a, b = [dot(d, p) for p in s], [dot(d, p) for p in t]
        if max(a) < min(b) or max(b) < min(a):
            return True
    return False


def beyond_corner(c, s, t):
    """Whether triangles with corner `c` in common, and `s`, `t` their other corners, share more than it.

    They share more where the cones from `c` do. A common direction may be found in the plane of one: the cone
    of the other cuts that plane in a cone of its own, whose bounds are compared.
    """
    e, f = [minus(p, c) for p in s], [minus(p, c) for p in t]
    n = cross(*e)
    sides = [dot(n, v) for v in f]
    if sides[0] == 0 and sides[1] == 0:
        return any(within(n, e, v) for v in f) or any(within(cross(*f), f, v) for v in e)
    if sides[0] * sides[1] > 0:
        return False
    if 0 in sides:
        # One edge of the other lies in the plane.
        return within(n, e, f[sides.index(0)])
    # Where the other passes through the plane.
    a, b = abs(sides[1]), abs(sides[0])
    return within(n, e, tuple(a * x + b * y for x, y in zip(*f)))


def within(n, pair, v):
    """Whether direction `v`, in the plane across `n`, is one of the closed cone between two."""
    return dot(cross(pair[0], v), n) >= 0 and dot(cross(v, pair[1]), n) >= 0


def meet(s, t, points):
    """Whether two triangles of corner numbers share more than common corners and edges."""
    common = [v for v in s if v in t]
    if not common:
        return not apart([points[v] for v in s], [points[v] for v in t])
    rest = [[points[v] for v in u if v not in common] for u in (s, t)]
    c = points[common[0]]
    if len(common) == 1:
        return beyond_corner(c, *rest)
    if len(common) == 2:
        e = minus(points[common[1]], c)
        f, g = minus(rest[0][0], c), minus(rest[1][0], c)
        n, m = cross(e, f), cross(e, g)
        return cross(n, m) == (0, 0, 0) and dot(n, m) > 0
    # Faces on the same corners lie on one another, and share nothing else.
    return False


def pairs(vertices, faces):
    """Pairs of faces whose boxes meet, by a sweep along the longest axis."""
    corners = vertices[faces]
    low, high = corners.min(axis=1), corners.max(axis=1)
    axis = int(np.argmax(high.max(axis=0) - low.min(axis=0)))
    order = np.argsort(low[:, axis], kind='stable')
    ends = np.searchsorted(low[order, axis], high[order, axis], side='right')
    for k, i in enumerate(order):
        near = order[k + 1:ends[k]]
        hit = (low[near] <= high[i]).all(axis=1) & (high[near] >= low[i]).all(axis=1)
        for j in near[hit]:
            yield int(min(i, j)), int(max(i, j))


def whole(places):
    """The places as integers, all multiplied by one power of two."""
    ratios = [[float(x).as_integer_ratio() for x in p] for p in places]
    most = max((below for p in ratios for _, below in p), default=1)
    return [tuple(above * (most // below) for above, below in p) for p in ratios]


def flaws(vertices, triangles, is_complex, most):
    """What is wrong, in words; nothing where the mesh is valid."""
    _, first, place = np.unique(vertices, axis=0, return_index=True, return_inverse=True)
    place = place.reshape(-1)
    faces = place[triangles]
    kept = [i for i, (a, b, c) in enumerate(faces.tolist()) if len({a, b, c}) == 3]
    faces, places = faces[kept], vertices[first]
    points = whole(places)
    told = []
    corners = [tuple(face) for face in faces.tolist()]
    flat = {i for i, t in enumerate(corners) if normal([points[v] for v in t]) == (0, 0, 0)}
    told += [f'face {kept[i]} is flat' for i in sorted(flat)]
    if not is_complex:
        at = defaultdict(list)
        for i, (a, b, c) in enumerate(corners):
            for edge in ((a, b), (b, c), (c, a)):
                at[tuple(sorted(edge))].append(kept[i])
        told += [f'faces {of} are alone at an edge' for of in at.values() if len(of) % 2]
    crossing = 0
    for i, j in pairs(places, faces):
        if i not in flat and j not in flat and meet(corners[i], corners[j], points):
            crossing += 1
            if crossing <= most:
                told.append(f'faces {kept[i]} and {kept[j]} meet elsewhere')
    if crossing > most:
        told.append(f'{crossing - most} more pairs meet elsewhere')
    return told


def main():
    words = sys.argv[1:]

    def option(name, default):
        if name not in words:
            return default
        at = words.index(name)
        value = words[at + 1]
        del words[at:at + 2]
        return value

    most, command = int(option('--most', '10')), option('--driftlab', None)
    is_complex = '--complex' in words
    paths = [word for word in words if word != '--complex']
    readers = {'.off': read_off, '.obj': read_obj, '.ply': read_ply}
    verdicts = Counter()
    for path in paths:
        vertices, triangles = readers[path[path.rindex('.'):].lower()](path)
        told = flaws(vertices, triangles, is_complex, most)
        print(f'{path}: {len(triangles)} faces:', 'valid' if not told else f'{len(told)} flaws told', flush=True)
        for line in told[:2 * most]:
            print('   ', line)
        if command:
            run = subprocess.run([command, 'mesh', 'tetrahedralize', path, '-q'], capture_output=True, text=True)
            agrees = run.returncode == (2 if told else 0)
            verdicts[agrees] += 1
            print('   ', 'agreed' if agrees else 'NOT agreed', f'{run.returncode}:', run.stderr.strip()[:200])
    if verdicts[False]:
        sys.exit(1)


if __name__ == '__main__':
    main()
