#!/usr/bin/python3
"""Print what a run ended with, beside the reference where there is one.

    contrib/report.py OUTPUT_DIRECTORY

The exit status is 1 if the run has failed.
"""
import argparse
import os
import sys

sys.path.insert(0, os.path.dirname(os.path.abspath(__file__)))
from results import read_summary, script  # noqa: E402


def show(value):
    return f"{value:.6g}" if isinstance(value, (int, float)) else "-"


def percent(value):
    return f"{100 * value:.3g} %" if isinstance(value, (int, float)) else "-"


def reached_end(summary):
    return summary.get("status", "finished") == "finished"


def report(summary):
    """The lines of the table."""
    errors, final = summary.get("errors", {}), summary.get("final", {})
    rows = [("quantity at the end", "computed", "reference", "error", "mean error")]
    beside = [n for n in ("fracture_length", "broken_length") if n in final and "equivalent_length" in errors]
    others = [n for n in final if n not in errors and not n.startswith(("error_", "reference_"))
              and n not in ("step", "time", "time_step", "fluid_balance_error")]
    names = [*errors, *(n for n in others if n not in beside)]
    if beside:  # what the compared length lies between
        place = names.index("equivalent_length") + 1
        names[place:place] = beside
    for name in names:
        error = errors.get(name, {})
        rows.append((name, show(final.get(name)), show(final.get("reference_" + name)),
                     percent(error.get("final")), percent(error.get("mean"))))
    widths = [max(len(row[i]) for row in rows) for i in range(len(rows[0]))]
    lines = ["  ".join(cell.ljust(w) if i == 0 else cell.rjust(w)
                       for i, (cell, w) in enumerate(zip(row, widths))) for row in rows]
    lines.insert(1, "-" * len(lines[0]))
    if not reached_end(summary):
        lines.insert(0, f"status: {summary['status']}. {summary.get('reason', '')}")
    lines += sorted({f"reference: {e['reference']}" for e in errors.values() if e.get("reference")})
    balance = summary.get("fluid_balance", {})
    if balance.get("injected"):
        lines.append(f"fluid: {show(balance['injected'])} injected, balanced to "
                     f"{balance.get('relative_error', float('nan')):.1e}")
    wall, work = summary.get("wall_seconds", {}).get("total"), summary.get("cpu_seconds")
    lines.append(f"{summary.get('case', '')} ({summary.get('fracture_model', '')}): "
                 f"{summary.get('steps')} steps, {summary.get('unknowns')} unknowns, "
                 f"{show(wall)} s ({show(work)} s of CPU time) on {summary.get('ranks')} rank(s)")
    if summary.get("deck"):
        lines.append(f"{summary['deck']}, {summary.get('date', '')}, {summary.get('machine', '')}")
    lines += [f"warning: {text}" for text in summary.get("warnings", [])]
    return lines


def main():
    parser = argparse.ArgumentParser(description=__doc__,
                                     formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("directory")
    summary = read_summary(parser.parse_args().directory)
    print("\n".join(report(summary)))
    return 0 if reached_end(summary) else 1


if __name__ == "__main__":
    script(main)
