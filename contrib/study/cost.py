"""What accuracy costs: the Pareto front, the cheapest run for an accuracy, observed orders."""
import math

WANTED = (0.10, 0.05, 0.02, 0.01)


def front(points):
    """Of (cost, error, what) those that no other beats in both, by cost."""
    best, chosen = math.inf, []
    for point in sorted(points, key=lambda p: p[:2]):
        if point[1] < best:
            best = point[1]
            chosen.append(point)
    return chosen


def points(rows, cost, error):
    """(cost, error, row) of the runs that have finished and have both, greater than zero."""
    return [(row[cost], row[error], row) for _, row in rows.iterrows()
            if row["status"] == "finished" and row[cost] is not None and row[error] is not None
            and row[cost] > 0. and row[error] > 0.]


def cheapest(rows, error, cost="cpu_seconds"):
    """[(accuracy wanted, the cheapest run that has it, or None)]."""
    there = points(rows, cost, error)
    return [(wanted, min((p for p in there if p[1] <= wanted), key=lambda p: p[:2], default=None))
            for wanted in WANTED]


def orders(rows, error):
    """{curve: [(coarser row, finer row, order in the cell size)]}."""
    found = {}
    for curve, of_curve in rows.groupby("curve", sort=False):
        there = sorted((p for p in points(of_curve, "cell_size", error)), key=lambda p: -p[0])
        pairs = [(a[2], b[2], math.log(a[1] / b[1]) / math.log(a[0] / b[0]))
                 for a, b in zip(there, there[1:]) if a[0] > 1.01 * b[0]]
        if pairs:
            found[curve] = pairs
    return found


def worst_of(rows, names):
    """The greatest mean error of the quantities, per row."""
    return rows[["error_mean_" + name for name in names]].max(axis=1)
