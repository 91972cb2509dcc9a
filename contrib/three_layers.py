#!/usr/bin/python3
"""A fracture in three layers after Zhang, Cao, Wang & Guo (2022): run, drawn, and many rocks of it.

    contrib/three_layers.py run   [--angles 0 27 45] [--resolution coarse] [--output DIR] [--set ...]
    contrib/three_layers.py plot  [--angles 0 27 45] [--resolution coarse] [--output DIR]
    contrib/three_layers.py seeds [--n 20] [--angle 0] [--end 4] [--output DIR] [--set ...]

`run` runs the decks prm/three_layers/<angle>/damage.prm; what is finished stays as it is, what was begun goes on
from its checkpoint. `plot` prints the zone's direction and shape, the stages, and draws the counterparts of
the paper's Figures 6 to 11 and 13 to 15 into DIR. `seeds` runs as many rocks to the end of the second stage,
that in which the pressure falls after breakdown, and prints mean and scatter of the breakdown pressure and of the
half-length; a rock counts in what it has come to by --end. Results are in DIR/<resolution>/<angle> and
DIR/<resolution>/seeds/<angle>/<seed>.
"""
import argparse
import math
import os
import statistics
import sys

import numpy as np

HERE = os.path.dirname(os.path.abspath(__file__))
ROOT = os.path.join(HERE, "..")
sys.path.insert(0, HERE)
from arguments import PROGRAM, positive, program, whole_from  # noqa: E402
from deck_runs import run_deck  # noqa: E402
from results import script  # noqa: E402
from three_layers import figures, zone  # noqa: E402

ANGLES = (0, 27, 45)


def run(options, angle, directory, settings):
    deck = os.path.join(ROOT, "prm", "three_layers", str(angle), "damage.prm")
    return run_deck(options.program, deck, directory,
                    [f"Resolution={options.resolution}", *settings, *options.set])


def place(options, angle):
    return os.path.join(options.output, options.resolution, str(angle))


def run_all(options):
    return 0 if all([run(options, angle, place(options, angle), []) for angle in options.angles]) else 1


def plot(options):
    runs = [figures.Run(place(options, angle), angle) for angle in options.angles]
    for one in runs:
        time, cells = zone.at(one.directory)
        found = zone.Zone(cells, one.angle)
        edges, low, high = found.section(max(3, int(round(one.half_length[-1] / 5.))))
        there = ~(low != low)
        area = ((high - low)[there] * (edges[1:] - edges[:-1])[there]).sum()
        height, length = (high - low)[there].max(), edges[-1] - edges[0]
        print(f"theta {one.angle:g}: to {time:.4g} s; zone at {found.direction():.1f} degrees, {length:.4g} m long, "
              f"{height:.4g} m high, its section {area / (math.pi / 4. * height * length):.2f} of an ellipse's")
        begin = "; ".join(f"stage {name} begins at {t:.3g} s" if t == t else f"stage {name} has not begun"
                          for name, t in zip(figures.STAGES[1:], one.stages()))
        print(f"  {begin}; "
              f"breakdown {1e-6 * one.pressure[one.breakdown()]:.3f} MPa, at the end {1e-6 * one.pressure[-1]:.3f} MPa, "
              f"{1e3 * one.width[-1]:.3g} mm, half-length {one.half_length[-1]:.4g} m")
    folder = os.path.join(options.output, options.resolution)
    figures.zones(runs, os.path.join(folder, "zones.png"))
    figures.histories(runs, os.path.join(folder, "histories.png"))
    for one in runs:
        figures.in_time(one, os.path.join(folder, f"in_time_{one.angle:g}.png"))
        figures.profiles(one, os.path.join(folder, f"profiles_{one.angle:g}.png"))
    return 0


def seeds(options):
    breakdown, ends, failed = [], [], 0
    for seed in range(1, options.n + 1):
        directory = os.path.join(options.output, options.resolution, "seeds", str(options.angle), str(seed))
        settings = [f"Rock/Random field/Seed={seed}", f"Time/End time={options.end} s", "Output/Fields=false"]
        if not run(options, options.angle, directory, settings):
            failed += 1
            continue
        one = figures.Run(directory, options.angle)
        peak, fallen, _ = one.stages()
        if math.isnan(peak):
            print(f"  seed {seed}: no breakdown by {one.time[-1]:.3g} s ('--end')", flush=True)
            continue
        breakdown.append(1e-6 * one.pressure[one.breakdown()])
        print(f"  seed {seed}: breakdown {breakdown[-1]:.4f} MPa at {peak:.3g} s, ", end="")
        if math.isnan(fallen):
            print(f"and no end of the fall by {one.time[-1]:.3g} s ('--end')", flush=True)
            continue
        end = int(np.flatnonzero(one.time == fallen)[0])
        ends.append((1e-6 * one.pressure[end], one.half_length[end], fallen))
        print(f"fallen to {ends[-1][0]:.4f} MPa at {fallen:.3g} s, half-length then {ends[-1][1]:.4g} m", flush=True)
    fall = list(zip(*ends)) or [(), (), ()]
    for name, unit, column in (("breakdown pressure", "MPa", breakdown), ("pressure it falls to", "MPa", fall[0]),
                               ("half-length at the end of stage II", "m", fall[1]),
                               ("end of stage II", "s", fall[2])):
        if column:
            scatter = f"standard deviation {statistics.stdev(column):.2g} {unit}, " if len(column) > 1 else ""
            print(f"{name}: mean {statistics.mean(column):.4g} {unit}, {scatter}"
                  f"{len(column)} of {options.n} rocks")
        else:
            print(f"{name}: in none of {options.n} rocks")
    return 0 if ends and not failed else 1


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("command", choices=("run", "plot", "seeds"))
    parser.add_argument("--angles", type=int, nargs="+", choices=ANGLES, default=list(ANGLES))
    parser.add_argument("--angle", type=int, choices=ANGLES, default=0)
    parser.add_argument("--resolution", choices=("coarse", "medium", "fine"), default="coarse")
    parser.add_argument("--n", type=whole_from(1), default=20)
    parser.add_argument("--end", type=positive, default=4., metavar="SECONDS")
    parser.add_argument("--output", default="three_layers", metavar="DIR")
    parser.add_argument("--program", type=program, default=PROGRAM)
    parser.add_argument("--set", action="append", default=[], metavar="'Section/Entry=value'")
    options = parser.parse_args()
    return {"run": run_all, "plot": plot, "seeds": seeds}[options.command](options)


if __name__ == "__main__":
    script(main)
