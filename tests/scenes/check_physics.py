#!/usr/bin/env python3
"""'Physics = auto': what is left out changes the answer by no more than is stated, and costs less by what is stated.

    check_physics.py --program build/source/stockwork --scratch DIR --deck DECK [--set ...] ...

    --leaves-out NAME   this is left out, and nothing else
    --less WORK=FACTOR  the full run does at least FACTOR times as much: `unknowns`, `iterations` (of Newton's
                        method) or `solves` (iterations times unknowns)
    --without PHASE     only the full run has this phase in its table of times
    --keeps NAME        this is kept
    --says TEXT         of the decision on NAME

Where something is left out both runs are made, and the finals of statistics.csv, or without a fracture the greatest
displacement, agree within what the audit states. A step of the full run takes at least HONEST of the times as much of
the processor that the audit states, the start of the program apart. With --keeps alone, --check has to do.
"""
import math
import re
import sys

from judged import judge, parser_of

COMPARED = ("inlet_aperture", "net_inlet_pressure", "fracture_volume", "equivalent_length", "broken_length")

WORK = {"unknowns": lambda s: s["unknowns"],
        "iterations": lambda s: s["nonlinear_iterations"],
        "solves": lambda s: s["nonlinear_iterations"] * s["unknowns"]}


# Of the stated factor: an estimate of processor time, seen on cores that others use too.
HONEST = 0.5

PHASES = ("assembly", "rock", "preconditioner", "solve", "fracture", "growth")


class Decision:
    def __init__(self, line):
        self.line = line
        said = re.match(r"(.*?) left out, which changes the answer by about (\S+) % and makes a step "
                        r"(?:about (\S+) times|hardly) cheaper: ", line)
        self.left_out = said is not None
        self.name = said[1] if said else re.match(r"(.*?) kept: ", line)[1]
        self.error = float(said[2]) / 100 if said else None
        self.factor = float(said[3] or 1) if said else 1.


def decisions(text):
    """By name."""
    return {found.name: found for found in map(Decision, re.findall(r"Physics = auto: (.*)", text))}


def greatest_displacement(directory):
    import vtu
    import numpy as np
    fields = vtu.read(vtu.at_time(vtu.series(directory, "fields"))[1])
    return float(np.linalg.norm(fields.point_data["displacement"], axis=1).max())


def check_answers(runner, full, reduced, stated):
    pairs = [(name, full["final"][name], reduced["final"][name]) for name in COMPARED if full["final"].get(name)]
    if not pairs:
        pairs = [("displacement", *(greatest_displacement(runner.output(name)) for name in ("full", "reduced")))]
    failed = []
    for name, one, other in pairs:
        off = other / one - 1
        print(f"  {name}: {one:.6g} in full, {other:.6g} reduced, {100 * off:+.3f} %; stated {100 * stated:.2g} %")
        if not abs(off) <= stated:
            failed.append(f"{name} is {100 * off:+.3f} % off, more than the {100 * stated:.2g} % that are stated")
    return failed


def step_seconds(summary):
    """Of the processor, per step; the start of the program and its output are none of a step's phases."""
    wall = summary["wall_seconds"]
    share = sum(wall.get(name, 0.) for name in PHASES) / wall["total"]
    return summary["cpu_seconds"] * share / summary["steps"]


def check_work(full, reduced, stated, options):
    one, other = step_seconds(full), step_seconds(reduced)
    print(f"  a step: {1e3 * one:.1f} ms in full, {1e3 * other:.1f} ms reduced: {one / other:.2f} times; stated {stated:.2g}")
    failed = []
    if not one >= HONEST * stated * other:
        failed.append(f"a step of the full run takes {one / other:.2f} times as long, {stated:.2g} are stated")
    for text in options.less:
        name, factor = text.split("=")
        one, other = WORK[name](full), WORK[name](reduced)
        print(f"  {name}: {one} in full, {other} reduced: {one / other:.2f} times")
        if not one >= float(factor) * other:
            failed.append(f"the full run has {one / other:.3f} times the {name}, not {factor}")
    for phase in options.without:
        if phase not in full["wall_seconds"] or phase in reduced["wall_seconds"]:
            failed.append(f"the phase '{phase}' is not in the full run alone")
    print(f"  processor: {full['cpu_seconds']:.2f} s in full, {reduced['cpu_seconds']:.2f} s reduced")
    return failed


def run(runner, options):
    settings = [*options.set, "Physics=auto"]
    if options.leaves_out:
        reduced = runner.run("reduced", options.deck, settings)
        text = runner.text("reduced", "stdout")
    else:
        command = runner.command("check", options.deck, settings, extra=["--check"])
        status = runner.wait(runner.start("check", command), command)
        text = runner.text("check", "stdout")
        if status != 0:
            return [f"exit status {status}\n{runner.tail('check')}"]
    found = decisions(text)
    for decision in found.values():
        print(f"  {decision.line}")
    failed = [f"'{name}' is not kept" for name in options.keeps if name not in found or found[name].left_out]
    left_out = [name for name, decision in found.items() if decision.left_out]
    if left_out != options.leaves_out:
        failed.append(f"left out is {left_out}, should be {options.leaves_out}")
    said = " ".join(found[name].line for name in options.keeps + options.leaves_out if name in found)
    failed += [f"it does not say '{text}'" for text in options.says if text not in said]
    if failed or not options.leaves_out:
        return failed
    full = runner.run("full", options.deck, options.set)
    stated = sum(found[name].error for name in left_out)
    failed = check_answers(runner, full, reduced, max(stated, options.solver))
    for assumption in re.findall(r"DOES NOT  (.* left out: .*)", text):
        failed.append(f"after the run: {assumption}")
    return failed + check_work(full, reduced, math.prod(found[name].factor for name in left_out), options)


def main():
    parser = parser_of(__doc__, 300., "leaves-out", "less", "without", "keeps", "says")
    # Where nothing changes, both runs are the same but for the tolerance of the solver.
    parser.add_argument("--solver", type=float, default=1e-8)
    return judge(run, parser.parse_args())


if __name__ == "__main__":
    sys.exit(main())
