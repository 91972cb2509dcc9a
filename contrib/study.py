#!/usr/bin/env python3
"""Run decks at several resolutions and print a table of their errors in Markdown.

    contrib/study.py prm/mandel/none.prm [prm/...] [--resolutions coarse medium fine]
                     [--output DIR] [--set 'Section/Entry=value'] [--quantities NAME ...]

Errors are relative, `final (mean)` in per cent. Results stay in DIR/<case>/<resolution>.
"""
import argparse
import os
import subprocess
import sys

ROOT = os.path.join(os.path.dirname(os.path.abspath(__file__)), "..")
sys.path.insert(0, os.path.join(ROOT, "contrib"))
from results import read_summary  # noqa: E402


def run(options, deck, resolution):
    """summary.json of one run; None if it failed."""
    case = os.path.splitext(os.path.relpath(deck, os.path.join(ROOT, "prm")))[0]
    output = os.path.join(options.output, case, resolution)
    os.makedirs(output, exist_ok=True)
    command = [options.program, deck, "--output", output, "--set", "Resolution=" + resolution]
    for setting in options.set:
        command += ["--set", setting]
    with open(os.path.join(output, "log"), "w", encoding="utf-8") as log:
        status = subprocess.run(command, stdout=log, stderr=subprocess.STDOUT, check=False,
                                env=dict(os.environ, OMP_NUM_THREADS="1", OPENBLAS_NUM_THREADS="1",
                                         DEAL_II_NUM_THREADS="1")).returncode
    return read_summary(output) if status == 0 else None


def number(value):
    return "-" if value is None else f"{100 * value:.2g}"


def row(case, resolution, summary, quantities):
    cells = [case, resolution]
    if summary is None:
        return cells + ["failed", "", ""] + [""] * len(quantities)
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
    parser.add_argument("--program", default=os.path.join(ROOT, "build", "source", "stockwork"))
    parser.add_argument("--resolutions", nargs="+", default=["coarse", "medium", "fine"])
    parser.add_argument("--output", default=os.path.join(ROOT, "build", "study"))
    parser.add_argument("--set", action="append", default=[])
    parser.add_argument("--quantities", nargs="+")
    options = parser.parse_args()

    results = []
    for deck in options.decks:
        for resolution in options.resolutions:
            summary = run(options, deck, resolution)
            case = summary["case"] if summary else deck
            results.append((case, resolution, summary))
            print(case, resolution, "done" if summary else "FAILED", file=sys.stderr, flush=True)
    quantities = options.quantities
    if not quantities:
        quantities = list(dict.fromkeys(name for _, _, s in results if s for name in s["errors"]))
    header = ["case", "resolution", "unknowns", "steps", "seconds",
              *(name.replace("_", " ") + " [%]" for name in quantities)]
    print("| " + " | ".join(header) + " |")
    print("| --- | --- |" + " ---: |" * (len(header) - 2))
    for case, resolution, summary in results:
        print("| " + " | ".join(row(case, resolution, summary, quantities)) + " |")


if __name__ == "__main__":
    main()
