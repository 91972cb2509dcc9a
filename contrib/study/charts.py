"""Curves: error against cost, histories, profiles and paths."""
import math

import numpy as np
from matplotlib.ticker import FixedLocator, FuncFormatter, NullLocator

from plot import profile as along
from plot import vtu
from plot.history import QUANTITIES, shown_as
from results import ResultError
from study.cost import cheapest, front, points
from study.difference import histories
from study.look import legend_below, plt

COSTS = (("cpu_seconds", "CPU time [s]"), ("unknowns", "unknowns"))
MARK_SIZES = {"coarse": 3.5, "medium": 5.5, "fine": 7.5}


def error_against_cost(rows, error, label, styles):
    """Log-log, against CPU time and against unknowns."""
    figure, axes = plt.subplots(1, 2, figsize=(10, 3.4), sharey=True)
    for ax, (cost, cost_label) in zip(axes, COSTS):
        accuracy(ax, rows, error, cost, styles)
        ax.set_xlabel(cost_label)
        few_decades(ax.xaxis)
    few_decades(axes[1].yaxis)  # that of both
    axes[0].set_ylabel(label)
    return legend_below(figure)


def all_cases(cases, styles):
    """Error against CPU time, a panel for each of [(case, rows, error, label)]."""
    columns = min(3, len(cases))
    lines = -(-len(cases) // columns)
    figure, axes = plt.subplots(lines, columns, figsize=(max(3.6 * columns, 5), 2.9 * lines), squeeze=False)
    for ax in axes.flat[len(cases):]:
        ax.remove()
    for ax, (case, rows, error, label) in zip(axes.flat, cases):
        accuracy(ax, rows, error, "cpu_seconds", styles)
        ax.set_title(case, fontsize=9)
        ax.set_xlabel("CPU time [s]")
        ax.set_ylabel(label)
        few_decades(ax.xaxis)
        few_decades(ax.yaxis)
    return legend_below(figure)


def accuracy(ax, rows, error, cost, styles):
    """One line per model and variant, larger marks where the mesh is finer; where all solve one problem, the Pareto front, and
    the cheapest for each accuracy wanted."""
    for curve, of_curve in rows.groupby("curve", sort=False):
        there = sorted(points(of_curve, cost, error), key=lambda p: p[0])
        line = {k: v for k, v in styles[curve].items() if k != "marker"}
        mark = {k: v for k, v in styles[curve].items() if k != "linestyle"}
        if there:
            ax.plot([p[0] for p in there], [100 * p[1] for p in there], lw=1.2, **line)
            ax.plot([], [], label=curve, lw=1.2, ms=5, **styles[curve])
        for x, y, row in there:
            ax.plot(x, 100 * y, ms=MARK_SIZES.get(row["resolution"], 5), linestyle="", **mark)
    one_problem = rows["problem"].nunique() <= 1
    best = front(points(rows, cost, error)) if one_problem else []
    if len(best) > 1:
        ax.plot([p[0] for p in best], [100 * p[1] for p in best], color="0.85", lw=6, zorder=0,
                solid_capstyle="round", label="Pareto front")
    marked = {}
    for wanted, point in cheapest(rows, error, cost) if one_problem else []:
        if point:
            marked.setdefault(point[:2], []).append(f"{100 * wanted:g}")
    for (x, y), texts in marked.items():
        ax.plot(x, 100 * y, "o", ms=13, mfc="none", mec="0.3", mew=0.8)
        ax.annotate(f"≤ {', '.join(texts)} %", (x, 100 * y), xytext=(7, 7), textcoords="offset points",
                    fontsize=8, color="0.2")
    ax.set_xscale("log")
    ax.set_yscale("log")
    ax.margins(0.12)


def few_decades(axis):
    """From one of 1, 2, 5, 10, ... to another, so that there are numbers to read however little the values differ."""
    low, high = axis.get_view_interval()
    numbers = [m * 10.**e for e in range(math.floor(math.log10(low)) - 1, math.ceil(math.log10(high)) + 1) for m in (1, 2, 5)]
    first, last = max(n for n in numbers if n <= low), min(n for n in [*numbers, 10. * numbers[-1]] if n >= high)
    shown = [n for n in numbers if first <= n <= last]
    if last > 300. * first:
        shown = [n for n in shown if math.log10(n) % 1 < 1e-9]
    axis.axes.set(**{axis.axis_name + "lim": (first, last)})
    axis.set_major_locator(FixedLocator(shown))
    axis.set_minor_locator(NullLocator())
    axis.set_major_formatter(FuncFormatter(lambda v, _: f"{v:g}"))


def finest(results):
    """The most refined run of each curve, the finished ones first."""
    found = {}
    for result in results:
        key = (result.status == "finished", result.summary.get("unknowns", 0))
        if result.curve not in found or key > found[result.curve][0]:
            found[result.curve] = (key, result)
    return [result for _, result in found.values()]


def history(results, styles):
    """The quantities over time, at the finest resolution of each curve, over the reference. None if there is none."""
    tables = [(r, histories(r)) for r in finest(results)]
    names = [n for n in QUANTITIES if any(np.any(np.nan_to_num(t.get(n, np.zeros(1)))) for _, t in tables)]
    tables = [(r, t) for r, t in tables if len(t.get("time", [])) > 1]
    names += [n[len("reference_"):] for _, t in tables for n in t if n.startswith("reference_")
              and n[len("reference_"):] not in names and n[len("reference_"):] in t]
    names = list(dict.fromkeys(names))
    if not names or not tables:
        return None
    columns = min(3, len(names))
    lines = -(-len(names) // columns)
    figure, axes = plt.subplots(lines, columns, figsize=(max(3.4 * columns, 5), 2.7 * lines + 0.5), squeeze=False)
    for ax in axes.flat[len(names):]:
        ax.remove()
    for ax, name in zip(axes.flat, names):
        label, unit, factor = shown_as(name, next(r.directory for r, t in tables if name in t))
        reference = next((t for _, t in tables if "reference_" + name in t), None)
        if reference is not None:
            ax.plot(reference["time"], factor * reference["reference_" + name], color="0.7", lw=4.5, label="reference")
        for result, values in tables:
            if name in values:
                style = styles[result.curve]
                ax.plot(values["time"], factor * values[name], lw=1.1, label=result.label, color=style["color"],
                        linestyle=style["linestyle"])
        ax.set_xlabel("time [s]")
        ax.set_ylabel(f"{label} [{unit}]")
    return legend_below(figure)


def fractures(results):
    """(common time, [(result, fracture at that time)]) of the runs that wrote fractures."""
    series = []
    for result in finest(results):
        try:
            series.append((result, vtu.series(result.directory, "fracture")))
        except (ResultError, OSError):
            continue
    if not series:
        return 0., []
    time = min(entries[-1][0] for _, entries in series)
    grids = [(result, *vtu.at_time(entries, time)) for result, entries in series]
    return time, [(result, at, grid) for result, at, path in grids
                  for grid in [vtu.read(path)] if len(grid.cells(vtu.LINE)[0])]


def profiles(results, styles):
    """Aperture and fluid pressure along the fractures at a time that all have reached."""
    _, there = fractures(results)
    names = [n for n in along.QUANTITIES if any(n in {**g.cell_data, **g.point_data} for _, _, g in there)]
    if not names:
        return None
    figure, axes = plt.subplots(1, len(names), figsize=(4.8 * len(names), 3.4), squeeze=False)
    for ax, name in zip(axes[0], names):
        label, factor = along.QUANTITIES[name]
        for result, time, grid in there:
            if name not in {**grid.cell_data, **grid.point_data}:
                continue
            place, values, axis = along.profile(grid, name)
            opening = along.profile(grid, "aperture")[1]
            seen = opening > 0.003 * opening.max(initial=0.)
            style = styles[result.curve]
            ax.plot(place[seen], factor * values[seen], lw=1.1, color=style["color"], linestyle=style["linestyle"],
                    label=f"{result.label}, {time:.4g} s")
            ax.set_xlabel(f"{axis} [m]")
        ax.set_ylabel(label)
    return legend_below(figure, 2)


def paths(results, styles):
    """Where the fractures are at a time that all have reached, to scale."""
    _, there = fractures(results)
    there = [(r, t, g) for r, t, g in there if r.deck.get("Dimension", "2") == "2"]
    if not there:
        return None
    figure, ax = plt.subplots(figsize=(7, 3.6))
    for i, (result, time, grid) in enumerate(there):
        ends, _ = grid.cells(vtu.LINE)
        pieces = grid.points[ends][:, :, :2]
        line = np.full((len(pieces), 3, 2), np.nan)
        line[:, :2] = pieces
        style = styles[result.curve]
        # Those that lie over one another are all seen: the first is the widest.
        ax.plot(*line.reshape(-1, 2).T, lw=1.2 + 1.8 * (len(there) - 1 - i), color=style["color"],
                label=f"{result.label}, {time:.4g} s")
    points_there = np.concatenate([g.points[:, :2] for _, _, g in there])
    low, high = points_there.min(axis=0), points_there.max(axis=0)
    least = 0.15 * max(high - low)  # a straight fracture has no height
    middle, half = (low + high) / 2, np.maximum(0.55 * (high - low), least)
    ax.set_xlim(middle[0] - half[0], middle[0] + half[0])
    ax.set_ylim(middle[1] - half[1], middle[1] + half[1])
    ax.set_aspect("equal")
    ax.set_xlabel("x [m]")
    ax.set_ylabel("y [m]")
    return legend_below(figure, 2)
