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
    """{curve: keywords of plot}. Colours tell models apart, or, where all are of one, variants."""
    curves = dict.fromkeys((r.model, r.curve) for r in results)
    models = list(dict.fromkeys(model for model, _ in curves))
    spare = [c for c in COLOURS if c not in {OF_MODEL.get(m) for m in models}]
    other = {m: spare[i % len(spare)] for i, m in enumerate(m for m in models if m not in OF_MODEL)}
    found, number = {}, {}
    for i, (model, curve) in enumerate(curves):
        n = number[model] = number.get(model, -1) + 1
        colour = (COLOURS[i % len(COLOURS)] if len(models) == 1 and len(curves) > 1 else
                  OF_MODEL.get(model) or other[model])
        mark = MARKS[(i if len(models) == 1 else models.index(model) + 3 * n) % len(MARKS)]
        found[curve] = dict(color=colour, marker=mark, linestyle=DASHES[n % len(DASHES)])
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
