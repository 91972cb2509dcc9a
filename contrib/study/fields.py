"""Fields of several runs side by side, on one scale; of runs in space, in the plane of section.py."""
import types

import numpy as np
from matplotlib.collections import PolyCollection

from plot import field as drawing
from plot import vtu
from results import ResultError
from study.charts import finest
from study.look import plt
from study.section import cracked, cut, is_cracked, plane

# Name, component: what is shown, as far as it is there.
SHOWN = (("total_stress", "yy"), ("pore_pressure", None), ("displacement", "y"))
SHOWN_IN_SPACE = (("opening", None), ("fluid_pressure", None), ("pore_pressure", None), ("total_stress", "across"))
UNITS = {**drawing.UNITS, "opening": ("mm", 1e3), "fluid_pressure": ("MPa", 1e-6)}
COLUMNS = 3


def fields(results):
    """[(title, figure)]"""
    flat = [r for r in finest(results) if not in_space(r)]
    solid = [r for r in finest(results) if in_space(r)]
    drawn = [side_by_side(flat, name, component, plane_panel) for name, component in SHOWN]
    drawn += [side_by_side(solid, name, component, section_panel) for name, component in SHOWN_IN_SPACE]
    return [(title, figure) for title, figure in drawn if figure is not None]


def in_space(result):
    return result.deck.get("Dimension", "2") == "3"


def plane_panel(ax, result, at, name, component, window):
    """(what the colours belong to, window, the value in the middle of the colours or None)"""
    options = types.SimpleNamespace(directory=result.directory, field=name, component=component, window=window, warp=None,
                                    fluid=False, mirror=False)
    shown, window = drawing.panel(ax, options, at)
    return shown, window, drawing.neutral(options)


def section_panel(ax, result, at, name, component, window):
    """The same where a plane cuts the cells, in the colour of their mean; 'across' is the stress normal to the plane."""
    time, path = vtu.at_time(vtu.series(result.directory, "fields"), at)
    grid = vtu.read(path)
    axis, height = plane(result.deck, grid.points)
    polygons, numbers = cut(grid, axis, height)
    letters = "xyz"[axis] * 2 if component == "across" else component
    values, at_points = drawing.choose(grid, name, letters)
    corners, hexahedra = grid.cells(vtu.HEXAHEDRON)
    values = values[corners[np.searchsorted(hexahedra, numbers)]].mean(axis=1) if at_points else values[numbers]
    # Cells of broken bonds have no stress, and are left grey.
    whole = ~is_cracked(grid, numbers) | (name != "total_stress") | ("opening" in grid.point_data)
    ax.set_facecolor("0.8")
    ax.add_collection(shown := PolyCollection(polygons[whole], array=values[whole] * UNITS[name][1], edgecolors="face",
                                              linewidths=0.2, rasterized=True))
    if window is None:
        fracture = cracked(grid, axis, height)
        corners = (fracture if len(fracture) else polygons).reshape(-1, 2)
        low, high, ends = corners.min(axis=0), corners.max(axis=0), polygons.reshape(-1, 2)
        low, high = (np.clip(c, ends.min(axis=0), ends.max(axis=0)) for c in (1.3 * low - 0.3 * high, 1.3 * high - 0.3 * low))
        window = low[0], high[0], low[1], high[1]
    ax.set_xlim(*window[:2])
    ax.set_ylim(*window[2:])
    ax.set_aspect("equal")
    ax.set_title(f"{'xyz'[axis]} = {height:.3g} m, {time:.4g} s")
    middle = drawing.neutral(types.SimpleNamespace(directory=result.directory, field=name, component=letters))
    return [shown], window, middle


def side_by_side(results, name, component, panel):
    title = " ".join(filter(None, (name.replace("_", " "), component)))
    there = [(r, entries) for r in results for entries in [series_with(r, name)] if entries]
    if not there:
        return title, None
    time = min(entries[-1][0] for _, entries in there)
    columns = min(COLUMNS, len(there))
    lines = -(-len(there) // columns)
    figure, axes = plt.subplots(lines, columns, squeeze=False, sharex=True, sharey=True)
    for ax in axes.flat[len(there):]:
        ax.remove()
    drawn, window, middle = [], None, None
    for ax, (result, entries) in zip(axes.flat, there):
        ax.grid(False)
        shown, window, neutral = panel(ax, result, vtu.at_time(entries, time)[0], name, component, window)
        middle = neutral if middle is None else middle
        ax.set_title(f"{result.label}\n{ax.get_title()}", fontsize=7)
        drawn += shown
    height = max(0.15, min(1.2, (window[3] - window[2]) / (window[1] - window[0])))
    figure.set_size_inches(3.4 * columns + 1.2, (3.2 * height + 0.7) * lines + 0.3)
    low, high, ends = drawing.limits(np.concatenate([np.ravel(c.get_array()) for c in drawn]), middle)
    for collection in drawn:
        collection.set_cmap("viridis" if middle is None else "RdBu_r")
        collection.set_clim(low, high)
    first = there[0][0]
    names = [letter for i, letter in enumerate("xyz") if i != (plane(first.deck)[0] if in_space(first) else 2)]
    numbers_outside(axes, names)
    unit = UNITS.get(name, ("-", 1.))[0]
    figure.colorbar(drawn[0], ax=[ax for ax in axes.flat if ax.figure], shrink=0.85, pad=0.02,
                    label=f"{title} [{unit}]", extend=ends)
    return title, figure


def numbers_outside(axes, names):
    """Panels that share their axes have names and numbers on the left and at the bottom only, below the last of a column."""
    for (line, column), ax in np.ndenumerate(axes):
        last = all(below.figure is None for below in axes[line + 1:, column])
        ax.tick_params(labelbottom=last, labelleft=column == 0)
        ax.set_xlabel(f"{names[0]} [m]" if last else "")
        ax.set_ylabel(f"{names[1]} [m]" if column == 0 else "")


def series_with(result, name):
    """The fields of a run that has this one; else nothing."""
    try:
        entries = vtu.series(result.directory, "fields")
        grid = vtu.read(entries[-1][1])
    except (ResultError, OSError):
        return []
    cells = grid.cells(vtu.HEXAHEDRON)[0] if in_space(result) else grid.quadrilaterals()[0]
    return entries if name in {**grid.point_data, **grid.cell_data} and len(cells) else []
