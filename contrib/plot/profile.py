#!/usr/bin/python3
"""Draw aperture and fluid pressure along the open part of the fracture, at several times.

    profile.py DIRECTORY [--times 4] [--output FILE.png]
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
from arguments import whole_from  # noqa: E402
from results import script  # noqa: E402

QUANTITIES = {"aperture": ("aperture [mm]", 1e3), "fluid_pressure": ("fluid pressure [MPa]", 1e-6),
              "pressure": ("fluid pressure [MPa]", 1e-6)}


def profile(fracture, name):
    """(distance of each piece's middle from the first mouth, value), sorted."""
    ends, cells = fracture.cells(vtu.LINE)
    middles = fracture.points[ends].mean(axis=1) if len(cells) else np.zeros((0, 3))
    if name in fracture.cell_data:
        values = fracture.cell_data[name][cells]
    else:
        values = fracture.point_data[name][ends].mean(axis=1)
    span = np.ptp(middles, axis=0) if len(cells) else np.zeros(3)
    place = middles[:, int(np.argmax(span))] if len(cells) else np.zeros(0)
    order = np.argsort(place)
    return place[order], values[order], "xyz"[int(np.argmax(span))]


def main():
    parser = argparse.ArgumentParser(description=__doc__,
                                     formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("directory")
    parser.add_argument("--times", type=whole_from(1), default=4)
    parser.add_argument("--output")
    options = parser.parse_args()

    entries = vtu.series(options.directory, "fracture")
    end = entries[-1][0]
    chosen = sorted({vtu.at_time(entries, end * (i + 1) / options.times)
                     for i in range(options.times)})
    last = vtu.read(entries[-1][1])
    names = [n for n in QUANTITIES if n in last.cell_data or n in last.point_data]
    figure, axes = plt.subplots(1, len(names), figsize=(4.5 * len(names), 3.2), squeeze=False)
    for ax, name in zip(axes[0], names):
        label, factor = QUANTITIES[name]
        for i, (time, path) in enumerate(chosen):
            place, values, axis = profile(vtu.read(path), name)
            seen = profile(vtu.read(path), "aperture")[1]
            seen = seen > 0.003 * seen.max(initial=0.)
            place, values = place[seen], values[seen]
            ax.plot(place, factor * values, color=plt.cm.viridis(0.85 * i / max(1, len(chosen) - 1)),
                    lw=1.3, label=f"{time:.4g} s")
        ax.set_xlabel(f"{axis} [m]")
        ax.set_ylabel(label)
        ax.grid(alpha=0.3)
    axes[0][0].legend(frameon=False)
    figure.tight_layout()
    output = options.output or os.path.join(options.directory, "profile.png")
    figure.savefig(output, dpi=110)
    print(output)


if __name__ == "__main__":
    script(main)
