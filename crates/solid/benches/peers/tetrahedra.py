#!/usr/bin/env python3
"""Tetrahedra of driftlab and of TetGen, on the same meshes, one after the other.

usage: tetrahedra.py DRIFTLAB MESH... [--switches pYYQ]

DRIFTLAB is the built command; MESH are OFF, OBJ, or PLY as driftlab writes it. TetGen comes from its
Python package (`pip install tetgen`); with YY it keeps the surface as it is, as driftlab does. Each runs
once, on one thread; seconds are those of the processor: of the whole command, which reads and checks the
file, and of TetGen's call alone. Points added are counted against the vertices of the input.
"""
import json
import os
import resource
import subprocess
import sys
import time

import numpy as np


def fan(corners):
    return [(corners[0], corners[i], corners[i + 1]) for i in range(1, len(corners) - 1)]


def read_off(path):
    words = ' '.join(line.split('#')[0] for line in open(path)).split()
    if words[0].upper() == 'OFF':
        words = words[1:]
    points, faces = int(words[0]), int(words[1])
    vertices = np.array(words[3:3 + 3 * points], float).reshape(-1, 3)
    at, triangles = 3 + 3 * points, []
    for _ in range(faces):
        count = int(words[at])
        triangles += fan([int(w) for w in words[at + 1:at + 1 + count]])
        at += 1 + count
    return vertices, np.array(triangles, np.int32)


def read_obj(path):
    vertices, triangles = [], []
    for line in open(path):
        words = line.split()
        if words[:1] == ['v']:
            vertices.append([float(w) for w in words[1:4]])
        elif words[:1] == ['f']:
            index = [int(w.split('/')[0]) for w in words[1:]]
            triangles += fan([i - 1 if i > 0 else len(vertices) + i for i in index])
    return np.array(vertices), np.array(triangles, np.int32)


def read_ply(path):
    """Binary, little-endian: doubles x y z, and faces of a uchar count, uints, and bytes behind them."""
    data = open(path, 'rb').read()
    at = data.index(b'end_header\n') + 11
    head = data[:at].decode().splitlines()
    points, faces = (int(l.split()[2]) for l in head if l.startswith('element'))
    split = next(i for i, line in enumerate(head) if line.startswith('element face'))
    kinds = {'double': 8, 'float': 4, 'uchar': 1, 'uint': 4, 'int': 4}
    width = [sum(kinds[l.split()[1]] for l in part if l.startswith('property') and 'list' not in l)
             for part in (head[:split], head[split:])]
    vertices = np.array([np.frombuffer(data, '<f8', 3, at + i * width[0]) for i in range(points)])
    at += points * width[0]
    triangles = []
    for _ in range(faces):
        triangles += fan(np.frombuffer(data, '<u4', data[at], at + 1).tolist())
        at += 1 + 4 * data[at] + width[1]
    return vertices, np.array(triangles, np.int32)


def ours(command, path):
    def used():
        usage = resource.getrusage(resource.RUSAGE_CHILDREN)
        return usage.ru_utime + usage.ru_stime

    start = used()
    run = subprocess.run([command, 'mesh', 'tetrahedralize', path, '--json', '-q'],
                         capture_output=True, text=True)
    seconds = used() - start
    if run.returncode:
        return None, run.stderr.strip()[:90]
    told = json.loads(run.stdout)
    return (told['tetrahedra'], told['steiner_points'], seconds), None


def theirs(vertices, triangles, switches):
    import tetgen
    start = time.process_time()
    # The library talks to standard output whatever it is told.
    sys.stdout.flush()
    kept, nowhere = os.dup(1), os.open(os.devnull, os.O_WRONLY)
    os.dup2(nowhere, 1)
    try:
        points, tetrahedra = tetgen.TetGen(vertices, triangles).tetrahedralize(switches=switches)[:2]
    except RuntimeError as error:
        return None, str(error).replace('\n', ' ')[:60]
    finally:
        os.dup2(kept, 1)
        os.close(kept)
        os.close(nowhere)
    return (len(tetrahedra), len(points) - len(vertices), time.process_time() - start), None


def main():
    words = sys.argv[1:]
    switches = 'pYYQ'
    if '--switches' in words:
        at = words.index('--switches')
        switches = words[at + 1]
        del words[at:at + 2]
    command, *paths = words
    readers = {'.off': read_off, '.obj': read_obj, '.ply': read_ply}
    print('| mesh | vertices | faces | tetrahedra: driftlab | TetGen | ratio | added: driftlab | TetGen '
          '| seconds: driftlab | TetGen | ratio |')
    print('|---|' + '--:|' * 10)
    for path in paths:
        name, extension = os.path.splitext(os.path.basename(path))
        vertices, triangles = readers[extension](path)
        told, why = ours(command, path)
        other, why_not = theirs(vertices, triangles, switches)
        cells = [name, len(vertices), len(triangles)]
        for i in range(3):
            form = (lambda x: f'{x:.3f}') if i == 2 else str
            cells.append(form(told[i]) if told else (why if i == 0 else ''))
            cells.append(form(other[i]) if other else (why_not if i == 0 else ''))
            if i != 1:
                cells.append(f'{told[i] / max(other[i], 1e-9):.2f}' if told and other else '')
        print('| ' + ' | '.join(map(str, cells)) + ' |', flush=True)


if __name__ == '__main__':
    main()
