"""The problem to scale: the domain, or a plane through it, the fractures when they were written first and last, the stress and the
boundary conditions."""
import numpy as np
from matplotlib.collections import PolyCollection

from plot import vtu
from plot.field import pascals
from results import ResultError
from study.look import plt
from study.section import cracked, cut, plane

LOOKS = ("#D55E00", 3.), ("#0072B2", 1.2)    # of a fracture, first and last


def first_and_last(result, name):
    """[(time, grid), (time, grid)]; empty where nothing has been written."""
    try:
        entries = vtu.series(result.directory, name)
        return [(time, vtu.read(file)) for time, file in dict.fromkeys((entries[0], entries[-1]))]
    except (ResultError, OSError):
        return []


def sketch(result):
    """None where the run has written no fields, or those of one dimension."""
    fields = first_and_last(result, "fields")
    if not fields:
        return None
    if result.deck.get("Dimension") == "3":
        return in_space(result, fields)
    start = fields[0][1]
    corners, _ = start.quadrilaterals()
    if not len(corners):
        return None
    domain = start.points[:, :2]
    cracks = [(time, g) for time, g in first_and_last(result, "fracture") if len(g.cells(vtu.LINE)[0])]
    figure, axes = plt.subplots(1, 2 if cracks else 1, figsize=(8 if cracks else 5, 3.6), squeeze=False)
    for i, ax in enumerate(axes[0]):
        points = domain if i == 0 else np.concatenate([g.points[:, :2] for _, g in cracks])
        window(ax, points, 0.12 if i == 0 else 0.4)
        ax.grid(False)
        mesh(ax, start.points[corners][:, :, :2])
        for (time, grid), (color, width) in zip(cracks, LOOKS):
            ends, _ = grid.cells(vtu.LINE)
            lines = np.full((len(ends), 3, 2), np.nan)
            lines[:, :2] = grid.points[ends][:, :, :2]
            ax.plot(*lines.reshape(-1, 2).T, label=f"at {time:.3g} s", color=color, lw=width)
        ax.set_aspect("equal")
        ax.set_xlabel("x [m]")
        ax.set_ylabel("y [m]")
        ax.set_title("the domain and its cells" if i == 0 else "around the fracture", fontsize=9)
    if cracks:
        axes[0][1].legend(fontsize=8, loc="upper right")
    boundary(axes[0][0], domain, result.deck, ("left", "right", "bottom", "top"))
    stress(axes[0][-1], result.deck)
    figure.tight_layout()
    return figure


def in_space(result, fields):
    """A plane through the domain, and what the fracture is in it."""
    start = fields[0][1]
    axis, at = plane(result.deck, start.points)
    mesh_there, _ = cut(start, axis, at)
    if not len(mesh_there):
        return None
    cracks = [(time, polygons) for time, grid in fields for polygons in [cracked(grid, axis, at)] if len(polygons)]
    figure, axes = plt.subplots(1, 2 if cracks else 1, figsize=(8 if cracks else 5, 3.6), squeeze=False)
    names = [name for i, name in enumerate("xyz") if i != axis]
    for i, ax in enumerate(axes[0]):
        window(ax, np.concatenate([mesh_there] if i == 0 else [p for _, p in cracks]).reshape(-1, 2), 0.12 if i == 0 else 0.4)
        ax.grid(False)
        mesh(ax, mesh_there)
        for (time, polygons), (color, _) in zip(reversed(cracks), reversed(LOOKS[:len(cracks)])):
            ax.add_collection(PolyCollection(polygons, facecolors=color, edgecolors="white", linewidths=0.2, alpha=0.8,
                                             label=f"fracture at {time:.3g} s"))
        ax.set_aspect("equal")
        ax.set_xlabel(f"{names[0]} [m]")
        ax.set_ylabel(f"{names[1]} [m]")
        ax.set_title(f"the domain at {'xyz'[axis]} = {at:.3g} m" if i == 0 else "around the fracture", fontsize=9)
    if cracks:
        axes[0][1].legend(fontsize=8, loc="upper right")
    sides = [("left", "right"), ("front", "back"), ("bottom", "top")]
    boundary(axes[0][0], mesh_there.reshape(-1, 2), result.deck, [s for i, pair in enumerate(sides) if i != axis for s in pair])
    figure.tight_layout()
    return figure


def window(ax, points, margin):
    low, high = points.min(axis=0), points.max(axis=0)
    half = np.maximum(0.5 * (high - low), 0.2 * max(high - low)) * (1 + margin)
    middle = (low + high) / 2
    ax.set_xlim(middle[0] - half[0], middle[0] + half[0])
    ax.set_ylim(middle[1] - half[1], middle[1] + half[1])


def mesh(ax, polygons):
    ax.add_collection(PolyCollection(polygons, facecolors="0.96", edgecolors="0.8", linewidths=0.2, rasterized=True))


def boundary(ax, domain, deck, sides):
    """What the deck's boundary conditions say of each of the four sides, at its middle."""
    low, high = domain.min(axis=0), domain.max(axis=0)
    middle = (low + high) / 2
    places = ((low[0], middle[1], 90), (high[0], middle[1], 90), (middle[0], low[1], 0), (middle[0], high[1], 0))
    for side, (x, y, turned) in zip(sides, places):
        said = [key.split("/", 1)[1].lower() for key, value in deck.items()
                if key.startswith("Boundary conditions/") and side in value]
        if said:
            ax.text(x, y, ", ".join(said), rotation=turned, ha="center", va="center", fontsize=7,
                    bbox=dict(facecolor="white", edgecolor="0.7", boxstyle="round,pad=0.2", alpha=0.9))


def stress(ax, deck):
    """The stress in situ as arrows beside a picture; compression points inwards."""
    given = [pascals(text) for text in deck.get("In situ/Stress", "").split(",")][:2]
    if len(given) < 2 or not any(given):
        return
    for value, (along, across) in zip(given, ((0.06, 0.), (0., 0.1))):
        for side in (1, -1):
            near, far = ((1.12 + side * r * along, 0.25 + side * r * across) for r in (0.5, 1.4))
            ax.annotate("", near if value < 0. else far, far if value < 0. else near, xycoords="axes fraction",
                        textcoords="axes fraction", arrowprops=dict(arrowstyle="-|>", color="0.2"))
    ax.text(1.04, 0.06, "\n".join(f"{name} {1e-6 * value:g} MPa" for name, value in zip(("xx", "yy"), given)),
            transform=ax.transAxes, fontsize=7, va="top")
