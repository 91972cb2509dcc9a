#!/usr/bin/python3
"""Draw the paths of the fractures of several runs, and print how far each has turned.

    paths.py DIRECTORY... [--time T] [--crack N] [--split Y] [--output FILE.png]
             [--turn FILE.png --pumping T]

Looked at is x > 0, and what lies above and what lies below y = Y (0 without --split) is a wing each. Printed are
the place of its tip, how far that has moved away from the line y = Y since the wing's first point [m], and the direction
of the wing's last quarter against x [degrees], positive away from that line. A fracture along it has to be kept to one
side by --split. With --crack only this one is looked at, counted from 1 in the order of the deck.
With --turn, how far the tips have moved away is drawn against the time of each run without its last T seconds.
"""
import argparse
import os
import sys

import matplotlib
matplotlib.use("Agg")
import matplotlib.pyplot as plt  # noqa: E402
import numpy as np  # noqa: E402

HERE = os.path.dirname(os.path.abspath(__file__))
sys.path[:0] = [HERE, os.path.join(HERE, "..")]
import vtu  # noqa: E402
from results import ResultError, script  # noqa: E402


def wings(fracture, split, crack):
    """[(points of a wing in order of x, 1 above or -1 below the split)]."""
    ends, cells = fracture.cells(vtu.LINE)
    if crack and len(ends):
        of_crack = (fracture.cell_data["crack"][cells] if "crack" in fracture.cell_data else
                    fracture.point_data["crack"][ends].mean(axis=1))
        ends = ends[of_crack.round() == crack]
    if not len(ends):
        return []
    points = np.unique(fracture.points[ends.ravel()][:, :2].round(9), axis=0)
    points = points[points[:, 0] >= 0.]
    found = [(points[side * (points[:, 1] - split) > 0.], side) for side in (1, -1)]
    return [(p[np.argsort(p[:, 0])], side) for p, side in found if len(p) > 1]


def turned(path, side):
    """x and y of the tip, how far it has moved away, and the direction of the last quarter in degrees."""
    (x0, y0), (x, y) = path[0], path[-1]
    last = path[path[:, 0] >= x - 0.25 * (x - x0)]
    slope = np.polyfit(last[:, 0], last[:, 1], 1)[0] if len(last) > 1 else 0.
    return x, y, side * (y - y0), side * np.degrees(np.arctan(slope))


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("directory", nargs="+")
    parser.add_argument("--time", type=float)
    parser.add_argument("--crack", type=int)
    parser.add_argument("--split", type=float, default=0.)
    parser.add_argument("--output")
    parser.add_argument("--turn")
    parser.add_argument("--pumping", type=float, default=0.)
    options = parser.parse_args()

    figure, ax = plt.subplots(figsize=(7, 3.2))
    moved = []
    print("run,time,x,y,away,direction")
    for i, directory in enumerate(options.directory):
        time, path = vtu.at_time(vtu.series(directory, "fracture"), options.time)
        found = wings(vtu.read(path), options.split, options.crack)
        if not found:
            raise ResultError(f"'{directory}' has no fracture in x > 0 at {time:g} s")
        name = os.path.basename(os.path.normpath(directory))
        for j, (points, side) in enumerate(found):
            print(f"{name},{time:g}," + ",".join(f"{v:.4g}" for v in turned(points, side)))
            moved.append(((time - options.pumping) / 3600, turned(points, side)[2]))
            ax.plot(*points.T, color=f"C{i}", lw=1.2, label=None if j else name)
    ax.set_xlabel("x [m]")
    ax.set_ylabel("y [m]")
    ax.grid(alpha=0.3)
    ax.legend(frameon=False)
    figure.tight_layout()
    output = options.output or os.path.join(options.directory[0], "paths.png")
    figure.savefig(output, dpi=110)
    print(output)
    if options.turn:
        draw_turn(sorted(moved), options.turn)


def draw_turn(moved, output):
    figure, ax = plt.subplots(figsize=(7, 2.6))
    ax.plot(*np.transpose(moved), "o-", lw=1.2, ms=4)
    ax.set_xscale("symlog", linthresh=1.)
    ax.axhline(0., color="k", lw=0.6)
    ax.set_xlabel("time before the injection [h]")
    ax.set_ylabel("moved away [m]")
    ax.grid(alpha=0.3)
    figure.tight_layout()
    figure.savefig(output, dpi=110)
    print(output)


if __name__ == "__main__":
    script(main)
