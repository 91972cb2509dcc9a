#!/usr/bin/env python3
"""Time Stockwork beside other programs that solve the same discrete problems; make doc/performance.md.

    contrib/benchmark/run.py [--dolfinx SCRIPT] [--dealii PROGRAM] [--repeat 3] [--write FILE]
                             [--jobs step/mandel2d/33 memory ...] [--nice -18]
    contrib/benchmark/run.py --before OLD/build/source/stockwork --repeat 10 --jobs before
    contrib/benchmark/run.py --program NEW/build/source/stockwork --before OLD/build/source/stockwork --jobs counted

Jobs: step/CASE/N    a time step, direct and iterative, with everything made anew and with the
                     factor (or preconditioner) kept
      iterations     of the preconditioned Krylov method from the smallest to the largest case
      memory         of iterative runs, per unknown
      ranks/CASE/N   a time step on one and two ranks
      accuracy       Mandel's problem to a pressure error of 6.4e-4
      kgd/NAME/RESOLUTION      a whole run with a fracture, by phase; its speed-up on two ranks, if asked
                               for as kgd/NAME/RESOLUTION/2
      scene[/MODEL]            what a fracture costs: kgd/toughness, coarse, against length, domain and model
      plastic/borehole         a step in which 5 % of the cells yield, over an elastic one
      before                   whole runs beside an older build, --before PROGRAM: user time, memory
      counted                  the same decks, coarse and short, by the instructions that valgrind counts: those of the run,
                               in brackets of a step [10^9]; their ratios; counted/NAME: those whose name starts so.
                               Valgrind does not know AVX-512: configure both builds with
                               -DSTOCKWORK_NATIVE=OFF -DCMAKE_CXX_FLAGS=-march=haswell
Cases: mandel2d      [0,100] x [0,10] m, 10 N x N squares, Q2-Q1, plate displacement prescribed
       footing3d     [0,10]^3 m, N^3 hexahedra, Q2-Q1, load on a quarter of the top

A *step* is assembly, preconditioner or factor, and solve to 1e-8: the difference of a run of many
steps and one of few, so that start-up, the ordering of the unknowns, verification and output do not
count; *anew* adds what Stockwork does once per mesh and the peers in every step. Own runs and the peers' take turns, pinned to one core per rank, BLAS with one thread; ratios
are medians of pairs. On a busy machine give --nice (as root) and look at the spread.

Peers are not part of this repository. They print one line of JSON: `SCRIPT perf CASE N --solver
mumps|fs-hypre --steps K [--reuse]` and `PROGRAM CASE N K` with `step`, `asm_mat`, `its`, `rss_MB`;
`SCRIPT mandel N STEPS --solver mumps --reuse` with `run` and `errp`.
"""
import argparse
import json
import os
import re
import shutil
import statistics
import subprocess
import sys
import tempfile

HERE = os.path.dirname(os.path.abspath(__file__))
ROOT = os.path.join(HERE, "..", "..")
sys.path.insert(0, os.path.join(HERE, ".."))
from results import read_statistics, read_summary  # noqa: E402

ENVIRONMENT = dict(os.environ, OMP_NUM_THREADS="1", OPENBLAS_NUM_THREADS="1",
                   DEAL_II_NUM_THREADS="1")

# Number of steps of the short and the long run.
SHORT, LONG = 3, 9

# Of each case: deck, extents of the mesh in cells, length of a step [s].
CASES = {
    "mandel2d": ("mandel_2d.prm", {"X": 10, "Y": 1}, 10.),
    "footing3d": ("footing_3d.prm", {"X": 1, "Y": 1, "Z": 1}, 1.),
}


# Whole runs beside an older program, which reads the decks of its own tree. Fields are not written: what
# is in them may be more today.
BEFORE = {
    "mandel": ("mandel/none.prm", []),
    "cryer": ("cryer/none.prm", []),
    "column": ("column/alpha_1/none.prm", []),
    "sneddon, given": ("sneddon/prescribed.prm", []),
    "sneddon, cohesive": ("sneddon/cohesive_xfem.prm", []),
    "kgd/toughness, cohesive": ("kgd/toughness/cohesive_xfem.prm", ["Resolution=coarse"]),
    "kgd/viscosity, cohesive": ("kgd/viscosity/cohesive_xfem.prm", ["Resolution=medium"]),
    "kgd/sun, bonds, to 6 s": ("kgd/sun/peridynamics.prm", ["Resolution=coarse", "Time/End time=6 s"]),
    "radial, bonds, to 0.2 s": ("radial/toughness/peridynamics.prm", ["Resolution=coarse", "Time/End time=0.2 s"]),
}

# The same decks counted, valgrind being fifty times as slow: resolution, and ends of a run of few steps and of one of
# more; none where the deck has one step.
COUNTED = {
    "mandel": ("mandel/none.prm", "medium", ("500 s", "5000 s")),
    "cryer": ("cryer/none.prm", "coarse", ("0.02 s", "0.2 s")),
    "column": ("column/alpha_1/none.prm", "medium", ("5 s", "60 s")),
    "sneddon, given": ("sneddon/prescribed.prm", "coarse", None),
    "sneddon, cohesive": ("sneddon/cohesive_xfem.prm", "coarse", None),
    "kgd/toughness, cohesive": ("kgd/toughness/cohesive_xfem.prm", "coarse", ("2 s", "10 s")),
    "kgd/viscosity, cohesive": ("kgd/viscosity/cohesive_xfem.prm", "coarse", ("2 s", "10 s")),
    "kgd/sun, bonds": ("kgd/sun/peridynamics.prm", "coarse", ("1 s", "2 s")),
    "radial, bonds": ("radial/toughness/peridynamics.prm", "coarse", ("0.05 s", "0.1 s")),
}

# A borehole in rock that yields, cells of equal length along the radius: the share of cells that yield is
# that of the radius.
PLASTIC = ["Mesh/Ring/Cells along the radius=1 cm at 10 cm, growth 1, largest 1 cm",
           "Mesh/Ring/Cells along the arc=24", "Mesh/Uniform refinements=1", "Time/Initial step=0.05 s",
           "Output/Fields=false", "Verification/Compare=at the end"]
INNER_RADIUS, OUTER_RADIUS = 0.1, 1.


class Bench:
    def __init__(self, options):
        self.options = options
        self.rows = []

    def row(self, job, own, peer="", ratio=None, required="", great=""):
        """One line of the table; `ratio` is what is compared with the goals."""
        text = "" if ratio is None else f"{ratio:.2f}"
        self.rows.append((job, own, peer, text, required, great))
        print("| " + " | ".join(self.rows[-1]) + " |", flush=True)

    def run(self, command, ranks):
        """Standard output of a command on so many ranks, one core each."""
        if ranks > 1:
            command = ["mpirun", "--allow-run-as-root", "--bind-to", "core", "-np", str(ranks), *command]
        elif shutil.which("taskset"):
            command = ["taskset", "-c", str(max(os.sched_getaffinity(0))), *command]
        if self.options.nice:
            command = ["nice", "-n", str(self.options.nice), *command]
        done = subprocess.run(command, env=ENVIRONMENT, capture_output=True, text=True)
        if done.returncode:
            sys.exit(f"{' '.join(command)}\nexit status {done.returncode}\n{done.stdout[-2000:]}"
                     f"{done.stderr[-2000:]}")
        return done.stdout

    def stockwork(self, deck, settings, ranks=1, read=read_summary):
        """What one run leaves behind, by default summary.json."""
        with tempfile.TemporaryDirectory() as output:
            command = [self.options.program, os.path.join(ROOT, "prm", deck), "--output", output]
            for setting in settings:
                command += ["--set", setting]
            self.run(command, ranks)
            return read(output)

    def own_run(self, case, n, solver, steps, reuse=False, ranks=1):
        """`full`: every step has another length, so nothing that depends on it can be kept."""
        deck, extents, dt = CASES[case]
        growth = 1. if reuse else 1.02
        end = dt * (steps if reuse else (growth**steps - 1) / (growth - 1))
        return self.stockwork("benchmark/" + deck, [
            *(f"Mesh/Box/{axis} spacing={per * n} cells" for axis, per in extents.items()),
            f"Linear solver/Type={solver}", "Time/Scheme=backward Euler", "Time/Error tolerance=inf",
            f"Time/Initial step={dt}", f"Time/Step growth={growth}",
            f"Time/End time={end * (1 + 1e-12)!r}", "Output/Fields=false",
            "Verification/Compare=at the end"], ranks)

    def own_step(self, case, n, solver, reuse=False, ranks=1):
        """Seconds of a step, of its assembly, of the assembly and of the set-up that are done once;
        long run's summary."""
        short, long = (self.own_run(case, n, solver, steps, reuse, ranks) for steps in (SHORT, LONG))
        count = long["steps"] - short["steps"]

        def seconds(summary, *phases):
            return sum(summary["wall_seconds"].get(phase, 0.) for phase in phases)
        step, assembly, setup = (
            (seconds(long, *phases) - seconds(short, *phases)) / count
            for phases in (("assembly", "preconditioner", "solve"), ("assembly",), ("preconditioner",)))
        return (step, assembly, seconds(short, "assembly") - short["steps"] * assembly,
                seconds(short, "preconditioner") - short["steps"] * setup, long)

    def peer(self, arguments, ranks=1):
        if not self.options.dolfinx:
            return None
        lines = self.run([self.options.python, self.options.dolfinx, *arguments], ranks).splitlines()
        return json.loads([line for line in lines if line.startswith("{")][-1])

    def dolfinx(self, case, n, solver, reuse=False, ranks=1):
        return self.peer(["perf", case, str(n), "--steps", "4", "--solver", solver,
                          *(["--reuse"] if reuse else [])], ranks)

    def dealii(self, case, n):
        if not self.options.dealii:
            return None
        lines = self.run([self.options.dealii, case, str(n), "4"], 1).splitlines()
        return json.loads([line for line in lines if line.startswith("{")][-1])

    def compare_steps(self, case, n):
        """Rows of one size: every kind of step, assembly per cell."""
        kinds = [("iterative, all anew", "iterative", False, "dolfinx + hypre",
                  lambda: self.dolfinx(case, n, "fs-hypre"), "1.0", "0.5")]
        if case == "mandel2d":
            kinds = [("direct, all anew", "direct", False, "dolfinx + MUMPS",
                      lambda: self.dolfinx(case, n, "mumps"), "1.0", "0.7"),
                     ("direct, factor kept", "direct", True, "dolfinx + MUMPS",
                      lambda: self.dolfinx(case, n, "mumps", True), "1.0", "0.4")] + kinds
        elif self.options.dealii:
            kinds.append(("iterative, all anew", "iterative", False, "deal.II + ML",
                          lambda: self.dealii(case, n), "1.0", "0.5"))
        per_cell, peer_per_cell = [], []
        for label, solver, reuse, name, rival, required, great in kinds:
            own, bare, other, ratios = [], [], [], []
            for _ in range(self.options.repeat):
                step, _, once, setup, summary = self.own_step(case, n, solver, reuse)
                # What the peers do in each step and Stockwork once per mesh. Orderings of direct
                # solvers are kept by all.
                extra = 0. if reuse else once + (setup if solver == "iterative" else 0.)
                bare.append(step)
                own.append(step + extra)
                per_cell.append(once / summary["cells"])
                result = rival()
                if result:
                    other.append(result["step"])
                    ratios.append(own[-1] / result["step"])
                    if name.startswith("dolfinx"):
                        peer_per_cell.append(result["asm_mat"] / summary["cells"])
            spread = (max(ratios) - min(ratios)) / statistics.median(ratios) if ratios else 0.
            iterations = summary["linear_iterations"] / summary["steps"]
            notes = [f"{iterations:.0f} iterations"] if solver == "iterative" else []
            if not reuse:
                notes.append(f"{statistics.median(bare):.3g} s as it runs")
            self.row(f"{case.upper()}({n}), {summary['unknowns']} unknowns: step, {label}",
                     f"{statistics.median(own):.3g} s" + (f" ({', '.join(notes)})" if notes else ""),
                     f"{name} {statistics.median(other):.3g} s" if other else "",
                     statistics.median(ratios) if ratios else None, required,
                     great + (f" (spread {100 * spread:.0f} %)" if len(ratios) > 1 else ""))
        once = statistics.median(per_cell) * 1e6
        peer_us = statistics.median(peer_per_cell) * 1e6 if peer_per_cell else None
        self.row(f"{case.upper()}({n}): matrices, per cell",
                 f"{once:.3g} µs, once per mesh",
                 f"dolfinx {peer_us:.3g} µs" if peer_us else "",
                 once / peer_us if peer_us else None,
                 "1.0" if case == "mandel2d" else "0.6", "0.7" if case == "mandel2d" else "0.3")

    def iterations(self):
        for case, sizes in (("mandel2d", (11, 33, 75)), ("footing3d", (5, 12, 20))):
            counts = []
            for n in sizes:
                summary = self.own_run(case, n, "iterative", SHORT)
                counts.append(summary["linear_iterations"] / summary["steps"])
            self.row(f"{case.upper()}, N = {', '.join(map(str, sizes))}: iterations",
                     ", ".join(f"{count:.1f}" for count in counts), "",
                     max(counts) / counts[0], "1.3", "")

    def memory(self):
        for case, n, required, great in (("mandel2d", 75, 2., 1.5), ("footing3d", 20, 5., 4.)):
            base = self.own_run(case, 1, "iterative", 1)["peak_memory_bytes"]
            summary = self.own_run(case, n, "iterative", SHORT)
            used = (summary["peak_memory_bytes"] - base) / summary["unknowns"] / 1e3
            rival = self.dolfinx(case, n, "fs-hypre")
            text = ""
            if rival:
                theirs = (rival["rss_MB"] - rival["rss0_MB"]) * 2**20 / summary["unknowns"] / 1e3
                text = f"dolfinx + hypre {theirs:.2f} kB"
            self.row(f"{case.upper()}({n}), iterative: memory per unknown, above {base / 1e6:.0f} MB",
                     f"{used:.2f} kB", text, None, f"{required:g} kB", f"{great:g} kB")

    def ranks(self, case, n):
        speed_ups = []
        for _ in range(self.options.repeat):
            one, two = (self.own_step(case, n, "iterative", ranks=k)[0] for k in (1, 2))
            speed_ups.append(one / two)
        rivals = [self.dolfinx(case, n, "fs-hypre", ranks=k) for k in (1, 2)]
        text = f"dolfinx + hypre {rivals[0]['step'] / rivals[1]['step']:.2f}" if rivals[0] else ""
        self.row(f"{case.upper()}({n}), iterative: speed-up on 2 ranks",
                 f"{statistics.median(speed_ups):.2f} (from {one:.3g} s)", text, None, "1.75", "1.9")

    def accuracy(self):
        ratios, own, other = [], [], []
        for _ in range(max(3, self.options.repeat)):
            summary = self.stockwork("benchmark/mandel_accuracy.prm", [])
            own.append(sum(summary["wall_seconds"][phase] for phase in ("assembly", "preconditioner", "solve")))
            rival = self.peer(["mandel", "8", "128", "--solver", "mumps", "--reuse"])
            if rival:
                other.append(rival["run"])
                ratios.append(own[-1] / other[-1])
        error = summary["errors"]["pore_pressure"]["final"]
        self.row("Mandel to a pressure error of 6.4e-4: all steps",
                 f"{statistics.median(own):.3g} s, {summary['steps']} steps of BDF2, error {error:.1e}",
                 f"dolfinx + MUMPS {statistics.median(other):.3g} s, 128 steps, "
                 f"error {rival['errp']:.1e}" if other else "",
                 statistics.median(ratios) if ratios else None, "1.0", "0.15")

    def plastic(self, case):
        """A step at whose end 5 % of the cells have yielded, over elastic ones; per linear iteration."""
        deck = f"{case}/convergence/none.prm"
        dt = 0.05

        def run(steps, *settings, read=read_summary):
            return self.stockwork(deck, [*PLASTIC, f"Time/End time={steps * dt} s", *settings], read=read)

        def seconds(summary, *phases):
            """Of processor time; what a phase takes is known of the wall clock only."""
            wall = summary["wall_seconds"]
            return summary["cpu_seconds"] * sum(wall.get(phase, 0.) for phase in phases) / wall["total"]

        def share(radius):
            return (radius - INNER_RADIUS) / (OUTER_RADIUS - INNER_RADIUS)
        elastic = ["Rock/mohr coulomb/Cohesion=1 GPa"]
        radii = run(20, read=read_statistics)["plastic_radius"]
        last = 1 + next(k for k, radius in enumerate(radii) if share(radius) > 0.05)
        steps, solves, per_iteration = [], [], []
        for _ in range(self.options.repeat):
            before, after, one, many = run(last - 1), run(last), run(1, *elastic), run(11, *elastic)
            newton = after["nonlinear_iterations"] - before["nonlinear_iterations"]
            linear = after["linear_iterations"] - before["linear_iterations"]
            anew = seconds(one, "assembly", "preconditioner", "solve")
            solve = seconds(after, "solve") - seconds(before, "solve")
            back = (seconds(many, "solve") - seconds(one, "solve")) / 10
            steps.append((after["cpu_seconds"] - before["cpu_seconds"]) / anew)
            solves.append(solve / newton / back)
            per_iteration.append(solve / linear / back)
        self.row(f"{case}, {after['unknowns']} unknowns, {100 * share(radii[last - 1]):.1f} % of the cells yield: step",
                 f"{newton} iterations, {linear} linear ones",
                 f"elastic step, factor anew, {anew:.2g} s", statistics.median(steps), "2", "")
        self.row(f"{case}: solve of an iteration", "", f"elastic, factor kept, {back:.2g} s",
                 statistics.median(solves), "2", "")
        self.row(f"{case}: solve per linear iteration", "", f"elastic, factor kept, {back:.2g} s",
                 statistics.median(per_iteration), "2", "")
        iterative = "Linear solver/Type=iterative"
        first, before, after = run(1, iterative), run(last - 1, iterative), run(last, iterative)
        newton = after["nonlinear_iterations"] - before["nonlinear_iterations"]
        linear = after["linear_iterations"] - before["linear_iterations"]
        elastic_step = first["linear_iterations"]
        self.row(f"{case}: linear iterations of the step, iterative", f"{linear} in {newton} iterations",
                 f"elastic step: {elastic_step} in {first['nonlinear_iterations']}", linear / elastic_step, "1.3", "")
        self.row(f"{case}: linear iterations of an iteration, iterative", f"{linear / newton:.1f}",
                 f"elastic one: {elastic_step / first['nonlinear_iterations']:.1f}",
                 linear / newton / elastic_step * first["nonlinear_iterations"], "1.3", "")

    def measured(self, program, deck, settings):
        """User seconds and peak memory [MB] of a run."""
        with tempfile.TemporaryDirectory() as output:
            command = [program, deck, "--output", output]
            for setting in [*settings, "Output/Fields=false"]:
                command += ["--set", setting]
            if self.options.nice:
                command = ["nice", "-n", str(self.options.nice), *command]
            child = subprocess.Popen(command, env=ENVIRONMENT, stdout=subprocess.DEVNULL)
            _, status, usage = os.wait4(child.pid, 0)
            child.returncode = status
            if status:
                sys.exit(f"{' '.join(command)}\nexit status {status}")
            return usage.ru_utime, usage.ru_maxrss / 1e3

    def old(self, deck):
        """The older program, and the deck in its tree."""
        if not self.options.before:
            sys.exit("Say which program was before: --before PROGRAM")
        return self.options.before, os.path.join(os.path.dirname(self.options.before), "..", "..", "prm", deck)

    def counted(self, *first):
        """Instructions of two builds."""
        for name, (deck, *runs) in COUNTED.items():
            if name.startswith("/".join(first)):
                (now, step), (before, old_step) = (self.instructions(*program, *runs) for program in (
                    (self.options.program, os.path.join(ROOT, "prm", deck)), self.old(deck)))
                self.row(name, f"{now:.2f} ({step:.4f})", f"{before:.2f} ({old_step:.4f})", None,
                         f"{now / before:.3f}", f"{step / old_step:.3f}")

    def instructions(self, program, deck, resolution, ends):
        """10^9 instructions of a run, and those of a step: what a run takes more than one of fewer steps, or than none."""
        def count(*arguments):
            done = subprocess.run(["valgrind", "--tool=cachegrind", "--cache-sim=no", "--cachegrind-out-file=/dev/null",
                                   program, *arguments], env=dict(ENVIRONMENT, OPENBLAS_CORETYPE="Haswell"),
                                  capture_output=True, text=True)
            if done.returncode:
                sys.exit(f"{program} {' '.join(arguments)}\nexit status {done.returncode}\n{done.stderr[-2000:]}")
            return 1e-9 * int(re.search(r"I +refs: +([\d,]+)", done.stderr)[1].replace(",", ""))

        def run(*end):
            with tempfile.TemporaryDirectory() as output:
                command = [deck, "--output", output]
                for setting in [f"Resolution={resolution}", *end, "Output/Fields=false"]:
                    command += ["--set", setting]
                return count(*command), read_summary(output)["steps"]
        (start, few), (whole, steps) = ([run(f"Time/End time={end}") for end in ends] if ends else
                                        ((count("--version"), 0), run()))
        return whole, (whole - start) / (steps - few)

    def scene(self, *models):
        """Processor time and memory of short and long fractures in small and large domains; and of a crack that does not
        grow, beside the same mesh without one."""
        for model in models or ("none", "prescribed", "damage", "cohesive_xfem"):
            if model in ("none", "prescribed"):
                summary = self.stockwork("sneddon/prescribed.prm", [
                    "Resolution=fine", f"Fracture/Model={model}", "Verification/Reference=none", "Output/Fields=false",
                    *(f"Boundary conditions/Displacement {axis}=" for axis in "xy"),
                    "Boundary conditions/Roller=left, right, top, bottom"])
                self.row(f"{model}, sneddon, fine, between rollers", self.cost(summary))
                continue
            for wall in (200, 800):
                for end in (1, 10, 100):
                    summary = self.stockwork(f"kgd/toughness/{model}.prm", [
                        "Resolution=coarse", f"Time/End time={end} s",
                        f"Mesh/Box/Lower corner=0, -{wall} m", f"Mesh/Box/Upper corner={wall} m, {wall} m",
                        "Verification/Reference=none", "Output/Fields=false"])
                    length = summary["final"].get("fracture_length", 0.)
                    self.row(f"{model}, walls at {wall} m, {end} s: a fracture of {length:.3g} m",
                             self.cost(summary))

    @staticmethod
    def cost(summary):
        return (f"{summary['unknowns']} unknowns, {summary['steps']} steps, {summary['cpu_seconds']:.2f} s, "
                f"{summary['peak_memory_bytes'] / 1e6:.0f} MB")

    def before(self):
        """Whole runs of two builds in turns."""
        for name, (deck, settings) in BEFORE.items():
            now, before = [], []
            for _ in range(self.options.repeat):
                before.append(self.measured(*self.old(deck), settings))
                now.append(self.measured(self.options.program, os.path.join(ROOT, "prm", deck), settings))
            ratios = sorted(a[0] / b[0] for a, b in zip(now, before))
            quarter = len(ratios) // 4
            self.row(name, f"{min(t for t, _ in now):.2f} s, {max(m for _, m in now):.0f} MB",
                     f"{min(t for t, _ in before):.2f} s, {max(m for _, m in before):.0f} MB",
                     statistics.median(ratios), f"{ratios[quarter]:.2f} to {ratios[-1 - quarter]:.2f}",
                     f"{max(m for _, m in now) / max(m for _, m in before):.3f}")

    def kgd(self, name, resolution, ranks=1):
        if ranks > 1:
            return self.kgd_on_ranks(name, resolution, ranks)
        summaries = [self.stockwork(f"kgd/{name}/cohesive_xfem.prm", [f"Resolution={resolution}"])
                     for _ in range(self.options.repeat)]
        summary = sorted(summaries, key=lambda s: s["wall_seconds"]["total"])[len(summaries) // 2]
        seconds = summary["wall_seconds"]
        required, great = {"viscosity/medium": ("4 s", "2.5 s")}.get(f"{name}/{resolution}", ("60 s", ""))
        self.row(f"kgd/{name}, {resolution}, {summary['unknowns']} unknowns: whole run",
                 f"{seconds['total']:.3g} s: " + ", ".join(
                     f"{phase} {value:.2g}" for phase, value in
                     sorted(seconds.items(), key=lambda item: -item[1])
                     if phase != "total" and value > 0.02 * seconds["total"]), "", None, required, great)

    def kgd_on_ranks(self, name, resolution, ranks):
        """Wall time of a whole run on one rank over that on several."""
        times = []
        for _ in range(self.options.repeat):
            times.append([self.stockwork(f"kgd/{name}/cohesive_xfem.prm", [f"Resolution={resolution}"], n)
                          ["wall_seconds"]["total"] for n in (1, ranks)])
        self.row(f"kgd/{name}, {resolution}: speed-up on {ranks} ranks",
                 f"{statistics.median(one / many for one, many in times):.2f} (from {times[-1][0]:.3g} s)", "",
                 None, "1.4", "")


def main():
    parser = argparse.ArgumentParser(description=__doc__,
                                     formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--program", default=os.path.join(ROOT, "build", "source", "stockwork"))
    parser.add_argument("--jobs", nargs="+", default=[
        "step/mandel2d/33", "step/mandel2d/75", "step/footing3d/12", "step/footing3d/20", "iterations",
        "memory", "ranks/mandel2d/75", "ranks/footing3d/20", "accuracy", "kgd/toughness/coarse", "kgd/viscosity/coarse",
        "kgd/viscosity/medium"])
    parser.add_argument("--repeat", type=int, default=3)
    parser.add_argument("--dolfinx", metavar="SCRIPT", help="peer: script for dolfinx + PETSc")
    parser.add_argument("--python", default="/usr/bin/python3", help="interpreter of that script")
    parser.add_argument("--dealii", metavar="PROGRAM", help="peer: textbook deal.II program")
    parser.add_argument("--before", metavar="PROGRAM", help="an older build, in its own tree")
    parser.add_argument("--nice", type=int, default=0, help="priority of all runs, e.g. -18")
    parser.add_argument("--write", metavar="FILE", help="append the table to a file")
    options = parser.parse_args()
    options.program = os.path.abspath(options.program)
    if options.before:
        options.before = os.path.abspath(options.before)
    bench = Bench(options)
    print(bench.run([options.program, "--version"], 1).strip())
    print("load of the machine:", " ".join(f"{x:.1f}" for x in os.getloadavg()))
    kinds = {"step": bench.compare_steps, "iterations": bench.iterations, "memory": bench.memory,
             "ranks": bench.ranks, "accuracy": bench.accuracy, "kgd": bench.kgd,
             "plastic": bench.plastic, "scene": bench.scene, "before": bench.before, "counted": bench.counted}
    for job in options.jobs:
        kind, *arguments = job.split("/")
        kinds[kind](*(int(a) if a.isdigit() else a for a in arguments))
        if options.write:
            with open(options.write, "a", encoding="utf-8") as file:
                while bench.rows:
                    file.write("| " + " | ".join(bench.rows.pop(0)) + " |\n")


if __name__ == "__main__":
    main()
