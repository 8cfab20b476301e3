"""Optimises a g2o file with GTSAM's Gauss-Newton: run_gtsam.py IN OUT; prints one line of JSON."""

import json
import sys
import time

import gtsam
import numpy as np

import graph as files

source, target = sys.argv[1:3]
with open(source) as lines:
    space = "SE3" in lines.readline()
factors, start = gtsam.readG2o(source, space)
begun = time.process_time()
if space:
    prior = gtsam.noiseModel.Isotropic.Sigma(6, 1e-3)
    factors.add(gtsam.PriorFactorPose3(0, start.atPose3(0), prior))
else:
    prior = gtsam.noiseModel.Isotropic.Sigma(3, 1e-3)
    factors.add(gtsam.PriorFactorPose2(0, start.atPose2(0), prior))
params = gtsam.GaussNewtonParams()
params.setMaxIterations(100)
optimizer = gtsam.GaussNewtonOptimizer(factors, start, params)
result = optimizer.optimize()
secs = time.process_time() - begun
poses = []
for at in range(result.size()):
    if space:
        pose = result.atPose3(at)
        q = pose.rotation().toQuaternion()
        poses.append([*np.asarray(pose.translation()), q.x(), q.y(), q.z(), q.w()])
    else:
        pose = result.atPose2(at)
        poses.append([pose.x(), pose.y(), pose.theta()])
files.write_poses(target, poses)
print(json.dumps({"secs": secs, "iterations": optimizer.iterations()}))
