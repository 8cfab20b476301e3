"""Pose graphs in g2o's format, and the cost of poses: plain Python, so that any interpreter can run it."""

import math


class Graph:
    """Vertices by dense index; a pose is (x, y, theta) in the plane and (x, y, z, qx, qy, qz, qw) in space."""

    def __init__(self, space, ids, poses, edges):
        self.space, self.ids, self.poses, self.edges = space, ids, poses, edges


def read(path):
    space, vertices, edges = False, {}, []
    with open(path) as lines:
        for line in lines:
            words = line.split()
            tag = words[0] if words else ""
            if tag.startswith("VERTEX_SE"):
                vertices[int(words[1])] = [float(word) for word in words[2:]]
            elif tag.startswith("EDGE_SE"):
                space = tag == "EDGE_SE3:QUAT"
                size = 7 if space else 3
                numbers = [float(word) for word in words[3:]]
                measured = numbers[:size]
                if space:
                    measured[3:] = unit(measured[3:])
                edges.append((int(words[1]), int(words[2]), measured, numbers[size:]))
    ids = sorted({end for edge in edges for end in edge[:2]})
    index = {vertex: at for at, vertex in enumerate(ids)}
    edges = [(index[a], index[b], measured, upper) for a, b, measured, upper in edges]
    return Graph(space, ids, [vertices.get(vertex) for vertex in ids], edges)


def write(path, graph, poses):
    vertex, edge = ("VERTEX_SE3:QUAT", "EDGE_SE3:QUAT") if graph.space else ("VERTEX_SE2", "EDGE_SE2")
    words = lambda numbers: " ".join(map(repr, numbers))
    with open(path, "w") as out:
        for at, pose in enumerate(poses):
            out.write(f"{vertex} {at} {words(pose)}\n")
        for a, b, measured, upper in graph.edges:
            out.write(f"{edge} {a} {b} {words(measured)} {words(upper)}\n")


def write_poses(path, poses):
    with open(path, "w") as out:
        for at, pose in enumerate(poses):
            tag = "VERTEX_SE2" if len(pose) == 3 else "VERTEX_SE3:QUAT"
            out.write(f"{tag} {at} {' '.join(repr(float(x)) for x in pose)}\n")


def read_poses(path, count):
    poses = [None] * count
    with open(path) as lines:
        for line in lines:
            if line.startswith("VERTEX_SE"):
                words = line.split()
                poses[int(words[1])] = [float(word) for word in words[2:]]
    return poses


def unit(q):
    norm = math.sqrt(sum(x * x for x in q))
    return [x / norm for x in q]


def times(a, b):
    """Product of quaternions, scalar last."""
    ax, ay, az, aw = a
    bx, by, bz, bw = b
    return [
        aw * bx + ax * bw + ay * bz - az * by,
        aw * by - ax * bz + ay * bw + az * bx,
        aw * bz + ax * by - ay * bx + az * bw,
        aw * bw - ax * bx - ay * by - az * bz,
    ]


def turn(q, v):
    """A vector turned by a unit quaternion."""
    moved = times(times(q, [*v, 0.0]), [-q[0], -q[1], -q[2], q[3]])
    return moved[:3]


def compose(a, b):
    if len(a) == 3:
        c, s = math.cos(a[2]), math.sin(a[2])
        angle = math.remainder(a[2] + b[2], math.tau)
        return [a[0] + c * b[0] - s * b[1], a[1] + s * b[0] + c * b[1], angle]
    t = turn(a[3:], b[:3])
    return [a[0] + t[0], a[1] + t[1], a[2] + t[2], *unit(times(a[3:], b[3:]))]


def inverse(a):
    if len(a) == 3:
        c, s = math.cos(a[2]), math.sin(a[2])
        return [-c * a[0] - s * a[1], s * a[0] - c * a[1], -a[2]]
    q = [-a[3], -a[4], -a[5], a[6]]
    return [*(-x for x in turn(q, a[:3])), *q]


def odometry(graph):
    """The chain of the first edge from each vertex to the next, else to the nearest earlier one."""
    steps = [None] * len(graph.ids)
    for a, b, measured, _ in graph.edges:
        low, high = min(a, b), max(a, b)
        rank = (low, a == low)
        if low != high and (steps[high] is None or rank > steps[high][0]):
            steps[high] = (rank, measured if a == low else inverse(measured))
    origin = [0.0] * 6 + [1.0] if graph.space else [0.0] * 3
    poses = []
    for step in steps:
        if step is None:
            poses.append(poses[-1] if poses else origin)
        else:
            poses.append(compose(poses[step[0][0]], step[1]))
    return poses


def chi2(graph, poses):
    """Sum of e' W e, without one half; e is translation and angle, or vector part of the quaternion."""
    size = 6 if graph.space else 3
    total = 0.0
    for a, b, measured, upper in graph.edges:
        gap = compose(inverse(measured), compose(inverse(poses[a]), poses[b]))
        if graph.space:
            sign = -1.0 if gap[6] < 0.0 else 1.0
            gap = [*gap[:3], *(sign * x for x in gap[3:6])]
        at = 0
        for row in range(size):
            total += upper[at] * gap[row] ** 2
            at += 1
            for column in range(row + 1, size):
                total += 2.0 * upper[at] * gap[row] * gap[column]
                at += 1
    return total
