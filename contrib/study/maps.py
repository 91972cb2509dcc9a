"""Stability maps: where runs end, and with what number, over two entries that were varied."""
import math
import os
import re

import numpy as np
from matplotlib.colors import LogNorm, Normalize

from measures import with_measures
from results import ResultError, lookup
from study.look import plt
from study.matrix import describe
from study.place import folder

LEAST = 3      # values of an entry that make it an axis
NUMBER = re.compile(r"[-+]?(\d+\.?\d*|\.\d+)(e[-+]?\d+)?", re.IGNORECASE)


def settings_of(result):
    """{entry: value} of a run of a study, its case among them."""
    return {"case": result.case, **result.settings}


def varied(results):
    """The entries with enough values, all of them numbers of one unit."""
    values = {}
    for result in results:
        for entry, value in settings_of(result).items():
            values.setdefault(entry, set()).add(value)
    found = []
    for entry, texts in values.items():
        numbers = {text: NUMBER.match(text) for text in texts}
        units = {text[match.end():].strip() for text, match in numbers.items() if match}
        if len(texts) >= LEAST and all(numbers.values()) and len(units) == 1:
            found.append(entry)
    return found


def along(results, entry):
    """The values of an entry as texts, by their numbers, or as they come."""
    texts = list(dict.fromkeys(s[entry] for s in map(settings_of, results) if entry in s))
    numbers = [NUMBER.match(text) for text in texts]
    return sorted(texts, key=lambda text: float(NUMBER.match(text)[0])) if all(numbers) else texts


def maps(results, errors):
    """[(title, figure)] of a case, one for each way to run what was varied, where this is two entries.
    errors: {directory: worst mean error}."""
    axes = varied(results)
    if len(axes) != 2:
        return []
    numbers = {r.directory: 100 * errors.get(r.directory, math.nan) for r in results}
    return [(title or group[0].model, draw([(title, group)], *axes, numbers, "worst mean error [%]"))
            for title, group in groups(results, *axes).items()]


def chosen_map(results, chosen, file=None):
    """The figure of what a study wants to be shown, a panel for each way to run what was varied; into a file as well."""
    numbers = {}
    for result in results:
        numbers[result.directory] = math.nan
        if result.status == "finished":
            try:
                numbers[result.directory] = float(lookup(
                    with_measures(result.directory, result.summary, [chosen["measure"]]), chosen["measure"]))
            except (KeyError, TypeError, ValueError) as error:
                raise ResultError(f"the map shows '{chosen['measure']}', but {result.directory}: {error}") from None
    panels = list(groups(results, chosen["x"], chosen["y"]).items())
    figure = draw(panels, chosen["x"], chosen["y"], numbers, chosen.get("label", chosen["measure"]),
                  (chosen.get("least", -math.inf), chosen.get("limit", math.inf)), chosen.get("x_names"),
                  chosen.get("x_label"))
    if file:
        folder(os.path.dirname(file))
        figure.savefig(file, dpi=100, bbox_inches="tight", metadata={"Software": None})
    return figure


def groups(results, x, y):
    """{what else differs: runs}."""
    settings = {r.directory: settings_of(r) for r in results}
    several = {"model": len({r.model for r in results}) > 1}
    for entry in {e for s in settings.values() for e in s} - {x, y}:
        several[entry] = len({s.get(entry) for s in settings.values()}) > 1
    found = {}
    for result in results:
        its = settings[result.directory]
        if x in its and y in its:
            title = ", ".join(filter(None, [result.model if several["model"] else "",
                                            describe((e, v) for e, v in its.items() if several.get(e))]))
            found.setdefault(title, []).append(result)
    return found


def draw(panels, x, y, numbers, label, allowed=(-math.inf, math.inf), x_names=None, x_label=None):
    """Panels side by side on one scale, with the number in each field; hatched where there is none, or one that is not
    allowed."""
    everything = [r for _, group in panels for r in group]
    xs, ys = along(everything, x), along(everything, y)
    figure, axes = plt.subplots(1, len(panels), figsize=(1.6 + 0.62 * len(xs) * len(panels), 1.5 + 0.4 * len(ys)),
                                sharey=True, squeeze=False, layout="constrained")
    there = [n for n in numbers.values() if math.isfinite(n)]
    scale = scale_of(there)
    for ax, (title, group) in zip(axes[0], panels):
        ax.grid(False)
        for result in group:
            its = settings_of(result)
            field(ax, xs.index(its[x]), ys.index(its[y]), numbers[result.directory], result, scale, allowed)
        ax.set_title(title.replace(", ", "\n"), fontsize=9)
        ax.set_xlim(0, len(xs))
        ax.set_ylim(0, len(ys))
        names = x_names or xs
        turned = dict(rotation=45, ha="right", rotation_mode="anchor") if max(map(len, names)) > 6 else {}
        ax.set_xticks(np.arange(len(xs)) + 0.5, names, **turned)
        ax.set_yticks(np.arange(len(ys)) + 0.5, ys)
    figure.supxlabel(x_label or x, fontsize=9)
    figure.supylabel(y, fontsize=9)
    if there:
        figure.colorbar(plt.cm.ScalarMappable(scale, "viridis_r"), ax=list(axes[0]), label=label, pad=0.02)
    return figure


def scale_of(there):
    """Of colours: logarithmic where numbers differ by much, over four decades at most: what is less is nil."""
    if not there:
        return Normalize(0., 1.)
    low, high = min(there), max(there)
    if low > 0. and high > 5. * low:
        return LogNorm(max(low, 1e-4 * high), high, clip=True)
    return Normalize(low, high if high > low else low + 1.)


def ended(result):
    """How a run ended that has no number: a deck that the program refuses is told with the place of what is wrong."""
    if result.status != "failed":
        return ""
    return "refused" if re.search(r"(\.prm:\d+|command line): ", result.reason) else "fails"


def field(ax, column, row, number, result, scale, allowed):
    known = math.isfinite(number)
    failed = result.status == "failed" or (known and not allowed[0] <= number <= allowed[1])
    dark = known and scale(number) > 0.5
    ax.add_patch(plt.Rectangle((column, row), 1, 1, facecolor=plt.cm.viridis_r(scale(number)) if known else "0.85",
                               edgecolor="0.8" if dark else "0.3", hatch="////" if failed else None, lw=0.))
    text = (f"{number:.3g}" if abs(number) < 1000. else f"{number:.0f}") if known else ended(result)
    ax.text(column + 0.5, row + 0.5, text, ha="center", va="center", fontsize=7,
            bbox=dict(facecolor="white", edgecolor="none", pad=0.8, alpha=0.85))
