"""The counterparts of Figures 6 to 11 and 13 to 15 of Zhang, Cao, Wang & Guo (2022)."""
import math
import os
import sys

import matplotlib
matplotlib.use("Agg")
import matplotlib.pyplot as plt  # noqa: E402
import numpy as np  # noqa: E402
from matplotlib.collections import PolyCollection  # noqa: E402

HERE = os.path.dirname(os.path.abspath(__file__))
sys.path[:0] = [os.path.join(HERE, "..")]
from results import read_deck, read_statistics  # noqa: E402
from three_layers import formulas, zone  # noqa: E402

# The deck's: a wing's rate [m^3/s], the coal, the fluid, in SI units.
RATE, HEIGHT = 10. / 60. / 2., 10.
YOUNG, POISSON, BIOT, SOLID, POROSITY, PERMEABILITY = 3e9, 0.3, 0.8, 12.5e9, 0.04, 5e-16
VISCOSITY, FLUID = 1e-3, 2.2e9
LEAST_STRESS, PORE_PRESSURE = 7.8e6, 4.5e6
SHEAR, PLANE = YOUNG / (2. * (1. + POISSON)), YOUNG / (1. - POISSON**2)
STORAGE = (BIOT - POROSITY) / SOLID + POROSITY / FLUID + BIOT**2 / (PLANE * (1. - POISSON)**2 / (1. - 2. * POISSON))

# Of one face: what the paper takes, and what this coal takes at the stress across the fracture.
CARTER = {"the paper's leak-off": 4.98e-4,
          "this coal's": formulas.carter_coefficient(LEAST_STRESS - PORE_PRESSURE, PERMEABILITY, STORAGE, VISCOSITY)}

STAGES = ("I", "II", "III", "IV")


class Run:
    """A run and what is drawn of it."""

    def __init__(self, directory, angle):
        self.directory, self.angle = directory, angle
        table = read_statistics(directory)
        self.time = np.array(table["time"])
        self.pressure = np.array(table["inlet_pressure"])
        self.width = np.array(table["inlet_aperture"])
        # The extents are those of the segments, each as long as a cell.
        self.half_length = 0.5 * np.hypot(table["extent_x"], table["extent_y"])
        self.resolution = read_deck(directory).get("Resolution", "")

    def breakdown(self):
        """Number of the step with the greatest pressure before it first falls, by a fiftieth of its rise."""
        greatest = np.maximum.accumulate(self.pressure)
        fallen = np.flatnonzero(self.pressure < greatest - 0.02 * (greatest - self.pressure[0]))
        return int(np.argmax(self.pressure[:fallen[0]] if len(fallen) else self.pressure))

    def stages(self):
        """Times at which stage II, III and IV begin; NaN where one does not. The pressure falls in II, from
        breakdown to where it rises again by a fifth of that; in IV the fracture's length stays within a hundredth of
        what it is at the end, if that is at least a fifth of the run and after II."""
        peak = self.breakdown()
        after = self.pressure[peak:]
        least = np.minimum.accumulate(after)
        rises = np.flatnonzero(after > least + 0.2 * (after[0] - least))
        end = peak + int(np.argmin(after[:rises[0] + 1] if len(rises) else after))
        shorter = np.flatnonzero(self.half_length < 0.99 * self.half_length[-1])
        stays = self.time[shorter[-1]] if len(shorter) else math.nan
        ends = stays if self.time[end] <= stays < 0.8 * self.time[-1] else math.nan
        return self.time[peak], self.time[end], ends


def _rectangles(cells, chosen, values, ax, **settings):
    low = cells.centre[chosen] - 0.5 * cells.size[chosen]
    high = low + cells.size[chosen]
    corners = np.stack([np.stack([low[:, 0], low[:, 1]], 1), np.stack([high[:, 0], low[:, 1]], 1),
                        np.stack([high[:, 0], high[:, 1]], 1), np.stack([low[:, 0], high[:, 1]], 1)], axis=1)
    return ax.add_collection(PolyCollection(corners, array=values[chosen], linewidths=0., **settings))


def _horizontal(ax, cells, angle, vmax, reach=100.):
    """The zone in the middle of the coal, and a line along the greatest stress."""
    chosen = cells.layer(0.) & (cells.fields["damage"] > 0.)
    drawn = _rectangles(cells, chosen, 1e3 * np.maximum(cells.fields["opening"], 0.), ax, cmap="viridis")
    drawn.set_clim(0., vmax)
    turn = np.radians(angle)
    ax.plot([-reach * np.cos(turn), reach * np.cos(turn)], [-reach * np.sin(turn), reach * np.sin(turn)],
            color="crimson", lw=0.6, ls="--")
    ax.set_xlim(-reach, reach)
    ax.set_ylim(-reach, reach)
    ax.set_aspect("equal")
    return drawn


def _vertical(ax, zone_, vmax):
    """The zone seen across the fracture."""
    edges = 0.5 * zone_.size[:, [0, 2]]
    low = np.stack([zone_.along - edges[:, 0], zone_.centre[:, 2] - edges[:, 1]], 1)
    high = np.stack([zone_.along + edges[:, 0], zone_.centre[:, 2] + edges[:, 1]], 1)
    corners = np.stack([low, np.stack([high[:, 0], low[:, 1]], 1), high, np.stack([low[:, 0], high[:, 1]], 1)], 1)
    order = np.argsort(zone_.opening())  # the widest on top where cells are one behind the other
    drawn = ax.add_collection(PolyCollection(corners[order], array=1e3 * zone_.opening()[order], cmap="viridis"))
    drawn.set_clim(0., vmax)
    for height in (-5., 5.):
        ax.axhline(height, color="0.5", lw=0.6)
    ax.set_xlim(-100., 100.)
    ax.set_ylim(-10., 10.)
    return drawn


def zones(runs, output):
    """Figures 6 and 7: the zone at the end in the horizontal and the vertical middle section, and the pressure."""
    figure, axes = plt.subplots(3, len(runs), figsize=(4. * len(runs), 8.), squeeze=False, layout="constrained",
                                height_ratios=[1., 0.4, 1.])
    for column, run in enumerate(runs):
        time, cells = zone.at(run.directory)
        found = zone.Zone(cells, run.angle)
        vmax = 1e3 * found.opening().max()
        drawn = _horizontal(axes[0, column], cells, run.angle, vmax)
        axes[0, column].set_title(f"θ = {run.angle:g}°, t = {time:.3g} s: zone at {found.direction():.1f}°", fontsize=10)
        _vertical(axes[1, column], found, vmax)
        axes[1, column].set_xlabel("along the greatest stress [m]")
        figure.colorbar(drawn, ax=axes[0, column], label="opening [mm]", shrink=0.8)
        drawn = _rectangles(cells, cells.layer(0.), 1e-6 * cells.fields["pore_pressure"], axes[2, column], cmap="magma")
        axes[2, column].set_xlim(-100., 100.)
        axes[2, column].set_ylim(-100., 100.)
        axes[2, column].set_aspect("equal")
        figure.colorbar(drawn, ax=axes[2, column], label="pore pressure [MPa]", shrink=0.8)
        axes[2, column].set_xlabel("x [m]")
    axes[0, 0].set_ylabel("y [m]")
    axes[1, 0].set_ylabel("z [m]")
    axes[2, 0].set_ylabel("y [m]")
    _save(figure, output)


def in_time(run, output, n=4):
    """Figure 8: the zone in the vertical section at several times."""
    end = run.time[-1]
    chosen = sorted({zone.at(run.directory, end * (i + 1) / n)[0] for i in range(n)})
    figure, axes = plt.subplots(len(chosen), 1, figsize=(8., 1.5 * len(chosen)), sharex=True, squeeze=False,
                                layout="constrained")
    pieces = [(time, zone.Zone(zone.at(run.directory, time)[1], run.angle)) for time in chosen]
    vmax = 1e3 * max(piece.opening().max() for _, piece in pieces)
    for ax, (time, piece) in zip(axes[:, 0], pieces):
        drawn = _vertical(ax, piece, vmax)
        ax.set_title(f"{time:.3g} s", fontsize=9, loc="left")
        ax.set_ylabel("z [m]")
    axes[-1, 0].set_xlabel("along the greatest stress [m]")
    figure.colorbar(drawn, ax=list(axes[:, 0]), label="opening [mm]")
    _save(figure, output)


def histories(runs, output):
    """Figures 9, 10 and 11: half-length, width and pressure at the well in time."""
    figure, axes = plt.subplots(1, 3, figsize=(13., 4.), layout="constrained")
    end = max(run.time[-1] for run in runs)
    time = np.linspace(1e-3 * end, end, 400)
    for i, run in enumerate(runs):
        axes[0].plot(run.time, run.half_length, color=f"C{i}", label=f"θ = {run.angle:g}°")
        axes[1].plot(run.time, 1e3 * run.width, color=f"C{i}")
        axes[2].plot(run.time, 1e-6 * run.pressure, color=f"C{i}")
        for name, begin in zip(STAGES, (run.time[0], *run.stages())):
            axes[2].axvline(begin, color=f"C{i}", lw=0.5, ls=":")
            if i == 0 and not math.isnan(begin):
                axes[2].text(begin, 1.0, name, transform=axes[2].get_xaxis_transform(), fontsize=8, va="bottom")
    for style, (name, carter) in zip(("--", ":"), CARTER.items()):
        length = np.array([formulas.length(RATE, t, HEIGHT, carter) for t in time])
        width = np.array([formulas.width(RATE, t, HEIGHT, carter, SHEAR, POISSON, VISCOSITY) for t in time])
        net = formulas.pressure_of_width(width, HEIGHT, SHEAR, POISSON)
        axes[0].plot(time[length < 100.], length[length < 100.], color="0.3", ls=style, label=f"Eq. 42, {name}")
        axes[1].plot(time, 1e3 * width, color="0.3", ls=style)
        axes[2].plot(time, 1e-6 * (LEAST_STRESS + net), color="0.3", ls=style)
    stored = formulas.stored_width(RATE, time, HEIGHT, SHEAR, POISSON, VISCOSITY)
    length = formulas.stored_length(RATE, time, HEIGHT, SHEAR, POISSON, VISCOSITY)
    axes[0].plot(time[length < 100.], length[length < 100.], color="0.3", label="without leak-off")
    axes[1].plot(time, 1e3 * stored, color="0.3")
    axes[2].plot(time, 1e-6 * (LEAST_STRESS + formulas.pressure_of_width(stored, HEIGHT, SHEAR, POISSON)), color="0.3")
    plane = [formulas.pressure(RATE, x, HEIGHT, SHEAR, POISSON, VISCOSITY) for x in runs[0].half_length]
    axes[2].plot(runs[0].time, 1e-6 * (LEAST_STRESS + np.array(plane)), color="0.6", ls="-.",
                 label="Eq. 42, third line, G³ and h put back")
    axes[2].set_xscale("log")
    axes[2].legend(frameon=False, fontsize=8)
    for ax, label in zip(axes, ("half-length [m]", "width at the well [mm]", "pressure in the well [MPa]")):
        ax.set_xlabel("time [s]")
        ax.set_ylabel(label)
        ax.grid(alpha=0.3)
    axes[0].legend(frameon=False, fontsize=8)
    _save(figure, output)


def wing(run):
    """(time, distance from the well, opening, fluid pressure or None) of the coal's middle, averaged over both wings
    and the thickness of two cells, in bins of a cell; and the half-length."""
    time, cells = zone.at(run.directory)
    found = zone.Zone(cells, run.angle)
    h = found.size[:, 0].min()
    middle = np.abs(found.centre[:, 2]) < h
    place, opening = np.abs(found.along[middle]), found.opening()[middle]
    pressure = found.fields.get("fluid_pressure")
    bins = np.arange(0., place.max() + h, h)
    number = np.digitize(place, bins)
    filled = [i for i in range(1, len(bins) + 1) if (number == i).any()]
    # A line that leaves the mesh's directions passes more than one cell in places.
    steps = np.array([[place[number == i].mean(), opening[number == i].mean(),
                       math.nan if pressure is None else pressure[middle][number == i].mean()] for i in filled])
    return time, steps[:, 0], steps[:, 1], steps[:, 2], place.max() + 0.5 * h


def profiles(run, output):
    """Figures 13, 14 and 15: pressure and half-width along the fracture."""
    time, place, opening, pressure, tip = wing(run)
    late = run.time > 0.7 * run.time[-1]
    speed = np.polyfit(run.time[late], run.half_length[late], 1)[0]
    distance = np.linspace(0.01, 0.5, 100) * HEIGHT  # further off, a fracture of this height is not in plane strain
    asymptote = np.array([formulas.tip_width(x, speed, PLANE, VISCOSITY) for x in distance])
    suction = np.array([formulas.tip_pressure(x, speed, PLANE, VISCOSITY) for x in distance])
    figure, axes = plt.subplots(1, 3, figsize=(13., 3.8), layout="constrained")
    axes[0].plot(place, 1e-6 * pressure, ".-", label=f"θ = {run.angle:g}°, t = {time:.3g} s")
    axes[0].plot(tip - distance, 1e-6 * (LEAST_STRESS + suction), color="0.3", ls="--", label="tip, Eq. 43")
    axes[0].set_ylim(7., None)
    axes[0].set_ylabel("fluid pressure [MPa]")
    axes[1].plot(place, 0.5e3 * opening, ".-")
    axes[1].plot(tip - distance, 0.5e3 * asymptote, color="0.3", ls="--", label=f"tip, Eq. 43, {speed:.2g} m/s")
    share = np.linspace(0., 1., 200)
    axes[1].plot(tip * share, 0.5e3 * opening[0] * (1. - share)**(2. / 3.), color="0.6", ls="-.",
                 label="(1 − ξ)^(2/3)")
    axes[1].set_ylim(0., 0.8e3 * opening.max())
    axes[1].set_ylabel("half-width [mm]")
    axes[2].plot(place / tip, opening / opening.max(), ".-", label="width")
    net = pressure - LEAST_STRESS
    axes[2].plot(place / tip, net / np.nanmax(np.abs(net)) if np.isfinite(net).any() else net, ".-",
                 label="net pressure")
    axes[2].set_ylim(-1., 1.05)
    axes[2].set_ylabel("over the greatest")
    for ax, label in zip(axes, ("from the well [m]", "from the well [m]", "ξ")):
        ax.set_xlabel(label)
        ax.grid(alpha=0.3)
        ax.legend(frameon=False, fontsize=8)
    _save(figure, output)


def _save(figure, output):
    figure.savefig(output, dpi=75, bbox_inches="tight")
    plt.close(figure)
    print(output)
