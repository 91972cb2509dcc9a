#!/usr/bin/env python3
"""Run decks at several resolutions and print a table of their errors in Markdown.

    contrib/study.py prm/mandel/none.prm [prm/...] [--resolutions coarse medium fine]
                     [--output DIR] [--set 'Section/Entry=value'] [--quantities NAME ...]

Errors are relative, `final (mean)` in per cent. Results stay in DIR/<case>/<resolution>. The exit status
is 1 if a run has failed.
"""
import argparse
import os
import subprocess
import sys

ROOT = os.path.join(os.path.dirname(os.path.abspath(__file__)), "..")
sys.path.insert(0, os.path.join(ROOT, "contrib"))
from arguments import PROGRAM, program  # noqa: E402
from results import ResultError, read_summary, script  # noqa: E402


def run(options, deck, resolution):
    """(summary.json of one run, ""), or (None, why it failed)."""
    case = os.path.splitext(os.path.relpath(deck, os.path.join(ROOT, "prm")))[0]
    if case.startswith(os.pardir):  # a deck of the user's own
        case = os.path.basename(case)
    output = os.path.join(options.output, case, resolution)
    os.makedirs(output, exist_ok=True)
    command = [options.program, deck, "--output", output, "--set", "Resolution=" + resolution]
    for setting in options.set:
        command += ["--set", setting]
    with open(os.path.join(output, "log"), "w", encoding="utf-8") as log:
        status = subprocess.run(command, stdout=log, stderr=subprocess.STDOUT, check=False,
                                env=dict(os.environ, OMP_NUM_THREADS="1", OPENBLAS_NUM_THREADS="1",
                                         DEAL_II_NUM_THREADS="1")).returncode
    if status == 0:
        return read_summary(output), ""
    with open(os.path.join(output, "log"), encoding="utf-8", errors="replace") as log:
        lines = [line.strip() for line in log if line.strip()]
    return None, lines[-1] if lines else f"exit status {status}, without a word"


def number(value):
    return "-" if value is None else f"{100 * value:.2g}"


def row(case, resolution, summary, why, quantities):
    cells = [case, resolution]
    if summary is None:
        return cells + ["failed: " + why.replace("|", "\\|"), "", ""] + [""] * len(quantities)
    cells += [str(summary["unknowns"]), str(summary["steps"]),
              f"{summary['wall_seconds']['total']:.3g}"]
    for name in quantities:
        error = summary["errors"].get(name)
        cells.append(f"{number(error['final'])} ({number(error['mean'])})" if error else "")
    return cells


def main():
    parser = argparse.ArgumentParser(description=__doc__,
                                     formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("decks", nargs="+")
    parser.add_argument("--program", type=program, default=PROGRAM)
    parser.add_argument("--resolutions", nargs="+", default=["coarse", "medium", "fine"])
    parser.add_argument("--output", default=os.path.join(ROOT, "build", "study"))
    parser.add_argument("--set", action="append", default=[])
    parser.add_argument("--quantities", nargs="+")
    options = parser.parse_args()

    results = []
    for deck in options.decks:
        for resolution in options.resolutions:
            summary, why = run(options, deck, resolution)
            case = summary["case"] if summary else deck
            results.append((case, resolution, summary, why))
            print(case, resolution, "done" if summary else "FAILED", file=sys.stderr, flush=True)
    there = list(dict.fromkeys(name for _, _, s, _ in results if s for name in s["errors"]))
    quantities = [name for name in options.quantities or there if name in there]
    header = ["case", "resolution", "unknowns", "steps", "seconds",
              *(name.replace("_", " ") + " [%]" for name in quantities)]
    print("| " + " | ".join(header) + " |")
    print("| --- | --- |" + " ---: |" * (len(header) - 2))
    for result in results:
        print("| " + " | ".join(row(*result, quantities)) + " |")
    failed = any(summary is None for _, _, summary, _ in results)
    unknown = [name for name in options.quantities or [] if name not in there]
    if unknown and not (failed and not there):
        raise ResultError(f"no run has an error of '{unknown[0]}'; there is: {', '.join(there) or 'none'}")
    return 1 if failed else 0


if __name__ == "__main__":
    script(main)
