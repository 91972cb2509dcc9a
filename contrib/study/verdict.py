"""The table of all runs: how close, what for, and how they ended."""
import re

import pandas

from study.collect import NOT_RUN
from study.difference import differences
from study.problem import problems

# An error below this is that of the arithmetic, or of a quantity that is imposed.
IMPOSED = 1e-9

ALONE = ("Alone: whether the run had its core for itself, and its time can be compared. 'yes, 2': on a core of its own, beside "
         "another run of the study at most; 'no, 40 %': others have used this much of the core, so the time is too long; "
         "'?': not measured.")

# What others may have used of a core.
ALONE_BELOW = 0.05

LENGTHS = {"um": 1e-6, "mm": 1e-3, "cm": 1e-2, "m": 1., "km": 1e3, "ft": 0.3048, "in": 0.0254, "": 1.}


# What `against` says of the run itself that others are measured against, and of one without any other.
STANDS_IN = "stands in"
NO_OTHER = "no other finished run of this problem"


def table(results, wanted=()):
    """One row per run; wanted: quantities that are asked for. error_end_X and error_mean_X are fractions: errors, or, where no run of the case has a reference,
    differences to the run that `against` names."""
    rows = []
    for case in dict.fromkeys(r.case for r in results):
        here = [r for r in results if r.case == case]
        number = {r.directory: i for i, group in enumerate(problems([r for r in here if r.status == "finished"]))
                  for r in group}
        errors = {r.directory: r.summary.get("errors") or {} for r in here}
        if any(errors.values()):
            rows += [row(r, errors[r.directory], reference(errors[r.directory]), number) for r in here]
            continue
        found = differences(here, wanted)
        for r in here:
            its, base, until = found.get(r.directory, ({}, None, None))
            alone = NO_OTHER if r.status == "finished" else ""
            rows.append(row(r, its, alone if base is None else STANDS_IN if base is r else base.label, number,
                            True, until))
    return pandas.DataFrame(rows)


def reference(errors):
    return next((e["reference"] for e in errors.values() if e.get("reference")), "")


def row(result, errors, against, number, differs=False, until=None):
    summary, record = result.summary, result.record
    cells = {"case": result.case, "model": result.model, "variant": result.variant, "resolution": result.resolution,
             "asked": result.asked, "ranks": result.ranks, "status": result.status, "reason": result.reason,
             "curve": result.curve, "label": result.label, "against": against, "differs": differs, "until": until,
             "problem": number.get(result.directory),
             "unknowns": summary.get("unknowns"), "cells": summary.get("cells"), "cell_size": cell_size(result),
             "reached": (summary.get("final") or {}).get("time"), "steps": summary.get("steps"), "rejected": summary.get("rejected_steps"),
             "nonlinear": summary.get("nonlinear_iterations"), "linear": summary.get("linear_iterations"),
             "cpu_seconds": summary.get("cpu_seconds") or record.get("cpu_seconds"),
             "wall_seconds": (summary.get("wall_seconds") or {}).get("total") or record.get("wall_seconds"),
             "others_share": record.get("others_share"), "at_once": record.get("at_once"),
             "memory_bytes": summary.get("peak_memory_bytes"),
             "balance": (summary.get("fluid_balance") or {}).get("relative_error"),
             "directory": result.directory}
    for name, error in errors.items():
        cells[f"error_end_{name}"] = error.get("final")
        cells[f"error_mean_{name}"] = error.get("mean")
    return cells


def cell_size(result):
    """Of the cells at the fracture [m]; without a fracture, that of all cells but for a factor."""
    match = re.fullmatch(r"([-+.\deE]+) *(\w*)", result.deck.get(f"Fracture/{result.model}/Cell size", ""))
    if match and match[2] in LENGTHS:
        return float(match[1]) * LENGTHS[match[2]]
    cells = result.summary.get("cells")
    return cells ** (-1. / int(result.deck.get("Dimension") or 2)) if cells else None


def quantities(rows, wanted=()):
    """The quantities that are charted: those wanted, or all whose error is one anywhere."""
    there = [c[len("error_mean_"):] for c in rows.columns if c.startswith("error_mean_") and rows[c].notna().any()]
    chosen = [name for name in wanted if name in there]
    return chosen or [name for name in there if rows["error_mean_" + name].max() > IMPOSED]


def missing(rows, wanted):
    """What is wrong with the quantities that are wanted, in a sentence; nothing where they are there, or no run has any."""
    there = [c[len("error_end_"):] for c in rows.columns if c.startswith("error_end_")]
    absent = [name for name in wanted if name not in there]
    names = " or ".join(f"'{name}'" for name in absent)
    return f"no run has an error of {names}; there is: {', '.join(there)}" if absent and there else ""


def per_cent(value):
    return "" if value is None or value != value else f"{100 * value:.2g}"


def count(value):
    return "" if value is None or value != value else f"{int(value)}"


def at(time):
    return "" if time is None or time != time else f" at {time:.4g} s"


def alone(row):
    """Whether the times of a run can be compared with others'; ALONE says what is meant."""
    if row["status"] == NOT_RUN:
        return ""
    if row["others_share"] is None or row["others_share"] != row["others_share"]:
        return "?"
    if row["others_share"] > ALONE_BELOW:
        return f"no, {100 * row['others_share']:.0f} %"
    return "yes" if row["at_once"] == 1 else f"yes, {int(row['at_once'])}"


def shown(rows, wanted=()):
    """The table as people read it: texts, with units in the headings."""
    texts = pandas.DataFrame(index=rows.index)
    texts["case"] = rows["case"]
    texts["model"] = rows["model"]
    if (rows["variant"] != "").any():
        texts["variant"] = rows["variant"]
    texts["resolution"] = rows["asked"]
    if (rows["ranks"] != 1).any():
        texts["ranks"] = rows["ranks"].astype(str)
    texts["status"] = [s if s != "failed" else f"FAILED{at(t)}: {r}"
                       for s, t, r in zip(rows["status"], rows["reached"], rows["reason"])]
    for name in quantities(rows, wanted):
        texts[name.replace("_", " ") + " end (mean) [%]"] = [
            f"{per_cent(end)}{at(until)} ({per_cent(mean)})" if per_cent(end) or per_cent(mean) else ""
            for end, mean, until in zip(rows["error_end_" + name], rows["error_mean_" + name], rows["until"])]
    if rows["differs"].any() or rows.loc[rows["against"] != "", "against"].nunique() > 1:
        texts["measured against"] = rows["against"]
    for name, heading in (("unknowns", "unknowns"), ("steps", "steps"), ("rejected", "rejected"),
                          ("nonlinear", "nonlinear it."), ("linear", "linear it.")):
        if name in ("unknowns", "steps") or (rows[name].fillna(0) != 0).any():
            texts[heading] = [count(v) for v in rows[name]]
    texts["CPU [s]"] = ["" if v is None or v != v else f"{v:.3g}" for v in rows["cpu_seconds"]]
    texts["memory [MB]"] = ["" if v is None or v != v else f"{v / 1e6:.0f}" for v in rows["memory_bytes"]]
    texts["balance"] = ["" if v is None or v != v else f"{v:.0e}" for v in rows["balance"]]
    texts["alone"] = [alone(row) for _, row in rows.iterrows()]
    return texts


def measured_against(rows):
    """What the errors of a case's rows are measured against, in a sentence."""
    if not rows["differs"].any():
        references = list(dict.fromkeys(a for a in rows["against"] if a))
        return f"Measured against: {'; '.join(references)}." if references else "Nothing to compare with."
    if not (rows["against"] == STANDS_IN).any():
        return "Nothing to compare with: no reference, and no two runs of the same physical problem of which one has finished."
    alone = list(rows.loc[rows["against"] == NO_OTHER, "label"])
    return ("No reference: what is shown are differences to the run that is named, the one with the most unknowns that has "
            "finished of the same physical problem."
            + (f" Nothing is shown of {'; '.join(alone)}: no other run of the same problem has finished." if alone else ""))


def markdown(texts):
    lines = ["| " + " | ".join(texts.columns) + " |", "|" + " --- |" * len(texts.columns)]
    for _, cells in texts.iterrows():
        lines.append("| " + " | ".join(str(c).replace("|", "\\|").replace("\n", " ") for c in cells) + " |")
    return "\n".join(lines)


def by_case(rows, wanted, write):
    """The tables of the cases, each with the quantities that it has, below its name."""
    return "\n\n".join(f"{case}\n\n" + write(shown(here, wanted).drop(columns=["case"]))
                       for case, here in rows.groupby("case", sort=False))


def plain(texts, width=48):
    """For the terminal; what is longer than `width` is said in full below."""
    notes, rows = [], [list(texts.columns)]
    for _, cells in texts.iterrows():
        line = []
        for cell in map(str, cells):
            if len(cell) > width:
                notes.append(cell)
                cell = cell[:width - 7].rstrip() + f"… [{len(notes)}]"
            line.append(cell)
        rows.append(line)
    widths = [max(len(row[i]) for row in rows) for i in range(len(rows[0]))]
    lines = ["  ".join(cell.ljust(w) for cell, w in zip(row, widths)).rstrip() for row in rows]
    return "\n".join(lines + [f"[{i}] {note}" for i, note in enumerate(notes, 1)])
