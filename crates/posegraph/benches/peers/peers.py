"""driftlab beside g2o and GTSAM on a folder of g2o files; see README.md here."""

import argparse
import json
import os
import pathlib
import resource
import subprocess
import sys
import tempfile

import graph as files

HERE = pathlib.Path(__file__).parent
ONE_THREAD = {name: "1" for name in ("OMP_NUM_THREADS", "OPENBLAS_NUM_THREADS", "RAYON_NUM_THREADS", "TBB_NUM_THREADS")}


def cpu_of_children():
    usage = resource.getrusage(resource.RUSAGE_CHILDREN)
    return usage.ru_utime + usage.ru_stime


def limited(secs):
    return lambda: resource.setrlimit(resource.RLIMIT_CPU, (secs, secs + 2))


def run(command, limit):
    """Output of a command and its CPU seconds; None where it fails."""
    before = cpu_of_children()
    done = subprocess.run(command, env={**os.environ, **ONE_THREAD}, cwd=tempfile.gettempdir(),
                          capture_output=True, text=True, preexec_fn=limited(limit))
    secs = cpu_of_children() - before
    try:
        return json.loads(done.stdout[done.stdout.index("{"):]), secs
    except ValueError:
        return None, secs


def cpu_of_ours(said):
    """CPU seconds of start and optimisation, as the peers measure their own."""
    return said["cpu_secs_init"] + said["cpu_secs_optimize"]


def best_of(command, runs, limit):
    """The run with the least CPU time in the optimiser, with the least CPU time of the process."""
    results = []
    for _ in range(runs):
        result, secs = run(command, limit)
        if result is None:
            return None
        if "secs_optimize" in result:
            result["secs"] = cpu_of_ours(result)
        results.append((result["secs"], secs, result))
        if secs > 5:
            break
    return min(r[0] for r in results), min(r[1] for r in results), results[0][2]


def main():
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("folder", type=pathlib.Path)
    parser.add_argument("--driftlab", default="target/release/driftlab")
    parser.add_argument("--g2o", help="python with g2o-python and numpy<2")
    parser.add_argument("--gtsam", help="python with gtsam")
    parser.add_argument("--init", default="file", help="start that driftlab computes; 'file' is the odometry chain")
    parser.add_argument("--runs", type=int, default=5)
    parser.add_argument("--limit", type=int, default=120, help="CPU seconds of a run")
    parser.add_argument("--only", help="part of a file's name")
    args = parser.parse_args()
    driftlab = str(pathlib.Path(args.driftlab).resolve())
    print("| graph | poses | solver | iterations | init + optimise s | process s | chi2 | optimise, of ours | process, of ours |")
    print("|---|---|---|---|---|---|---|---|---|")
    with tempfile.TemporaryDirectory() as scratch:
        for path in sorted(args.folder.glob("*.g2o")):
            if args.only and args.only not in path.name:
                continue
            graph = files.read(path)
            source, target = f"{scratch}/in.g2o", f"{scratch}/out.g2o"
            files.write(source, graph, files.odometry(graph))
            solvers = {
                "driftlab": [driftlab, "graph", "optimize", source, "-o", target, "--force",
                             "--init", args.init, "--json"],
            }
            for name in ("g2o", "gtsam"):
                python = getattr(args, name)
                if python:
                    solvers[name] = [python, str(HERE / f"run_{name}.py"), source, target]
            ours = None
            for name, command in solvers.items():
                pathlib.Path(target).unlink(missing_ok=True)
                result = best_of(command, args.runs, args.limit)
                if result is None:
                    print(f"| {path.stem} | {len(graph.ids)} | {name} | fails | | | | | |")
                    continue
                secs, process, said = result
                cost = files.chi2(graph, files.read_poses(target, len(graph.ids)))
                ours = ours or (secs, process)
                print(f"| {path.stem} | {len(graph.ids)} | {name} | {said.get('iterations')} | {secs:.4f} | {process:.3f}"
                      f" | {cost:.8g} | {secs / ours[0]:.2f} | {process / ours[1]:.1f} |")
                sys.stdout.flush()


if __name__ == "__main__":
    main()
