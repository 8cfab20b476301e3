"""Real depth images as the frames that `benches/relative.rs` reads.

Needs `pip install numpy pillow`.

    python frames_of_folder.py FOLDER OUT FX FY CX CY UNITS_PER_METRE

Of each image `*depth*` of FOLDER the pose is the file `*.pose.txt` of the same name (4 by 4), else the line of
`pose.txt` (x y z qx qy qz qw) in order, else the origin.
"""

import pathlib
import re
import sys

import numpy as np
from PIL import Image


def quaternion(r):
    """x y z w of a rotation matrix, by its largest diagonal."""
    four = [r[0][0] - r[1][1] - r[2][2], r[1][1] - r[0][0] - r[2][2], r[2][2] - r[0][0] - r[1][1], np.trace(r)]
    k = int(np.argmax(four))
    s = 2.0 * np.sqrt(1.0 + four[k])
    if k == 3:
        return [(r[2][1] - r[1][2]) / s, (r[0][2] - r[2][0]) / s, (r[1][0] - r[0][1]) / s, s / 4]
    i, j, l = k, (k + 1) % 3, (k + 2) % 3
    q = [0.0] * 4
    q[i], q[j], q[l] = s / 4, (r[j][i] + r[i][j]) / s, (r[l][i] + r[i][l]) / s
    q[3] = (r[l][j] - r[j][l]) / s
    return q


def main():
    folder, out = pathlib.Path(sys.argv[1]), pathlib.Path(sys.argv[2])
    fx, fy, cx, cy, units = (float(x) for x in sys.argv[3:8])
    out.mkdir(parents=True, exist_ok=True)
    images = [p for p in folder.iterdir() if "depth" in p.name and p.suffix in (".png", ".pgm")]
    images.sort(key=lambda p: int(re.search(r"[0-9]+", p.name).group()))
    lines = folder / "pose.txt"
    lines = lines.read_text().splitlines() if lines.exists() else []
    for number, path in enumerate(images):
        levels = np.asarray(Image.open(path)).astype(np.float64)
        levels[levels >= 65535] = 0
        (levels / units).astype("<f4").tofile(out / f"{number:04}.f32")
        matrix = path.with_name(path.name.replace(".depth.png", ".pose.txt"))
        pose = [0, 0, 0, 0, 0, 0, 1]
        if matrix != path and matrix.exists():
            m = np.loadtxt(matrix)
            pose = [*m[:3, 3], *quaternion(m[:3, :3])]
        elif number < len(lines):
            pose = [float(x) for x in lines[number].split()]
        (out / f"{number:04}.pose").write_text(" ".join(str(float(x)) for x in pose) + "\n")
    rows, columns = levels.shape
    (out / "camera").write_text(f"{columns} {rows} {fx} {fy} {cx} {cy}\n")


main()
