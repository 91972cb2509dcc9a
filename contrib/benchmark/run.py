#!/usr/bin/env python3
"""Time Stockwork on three jobs, beside peers if their programs are at hand.

    contrib/benchmark/run.py [--program build/source/stockwork] [--cases mandel2d/33 footing3d/12 ...]
                             [--ranks 1 2] [--repeat 3]
                             [--dolfinx SCRIPT] [--dealii PROGRAM]

MANDEL2D(n)   [0,100] x [0,10] m, 10 n x n squares, Q2-Q1, plate displacement prescribed, dt 10 s
FOOTING3D(n)  [0,10]^3 m, n^3 hexahedra, Q2-Q1, load on a quarter of the top, dt 1 s
kgd           prm/kgd/toughness and viscosity, coarse: the whole run

A *step* is assembly + preconditioner (or factor) + solve, as the peers count it: the difference
of a run of many steps and one of few, per step, so that start-up, the first factorisation and
output do not count. `full`: every step has another length, so matrix and factor are made anew.
`reused`: steps of one length, the factor stays. Runs alternate with the peers', pinned to one core
per rank, BLAS and OpenMP with one thread; the median counts. Quote the machine's load with it: on a
busy machine compare ratios, not seconds.

Peers print one line of JSON with the entries `step` and `ndof` (Biot: `SCRIPT perf CASE N --solver
mumps|fs-hypre --steps K`; `PROGRAM CASE N K`). They are not part of this repository.
"""
import argparse
import json
import os
import shutil
import statistics
import subprocess
import sys
import tempfile

HERE = os.path.dirname(os.path.abspath(__file__))
ROOT = os.path.join(HERE, "..", "..")
sys.path.insert(0, os.path.join(HERE, ".."))
from results import read_summary  # noqa: E402

ENVIRONMENT = dict(os.environ, OMP_NUM_THREADS="1", OPENBLAS_NUM_THREADS="1",
                   DEAL_II_NUM_THREADS="1")

# Number of steps of the short and the long run.
SHORT, LONG = 3, 9


def mandel(n):
    return ["mandel_2d.prm", "Mesh/Box/X spacing=%d cells" % (10 * n),
            "Mesh/Box/Y spacing=%d cells" % n], 10.


def footing(n):
    return ["footing_3d.prm", *("Mesh/Box/%s spacing=%d cells" % (axis, n) for axis in "XYZ")], 1.


BIOT = {"mandel2d": mandel, "footing3d": footing}


def run(command, ranks):
    """Standard output of a command on so many ranks, one core each."""
    if ranks > 1:
        command = ["mpirun", "--allow-run-as-root", "--bind-to", "core", "-np", str(ranks), *command]
    elif shutil.which("taskset"):
        command = ["taskset", "-c", str(max(os.sched_getaffinity(0))), *command]
    done = subprocess.run(command, env=ENVIRONMENT, capture_output=True, text=True)
    if done.returncode:
        sys.exit(f"{' '.join(command)}\nexit status {done.returncode}\n{done.stdout[-2000:]}"
                 f"{done.stderr[-2000:]}")
    return done.stdout


def stockwork(options, deck, settings, ranks):
    """summary.json of one run."""
    with tempfile.TemporaryDirectory() as output:
        command = [options.program, deck, "--output", output]
        for setting in settings:
            command += ["--set", setting]
        run(command, ranks)
        return read_summary(output)


def own_step(options, case, n, solver, reuse, ranks):
    """(seconds of one step, summary of the long run)."""
    (deck, *settings), dt = BIOT[case](n)
    growth = 1. if reuse else 1.0001
    summaries = []
    for steps in (SHORT, LONG):
        end = dt * (steps if growth == 1. else (growth**steps - 1) / (growth - 1))
        summaries.append(stockwork(options, os.path.join(ROOT, "prm", "benchmark", deck), [
            *settings, f"Linear solver/Type={solver}", f"Time/Initial step={dt}",
            f"Time/Step growth={growth}",
            "Time/Scheme=backward Euler", "Time/Error tolerance=inf", f"Time/End time={end * (1 + 1e-12)!r}"], ranks))
    seconds = [sum(s["wall_seconds"].get(phase, 0.)
                   for phase in ("assembly", "preconditioner", "solve")) for s in summaries]
    steps = [s["steps"] for s in summaries]
    return (seconds[1] - seconds[0]) / (steps[1] - steps[0]), summaries[1]


def peer_step(command, ranks):
    lines = [line for line in run(command, ranks).splitlines() if line.startswith("{")]
    return json.loads(lines[-1])


def median_row(label, attempts, peer=None):
    """One line of the table; the median of the attempts, and its ratio to the peer's."""
    seconds = statistics.median(attempts)
    spread = (max(attempts) - min(attempts)) / seconds
    ratio = f"{seconds / peer:8.2f}" if peer else " " * 8
    print(f"  {label:34s} {seconds:9.4f} s   spread {100 * spread:3.0f} %  {ratio}", flush=True)
    return seconds


def biot(options, case, n, ranks):
    direct = case == "mandel2d"
    kinds = [("direct, full", "direct", False), ("direct, reused", "direct", True)] if direct else []
    kinds += [("iterative, full", "iterative", False), ("iterative, reused", "iterative", True)]
    peers = []
    if options.dolfinx:
        base = [options.python, options.dolfinx, "perf", case, str(n), "--steps", "5"]
        if direct:
            peers += [("dolfinx+MUMPS, full", [*base, "--solver", "mumps"], "direct, full"),
                      ("dolfinx+MUMPS, reused", [*base, "--solver", "mumps", "--reuse"],
                       "direct, reused")]
        peers.append(("dolfinx+hypre, full", [*base, "--solver", "fs-hypre"], "iterative, full"))
    if options.dealii:
        peers.append(("deal.II+ML, full", [options.dealii, case, str(n), "5"], "iterative, full"))

    own, other, last = {k[0]: [] for k in kinds}, {p[0]: [] for p in peers}, {}
    for _ in range(options.repeat):
        for label, solver, reuse in kinds:
            seconds, last[label] = own_step(options, case, n, solver, reuse, ranks)
            own[label].append(seconds)
        for label, command, _ in peers:
            other[label].append(peer_step(command, ranks)["step"])

    unknowns = last[kinds[0][0]]["unknowns"]
    print(f"\n{case.upper()}({n}), {unknowns} unknowns, {ranks} rank(s)"
          f"{'':20s}{'ours/peer':>38s}" if peers else
          f"\n{case.upper()}({n}), {unknowns} unknowns, {ranks} rank(s)")
    medians = {label: median_row(label, attempts) for label, attempts in other.items()}
    for label, _, _ in kinds:
        rivals = [(name, medians[name]) for name, _, against in peers if against == label]
        if not rivals:
            median_row("stockwork " + label, own[label])
        for name, seconds in rivals:
            median_row(f"stockwork {label}", own[label], seconds)
        summary = last[label]
        print(f"    {summary['linear_iterations'] / summary['steps']:.1f} linear iterations a step, "
              f"{summary['peak_memory_bytes'] / summary['unknowns'] / 1e3:.2f} kB an unknown, "
              + ", ".join(f"{k} {v:.2f}" for k, v in summary["wall_seconds"].items()) + " s")


def kgd(options, name, ranks):
    deck = os.path.join(ROOT, "prm", "kgd", name, "cohesive_xfem.prm")
    summaries = [stockwork(options, deck, ["Resolution=coarse"], ranks)
                 for _ in range(options.repeat)]
    summary = sorted(summaries, key=lambda s: s["wall_seconds"]["total"])[len(summaries) // 2]
    print(f"\nkgd/{name}, {summary['unknowns']} unknowns, {summary['steps']} steps, {ranks} rank(s)")
    median_row("whole run", [s["wall_seconds"]["total"] for s in summaries])
    print("    " + ", ".join(f"{k} {v:.2f}" for k, v in summary["wall_seconds"].items()) + " s")
    print("    " + ", ".join(f"{k} {100 * v['final']:.2f} % ({100 * v['mean']:.2f} %)"
                             for k, v in summary["errors"].items()) + "   error: final (mean)")


def main():
    parser = argparse.ArgumentParser(description=__doc__,
                                     formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--program", default=os.path.join(ROOT, "build", "source", "stockwork"))
    parser.add_argument("--cases", nargs="+", metavar="CASE/N", default=[
        "mandel2d/33", "mandel2d/75", "footing3d/12", "footing3d/20", "kgd/toughness",
        "kgd/viscosity"])
    parser.add_argument("--ranks", nargs="+", type=int, default=[1])
    parser.add_argument("--repeat", type=int, default=3)
    parser.add_argument("--dolfinx", metavar="SCRIPT", help="peer: script for dolfinx + PETSc")
    parser.add_argument("--python", default="/usr/bin/python3", help="interpreter of that script")
    parser.add_argument("--dealii", metavar="PROGRAM", help="peer: textbook deal.II program")
    options = parser.parse_args()
    options.program = os.path.abspath(options.program)
    print(run([options.program, "--version"], 1).strip())
    print("load of the machine:", " ".join(f"{x:.1f}" for x in os.getloadavg()))
    for ranks in options.ranks:
        for case in options.cases:
            name, what = case.split("/")
            if name == "kgd":
                kgd(options, what, ranks)
            else:
                biot(options, name, int(what), ranks)


if __name__ == "__main__":
    main()
