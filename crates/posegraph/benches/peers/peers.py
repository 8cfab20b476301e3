"""driftlab beside its peers on a folder of g2o files; see README.md here."""

import argparse
import json
import os
import pathlib
import resource
import statistics
import subprocess
import sys
import tempfile

import graph as files

HERE = pathlib.Path(__file__).parent
ONE_THREAD = {name: "1" for name in ("OMP_NUM_THREADS", "OPENBLAS_NUM_THREADS", "RAYON_NUM_THREADS", "TBB_NUM_THREADS")}


# What each is started with.
PEERS = {"g2o": "python", "gtsam": "python", "apex": "binary", "factrs": "binary"}

# Above so many times our cost a peer ended in another minimum, or nowhere: its time is none for the same work. Below,
# the cost may still be another one that it minimises.
ELSEWHERE = 2.0

HEAD = """| graph | poses | iterations | optimise: driftlab | {peers} | of the fastest | process: driftlab | own start | {peers} | of the fastest | own start | chi2 | {peers} |
|{lines}"""


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


def median_of(command, runs, limit):
    """Medians of CPU time in the optimiser and of the process, and what the first run said."""
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
    return statistics.median(r[0] for r in results), statistics.median(r[1] for r in results), results[0][2]


def main():
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("folder", type=pathlib.Path)
    parser.add_argument("--driftlab", default="target/release/driftlab")
    parser.add_argument("--g2o", help="python with g2o-python and numpy<2")
    parser.add_argument("--gtsam", help="python with gtsam")
    parser.add_argument("--apex", help="the binary that apex/ here builds")
    parser.add_argument("--factrs", help="the binary that factrs/ here builds")
    parser.add_argument("--init", default="file", help="start that driftlab computes; 'file' is the odometry chain")
    parser.add_argument("--runs", type=int, default=5)
    parser.add_argument("--limit", type=int, default=120, help="CPU seconds of a run")
    parser.add_argument("--only", help="part of a file's name")
    args = parser.parse_args()
    driftlab = str(pathlib.Path(args.driftlab).resolve())
    peers = [name for name in PEERS if getattr(args, name)]
    print(HEAD.format(peers=" | ".join(peers), lines="---|" * (3 * len(peers) + 10)))
    with tempfile.TemporaryDirectory() as scratch:
        for path in sorted(args.folder.glob("*.g2o")):
            if args.only and args.only not in path.name:
                continue
            graph = files.read(path)
            source, target = f"{scratch}/in.g2o", f"{scratch}/out.g2o"
            files.write(source, graph, files.odometry(graph))
            ours = [driftlab, "graph", "optimize", source, "-o", target, "--force", "--json"]
            commands = {"driftlab": [*ours, "--init", args.init], "own start": ours}
            for name in peers:
                if PEERS[name] == "python":
                    commands[name] = [getattr(args, name), str(HERE / f"run_{name}.py"), source, target]
                else:
                    commands[name] = [str(pathlib.Path(getattr(args, name)).resolve()), source, target]
            results = {}
            for name, command in commands.items():
                pathlib.Path(target).unlink(missing_ok=True)
                found = median_of(command, args.runs, args.limit)
                if found:
                    cost = files.chi2(graph, files.read_poses(target, len(graph.ids)))
                    results[name] = found[0], found[1], cost, found[2].get("iterations")
            print(row(path.stem, len(graph.ids), peers, results), flush=True)


def row(name, poses, peers, results):
    """One line of the table: milliseconds, and what ours is of the fastest peer that came as low."""
    if "driftlab" not in results:
        return f"| {name} | {poses} | fails |"
    ours = results["driftlab"]
    cells = [name, str(poses), str(ours[3])]
    for which in (0, 1):
        own = results["own start"][1]
        times = [results[peer][which] if peer in results else None for peer in peers]
        cells.append(f"{ours[which] * 1e3:.4g}")
        cells += [f"{own * 1e3:.4g}"] if which else []
        cells += [f"{time * 1e3:.4g}" if time else "fails" for time in times]
        ended = [time for peer, time in zip(peers, times) if time and results[peer][2] < ELSEWHERE * ours[2]]
        for time in [ours[which], own] if which else [ours[which]]:
            cells.append(f"{time / min(ended):.2f}" if ended else "")
    cells.append(f"{ours[2]:.8g}")
    for peer in peers:
        cells.append(f"{results[peer][2] / ours[2] - 1:+.1e}" if peer in results else "")
    return f"| {' | '.join(cells)} |"


if __name__ == "__main__":
    main()
