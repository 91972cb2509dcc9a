#!/usr/bin/env python3
"""'Physics = auto': what is left out changes the answer by no more than is stated, and costs less.

    check_physics.py --program build/source/stockwork --scratch DIR --deck DECK [--set ...] ...

    --leaves-out NAME   this is left out, and nothing else
    --less WORK=FACTOR  the full run does at least FACTOR times as much: `unknowns`, `iterations` (of Newton's
                        method) or `solves` (iterations times unknowns)
    --without PHASE     only the full run has this phase in its table of times
    --keeps NAME        this is kept
    --says TEXT         of the decision on NAME

Where something is left out both runs are made, and the finals of statistics.csv, or without a fracture the greatest
displacement, agree within what the audit states. With --keeps alone, --check has to do.
"""
import re
import sys

from judged import judge, parser_of

COMPARED = ("inlet_aperture", "net_inlet_pressure", "fracture_volume", "equivalent_length")

WORK = {"unknowns": lambda s: s["unknowns"],
        "iterations": lambda s: s["nonlinear_iterations"],
        "solves": lambda s: s["nonlinear_iterations"] * s["unknowns"]}


def decisions(text):
    """{name: (is left out, stated error, the line)}"""
    found = {}
    for line in re.findall(r"Physics = auto: (.*)", text):
        left_out = re.match(r"(.*?) left out, which changes the answer by about (\S+) %", line)
        if left_out:
            found[left_out[1]] = (True, float(left_out[2]) / 100, line)
        else:
            found[re.match(r"(.*?) kept: ", line)[1]] = (False, None, line)
    return found


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


def check_work(full, reduced, options):
    failed = []
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
    for name, (_, _, line) in found.items():
        print(f"  {line}")
    failed = [f"'{name}' is not kept" for name in options.keeps if name not in found or found[name][0]]
    left_out = [name for name, decision in found.items() if decision[0]]
    if left_out != options.leaves_out:
        failed.append(f"left out is {left_out}, should be {options.leaves_out}")
    said = " ".join(line for name, (_, _, line) in found.items() if name in options.keeps + options.leaves_out)
    failed += [f"it does not say '{text}'" for text in options.says if text not in said]
    if failed or not options.leaves_out:
        return failed
    full = runner.run("full", options.deck, options.set)
    stated = sum(found[name][1] for name in left_out)
    failed = check_answers(runner, full, reduced, max(stated, options.solver))
    for assumption in re.findall(r"DOES NOT  (.* left out: .*)", text):
        failed.append(f"after the run: {assumption}")
    return failed + check_work(full, reduced, options)


def main():
    parser = parser_of(__doc__, 300., "leaves-out", "less", "without", "keeps", "says")
    # Where nothing changes, both runs are the same but for the tolerance of the solver.
    parser.add_argument("--solver", type=float, default=1e-8)
    return judge(run, parser.parse_args())


if __name__ == "__main__":
    sys.exit(main())
