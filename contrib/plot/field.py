#!/usr/bin/python3
"""Draw a field of the rock, deformed, with the fracture opened by as much.

    field.py DIRECTORY [--field pore_pressure] [--component yy] [--time T] [--warp FACTOR]
             [--window x0,x1,y0,y1] [--mirror] [--output FILE.png]

Without --window, what surrounds the fracture is shown (without a fracture, everything). --warp is
the factor on displacement and opening; by default the greatest opening is drawn as 6 % of the
window's height. --mirror adds the mirror image at x = 0 of a half model.
"""
import argparse
import os
import sys

import matplotlib
matplotlib.use("Agg")
import matplotlib.pyplot as plt  # noqa: E402
import numpy as np  # noqa: E402
from matplotlib.collections import LineCollection, PolyCollection  # noqa: E402

sys.path.insert(0, os.path.dirname(os.path.abspath(__file__)))
import vtu  # noqa: E402

COMPONENTS = {"x": 0, "y": 1, "z": 2, "xx": 0, "xy": 1, "xz": 2, "yx": 3, "yy": 4, "yz": 5,
              "zx": 6, "zy": 7, "zz": 8}

UNITS = {"pore_pressure": ("MPa", 1e-6), "total_stress": ("MPa", 1e-6),
         "effective_stress": ("MPa", 1e-6), "displacement": ("mm", 1e3), "flux": ("m/s", 1.)}


def choose(grid, name, component):
    """The named array as one value per point or per cell."""
    arrays = {**grid.cell_data, **grid.point_data}
    if name not in arrays:
        sys.exit(f"field.py: no field '{name}'; there is: {', '.join(sorted(arrays))}")
    values = arrays[name]
    if values.ndim == 2:
        values = values[:, COMPONENTS[component]] if component else np.linalg.norm(values, axis=1)
    return values, name in grid.point_data


def fracture_lines(fracture):
    """The pieces of the fracture as ((n, 2, 2) end points, apertures)."""
    ends, cells = fracture.cells(vtu.LINE)
    if not len(cells):
        return np.zeros((0, 2, 2)), np.zeros(0)
    lines = fracture.points[ends][:, :, :2]
    if "aperture" in fracture.cell_data:
        return lines, fracture.cell_data["aperture"][cells]
    return lines, fracture.point_data["aperture"][ends].mean(axis=1)


def is_open(aperture):
    """Where the opening can be seen; cells may be cut ahead of the fracture."""
    return aperture >= 0.01 * aperture.max(initial=0.)


def window_of(grid, lines, aperture):
    low, high = grid.points.min(axis=0)[:2], grid.points.max(axis=0)[:2]
    if not len(lines):
        return low[0], high[0], low[1], high[1]
    corner = lines[is_open(aperture)].reshape(-1, 2)
    middle, size = (corner.min(axis=0) + corner.max(axis=0)) / 2, np.ptp(corner, axis=0).max()
    x = np.clip([middle[0] - 0.75 * size, middle[0] + 0.75 * size], low[0], high[0])
    y = np.clip([middle[1] - 0.5 * size, middle[1] + 0.5 * size], low[1], high[1])
    return *x, *y


def draw(options):
    time, path = vtu.at_time(vtu.series(options.directory, "fields"), options.time)
    grid = vtu.read(path)
    lines, aperture = np.zeros((0, 2, 2)), np.zeros(0)
    if os.path.exists(os.path.join(options.directory, "fracture.pvd")):
        fractures = vtu.series(options.directory, "fracture")
        lines, aperture = fracture_lines(vtu.read(vtu.at_time(fractures, time)[1]))
    window = options.window or window_of(grid, lines, aperture)
    opening = aperture.max(initial=0.)
    warp = options.warp if options.warp is not None else (
        0.06 * (window[3] - window[2]) / opening if opening > 0 else 0.)

    values, at_points = choose(grid, options.field, options.component)
    corners, cells = grid.quadrilaterals()
    centres = grid.points[corners].mean(axis=1)
    margin = 0.1 * max(window[1] - window[0], window[3] - window[2])
    seen = ((centres[:, 0] > window[0] - margin) & (centres[:, 0] < window[1] + margin)
            & (centres[:, 1] > window[2] - margin) & (centres[:, 1] < window[3] + margin))
    if not seen.any():  # a window smaller than a cell
        seen[:] = True
    corners, cells = corners[seen], cells[seen]
    moved = grid.points[:, :2].copy()
    if "displacement" in grid.point_data:
        moved += warp * grid.point_data["displacement"][:, :2]
    unit, factor = UNITS.get(options.field, ("-", 1.))
    colour = factor * (values[corners].mean(axis=1) if at_points else values[cells])

    figure, ax = plt.subplots(figsize=(7, 7 * min(1.2, max(
        0.35, (window[3] - window[2]) / (window[1] - window[0]))) + 0.3))
    polygons = moved[corners]
    faces = lines
    if options.mirror:
        flip = np.array([-1., 1.])
        polygons = np.concatenate([polygons, polygons * flip])
        colour = np.concatenate([colour, colour])
        faces, aperture = np.concatenate([faces, faces * flip]), np.concatenate([aperture] * 2)
        window = (-window[1], window[1], window[2], window[3])
    shown = ax.add_collection(PolyCollection(polygons, array=colour, cmap="viridis",
                                             antialiaseds=False, rasterized=True))
    if len(faces):
        tangent = faces[:, 1] - faces[:, 0]
        normal = np.stack([-tangent[:, 1], tangent[:, 0]], axis=1)
        normal /= np.linalg.norm(normal, axis=1)[:, None]
        half = (0.5 * warp * np.maximum(aperture, 0.))[:, None] * normal
        upper, lower = faces + half[:, None], faces - half[:, None]
        closed, opened = ~is_open(aperture), is_open(aperture)
        ax.add_collection(LineCollection(faces[closed], colors="0.6", linewidths=0.8))
        upper, lower = upper[opened], lower[opened]
        ax.add_collection(PolyCollection(np.concatenate([upper, lower[:, ::-1]], axis=1),
                                         facecolors="white", edgecolors="white"))
        ax.add_collection(LineCollection(np.concatenate([upper, lower]), colors="crimson",
                                         linewidths=1.))
    ax.set_xlim(window[0], window[1])
    ax.set_ylim(window[2], window[3])
    ax.set_aspect("equal")
    ax.set_xlabel("x [m]")
    ax.set_ylabel("y [m]")
    name = " ".join(filter(None, (options.field.replace("_", " "), options.component)))
    figure.colorbar(shown, ax=ax, shrink=0.8, label=f"{name} [{unit}]")
    ax.set_title(f"t = {time:.4g} s" + (f", opening drawn × {float(f'{warp:.2g}'):g}" if warp else ""),
                 fontsize=10)
    output = options.output or os.path.join(options.directory, options.field + ".png")
    figure.savefig(output, dpi=110, bbox_inches="tight")
    print(output)


def main():
    parser = argparse.ArgumentParser(description=__doc__,
                                     formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("directory")
    parser.add_argument("--field", default="pore_pressure")
    parser.add_argument("--component", choices=COMPONENTS)
    parser.add_argument("--time", type=float)
    parser.add_argument("--warp", type=float)
    parser.add_argument("--window", type=lambda text: tuple(float(x) for x in text.split(",")))
    parser.add_argument("--mirror", action="store_true")
    parser.add_argument("--output")
    draw(parser.parse_args())


if __name__ == "__main__":
    main()
