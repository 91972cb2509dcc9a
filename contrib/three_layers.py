#!/usr/bin/python3
"""A fracture in three layers after Zhang, Cao, Wang & Guo (2022): run, drawn, and many rocks of it.

    contrib/three_layers.py run   [--angles 0 27 45] [--resolution coarse] [--output DIR] [--set ...]
    contrib/three_layers.py plot  [--angles 0 27 45] [--resolution coarse] [--output DIR]
    contrib/three_layers.py seeds [--n 20] [--angle 0] [--end 1.5] [--output DIR] [--set ...]

`run` runs the decks prm/three_layers/<angle>/damage.prm; what is finished stays as it is, what was begun goes on
from its checkpoint. `plot` prints the zone's direction and shape, the stages, and draws the counterparts of
the paper's Figures 6 to 11 and 13 to 15 into DIR. `seeds` runs as many rocks to the end of the second stage,
that in which the pressure falls after breakdown, and prints mean and scatter of the breakdown pressure and of the
half-length. Results are in DIR/<resolution>/<angle> and DIR/<resolution>/seeds/<angle>/<seed>.
"""
import argparse
import math
import os
import statistics
import sys

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
        print(f"  stages II, III, IV begin at {', '.join(f'{t:.3g}' for t in one.stages())} s; "
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
    values, failed = [], 0
    for seed in range(1, options.n + 1):
        directory = os.path.join(options.output, options.resolution, "seeds", str(options.angle), str(seed))
        settings = [f"Rock/Random field/Seed={seed}", f"Time/End time={options.end} s", "Output/Fields=false"]
        if not run(options, options.angle, directory, settings):
            failed += 1
            continue
        one = figures.Run(directory, options.angle)
        peak, fallen, _ = one.stages()
        if fallen == one.time[-1]:
            print(f"  seed {seed}: the pressure falls to the end: give a later --end", flush=True)
            failed += 1
            continue
        values.append((1e-6 * one.pressure[one.breakdown()], 1e-6 * float(one.pressure[one.time == fallen][0]),
                       float(one.half_length[one.time == fallen][0]), fallen))
        print(f"  seed {seed}: breakdown {values[-1][0]:.4f} MPa at {peak:.3g} s, fallen to {values[-1][1]:.4f} MPa at "
              f"{fallen:.3g} s, half-length then {values[-1][2]:.4g} m", flush=True)
    for name, unit, column in zip(("breakdown pressure", "pressure it falls to", "half-length at the end of stage II",
                                   "end of stage II"), ("MPa", "MPa", "m", "s"), zip(*values)):
        scatter = statistics.stdev(column) if len(column) > 1 else math.nan
        print(f"{name}: mean {statistics.mean(column):.4g} {unit}, standard deviation {scatter:.2g} {unit}, "
              f"{len(column)} rocks")
    return 1 if failed else 0


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("command", choices=("run", "plot", "seeds"))
    parser.add_argument("--angles", type=int, nargs="+", choices=ANGLES, default=list(ANGLES))
    parser.add_argument("--angle", type=int, choices=ANGLES, default=0)
    parser.add_argument("--resolution", choices=("coarse", "medium", "fine"), default="coarse")
    parser.add_argument("--n", type=whole_from(1), default=20)
    parser.add_argument("--end", type=positive, default=1.5, metavar="SECONDS")
    parser.add_argument("--output", default="three_layers", metavar="DIR")
    parser.add_argument("--program", type=program, default=PROGRAM)
    parser.add_argument("--set", action="append", default=[], metavar="'Section/Entry=value'")
    options = parser.parse_args()
    return {"run": run_all, "plot": plot, "seeds": seeds}[options.command](options)


if __name__ == "__main__":
    script(main)
