"""Stability maps: where runs end, and with what error, over two entries that were varied."""
import re

import numpy as np
from matplotlib.colors import LogNorm

from study.look import plt

LEAST = 3    # values of an entry that make it an axis


def varied(results):
    """{entry: {value as a number: as text}} of the entries with enough values, all of them numbers."""
    values = {}
    for result in results:
        for setting in result.record.get("settings", []):
            entry, value = setting.split("=", 1)
            values.setdefault(entry, set()).add(value)
    found = {}
    for entry, texts in values.items():
        numbers = {text: re.match(r"[-+]?(\d+\.?\d*|\.\d+)(e[-+]?\d+)?", text, re.IGNORECASE) for text in texts}
        units = {text[match.end():].strip() for text, match in numbers.items() if match}
        if len(texts) >= LEAST and all(numbers.values()) and len(units) == 1:
            found[entry] = {float(match[0]): text for text, match in numbers.items()}
    return found


def maps(results, errors):
    """[(title, figure)], one for each way to run what was varied. errors: {directory: worst mean error}."""
    found = []
    axes = varied(results)
    if len(axes) != 2:
        return found
    (x, xs), (y, ys) = ((entry, sorted(values)) for entry, values in axes.items())
    groups = {}
    for result in results:
        settings = dict(s.split("=", 1) for s in result.record.get("settings", []))
        if x in settings and y in settings:
            others = (result.model, *(v for e, v in settings.items() if e not in (x, y)))
            groups.setdefault(", ".join(filter(None, others)), []).append((result, settings))
    for title, group in groups.items():
        error, failed = np.full((len(ys), len(xs)), np.nan), []
        for result, settings in group:
            place = [values.index(next(n for n, t in axes[e].items() if t == settings[e])) for e, values in
                     ((y, ys), (x, xs))]
            error[tuple(place)] = 100 * errors.get(result.directory, np.nan)
            if result.status == "failed":
                failed.append(place)
        found.append((title, draw(x, [axes[x][v] for v in xs], y, [axes[y][v] for v in ys], error, failed)))
    return found


def draw(x, x_texts, y, y_texts, error, failed):
    figure, ax = plt.subplots(figsize=(1.6 + 0.7 * len(x_texts), 1.2 + 0.5 * len(y_texts)))
    ax.grid(False)
    there = error[np.isfinite(error) & (error > 0.)]
    if len(there):
        shown = ax.pcolormesh(np.ma.masked_invalid(error), cmap="viridis_r",
                              norm=LogNorm(there.min(), max(there.max(), 1.01 * there.min())))
        figure.colorbar(shown, label="worst mean error [%]")
    for row, column in failed:
        ax.add_patch(plt.Rectangle((column, row), 1, 1, facecolor="0.85", edgecolor="0.5", hatch="xx"))
        ax.text(column + 0.5, row + 0.5, "fails", ha="center", va="center", fontsize=8,
                bbox=dict(facecolor="white", edgecolor="none", pad=1))
    ax.set_xlim(0, len(x_texts))
    ax.set_ylim(0, len(y_texts))
    ax.set_xticks(np.arange(len(x_texts)) + 0.5, x_texts)
    ax.set_yticks(np.arange(len(y_texts)) + 0.5, y_texts)
    ax.set_xlabel(x)
    ax.set_ylabel(y)
    figure.tight_layout()
    return figure
