"""OctoMap at 5 cm over the frames that `benches/relative.rs` wrote, beside its times.

Needs `pip install numpy octomap-python`. Processor time of each insertion of a whole cloud with rays, in
milliseconds, and the memory of the tree.

    cargo bench -p maps3d --bench relative -- 60 FOLDER
    python octomap_frames.py FOLDER
"""

import pathlib
import sys
import time

import numpy as np
import octomap

RANGE_M = 8.0


def turned(q):
    x, y, z, w = q
    return np.array(
        [
            [1 - 2 * (y * y + z * z), 2 * (x * y - z * w), 2 * (x * z + y * w)],
            [2 * (x * y + z * w), 1 - 2 * (x * x + z * z), 2 * (y * z - x * w)],
            [2 * (x * z - y * w), 2 * (y * z + x * w), 1 - 2 * (x * x + y * y)],
        ]
    )


def main():
    folder = pathlib.Path(sys.argv[1])
    columns, rows, fx, fy, cx, cy = (float(x) for x in (folder / "camera").read_text().split())
    columns, rows = int(columns), int(rows)
    tree = octomap.OcTree(0.05)
    v, u = np.mgrid[0:rows, 0:columns]
    times = []
    for path in sorted(folder.glob("*.f32")):
        depth = np.fromfile(path, dtype="<f4").reshape(rows, columns).astype(np.float64)
        pose = np.array(path.with_suffix(".pose").read_text().split(), dtype=np.float64)
        good = np.isfinite(depth) & (depth > 0)
        z = depth[good]
        points = np.stack([(u[good] - cx) / fx * z, (v[good] - cy) / fy * z, z], axis=1)
        points = np.ascontiguousarray(points @ turned(pose[3:]).T + pose[:3])
        started = time.process_time()
        tree.insertPointCloud(points, pose[:3], RANGE_M, True, False)
        times.append(1e3 * (time.process_time() - started))
        if len(times) % 10 == 0:
            print(f"frame {len(times)}: median of the last ten {np.median(times[-10:]):.1f} ms")
    print(f"OctoMap 5 cm: median {np.median(times):.1f} ms over {len(times)} frames, ", end="")
    print(f"{tree.memoryUsage() / 1024:.0f} KiB, {tree.getNumLeafNodes()} leaves")


main()
