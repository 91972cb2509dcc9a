#!/usr/bin/python3
"""Compression of the rock beside a straight fracture, and what of it the run has added: the back-stress.

    contrib/back_stress.py OUTPUT_DIRECTORY [--time T] [--from D] [--to D] [--middle SHARE]

From the fields of the output nearest to the time (the last one otherwise): the mean, by area, of the total
stress across the fracture and of the pore pressure in the cells whose centres lie between two distances
[m] from the fracture's line, beside the middle share of its length. The back-stress is this compression less
that of 'In situ/Stress' (constant, in SI units or MPa). While the fracture is open, its fluid presses on the
rock as well; when it has just closed, the back-stress is what leaked fluid and the swollen rock have made.
"""
import argparse
import os
import sys

import numpy as np

HERE = os.path.dirname(os.path.abspath(__file__))
sys.path[:0] = [HERE, os.path.join(HERE, "plot")]
import vtu  # noqa: E402
from field import pascals  # noqa: E402
from results import ResultError, read_deck, script  # noqa: E402


def line_of(fracture):
    """Middle, unit tangent and length of the line through the ends of a fracture."""
    ends, _ = fracture.cells(vtu.LINE)
    points = fracture.points[ends].reshape(-1, 3)[:, :2]
    along = np.linalg.svd(points - points.mean(axis=0))[2][0]
    place = points @ along
    first, last = points[place.argmin()], points[place.argmax()]
    return (first + last) / 2, along, place.max() - place.min()


def mean_beside(grid, line, distances, middle):
    """Compression across the line and pore pressure (None without) of cells beside it; how many."""
    centre, along, length = line
    normal = np.array([-along[1], along[0]])
    corners, cells = grid.quadrilaterals()
    polygons = grid.points[corners][:, :, :2]
    offset = polygons.mean(axis=1) - centre
    far = np.abs(offset @ normal)
    chosen = (far >= distances[0]) & (far <= distances[1]) & (np.abs(offset @ along) <= 0.5 * middle * length)
    if not chosen.any():
        raise ResultError("no cell lies there; widen --from, --to or --middle")
    diagonals = polygons[chosen, 2] - polygons[chosen, 0], polygons[chosen, 3] - polygons[chosen, 1]
    area = 0.5 * np.abs(diagonals[0][:, 0] * diagonals[1][:, 1] - diagonals[0][:, 1] * diagonals[1][:, 0])

    def mean(name):
        if name in grid.cell_data:
            values = grid.cell_data[name][cells][chosen]
        else:
            values = grid.point_data[name][corners[chosen]].mean(axis=1)
        return np.average(values, axis=0, weights=area)

    stress = mean("total_stress")
    across = (normal[0] ** 2 * stress[0] + normal[1] ** 2 * stress[4]
              + normal[0] * normal[1] * (stress[1] + stress[3]))
    pores = mean("pore_pressure") if "pore_pressure" in {**grid.cell_data, **grid.point_data} else None
    return -across, pores, chosen.sum()


def in_situ(directory, normal):
    """Compression across a plane by the deck's constant stress [Pa]."""
    stress = read_deck(directory).get("In situ/Stress") or "0, 0"
    given = [pascals(text) for text in stress.split(",")] + [0.]
    return -(normal[0] ** 2 * given[0] + normal[1] ** 2 * given[1] + 2 * normal[0] * normal[1] * given[2])


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("directory")
    parser.add_argument("--time", type=float, help="[s]")
    parser.add_argument("--from", type=float, default=1., dest="first", help="distance [m]")
    parser.add_argument("--to", type=float, default=4., help="distance [m]")
    parser.add_argument("--middle", type=float, default=0.5, help="share of the length")
    options = parser.parse_args()
    time, path = vtu.at_time(vtu.series(options.directory, "fields"), options.time)
    fracture = vtu.read(vtu.at_time(vtu.series(options.directory, "fracture"), time)[1])
    line = line_of(fracture)
    across, pores, n = mean_beside(vtu.read(path), line, (options.first, options.to), options.middle)
    far = in_situ(options.directory, np.array([-line[1][1], line[1][0]]))
    print(f"at {time:g} s, {n} cells {options.first:g} to {options.to:g} m beside the fracture")
    print(f"compression across it: {across / 1e6:.4f} MPa")
    print(f"in-situ stress across it: {far / 1e6:.4f} MPa")
    print(f"back-stress: {(across - far) / 1e6:.4f} MPa")
    if pores is not None:
        print(f"pore pressure there: {pores / 1e6:.4f} MPa")


if __name__ == "__main__":
    script(main)
