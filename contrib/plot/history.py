#!/usr/bin/python3
"""Draw the history of a run beside the reference solution where the case has one.

    history.py DIRECTORY... [--columns fracture_length,inlet_aperture] [--output FILE.png]

Several directories (models, resolutions) share the axes. A reference is the column
`reference_NAME` of statistics.csv. Of the length, what is compared is drawn, from the mouth to the
middle of the process zone, and the physical tip as a thin line.
"""
import argparse
import os
import sys

import matplotlib
matplotlib.use("Agg")
import matplotlib.pyplot as plt  # noqa: E402
import numpy as np  # noqa: E402

sys.path.insert(0, os.path.join(os.path.dirname(os.path.abspath(__file__)), ".."))
from results import ResultError, read_deck, read_statistics, read_summary, read_units, script  # noqa: E402

# What is drawn, if there: column, label, unit and factor from SI.
QUANTITIES = {
    "equivalent_length": ("fracture length", "m", 1.),
    "inlet_aperture": ("aperture at the inlet", "mm", 1e3),
    "net_inlet_pressure": ("net pressure at the inlet", "MPa", 1e-6),
    "pore_pressure": ("pore pressure", "MPa", 1e-6),
    "displacement": ("displacement", "mm", 1e3),
    "load": ("load", "kN/m", 1e-3),
    "dissipated_energy": ("dissipated energy", "J/m", 1.),
}
# Of the other columns, by how their names end.
ENDINGS = {"length": ("m", 1.), "aperture": ("mm", 1e3), "pressure": ("MPa", 1e-6), "volume": ("m²", 1.)}
# Of a run in space.
IN_SPACE = {"m^2": ("m²", 1.), "m^3": ("m³", 1.), "J": ("J", 1.), "N": ("kN", 1e-3)}
PREFIX = "reference_"
THIN = {"equivalent_length": ("fracture_length", "physical tip")}


def numbers(column):
    return np.array([x if isinstance(x, float) else np.nan for x in column])


def shown_as(name, directory):
    """(label, unit, factor from SI) of a column, as the run's own units have it."""
    label, unit, factor = QUANTITIES.get(
        name, (name.replace("_", " "), *ENDINGS.get(name.rsplit("_", 1)[-1], ("SI", 1.))))
    si = read_units(directory).get(name)
    if si == "m^2" and name.endswith("length"):
        label = label.replace("length", "area")
    return label, *IN_SPACE.get(si, (unit, factor))


def labels(directories, runs):
    """Model and resolution of each run, and its directory where that does not tell them apart."""
    names = [", ".join(filter(None, (summary.get("fracture_model", ""), read_deck(d).get("Resolution"))))
             for d, (summary, _) in zip(directories, runs)]
    places = [os.path.normpath(d) for d in directories]
    shared = os.path.commonpath([os.path.abspath(place) for place in places])
    if len(set(places)) == 1:
        shared = os.path.dirname(shared)
    return [f"{name} ({os.path.relpath(place, shared)})" if names.count(name) > 1 else name
            for name, place in zip(names, places)]


def draw(directories, columns, output):
    runs = [(read_summary(d), read_statistics(d)) for d in directories]
    names = columns or [n for n in QUANTITIES
                        if any(any(numbers(table.get(n, []))) for _, table in runs)]
    there = sorted(set().union(*(table for _, table in runs)))
    unknown = [name for name in names if name not in there]
    if unknown or not names:
        raise ResultError((f"no run has the column '{unknown[0]}'" if unknown else "choose --columns")
                          + f"; there is: {', '.join(there)}")
    named = labels(directories, runs)
    figure, axes = plt.subplots(1, len(names), figsize=(4 * len(names), 3.2), squeeze=False)
    for ax, name in zip(axes[0], names):
        label, unit, factor = shown_as(name, next(d for d, (_, t) in zip(directories, runs) if name in t))
        for i, (_, table) in enumerate(runs):
            if name not in table:
                continue
            time = numbers(table["time"])
            if PREFIX + name in table and i == 0:
                ax.plot(time, factor * numbers(table[PREFIX + name]), color="0.2", lw=2.5,
                        alpha=0.5, label="reference")
            ax.plot(time, factor * numbers(table[name]), "--" if i else "-", color=f"C{i}", lw=1.2,
                    label=named[i])
            thin, meaning = THIN.get(name, (None, ""))
            if thin in table:
                ax.plot(time, factor * numbers(table[thin]), color=f"C{i}", lw=0.5,
                        label=meaning if i == 0 else None)
        ax.set_xlabel("time [s]")
        ax.set_ylabel(f"{label} [{unit}]")
        if name in QUANTITIES or unit != "MPa":  # a total pressure is far from zero
            ax.set_ylim(bottom=min(0., ax.get_ylim()[0]))
        ax.grid(alpha=0.3)
    axes[0][0].legend(frameon=False)
    figure.suptitle(runs[0][0].get("case", ""), fontsize=10)
    figure.tight_layout()
    figure.savefig(output, dpi=110)
    print(output)


def main():
    parser = argparse.ArgumentParser(description=__doc__,
                                     formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("directories", nargs="+")
    parser.add_argument("--columns", type=lambda text: text.split(","))
    parser.add_argument("--output")
    options = parser.parse_args()
    draw(options.directories, options.columns,
         options.output or os.path.join(options.directories[0], "history.png"))


if __name__ == "__main__":
    script(main)
