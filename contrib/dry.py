#!/usr/bin/python3
"""When does a fast crack of bonds fork? The decks prm/dry: run, in tables, drawn.

    contrib/dry.py run   [--cases pmma_strip glass_plate kalthoff bridge] [--output DIR] [--program FILE]
    contrib/dry.py table [the same]
    contrib/dry.py draw  [--output DIR]

`run` runs the strip at nine stretches, with cells of 0.1 and 0.05 mm, horizons of 3, 4 and 5 cells, bonds that are brittle
or soften; the plate of glass, Kalthoff's plate and the notch under a given pressure with fewer of these varied. What is
finished stays as it is. `table` prints what each crack did, `draw` the energy at which the strip forks. Results are in
DIR/<case>/<name>.

A crack forks when its breadth grows beyond a sixteenth of the body's: arms that die before are none. Where, and the angle
between the arms, are read off the breadth over the length as that triples. Speeds are the greatest over a sixteenth of the
length, before the fork.
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
from tips import greatest_speed, number, rayleigh_speed  # noqa: E402

BONDS = "Fracture/peridynamics/"
LAWS = {"brittle": [], "soft": [BONDS + "Softening=4"]}  # the decks' bonds are brittle
STRETCHES = (0.028, 0.0305, 0.0325, 0.034, 0.035, 0.0365, 0.038, 0.040, 0.045)  # mm to either side
HORIZONS = (3, 4, 5)
HIT = ["Mesh/Side boxes=hit: (-1 mm, -1 mm) to (1 mm, 25 mm)", "Boundary conditions/Displacement x=hit: 16.5*t",
       "Boundary conditions/Normal traction="]


def strip(stretch, resolution, horizon, law):
    return (f"{stretch:g}_{resolution}_{horizon}_{law}", "pmma_strip/0.040",
            [f"Resolution={resolution}", f"{BONDS}Horizon={horizon}", *LAWS[law], "Output/Fields=false",
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
RUNS = {
    "pmma_strip": [strip(*what) for what in itertools.product(STRETCHES, ("medium", "fine"), HORIZONS, LAWS)],
    "glass_plate": [*(plate("light", *what) for what in itertools.product(("coarse", "medium"), HORIZONS, LAWS)),
                    plate("heavy", "coarse", 3, "brittle"), plate("heavy", "medium", 3, "brittle"),
                    *(plate("light", resolution, 3, "brittle", TWICE) for resolution in ("coarse", "medium"))],
    "kalthoff": [*(steel(resolution, 3, "brittle", moved)
                   for resolution in ("coarse", "medium", "fine") for moved in (False, True)),
                 steel("medium", 4, "brittle"), steel("medium", 5, "brittle"), steel("medium", 3, "soft")],
    "bridge": [*(notch(1, *what) for what in itertools.product(("medium", "fine"), HORIZONS, LAWS) if what[2] == "brittle"),
               notch(1, "fine", 3, "brittle", REST), notch(0.8, "fine", 3, "brittle"), notch(0.6, "fine", 3, "brittle"),
               notch(0.45, "medium", 3, "brittle"), notch(0.45, "fine", 3, "brittle")]}

BREADTHS = {"pmma_strip": 16e-3, "glass_plate": 40e-3, "bridge": 16.}  # of the body [m]


def place(options, case, name):
    return os.path.join(options.output, case, name)


def run(options):
    ended = [run_deck(options.program, os.path.join(ROOT, "prm", "dry", *deck.split("/"), "peridynamics.prm"),
                      place(options, case, name), settings)
             for case in options.cases for name, deck, settings in RUNS[case]]
    return 0 if all(ended) else 1


def fork(length, breadth, least):
    """(step, length, angle between the arms [degrees]) where the breadth has grown to so much, or None."""
    first = next((i for i, b in enumerate(breadth) if b >= least), None)
    if first is None:
        return None
    last = next((i for i, b in enumerate(breadth) if b >= 3. * least), len(breadth) - 1)
    if length[last] <= length[first]:
        return first, length[first], math.nan
    slope = (breadth[last] - breadth[first]) / (length[last] - length[first])
    return first, length[first] - breadth[first] / slope, 2. * math.degrees(math.atan(0.5 * slope))


def outcome(case, directory):
    """What a crack of a strip, a plate or a notch has done, by name."""
    columns, summary, deck = read_statistics(directory), read_summary(directory), read_deck(directory)
    times, length, breadth = columns["time"], columns["extent_x"], columns["extent_y"]
    least = BREADTHS[case] / 16.
    forked = fork(length, breadth, least)
    end = forked[0] + 1 if forked else len(times)
    speed = greatest_speed(times[:end], length[:end], BREADTHS[case] / 8. if case != "bridge" else 0.6)
    return {"forked": forked, "speed": speed / rayleigh_speed(deck), "length": length[-1], "breadth": breadth[-1],
            "balance": max(map(abs, columns["energy_balance_error"])), "seconds": summary["cpu_seconds"],
            "time": times[forked[0]] if forked else times[-1], "status": summary["status"]}


def stored_over_tough(stretch):
    """Of the strip ahead of the crack, in plane stress with its grips held along it."""
    deck = {"E": 3.09e9, "nu": 1. / 3., "G_c": 300., "height": 16e-3}
    strain = 2e-3 * stretch / deck["height"]
    return 0.5 * deck["E"] / (1. - deck["nu"]**2) * strain**2 * deck["height"] / deck["G_c"]


def told(case, directory):
    """The cells of a row of the table."""
    try:
        found = outcome(case, directory)
    except ResultError as error:
        return f"{error} | | | | |"
    scale, unit = (1e3, "mm") if case != "bridge" else (1., "m")
    forked = "no" if not found["forked"] else f"at {scale * found['forked'][1]:.3g} {unit}, {found['forked'][2]:.0f}°"
    return (f"{forked} | {found['speed']:.2f} | {scale * found['length']:.3g}, {scale * found['breadth']:.2g} | "
            f"{found['balance']:.0e} | {found['seconds']:.0f} |")


def threshold(options, resolution, horizon, law):
    """(greatest energy without a fork below all forks, least with one, the forks' energies, speeds, angles), energies over G_c."""
    found = {}
    for stretch in STRETCHES:
        try:
            found[stretch] = outcome("pmma_strip", place(options, "pmma_strip", strip(stretch, resolution, horizon, law)[0]))
        except ResultError:
            continue
    return found


def table(options):
    for case in options.cases:
        if case == "kalthoff":
            print("\n| Kalthoff | angle over the first 10, 20, 60 mm | balance | processor [s] |\n| --- | --- | ---: | ---: |")
            for name, _, _ in RUNS[case]:
                print(f"| {name} | {kalthoff(place(options, case, name))}")
            continue
        unit = "m" if case == "bridge" else "mm"
        print(f"\n| {case} | forks, angle between the arms | tip speed over c_R | end: length, breadth [{unit}] | balance | processor [s] |\n"
              "| --- | --- | ---: | --- | ---: | ---: |")
        for name, _, _ in RUNS[case]:
            print(f"| {name} | {told(case, place(options, case, name))}")
    return 0


def kalthoff(directory):
    """Angles to the notch of the way from its end at (50 mm, 25 mm), by the extents of notch and crack."""
    try:
        columns, summary = read_statistics(directory), read_summary(directory)
    except ResultError as error:
        return f"{error} | | |"
    angles = []
    for way in (10e-3, 20e-3, 60e-3):
        last = next((i for i, (x, y) in enumerate(zip(columns["extent_x"], columns["extent_y"]))
                     if math.hypot(x - 50e-3, y) >= way), -1)
        angles.append(math.degrees(math.atan2(columns["extent_y"][last], columns["extent_x"][last] - 50e-3)))
    return (", ".join(f"{angle:.0f}°" for angle in angles)
            + f" | {max(map(abs, columns['energy_balance_error'])):.0e} | {summary['cpu_seconds']:.0f} |")


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("command", choices=("run", "table"))
    parser.add_argument("--cases", nargs="+", choices=RUNS, default=list(RUNS))
    parser.add_argument("--output", default="dry", metavar="DIR")
    parser.add_argument("--program", type=program, default=PROGRAM)
    options = parser.parse_args()
    return {"run": run, "table": table}[options.command](options)


if __name__ == "__main__":
    script(main)
