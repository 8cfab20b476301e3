"""Time per iteration and memory of g2o on graphs of growing size: growth.py PYTHON_OF_G2O DRIFTLAB [SECONDS].

`cargo bench -p posegraph --bench incremental -- growth` prints the same for this crate. A case that takes longer than
SECONDS is left out."""

import json
import pathlib
import subprocess
import sys
import tempfile

HERE = pathlib.Path(__file__).parent
CASES = [("manhattan", 1000), ("manhattan", 10_000), ("manhattan", 100_000),
         ("lattice", 1000), ("lattice", 10_648), ("lattice", 29_791)]


def main():
    python, driftlab = sys.argv[1:3]
    limit = float(sys.argv[3]) if len(sys.argv) > 3 else 600.0
    print("| graph | poses | iteration ms | MB beyond the loaded graph |\n|---|---|---|---|", flush=True)
    with tempfile.TemporaryDirectory() as scratch:
        source, target = f"{scratch}/in.g2o", f"{scratch}/out.g2o"
        for shape, poses in CASES:
            made = [driftlab, "graph", "generate", shape, "--poses", str(poses), "-o", source, "--force"]
            subprocess.run(made, check=True, capture_output=True)
            try:
                few, many = (run(python, source, target, iterations, limit) for iterations in (1, 3))
            except subprocess.TimeoutExpired:
                print(f"| {shape} | {poses} | over {limit:.0f} s for three | |", flush=True)
                continue
            each = (many["secs"] - few["secs"]) / max(many["iterations"] - few["iterations"], 1)
            print(f"| {shape} | {poses} | {each * 1e3:.1f} | {many['mb_peak'] - many['mb_loaded']:.0f} |", flush=True)


def run(python, source, target, iterations, limit):
    command = [python, str(HERE / "run_g2o.py"), source, target, str(iterations)]
    done = subprocess.run(command, capture_output=True, text=True, timeout=limit, check=True)
    return json.loads(done.stdout.strip().splitlines()[-1])


main()
