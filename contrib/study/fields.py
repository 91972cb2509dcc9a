"""Fields of several runs side by side, on one scale."""
import types

import numpy as np

from plot import field as drawing
from plot import vtu
from results import ResultError
from study.charts import finest
from study.look import plt

# Name, component: what is shown, as far as it is there.
SHOWN = (("total_stress", "yy"), ("pore_pressure", None), ("displacement", "y"))
COLUMNS = 3


def fields(results):
    """[(title, figure)]"""
    return [(title, figure) for name, component in SHOWN
            for title, figure in [side_by_side(results, name, component)] if figure is not None]


def side_by_side(results, name, component):
    title = " ".join(filter(None, (name.replace("_", " "), component)))
    there = [(r, entries) for r in finest(results) for entries in [series_with(r, name)] if entries]
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
        at = vtu.at_time(entries, time)[0]
        options = types.SimpleNamespace(directory=result.directory, field=name, component=component, window=window,
                                        warp=None, fluid=False, mirror=False)
        ax.grid(False)
        shown, window = drawing.panel(ax, options, at)
        middle = drawing.neutral(options) if middle is None else middle
        ax.set_title(f"{result.label}\n{ax.get_title()}", fontsize=7)
        drawn += shown
    height = max(0.15, min(1.2, (window[3] - window[2]) / (window[1] - window[0])))
    figure.set_size_inches(3.4 * columns + 1.2, (3.2 * height + 0.7) * lines + 0.3)
    low, high, ends = drawing.limits(np.concatenate([np.ravel(c.get_array()) for c in drawn]), middle)
    for collection in drawn:
        collection.set_cmap("viridis" if middle is None else "RdBu_r")
        collection.set_clim(low, high)
    numbers_outside(axes)
    unit = drawing.UNITS.get(name, ("-", 1.))[0]
    figure.colorbar(drawn[0], ax=[ax for ax in axes.flat if ax.figure], shrink=0.85, pad=0.02,
                    label=f"{title} [{unit}]", extend=ends)
    return title, figure


def numbers_outside(axes):
    """Panels that share their axes have names and numbers on the left and at the bottom only, below the last of a column."""
    for (line, column), ax in np.ndenumerate(axes):
        last = all(below.figure is None for below in axes[line + 1:, column])
        ax.tick_params(labelbottom=last, labelleft=column == 0)
        ax.set_xlabel("x [m]" if last else "")
        ax.set_ylabel("y [m]" if column == 0 else "")


def series_with(result, name):
    """The fields of a plane run that has this one; else nothing."""
    if result.deck.get("Dimension", "2") != "2":
        return []
    try:
        entries = vtu.series(result.directory, "fields")
        grid = vtu.read(entries[-1][1])
    except (ResultError, OSError):
        return []
    return entries if name in {**grid.point_data, **grid.cell_data} and len(grid.quadrilaterals()[0]) else []
