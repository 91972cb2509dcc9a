"""Numbers of a finished run by name, for tests and for maps of studies.

A name is a path into summary.json (`errors/pore_pressure/final`), or one of

    rates/COLUMN          of statistics.csv: its growth per time in the second half of the run
    minimum/COLUMN        and maximum/COLUMN, of all steps
    closure/QUANTITY      of contrib/closure.py
    direction             the slope of the fractures' diagonal [degrees]
    pressure_and_length   the square of the net pressure at the first well times the equivalent length [Pa^2 m]: with one
                          pressure in all of a straight fracture G = pi p^2 L/(2 E') (Griffith 1921)
    late_direction        that of what it has grown by in the second half of the run
    fields/FIELD/minimum  and fields/FIELD/maximum, over the last fields that were written; of a tensor or a vector, over
                          its components (needs numpy)
"""
import math

from closure import closure
from results import read_statistics


# What a name may begin with: numbers and groups of summary.json (source/base/run_summary.cc), and those from other files.
BEGINNINGS = ("cells", "unknowns", "ranks", "steps", "rejected_steps", "nonlinear_iterations", "linear_iterations",
              "wall_seconds", "cpu_seconds", "peak_memory_bytes", "final", "errors", "fluid_balance", "warnings",
              "rates", "minimum", "maximum", "closure", "direction", "late_direction", "pressure_and_length",
              "fields")


def with_measures(directory, summary, names):
    """The summary with what the names ask for besides."""
    kinds = {name.split("/")[0] for name in names}
    found = dict(summary)
    if "rates" in kinds:
        found["rates"] = late_rates(read_statistics(directory))
    if kinds & {"minimum", "maximum"}:
        columns = {name: [x for x in column if isinstance(x, float)]
                   for name, column in read_statistics(directory).items()}
        found["minimum"] = {name: min(column) for name, column in columns.items() if column}
        found["maximum"] = {name: max(column) for name, column in columns.items() if column}
    if "closure" in kinds:
        found["closure"] = closure(read_statistics(directory))[0]
    if "direction" in kinds:
        final = summary["final"]
        found["direction"] = math.degrees(math.atan2(final["extent_y"], final["extent_x"]))
    if "pressure_and_length" in kinds:
        final = summary["final"]
        found["pressure_and_length"] = final["net_inlet_pressure"]**2 * final["equivalent_length"]
    if "late_direction" in kinds:
        rates = late_rates(read_statistics(directory))
        found["late_direction"] = math.degrees(math.atan2(rates["extent_y"], rates["extent_x"]))
    if "fields" in kinds:
        found["fields"] = extremes(directory)
    return found


def late_rates(table):
    """Of each column that is all numbers."""
    times = table["time"]
    first = next(i for i, time in enumerate(times) if time >= 0.5 * times[-1])
    return {name: (column[-1] - column[first]) / (times[-1] - times[first])
            for name, column in table.items() if all(isinstance(x, float) for x in column)}


def extremes(directory):
    """{field: {minimum, maximum}} of the last fields that were written."""
    from plot import vtu  # here, for all else is the standard library's
    data = vtu.read(vtu.at_time(vtu.series(directory, "fields"))[1]).point_data
    return {name: {"minimum": float(values.min()), "maximum": float(values.max())} for name, values in data.items()}
