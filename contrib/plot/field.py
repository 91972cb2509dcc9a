#!/usr/bin/python3
"""Draw a field of the rock, deformed, with the fracture opened by as much.

    field.py DIRECTORY [--field NAME] [--component yy] [--time T...] [--warp FACTOR]
             [--window x0,x1,y0,y1] [--mirror] [--fluid] [--output FILE.png]

Without --field, this is the pore pressure, without one the displacement or the total stress.
What has a sign (components of stress, displacement, flux) is drawn in colours that part at zero, or
at the stress in situ where the deck gives one. Cells that the fracture has opened are left grey, as
are stresses where bonds are broken. Several times are drawn side by side. --fluid fills the opening
with the pressure of the fluid, in the colours of the pore pressure; otherwise it is white.
Without --window, what surrounds the fracture is shown (without a fracture, everything). --warp is
the factor on displacement and opening; by default the greatest opening is drawn as 6 % of the
window's height. --mirror adds the mirror image at x = 0 of a half model.
"""
import argparse
import os
import re
import sys

import matplotlib
matplotlib.use("Agg")
import matplotlib.pyplot as plt  # noqa: E402
import numpy as np  # noqa: E402
from matplotlib.collections import LineCollection, PolyCollection  # noqa: E402
from matplotlib.tri import Triangulation  # noqa: E402

HERE = os.path.dirname(os.path.abspath(__file__))
sys.path[:0] = [HERE, os.path.join(HERE, "..")]
import arguments  # noqa: E402
import vtu  # noqa: E402
from results import ResultError, read_deck, script  # noqa: E402

COMPONENTS = {"x": 0, "y": 1, "z": 2, "xx": 0, "xy": 1, "xz": 2, "yx": 3, "yy": 4, "yz": 5,
              "zx": 6, "zy": 7, "zz": 8}

DEFAULTS = ["pore_pressure", "displacement", "total_stress"]

UNITS = {"pore_pressure": ("MPa", 1e-6), "total_stress": ("MPa", 1e-6),
         "effective_stress": ("MPa", 1e-6), "displacement": ("mm", 1e3), "flux": ("m/s", 1.)}


def choose(grid, name, component):
    """The named array as one value per point or per cell."""
    arrays = {**grid.cell_data, **grid.point_data}
    if name not in arrays:
        raise ResultError(f"no field '{name}'; there is: {', '.join(sorted(arrays))}")
    values = arrays[name]
    letters = 0 if values.ndim == 1 else 1 if values.shape[1] == 3 else 2
    if component and len(component) != letters:
        raise ResultError(f"no component '{component}' of '{name}', which "
                          f"{('is a number', 'has x, y and z', 'has xx, xy, yy and so on')[letters]}")
    if values.ndim == 2:
        values = values[:, COMPONENTS[component]] if component else np.linalg.norm(values, axis=1)
    return values, name in grid.point_data


def default_field(grid):
    """What is drawn if nothing is asked for."""
    return next((name for name in DEFAULTS if name in {**grid.cell_data, **grid.point_data}), DEFAULTS[0])


def neutral(options):
    """The value in the middle of the colours, in the unit drawn; None where nothing has a sign."""
    if options.component is None:
        return None
    if options.field != "total_stress":
        return 0.
    deck = read_deck(options.directory)
    if deck.get("In situ/Stress gradient"):
        return 0.
    names = ["xx", "yy", "xy"] if deck.get("Dimension", "2") == "2" else ["xx", "yy", "zz", "xy", "xz", "yz"]
    given = dict(zip(names, deck.get("In situ/Stress", "").split(",")))
    return pascals(given.get(options.component, "")) * UNITS["total_stress"][1]


def pascals(text):
    """A stress as decks have it, with a prefix or none; zero if it is anything else."""
    match = re.fullmatch(r"\s*([-+0-9.eE]+)\s*([kMG]?)Pa\s*|\s*([-+0-9.eE]+)\s*", text)
    if not match:
        return 0.
    return float(match[1] or match[3]) * {"k": 1e3, "M": 1e6, "G": 1e9}.get(match[2], 1.)


def opened(polygons, lines):
    """Which quadrilaterals (n, 4, 2), sides along the axes or nearly, hold a piece of line."""
    low, high = polygons.min(axis=1), polygons.max(axis=1)
    inside = np.zeros(len(polygons), bool)
    for place in (lines.mean(axis=1), 0.9 * lines[:, 0] + 0.1 * lines[:, 1],
                  0.1 * lines[:, 0] + 0.9 * lines[:, 1]):
        for point in place:
            inside |= ((point > low) & (point < high)).all(axis=1)
    return inside


def at_corners(grid, corners, cells, values, at_points, broken):
    """A value at each corner of each cell: of a field that is written by cells, or with a jump from
    cell to cell, the mean of those around that are whole and of the same rock."""
    own = values[corners] if at_points else np.repeat(values[cells][:, None], 4, axis=1)
    keys = np.round(grid.points[corners][:, :, :2] / np.ptp(grid.points, axis=0).max(), 9)
    rock = grid.point_data.get("region")
    rock = np.zeros(corners.shape) if rock is None else rock[corners]
    keys = np.concatenate([keys, rock[:, :, None], np.repeat(broken[:, None], 4, axis=1)[:, :, None]], axis=2)
    _, place = np.unique(keys.reshape(-1, 4), axis=0, return_inverse=True)
    place = place.ravel()
    mean = np.bincount(place, own.ravel()) / np.bincount(place)
    return mean[place].reshape(own.shape)


def smooth(ax, polygons, colour):
    """Quadrilaterals (n, 4, 2) with a value at each corner, shaded: four triangles each."""
    n = len(polygons)
    points = np.concatenate([polygons.reshape(-1, 2), polygons.mean(axis=1)])
    values = np.concatenate([colour.ravel(), colour.mean(axis=1)])
    corner = np.arange(4 * n).reshape(n, 4)
    triangles = np.stack([corner, np.roll(corner, -1, axis=1),
                          np.repeat(4 * n + np.arange(n)[:, None], 4, axis=1)], axis=2)
    return ax.tripcolor(Triangulation(*points.T, triangles.reshape(-1, 3)), values, shading="gouraud",
                        rasterized=True)


def fracture_lines(fracture):
    """The pieces of the fracture as ((n, 2, 2) end points, apertures)."""
    ends, _ = fracture.cells(vtu.LINE)
    if not len(ends):
        return np.zeros((0, 2, 2)), np.zeros(0)
    return fracture.points[ends][:, :, :2], fracture_values(fracture, "aperture")


def fracture_values(fracture, name):
    """A value per piece of the fracture."""
    ends, cells = fracture.cells(vtu.LINE)
    if name in fracture.cell_data:
        return fracture.cell_data[name][cells]
    if name not in fracture.point_data:
        raise ResultError(f"no '{name}' of the fracture; there is: "
                          + ", ".join(sorted({**fracture.cell_data, **fracture.point_data})))
    return fracture.point_data[name][ends].mean(axis=1)


def is_open(aperture):
    """Where the opening can be seen; cells may be cut ahead of the fracture."""
    return aperture >= 0.01 * aperture.max(initial=0.)


def window_of(grid, lines, aperture):
    low, high = grid.points.min(axis=0)[:2], grid.points.max(axis=0)[:2]
    if not len(lines):
        return low[0], high[0], low[1], high[1]
    seen = is_open(aperture)
    corner = lines[seen if seen.any() else slice(None)].reshape(-1, 2)  # all of one that has closed
    middle, size = (corner.min(axis=0) + corner.max(axis=0)) / 2, np.ptp(corner, axis=0).max()
    x = np.clip([middle[0] - 0.75 * size, middle[0] + 0.75 * size], low[0], high[0])
    y = np.clip([middle[1] - 0.5 * size, middle[1] + 0.5 * size], low[1], high[1])
    return *x, *y


def panel(ax, options, time):
    """One picture: its time, its factor on the opening, and what the colours belong to."""
    asked, (time, path) = time, vtu.at_time(vtu.series(options.directory, "fields"), time)
    if asked is not None and abs(asked - time) > 1e-6 * abs(time):
        print(f"no fields were written at {asked:g} s; drawn are those at {time:g} s")
    grid = vtu.read(path)
    lines, aperture, pressure = np.zeros((0, 2, 2)), np.zeros(0), None
    if os.path.exists(os.path.join(options.directory, "fracture.pvd")):
        fracture = vtu.read(vtu.at_time(vtu.series(options.directory, "fracture"), time)[1])
        lines, aperture = fracture_lines(fracture)
        if options.fluid:
            pressure = 1e-6 * fracture_values(fracture, "fluid_pressure")
    window = options.window or window_of(grid, lines, aperture)
    opening = aperture.max(initial=0.)
    warp = options.warp if options.warp is not None else (
        0.06 * (window[3] - window[2]) / opening if opening > 0 else 0.)

    values, at_points = choose(grid, options.field, options.component)
    corners, cells = grid.quadrilaterals()
    if not len(cells):
        raise ResultError(f"the cells of '{options.directory}' are not quadrilaterals: only plane runs are drawn")
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
    factor = UNITS.get(options.field, ("-", 1.))[1]
    broken = opened(grid.points[corners][:, :, :2], lines[is_open(aperture)])
    if "damage" in grid.point_data and "stress" in options.field:  # of the bonds that have gone
        broken |= grid.point_data["damage"][corners].mean(axis=1) > 0.05
    if broken.all():  # a window of nothing else
        broken[:] = False
    colour = factor * at_corners(grid, corners, cells, values, at_points, broken)

    polygons = moved[corners]
    faces = lines
    if options.mirror:
        flip = np.array([-1., 1.])
        polygons = np.concatenate([polygons, polygons * flip])
        colour, broken = np.concatenate([colour, colour]), np.concatenate([broken, broken])
        faces, aperture = np.concatenate([faces, faces * flip]), np.concatenate([aperture] * 2)
        pressure = None if pressure is None else np.concatenate([pressure] * 2)
        window = (-window[1], window[1], window[2], window[3])
    shown = [smooth(ax, polygons[~broken], colour[~broken])]
    if broken.any():
        ax.add_collection(PolyCollection(polygons[broken], facecolors="0.8", edgecolors="0.8",
                                         linewidths=0.3))
    if len(faces):
        tangent = faces[:, 1] - faces[:, 0]
        normal = np.stack([-tangent[:, 1], tangent[:, 0]], axis=1)
        normal /= np.linalg.norm(normal, axis=1)[:, None]
        half = (0.5 * warp * np.maximum(aperture, 0.))[:, None] * normal
        upper, lower = faces + half[:, None], faces - half[:, None]
        closed, wide = ~is_open(aperture), is_open(aperture)
        ax.add_collection(LineCollection(faces[closed], colors="0.6", linewidths=0.8))
        upper, lower = upper[wide], lower[wide]
        inside = np.concatenate([upper, lower[:, ::-1]], axis=1)
        if pressure is None:
            ax.add_collection(PolyCollection(inside, facecolors="white", edgecolors="white"))
        else:
            shown.append(ax.add_collection(PolyCollection(
                inside, array=pressure[wide], linewidths=0.)))
        ax.add_collection(LineCollection(np.concatenate([upper, lower]), colors="crimson",
                                         linewidths=1.))
    ax.set_xlim(window[0], window[1])
    ax.set_ylim(window[2], window[3])
    ax.set_aspect("equal")
    ax.set_xlabel("x [m]")
    ax.set_title(f"t = {time:.4g} s" + (f", opening drawn × {float(f'{warp:.2g}'):g}" if warp else ""),
                 fontsize=10)
    return shown, window


def limits(values, middle):
    """(least, greatest, which ends are cut off): all values; around a middle, as far to both sides, and
    without the last hundredth, for there is no end to what a tip has."""
    if middle is None:
        return values.min(), values.max(), "neither"
    reach = np.quantile(np.abs(np.asarray(values) - middle), 0.99) or 1e-12
    return middle - reach, middle + reach, "both"


def draw(options):
    times = options.time or [None]
    if options.field is None:
        options.field = default_field(vtu.read(vtu.at_time(vtu.series(options.directory, "fields"))[1]))
    figure, axes = plt.subplots(1, len(times), squeeze=False, sharey=True)
    panels = [panel(ax, options, time) for ax, time in zip(axes[0], times)]
    window = panels[0][1]
    height = 7 if len(times) == 1 else 4.5
    shape = min(1.2, max(0.35, (window[3] - window[2]) / (window[1] - window[0])))
    figure.set_size_inches(len(times) * height / max(1., shape if len(times) > 1 else 1.),
                           height * (shape if len(times) == 1 else 1.) + 0.3)
    coloured = [collection for shown, _ in panels for collection in shown]
    low, high, ends = limits(np.concatenate([np.ravel(c.get_array()) for c in coloured]), neutral(options))
    for collection in coloured:
        collection.set_cmap("viridis" if neutral(options) is None else "RdBu_r")
        collection.set_clim(low, high)
    axes[0, 0].set_ylabel("y [m]")
    name = " ".join(filter(None, (options.field.replace("_", " "), options.component)))
    unit = UNITS.get(options.field, ("-", 1.))[0]
    figure.colorbar(coloured[0], ax=list(axes[0]), shrink=0.8, label=f"{name} [{unit}]", extend=ends,
                    **({"pad": 0.01} if len(times) > 1 else {}))
    output = options.output or os.path.join(options.directory, options.field + ".png")
    figure.savefig(output, dpi=110 if len(times) == 1 else 80, bbox_inches="tight")
    print(output)


def main():
    parser = argparse.ArgumentParser(description=__doc__,
                                     formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("directory")
    parser.add_argument("--field", metavar="NAME")
    parser.add_argument("--component", choices=COMPONENTS)
    parser.add_argument("--time", type=float, nargs="+")
    parser.add_argument("--warp", type=float)
    parser.add_argument("--window", type=arguments.window)
    parser.add_argument("--mirror", action="store_true")
    parser.add_argument("--fluid", action="store_true")
    parser.add_argument("--output")
    draw(parser.parse_args())


if __name__ == "__main__":
    script(main)
