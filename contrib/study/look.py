"""Colours, lines and marks: the same model looks the same in every picture. The colours are those of Okabe and Ito
(2008), which people who see red and green alike can tell; marks and dashes say the same once more."""
import matplotlib
matplotlib.use("Agg")
import matplotlib.pyplot as plt  # noqa: E402

COLOURS = ("#0072B2", "#D55E00", "#009E73", "#CC79A7", "#E69F00", "#56B4E9", "#000000")
OF_MODEL = dict(cohesive_xfem=COLOURS[0], damage=COLOURS[1], peridynamics=COLOURS[2], prescribed=COLOURS[3],
                phase_field=COLOURS[4], none=COLOURS[6])
MARKS = "osD^vP*X<>"
DASHES = ("-", "--", "-.", ":", (0, (5, 1, 1, 1, 1, 1)), (0, (1, 3)))

plt.rcParams.update({"font.size": 9, "axes.grid": True, "grid.alpha": 0.3, "axes.spines.top": False,
                     "axes.spines.right": False, "legend.frameon": False, "svg.hashsalt": "stockwork",
                     "figure.dpi": 100})


def styles(results):
    """{curve: keywords of plot}. The colour tells models apart, or, where all runs are of one, the first entry that was
    varied; marks and dashes tell the rest."""
    several = len({r.model for r in results}) > 1
    parts = {r.curve: (r.model, r.curve) if several else tuple((r.curve.split(", ", 2) + ["", ""])[1:3]) for r in results}
    firsts = list(dict.fromkeys(first for first, _ in parts.values()))
    spare = [c for c in COLOURS if c not in {OF_MODEL.get(f) for f in firsts}] or COLOURS
    unnamed = [f for f in firsts if f not in OF_MODEL]
    colours = {f: OF_MODEL.get(f) or spare[unnamed.index(f) % len(spare)] for f in firsts}
    rests = {f: list(dict.fromkeys(rest for first, rest in parts.values() if first == f)) for f in firsts}
    all_rests = list(dict.fromkeys(rest for _, rest in parts.values()))
    found = {}
    for curve, (first, rest) in parts.items():
        n = rests[first].index(rest) if several else all_rests.index(rest)
        mark = MARKS[(firsts.index(first) + 3 * n if several else n) % len(MARKS)]
        found[curve] = dict(color=colours[first], marker=mark, linestyle=DASHES[n % len(DASHES)])
    return found


def legend_below(figure, columns=3):
    """One legend for all axes, each label once, in room of its own below them."""
    handles = {label: handle for ax in figure.axes for handle, label in zip(*ax.get_legend_handles_labels())}
    lines = -(-len(handles) // columns)
    width, height = figure.get_size_inches()
    room = 0.19 * lines + 0.1
    figure.set_size_inches(width, height + room)
    figure.tight_layout(rect=(0., room / (height + room), 1., 1.))
    figure.legend(handles.values(), handles.keys(), loc="lower center", ncol=columns, fontsize=8)
    return figure
