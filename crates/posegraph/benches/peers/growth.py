"""Time per iteration and memory on graphs of growing size, beside g2o; prints a table and draws it.

    growth.py PYTHON_OF_G2O DRIFTLAB [--limit SECONDS] [--svg FILE]

A case of g2o that takes longer than the limit is left out, and so are larger ones of its kind."""

import argparse
import json
import os
import pathlib
import resource
import subprocess
import tempfile

import plot

HERE = pathlib.Path(__file__).parent
CASES = [("town (2D)", "manhattan", [1000, 10_000, 100_000]), ("lattice (3D)", "lattice", [1000, 10_648, 29_791])]
ONE_THREAD = {name: "1" for name in ("OMP_NUM_THREADS", "OPENBLAS_NUM_THREADS", "RAYON_NUM_THREADS", "TBB_NUM_THREADS")}
FEW, MANY = 1, 4


def run(command, limit=None):
    """The JSON that a command prints, the most memory it held (MB), and its CPU seconds."""
    with tempfile.TemporaryFile("w+") as output:
        child = subprocess.Popen(command, env={**os.environ, **ONE_THREAD}, stdout=output, stderr=subprocess.DEVNULL,
                                 preexec_fn=limited(limit))
        _, status, usage = os.wait4(child.pid, 0)
        child.returncode = os.waitstatus_to_exitcode(status)
        output.seek(0)
        text = output.read()
    if child.returncode != 0:
        return None, 0.0, 0.0
    return json.loads(text[text.index("{"):]), usage.ru_maxrss / 1024, usage.ru_utime + usage.ru_stime


def limited(secs):
    return (lambda: resource.setrlimit(resource.RLIMIT_CPU, (secs, secs + 2))) if secs else None


def ours(driftlab, source, target):
    """What few and many iterations of the whole process differ by, and the memory beyond reading the graph."""
    command = lambda iterations: [driftlab, "graph", "optimize", source, "--json", "--init", "spanning-tree",
                                  "--max-iterations", str(iterations)]
    _, loaded, _ = run([driftlab, "graph", "convert", source, "-o", target, "--force", "--json"])
    few, _, few_secs = best(command(FEW))
    many, peak, many_secs = best(command(MANY))
    return (many_secs - few_secs) / (many["iterations"] - few["iterations"]), max(peak - loaded, 0.1)


def best(command):
    """The run with the least CPU time; a single one where it takes long."""
    results = [run(command)]
    while results[0][2] < 1.0 and len(results) < 5:
        results.append(run(command))
    return min(results, key=lambda result: result[2])


def peers(python, source, target, limit):
    command = lambda iterations: [python, str(HERE / "run_g2o.py"), source, target, str(iterations)]
    few, _, _ = run(command(FEW), limit)
    many, _, _ = run(command(MANY), limit) if few else (None, 0.0, 0.0)
    if many is None:
        return None
    memory = max(many["mb_peak"] - many["mb_loaded"], 0.1)
    return (many["secs"] - few["secs"]) / (many["iterations"] - few["iterations"]), memory


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("g2o")
    parser.add_argument("driftlab")
    parser.add_argument("--limit", type=int, default=600)
    parser.add_argument("--svg")
    args = parser.parse_args()
    times, memories = [], []
    print("| graph | poses | factors | iteration ms | MB beyond the loaded graph | g2o: iteration ms | g2o: MB |")
    print("|---|---|---|---|---|---|---|", flush=True)
    with tempfile.TemporaryDirectory() as scratch:
        source, target = f"{scratch}/in.g2o", f"{scratch}/out.g2o"
        for name, shape, sizes in CASES:
            lines = {who: ([], []) for who in ("driftlab", "g2o")}
            measure_g2o = True
            for poses in sizes:
                made = [args.driftlab, "graph", "generate", shape, "--poses", str(poses), "-o", source, "--force"]
                subprocess.run(made, check=True, capture_output=True)
                with open(source) as text:
                    factors = sum(line.startswith("EDGE") for line in text)
                results = {"driftlab": ours(args.driftlab, source, target), "g2o": None}
                if measure_g2o:
                    results["g2o"] = peers(args.g2o, source, target, args.limit)
                    measure_g2o = results["g2o"] is not None
                for who, result in results.items():
                    if result:
                        lines[who][0].append((poses, result[0] * 1e3))
                        lines[who][1].append((poses, result[1]))
                cells = [f"{r[0] * 1e3:.1f} | {r[1]:.0f}" if r else "- | -" for r in results.values()]
                print(f"| {name} | {poses} | {factors} | {' | '.join(cells)} |", flush=True)
            times += [(f"{who}, {name}", line[0]) for who, line in lines.items()]
            memories += [(f"{who}, {name}", line[1]) for who, line in lines.items()]
    if args.svg:
        plot.write(args.svg, [("Time of an iteration", "poses", "ms (CPU)", times),
                              ("Memory beyond the loaded graph", "poses", "MB", memories)])


if __name__ == "__main__":
    main()
