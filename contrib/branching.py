#!/usr/bin/python3
"""Does a hydraulic fracture branch? The eighteen runs of Sun et al. (2021), section 5: run, in a table, drawn.

    contrib/branching.py run   [--factors rate modulus ...] [--resolution fine] [--output DIR] [--set ...]
    contrib/branching.py table [the same]
    contrib/branching.py draw  [the same]
    contrib/branching.py study [--output DIR] [--set ...]

`run` runs the decks prm/branching/<factor>/<value>/peridynamics.prm; what is finished stays as it is, what was begun
goes on from its checkpoint. `table` prints what each fracture has become, `draw` draws a picture per factor: damage
and opening at the end of its three runs, mirrored at the inlet, and the pressure there in time. Results are in
DIR/<resolution>/<factor>/<value>. `study` runs rate/0.01 again with one thing changed at a time (cells, horizon, steps,
inertia, bonds, the order in which they break; load and fluid as published), and prints the table and a picture of them:
what of a fracture's shape is the lattice's, always at fine resolution. Results are in DIR/study.
"""
import argparse
import os
import re
import sys

import matplotlib
matplotlib.use("Agg")
import matplotlib.pyplot as plt  # noqa: E402

HERE = os.path.dirname(os.path.abspath(__file__))
ROOT = os.path.join(HERE, "..")
sys.path[:0] = [HERE, os.path.join(HERE, "plot")]
import field  # noqa: E402
from arguments import PROGRAM, program  # noqa: E402
from deck_runs import run_deck  # noqa: E402
from results import ResultError, read_deck, read_statistics, read_summary, script  # noqa: E402
from tips import greatest_speed, number, rayleigh_speed  # noqa: E402

# Factor: its values.
FACTORS = {"rate": ("0.001", "0.005", "0.01"), "modulus": ("15.96", "23.94", "31.92"), "porosity": ("0.2", "0.3", "0.4"),
           "permeability": ("1e-14", "1e-13", "1e-12"), "viscosity": ("0.1", "0.01", "0.001"),
           "toughness": ("1", "0.01", "0.001")}
UNITS = {"rate": "m²/s per wing", "modulus": "GPa", "porosity": "", "permeability": "m²", "viscosity": "Pa s",
         "toughness": "J/m²"}

# Rows of the study: a name, its settings.
BONDS = "Fracture/peridynamics/"
BRITTLE = [BONDS + "Softening=1"]
HALF_CELLS = [BONDS + "Cell size=0.0375 m", "Mesh/Box/Lower corner=0, -7.81875 m", "Mesh/Box/Upper corner=7.8 m, 7.78125 m"]
STUDY = {
    "as the deck says": [],
    "cells of 0.15 m": ["Resolution=medium"],
    "cells of 0.0375 m": HALF_CELLS,
    "a horizon of 3 cells": [BONDS + "Horizon=3"],
    "a horizon of 5 cells": [BONDS + "Horizon=5"],
    "half the step": ["Time/Initial step=0.25 ms", "Time/Maximum step=0.25 ms"],
    "steps of 9 us, to 20 ms": ["Time/Initial step=9e-6 s", "Time/Maximum step=9e-6 s", "Time/End time=20 ms"],
    "no inertia": ["Time/Inertia=off", BONDS + "Tracking=none"],
    "across a path": [BONDS + "Tracking=path"],
    "no inertia, across a path": ["Time/Inertia=off", BONDS + "Tracking=path"],
    "brittle bonds": BRITTLE,
    "brittle, one at a time": [*BRITTLE, BONDS + "Bonds per pass=1"],
    "brittle, all at once": [*BRITTLE, BONDS + "Bonds per pass=1000000"],
    "brittle, cells of 0.0375 m": [*BRITTLE, *HALF_CELLS],
    "as published": [*BRITTLE, "Fracture flow/Vapour pressure=-inf", BONDS + "Closure=as published",
                     BONDS + "Fluid=permeability tensor", BONDS + "Bond volumes=exact", BONDS + "Surface correction=false",
                     BONDS + "Critical stretch factor=1"]}
STUDIED = ("rate", "0.01")

CELLS_OF_A_MEAN_SPEED = 4  # a tip goes from cell to cell: its speed is that over a horizon


def place(options, factor, value):
    return os.path.join(options.output, options.resolution, factor, value)


def runs(options):
    return [(factor, value) for factor in options.factors for value in FACTORS[factor]]


def deck_of(factor, value):
    return os.path.join(ROOT, "prm", "branching", factor, value, "peridynamics.prm")


def run(options):
    ended = [run_deck(options.program, deck_of(factor, value), place(options, factor, value),
                      [f"Resolution={options.resolution}", *options.set])
             for factor, value in runs(options)]
    return 0 if all(ended) else 1


def table(options):
    return print_table([(f"`{factor}/{value}`", place(options, factor, value)) for factor, value in runs(options)])


def print_table(rows):
    """Of named directories. The exit status: 1 if there is nothing in any of them."""
    print("| | to [s] | inlet pressure, greatest, last [MPa] | aperture [mm] | extent in x, y [m] | branches, forks (at any time) | "
          "greatest speed of the tip over c_R | leaked [%] | balance | steps (tried again) | processor [min] |")
    print("| --- | ---: | --- | ---: | --- | --- | ---: | ---: | ---: | ---: | ---: |")
    n_read = 0
    for name, directory in rows:
        try:
            columns, summary, deck = read_statistics(directory), read_summary(directory), read_deck(directory)
        except ResultError as error:
            print(f"| {name} | {error} |" + " |" * 9)
            continue
        n_read += 1
        last = {name: column[-1] for name, column in columns.items()}
        cell = number(deck["Fracture/peridynamics/Cell size"])
        speed = greatest_speed(columns["time"], columns["extent_x"], CELLS_OF_A_MEAN_SPEED * cell)
        end = number(deck["Time/End time"])
        print(f"| {name} | {last['time']:.3g}" + ("" if summary["status"] == "finished" else f" of {end:g}")
              + f" | {1e-6 * max(columns['inlet_pressure']):.3g}, {1e-6 * last['inlet_pressure']:.3g}"
              f" | {1e3 * last['inlet_aperture']:.3g} | {last['extent_x']:.3g}, {last['extent_y']:.2g}"
              f" | {last['branches']:g}, {last['forks']:g} ({max(columns['forks']):g}) | {speed / rayleigh_speed(deck):.3f}"
              f" | {100. * last['leaked_volume'] / last['injected_volume']:.2g}"
              f" | {max(map(abs, columns['fluid_balance_error'])):.0e}"
              f" | {summary['steps']} ({summary['rejected_steps']}) | {summary['cpu_seconds'] / 60.:.1f} |")
    return 0 if n_read else 1


def study(options):
    """A run that stops before its end is a row of the table like any other."""
    places = {name: os.path.join(options.output, "study", re.sub(r"[^a-z0-9.]+", "_", name)) for name in STUDY}
    for name, settings in STUDY.items():
        run_deck(options.program, deck_of(*STUDIED), places[name], ["Resolution=fine", *settings, *options.set])
    status = print_table(list(places.items()))
    there = {name: directory for name, directory in places.items() if os.path.exists(os.path.join(directory, "fields.pvd"))}
    if there:
        n_rows = -(-len(there) // 5)
        figure, axes = plt.subplots(n_rows, 5, figsize=(16., 2.6 * n_rows), layout="constrained", squeeze=False)
        for axis in axes.flat[len(there):]:
            axis.axis("off")
        for axis, (name, directory) in zip(axes.flat, there.items()):
            draw_damage(axis, directory, name, (0., 3.5, -1.5, 1.5))
        output = os.path.join(options.output, "study.png")
        figure.savefig(output, dpi=80)
        print(output)
    return status


def draw_damage(axis, directory, name, window):
    """At the end, with the opening, mirrored at the inlet."""
    shown, _ = field.panel(axis, argparse.Namespace(directory=directory, field="damage", component=None, window=window,
                                                    mirror=True, warp=None, fluid=False), None)
    for collection in shown:
        collection.set_clim(0., 1.)
    axis.set_title(f"{name}, {axis.get_title()}", fontsize=8)


def draw(options):
    folder = os.path.join(options.output, options.resolution)
    n_drawn = 0
    for factor in options.factors:
        histories = {}
        for value in FACTORS[factor]:
            try:
                histories[value] = read_statistics(place(options, factor, value))
            except ResultError as error:
                print(f"{factor}/{value}: {error}", file=sys.stderr)
        if not histories:
            continue
        length, height = (max(columns[extent][-1] for columns in histories.values()) for extent in ("extent_x", "extent_y"))
        window = (0., max(5.5, length + 0.5), -max(2., height + 0.5), max(2., height + 0.5))
        figure, axes = plt.subplots(1, 4, figsize=(16., 3.6), layout="constrained")
        for axis in axes[len(histories):3]:
            axis.axis("off")
        for axis, value in zip(axes, histories):
            draw_damage(axis, place(options, factor, value), f"{factor} {value} {UNITS[factor]}", window)
            columns = histories[value]
            axes[3].plot(columns["time"], [1e-6 * p for p in columns["inlet_pressure"]], label=f"{value} {UNITS[factor]}")
        axes[0].set_ylabel("y [m]")
        axes[3].set_xlabel("time [s]")
        axes[3].set_ylabel("pressure at the inlet [MPa]")
        axes[3].grid(alpha=0.3)
        axes[3].legend(frameon=False)
        output = os.path.join(folder, f"{factor}.png")
        figure.savefig(output, dpi=80)
        plt.close(figure)
        print(output)
        n_drawn += 1
    return 0 if n_drawn else 1


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("command", choices=("run", "table", "draw", "study"))
    parser.add_argument("--factors", nargs="+", choices=FACTORS, help="not with study; default: all")
    parser.add_argument("--resolution", choices=("coarse", "medium", "fine"), help="not with study; default: fine")
    parser.add_argument("--output", default="branching", metavar="DIR")
    parser.add_argument("--program", type=program, default=PROGRAM)
    parser.add_argument("--set", action="append", default=[], metavar="'Section/Entry=value'")
    options = parser.parse_args()
    if options.command == "study" and (options.factors or options.resolution):
        parser.error(f"the study is of {'/'.join(STUDIED)}, fine: no --factors, no --resolution")
    options.factors = options.factors or list(FACTORS)
    options.resolution = options.resolution or "fine"
    return {"run": run, "table": table, "draw": draw, "study": study}[options.command](options)


if __name__ == "__main__":
    script(main)
