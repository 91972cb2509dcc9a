#!/usr/bin/python3
"""When does a fast crack of bonds fork? The decks prm/dry: run, in tables, drawn.

    contrib/dry.py run   [--cases pmma_strip glass_plate kalthoff bridge] [--output DIR] [--program FILE]
    contrib/dry.py table [the same]
    contrib/dry.py draw  [--output DIR]

`run` runs the strip at nine stretches, with cells of 0.1 and 0.05 mm, horizons of 3, 4 and 5 cells, bonds that are brittle
or soften, and its notch a row of cells off the middle (moved); the plate of glass, Kalthoff's plate and the notch under
a given pressure with fewer of these varied. What is finished stays as it is. `table` prints what each crack did, `draw`
the energy at which the strip forks. Results are in DIR/<case>/<name>.

A crack forks when it becomes broader than three sixteenths of the body, and more than one before its tip has come through
fifteen sixteenths of its length. Where, and the angle between the arms, are read off breadth over length in between. Arms
that die before are none, and less than 15 degrees are a band of damage that becomes broader. Speeds are the greatest over
6 per cent of the body's length, before the fork. Angles of Kalthoff's crack are those of the part of it that hangs
together with the end of the notch.
"""
import argparse
import itertools
import math
import os
import sys

HERE = os.path.dirname(os.path.abspath(__file__))
ROOT = os.path.join(HERE, "..")
sys.path.insert(0, HERE)
from arguments import PROGRAM, program  # noqa: E402
from deck_runs import run_deck  # noqa: E402
from results import ResultError, read_deck, read_statistics, read_summary, script  # noqa: E402
from tips import greatest_speed, rayleigh_speed  # noqa: E402

BONDS = "Fracture/peridynamics/"
LAWS = {"brittle": [], "soft": [BONDS + "Softening=4"]}  # the decks' bonds are brittle
# Brittle as well, the strip's notch a row of cells off the middle: {resolution: settings}.
MOVED_NAME = "brittle, notch a row off the middle"
MOVED = {resolution: [f"Cracks/Open=0, {row} mm -> 4 mm, {row} mm"]
         for resolution, row in (("medium", 16. / 159.), ("fine", 16. / 319.))}
STRETCHES = (0.028, 0.0305, 0.0325, 0.034, 0.035, 0.0365, 0.038, 0.040, 0.045)  # mm to either side
HORIZONS = (3, 4, 5)
HIT = ["Mesh/Side boxes=hit: (-1 mm, -1 mm) to (1 mm, 25 mm)", "Boundary conditions/Displacement x=hit: 16.5*t",
       "Boundary conditions/Normal traction="]


def strip(stretch, resolution, horizon, law):
    more = MOVED[resolution] if law == "moved" else LAWS[law]
    return (f"{stretch:g}_{resolution}_{horizon}_{law}", "pmma_strip/0.040",
            [f"Resolution={resolution}", f"{BONDS}Horizon={horizon}", *more, "Output/Fields=false",
             f"Boundary conditions/Displacement y=bottom: {-stretch:g}e-3; top: {stretch:g}e-3"])


def plate(load, resolution, horizon, law, more=()):
    return (f"{load}_{resolution}_{horizon}_{law}" + ("_twice" if more else ""), f"glass_plate/{load}",
            [f"Resolution={resolution}", f"{BONDS}Horizon={horizon}", *LAWS[law], *more])


def steel(resolution, horizon, law, moved=False):
    return (f"{resolution}_{horizon}_{law}" + ("_moved" if moved else ""), "kalthoff",
            [f"Resolution={resolution}", f"{BONDS}Horizon={horizon}", *LAWS[law], *(HIT if moved else [])])


def notch(pressure, resolution, horizon, law, more=()):
    return (f"{pressure}_{resolution}_{horizon}_{law}" + ("_rest" if more else ""), "bridge/1",
            [f"Resolution={resolution}", f"{BONDS}Horizon={horizon}", *LAWS[law], f"Cracks/Fluid pressure={pressure} MPa", *more])


TWICE = ["Boundary conditions/Normal traction=top: 4 MPa; bottom: 4 MPa"]
REST = ["Time/Start=in equilibrium"]

# Of each case: (name, deck, settings) of each run.
STRIPS = [*itertools.product(("medium", "fine"), HORIZONS, LAWS), *itertools.product(("medium", "fine"), (3, 5), ("moved",))]
RUNS = {
    "pmma_strip": [strip(stretch, *what) for stretch, what in itertools.product(STRETCHES, STRIPS)],
    "glass_plate": [*(plate("light", *what) for what in itertools.product(("coarse", "medium"), HORIZONS, LAWS)),
                    plate("heavy", "coarse", 3, "brittle"), plate("heavy", "medium", 3, "brittle"),
                    *(plate("light", resolution, 3, "brittle", TWICE) for resolution in ("coarse", "medium"))],
    "kalthoff": [*(steel(resolution, 3, "brittle", moved)
                   for resolution in ("coarse", "medium", "fine") for moved in (False, True)),
                 steel("medium", 4, "brittle"), steel("medium", 5, "brittle"), steel("medium", 3, "soft")],
    "bridge": [*(notch(1, *what) for what in itertools.product(("medium", "fine"), HORIZONS, ("brittle",))),
               notch(1, "fine", 3, "brittle", REST), notch(0.8, "fine", 3, "brittle"), notch(0.6, "fine", 3, "brittle"),
               notch(0.45, "medium", 3, "brittle"), notch(0.45, "fine", 3, "brittle")]}

NOTCH_END, WAYS = (50e-3, 25e-3), (10e-3, 20e-3, 40e-3)  # of Kalthoff's plate [m]
LEAST_ANGLE = 15.  # between arms [degrees]
SIZES = {"pmma_strip": (32e-3, 16e-3), "glass_plate": (100e-3, 40e-3), "bridge": (8.1, 16.)}  # length, breadth of the body [m]


def place(options, case, name):
    return os.path.join(options.output, case, name)


def run(options):
    ended = [run_deck(options.program, os.path.join(ROOT, "prm", "dry", *deck.split("/"), "peridynamics.prm"),
                      place(options, case, name), settings)
             for case in options.cases for name, deck, settings in RUNS[case]]
    return 0 if all(ended) else 1


def fork(length, breadth, size):
    """(step, length [m], angle between the arms [degrees]) where a crack in a body of a length and a breadth forks, or None."""
    first, last = (next((i for i, b in enumerate(breadth) if b >= share / 16. * size[1]), None) for share in (1., 3.))
    if last is None or length[first] > 15. / 16. * size[0]:
        return None
    ahead, apart = length[last] - length[first], breadth[last] - breadth[first]
    angle = 2. * math.degrees(math.atan2(0.5 * apart, ahead))
    return (first, length[first] - breadth[first] * ahead / apart, angle) if angle >= LEAST_ANGLE else None


def outcome(case, directory):
    """What the crack of a strip, a plate or a notch has done, by name."""
    columns, summary, deck = read_statistics(directory), read_summary(directory), read_deck(directory)
    length, breadth, size = columns["extent_x"], columns["extent_y"], SIZES[case]
    forked = fork(length, breadth, size)
    end = forked[0] + 1 if forked else len(length)
    return {"forked": forked, "length": length[-1], "breadth": breadth[-1], "seconds": summary["cpu_seconds"],
            "speed": greatest_speed(columns["time"][:end], length[:end], 0.06 * size[0]) / rayleigh_speed(deck),
            "balance": max(map(abs, columns["energy_balance_error"]))}


def stored_over_tough(stretch):
    """Energy per area of the strip ahead of the crack over G_c, of prm/cases/dry/pmma_strip.part.prm: in plane stress, its
    long sides held along themselves and moved apart by the stretch [mm] each."""
    modulus, poisson_ratio, toughness, height = 3.09e9, 1. / 3., 300., SIZES["pmma_strip"][1]
    strain = 2e-3 * stretch / height
    return 0.5 * modulus / (1. - poisson_ratio**2) * strain**2 * height / toughness


def forks_at(found, scale, unit):
    return "no" if not found["forked"] else f"{scale * found['forked'][1]:.3g} {unit}, {found['forked'][2]:.0f}°"


def strip_rows(options):
    """(cells, horizon, bonds): {stretch: outcome} of what has run."""
    for resolution, horizon, law in STRIPS:
        found = {}
        for stretch in STRETCHES:
            try:
                found[stretch] = outcome("pmma_strip", place(options, "pmma_strip", strip(stretch, resolution, horizon, law)[0]))
            except ResultError:
                continue
        yield ({"medium": "0.1 mm", "fine": "0.05 mm"}[resolution], horizon, law), found


def print_strips(options):
    print("\n| cells, horizon, bonds | " + " | ".join(f"{stored_over_tough(stretch):.2f} G_c" for stretch in STRETCHES)
          + " | tip speed over c_R | balance | processor [s] |\n| --- |" + " --- |" * len(STRETCHES) + " --- | ---: | --- |")
    for (cells, horizon, law), found in strip_rows(options):
        if not found:
            continue
        speeds, seconds = ([what[name] for what in found.values()] for name in ("speed", "seconds"))
        print(f"| {cells}, {horizon}, {MOVED_NAME if law == 'moved' else law} | "
              + " | ".join(forks_at(found[stretch], 1e3, "mm") if stretch in found else "" for stretch in STRETCHES)
              + f" | {min(speeds):.2f} to {max(speeds):.2f} | {max(what['balance'] for what in found.values()):.0e}"
              f" | {min(seconds):.0f} to {max(seconds):.0f} |")


def print_bodies(options, case):
    scale, unit = (1., "m") if case == "bridge" else (1e3, "mm")
    print(f"\n| {case} | forks, angle between the arms | tip speed over c_R | end: length, breadth [{unit}] | balance | "
          "processor [s] |\n| --- | --- | ---: | --- | ---: | ---: |")
    for name, _, _ in RUNS[case]:
        try:
            found = outcome(case, place(options, case, name))
        except ResultError as error:
            print(f"| {name} | {error} | | | | |")
            continue
        print(f"| {name} | {forks_at(found, scale, unit)} | {found['speed']:.2f} | {scale * found['length']:.3g}, "
              f"{scale * found['breadth']:.2g} | {found['balance']:.0e} | {found['seconds']:.0f} |")


def print_kalthoff(options):
    print("\n| kalthoff | angle to the notch over the first " + ", ".join(f"{1e3 * way:g}" for way in WAYS)
          + " mm | balance | processor [s] |\n| --- | --- | ---: | ---: |")
    for name, _, _ in RUNS["kalthoff"]:
        directory = place(options, "kalthoff", name)
        try:
            summary, columns = read_summary(directory), read_statistics(directory)
        except ResultError as error:
            print(f"| {name} | {error} | | |")
            continue
        print(f"| {name} | " + ", ".join(f"{angle:.0f}°" for angle in angles(directory))
              + f" | {max(map(abs, columns['energy_balance_error'])):.0e} | {summary['cpu_seconds']:.0f} |")


def angles(directory):
    """Of Kalthoff's crack to the notch, over each of the ways [degrees]: to the farthest of what hangs together with the
    end of the notch, and lies within this way."""
    import numpy as np  # here, for all else is the standard library's
    from plot import vtu
    fracture = vtu.read(vtu.at_time(vtu.series(directory, "fracture"))[1])
    ends, _ = fracture.cells(vtu.LINE)
    middles, size = fracture.points[ends].mean(axis=1)[:, :2] - NOTCH_END, np.ptp(fracture.points[ends], axis=1).max()
    away = np.linalg.norm(middles, axis=1)
    hangs = away < 2. * size
    while True:
        near = np.linalg.norm(middles[:, None] - middles[hangs], axis=2).min(axis=1) < 1.6 * size
        if (near == hangs).all():
            break
        hangs = near
    for way in WAYS:
        x, y = middles[np.argmax(np.where(hangs & (away <= way) & (middles[:, 1] > 2. * size), away, -1.))]
        yield math.degrees(math.atan2(y, x))


def table(options):
    for case in options.cases:
        if case == "pmma_strip":
            print_strips(options)
        elif case == "kalthoff":
            print_kalthoff(options)
        else:
            print_bodies(options, case)
    return 0


def draw(options):
    """At which stored energy the strip forks."""
    import matplotlib  # here, for all else is the standard library's
    matplotlib.use("Agg")
    import matplotlib.pyplot as plt
    rows = [row for row in strip_rows(options) if row[1]]
    if not rows:
        raise ResultError(f"no run of the strip has ended in '{options.output}'")
    figure, axis = plt.subplots(figsize=(7.5, 0.6 + 0.3 * len(rows)), layout="constrained")
    for height, (_, found) in enumerate(reversed(rows)):
        for stretch, what in found.items():
            axis.plot(stored_over_tough(stretch), height, "o", markersize=8, color="tab:blue",
                      markerfacecolor="tab:blue" if what["forked"] else "white")
    axis.axvline(2., color="0.6", linestyle="--", zorder=0)
    axis.set_yticks(range(len(rows)), [f"{cells}, {horizon} cells, {law}" for (cells, horizon, law), _ in reversed(rows)])
    axis.set_xlabel("energy stored ahead over $G_c$ (filled: forks; dashed: Bleyer et al. 2017)")
    output = os.path.join(options.output, "pmma_strip.png")
    figure.savefig(output, dpi=100)
    print(output)
    return 0


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("command", choices=("run", "table", "draw"))
    parser.add_argument("--cases", nargs="+", choices=RUNS, help="not with draw; default: all")
    parser.add_argument("--output", default="dry", metavar="DIR")
    parser.add_argument("--program", type=program, default=PROGRAM)
    options = parser.parse_args()
    if options.command == "draw" and options.cases:
        parser.error("what is drawn is the strip: no --cases")
    options.cases = options.cases or list(RUNS)
    return {"run": run, "table": table, "draw": draw}[options.command](options)


if __name__ == "__main__":
    script(main)
