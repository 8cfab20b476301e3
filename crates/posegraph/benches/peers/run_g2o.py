"""Optimises a g2o file with g2o: run_g2o.py IN OUT [ITERATIONS]; prints one line of JSON.

The wheel reads no files, so the graph is built through its interface."""

import json
import resource
import sys
import time

import g2o
import numpy as np

import graph as files

source, target = sys.argv[1:3]
limit = int(sys.argv[3]) if len(sys.argv) > 3 else 100
graph = files.read(source)

optimizer = g2o.SparseOptimizer()
if graph.space:
    block = g2o.BlockSolverSE3(g2o.LinearSolverEigenSE3())
    new_vertex, new_edge = g2o.VertexSE3, g2o.EdgeSE3

    def as_pose(numbers):
        rotation = g2o.Quaternion(numbers[6], *numbers[3:6]).matrix()
        return g2o.Isometry3d(rotation, np.array(numbers[:3]))

    def as_numbers(pose):
        q = g2o.Quaternion(pose.R)
        return [*pose.t, q.x(), q.y(), q.z(), q.w()]

else:
    block = g2o.BlockSolverSE2(g2o.LinearSolverEigenSE2())
    new_vertex, new_edge = g2o.VertexSE2, g2o.EdgeSE2
    as_pose = lambda numbers: g2o.SE2(*numbers)
    as_numbers = lambda pose: list(pose.to_vector())
optimizer.set_algorithm(g2o.OptimizationAlgorithmGaussNewton(block))

vertices = []
for at, numbers in enumerate(graph.poses):
    vertex = new_vertex()
    vertex.set_id(at)
    vertex.set_estimate(as_pose(numbers))
    vertex.set_fixed(at == 0)
    optimizer.add_vertex(vertex)
    vertices.append(vertex)
size = 6 if graph.space else 3
rows, columns = np.triu_indices(size)
for a, b, measured, upper in graph.edges:
    information = np.zeros((size, size))
    information[rows, columns] = upper
    information[columns, rows] = upper
    edge = new_edge()
    edge.set_vertex(0, vertices[a])
    edge.set_vertex(1, vertices[b])
    edge.set_measurement(as_pose(measured))
    edge.set_information(information)
    optimizer.add_edge(edge)

loaded = resource.getrusage(resource.RUSAGE_SELF).ru_maxrss / 1024
begun = time.process_time()
if len(sys.argv) <= 3:
    stop = g2o.SparseOptimizerTerminateAction()
    stop.set_gain_threshold(1e-6)
    optimizer.add_post_iteration_action(stop)
optimizer.initialize_optimization()
ready = time.process_time()
iterations = optimizer.optimize(limit)
ended = time.process_time()
files.write_poses(target, [as_numbers(vertex.estimate()) for vertex in vertices])
peak = resource.getrusage(resource.RUSAGE_SELF).ru_maxrss / 1024
print(json.dumps({"secs": ended - begun, "iterations": iterations, "secs_ready": ready - begun,
                  "mb_loaded": loaded, "mb_peak": peak}))
