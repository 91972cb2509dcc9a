#!/usr/bin/python3
"""A hydraulic fracture meets a natural crack: published criteria, runs over angle and contrast of stress, the map.

    contrib/natural_crack.py criteria [--friction 0.6] [--least 1] [--strength 1.48] [--output DIR]
    contrib/natural_crack.py run      [--model peridynamics cohesive_xfem] [--angles 30 45 60 90] [--contrasts 0 1 2 4]
                                      [--cemented SHARE] [--output DIR] [--set ...]
    contrib/natural_crack.py map      [the same]

`criteria` prints the least contrast of stress with which the natural crack is crossed after Blanton (1982), Renshaw &
Pollard (1995) and Gu & Weng (2010), and draws the curves. `run` runs the decks prm/natural_crack/<angle>/<model>.prm
with each contrast; what is finished stays as it is. `map` prints what each run has done, the sum of its fluid, and
draws the map, both models beside the criteria, and the fractures. Stresses are in MPa. With --cemented the natural crack holds, and
takes this share of the rock's energy release rate. Results are in DIR/<model>/<open or cemented>/<friction and least>/<angle>/<contrast>.
"""
import argparse
import itertools
import math
import os
import sys

import matplotlib
matplotlib.use("Agg")
import matplotlib.pyplot as plt  # noqa: E402
import numpy as np  # noqa: E402

HERE = os.path.dirname(os.path.abspath(__file__))
ROOT = os.path.join(HERE, "..")
sys.path.insert(0, HERE)
from arguments import PROGRAM, positive, program  # noqa: E402
from deck_runs import run_deck  # noqa: E402
from natural_crack import criteria, outcome  # noqa: E402
from results import ResultError, read_statistics, read_summary, script  # noqa: E402

ANGLES = (30, 45, 60, 90)
MODELS = {"peridynamics": ("bonds", -1.3, 10), "cohesive_xfem": ("cut cells", 1.3, 6)}  # name, place on the map, size
SIGNS = {"crosses": ("^", "tab:green"), "both": ("D", "tab:olive"), "turns": ("s", "tab:orange"),
         "stops": ("o", "tab:red"), "not there": ("x", "0.5")}


def curves(options):
    """{name: (angles, contrasts over the strength)}."""
    angles = np.linspace(20., 90., 141)
    least, mu = options.least / options.strength, options.friction
    return {"Blanton (1982)": (angles, [criteria.blanton_contrast(a, 1., mu) for a in angles]),
            "Gu & Weng (2010)": (angles, [criteria.gu_weng_contrast(a, least, 1., mu, most=50.) for a in angles]),
            "Renshaw & Pollard (1995)": (np.array([90.]), [criteria.renshaw_pollard_contrast(least, 1., mu)])}


def draw_curves(options, ax):
    for color, (name, (angles, contrasts)) in zip(("tab:blue", "tab:purple", "black"), curves(options).items()):
        contrasts = np.array(contrasts)
        seen = np.isfinite(contrasts)
        ax.plot(angles[seen], contrasts[seen], "*" if len(angles) == 1 else "-", color=color, ms=12, zorder=4,
                label=f"{name}: crosses above")
    ax.set_ylim(-0.2, 6.)
    ax.set_xlim(20., 95.)
    ax.set_xlabel("angle [degrees]")
    ax.set_ylabel("contrast of stress over the strength")
    ax.grid(alpha=0.3)


def save(figure, output):
    figure.savefig(output, dpi=75, bbox_inches="tight")
    plt.close(figure)
    print(output)


def print_criteria(options):
    print(f"friction {options.friction:g}, least compression {options.least:g} MPa, strength {options.strength:g} MPa; "
          "crosses where the contrast is more than")
    for name, (angles, contrasts) in curves(options).items():
        shown = [(a, options.strength * c) for a, c in zip(angles, contrasts) if min(abs(a - b) for b in ANGLES) < 1e-9]
        print(f"  {name}: " + ", ".join(f"{a:g} degrees {c:.2f} MPa" if math.isfinite(c) else f"{a:g} degrees never"
                                        for a, c in shown))
    os.makedirs(options.output, exist_ok=True)
    figure, ax = plt.subplots(figsize=(6., 4.5), layout="constrained")
    draw_curves(options, ax)
    ax.legend(frameon=False, fontsize=8)
    save(figure, os.path.join(options.output, "criteria.png"))
    return 0


def place(options, model, angle, contrast):
    kind = "open" if options.cemented is None else f"cemented_{options.cemented:g}"
    rest = f"friction_{options.friction:g}_least_{options.least:g}"
    return os.path.join(options.output, model, kind, rest, str(angle), f"{contrast:g}")


def settings(options, model, deck, contrast):
    """What differs from the deck."""
    entries = [f"In situ/Stress={-(options.least + contrast):g} MPa, {-options.least:g} MPa",
               f"Fracture/{model}/Friction coefficient={options.friction:g}"]
    if options.cemented is not None:
        cracks = [line.split("=")[1] for line in open(deck, encoding="utf-8") if line.strip().startswith("set Open")][0]
        notch, natural = cracks.strip().split(";")
        entries += [f"Cracks/Open={notch}", f"Cracks/Cohesive={natural}",
                    f"Fracture/{model}/Cohesive energy={options.cemented:g}"]
    return entries + options.set


def run(options):
    ended = True
    for model, angle, contrast in itertools.product(options.model, options.angles, options.contrasts):
        deck = os.path.join(ROOT, "prm", "natural_crack", str(angle), f"{model}.prm")
        part = os.path.join(ROOT, "prm", "cases", "natural_crack", f"{angle}.part.prm")
        entries = ["Resolution=coarse", *settings(options, model, part, contrast)]
        ended &= run_deck(options.program, deck, place(options, model, angle, contrast), entries)
    return 0 if ended else 1


def draw_fracture(ax, found, angle):
    widest = found.pieces.aperture.max()
    turn = math.radians(angle)
    x, y = outcome.HALF_LENGTH * math.cos(turn), outcome.HALF_LENGTH * math.sin(turn)
    ax.plot([outcome.MIDDLE - x, outcome.MIDDLE + x], [-y, y], color="0.7", lw=1.)
    for ends, width in zip(found.pieces.ends, found.pieces.aperture):
        if width > outcome.LEAST_APERTURE:
            ax.plot(*ends.T, color="tab:blue", lw=0.5 + 4. * width / widest, solid_capstyle="round")
    ax.set_aspect("equal")
    ax.set_xlim(0., 4.)
    ax.set_ylim(-2., 2.)
    ax.set_xticks([])
    ax.set_yticks([])


def draw_ways(options, model, ax):
    """The fractures of a model, each in a panel, and its signs on the map."""
    name_of_model, aside, size = MODELS[model]
    ways, axes = plt.subplots(len(options.contrasts), len(options.angles), squeeze=False, layout="constrained",
                              figsize=(2.2 * len(options.angles), 2.2 * len(options.contrasts)))
    for (row, contrast), (column, angle) in itertools.product(enumerate(sorted(options.contrasts, reverse=True)),
                                                              enumerate(options.angles)):
        directory = place(options, model, angle, contrast)
        panel = axes[row, column]
        panel.set_title(f"{angle}°, {contrast:g} MPa", fontsize=9)
        at = f"{name_of_model}, {angle} degrees, {contrast:g} MPa: "
        try:
            table, summary = read_statistics(directory), read_summary(directory)
            time, pieces = outcome.Pieces.read(directory)
        except ResultError as error:
            print(f"{at}{error}")
            continue
        found = outcome.Outcome(pieces, angle)
        name = found.name()
        wanted = table["injected_volume"][-1]
        missing = (table["fracture_volume"][-1] + table["leaked_volume"][-1]) / wanted - 1.
        print(f"{at}{name}; beyond {found.beyond:.2f} m, natural crack open {found.opened:.2f} m, "
              f"grown at its ends {found.tips:.2f} m; {time:g} s, inlet {1e-6 * table['inlet_pressure'][-1]:.3f} MPa; fractures and "
              f"leak-off over injected, less 1: {missing:.1e}; {summary.get('status')}")
        marker, color = SIGNS[name]
        ax.plot(angle + aside, contrast / options.strength, marker, color=color, ms=size, zorder=5, mec="black")
        draw_fracture(panel, found, angle)
    return ways


def draw_map(options):
    figure, ax = plt.subplots(figsize=(7., 5.), layout="constrained")
    draw_curves(options, ax)
    kind = "open" if options.cemented is None else f"cemented_{options.cemented:g}"
    os.makedirs(options.output, exist_ok=True)
    for model in options.model:
        save(draw_ways(options, model, ax), os.path.join(options.output, f"ways_{model}_{kind}.png"))
    for name, (marker, color) in SIGNS.items():
        ax.plot([], [], marker, color=color, ms=8, mec="black", label=name)
    names = [f"{side} sign: {MODELS[model][0]}" for side, model in zip(("left, large", "right, small"), MODELS) if model in options.model]
    ax.legend(frameon=False, fontsize=8, loc="upper left", bbox_to_anchor=(1., 1.), title="\n".join(names), title_fontsize=8)
    save(figure, os.path.join(options.output, f"map_{kind}.png"))
    return 0


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("command", choices=("criteria", "run", "map"))
    parser.add_argument("--model", nargs="+", choices=MODELS, default=list(MODELS))
    parser.add_argument("--angles", type=int, nargs="+", choices=ANGLES, default=list(ANGLES))
    parser.add_argument("--contrasts", type=float, nargs="+", default=[0., 1., 2., 4.], metavar="MPA")
    parser.add_argument("--least", type=positive, default=1., metavar="MPA", help="compression across the fracture's way")
    parser.add_argument("--friction", type=positive, default=0.6)
    parser.add_argument("--strength", type=positive, default=1.48, metavar="MPA", help="of bonds of 0.2 m cells")
    parser.add_argument("--cemented", type=positive, metavar="SHARE")
    parser.add_argument("--output", default="natural_crack", metavar="DIR")
    parser.add_argument("--program", type=program, default=PROGRAM)
    parser.add_argument("--set", action="append", default=[], metavar="'Section/Entry=value'")
    options = parser.parse_args()
    return {"criteria": print_criteria, "run": run, "map": draw_map}[options.command](options)


if __name__ == "__main__":
    script(main)
