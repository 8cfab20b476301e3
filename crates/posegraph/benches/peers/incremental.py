"""GTSAM's iSAM2 pose by pose: incremental.py FILE.g2o ...; prints a row per file, CPU time of the updates alone."""

import sys
import tempfile
import time

import gtsam
import numpy as np

import graph as files


def feed(path):
    graph = files.read(path)
    with tempfile.NamedTemporaryFile(suffix=".g2o") as named:
        files.write(named.name, graph, files.odometry(graph))
        factors, _ = gtsam.readG2o(named.name, graph.space)
    steps = [[] for _ in graph.ids]
    for at, (a, b, *_) in enumerate(graph.edges):
        steps[max(a, b)].append((min(a, b) + 1 != max(a, b), at))
    params = gtsam.ISAM2Params()
    params.setRelinearizeThreshold(0.01)
    params.relinearizeSkip = 1
    isam = gtsam.ISAM2(params)
    pose_of = isam.calculateEstimatePose3 if graph.space else isam.calculateEstimatePose2
    times = []
    for vertex, step in enumerate(steps):
        new, start = gtsam.NonlinearFactorGraph(), gtsam.Values()
        for _, at in sorted(step):
            new.add(factors.at(at))
        if vertex == 0:
            pose = gtsam.Pose3() if graph.space else gtsam.Pose2()
            prior = gtsam.PriorFactorPose3 if graph.space else gtsam.PriorFactorPose2
            size = 6 if graph.space else 3
            new.add(prior(0, pose, gtsam.noiseModel.Isotropic.Sigma(size, 1e-3)))
        else:
            first = sorted(step)[0][1]
            a, b = graph.edges[first][:2]
            measured = factors.at(first).measured()
            pose = pose_of(a).compose(measured) if b == vertex else pose_of(b).compose(measured.inverse())
        start.insert(vertex, pose)
        begun = time.process_time()
        isam.update(new, start)
        times.append(time.process_time() - begun)
    begun = time.process_time()
    for _ in range(3):
        isam.update()
    finish = time.process_time() - begun
    poses = []
    for vertex in range(len(graph.ids)):
        pose = pose_of(vertex)
        if graph.space:
            q = pose.rotation().toQuaternion()
            poses.append([*pose.translation(), q.x(), q.y(), q.z(), q.w()])
        else:
            poses.append([pose.x(), pose.y(), pose.theta()])
    return times, finish, files.chi2(graph, poses)


print("| graph | poses | total s | median ms | p95 | p99 | max | three more updates ms | chi2 |")
print("|---|---|---|---|---|---|---|---|---|")
for path in sys.argv[1:]:
    times, finish, cost = feed(path)
    median, p95, p99, longest = np.percentile(np.array(times) * 1e3, [50, 95, 99, 100])
    print(f"| {path.rsplit('/', 1)[-1]} | {len(times)} | {sum(times) + finish:.2f} | {median:.2f} | {p95:.2f} | {p99:.2f}"
          f" | {longest:.1f} | {finish * 1e3:.0f} | {cost:.8g} |")
