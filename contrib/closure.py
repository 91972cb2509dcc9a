#!/usr/bin/python3
"""Shut-in and closure pressure of a run, from its statistics.csv.

    contrib/closure.py OUTPUT_DIRECTORY [--shut-in TIME]

The shut-in is the last time at which the first well's rate falls to zero. A well that flows back is none.
Printed are

- ISIP, the instantaneous shut-in pressure: the falloff of the inlet pressure, drawn against the square
  root of the time since shut-in, prolonged in a straight line to shut-in;
- the pressure at which the faces first touch at the well: the inlet aperture has fallen to a hundredth
  of what it was at shut-in. Only a simulation can see this;
- the closure pressure by the G function (Nolte 1979; Barree, Barree and Craig 2009, "Holistic fracture
  diagnostics"): while the open fracture leaks by Carter's law, G dp/dG is a straight line through the
  origin; it ends at closure. Taken is the last point before G dp/dG falls for good from within a
  tenth of its greatest value, if the faces have met by the end of the run. In porous rock a closed fracture
  still leaks and holds next to nothing, so that G dp/dG leaps: where it gets above four times the line, the
  last point below twice the line is taken.
"""
import argparse
import math
import os
import sys

sys.path.insert(0, os.path.dirname(os.path.abspath(__file__)))
from results import ResultError, read_statistics, script  # noqa: E402

LABELS = {"isip": "ISIP", "first_contact": "pressure at first contact",
          "g_function": "closure pressure (G function)"}


def shut_in(times, rates):
    """Index of the last step with a rate before it is zero to the end."""
    flowing = [i for i, rate in enumerate(rates) if rate > 0.]
    if not flowing or flowing[-1] + 3 >= len(times):
        raise ResultError("the first well is not shut in at the end, or the run ends with it; "
                          "'--shut-in' names an earlier rest")
    return flowing[-1]


def step_at(times, shut):
    """Index of the last step up to a time."""
    before = [i for i, time in enumerate(times) if time <= shut * (1. + 1e-9)]
    if not before or before[-1] + 3 >= len(times):
        raise ResultError(f"a shut-in at {shut:g} s leaves no step before it or fewer than three after it: "
                          f"the run is from {times[0]:g} to {times[-1]:g} s")
    return before[-1]


def end_of_rest(times, rates, last):
    """Index after the last step in which the well rests since a step: the end, or where it pumps again.
    Of one that stores fluid, the rate falls bit by bit, and does not rise."""
    least = 1e-6 * max(map(abs, rates))

    def refuse(i):
        raise ResultError(f"the first well is not shut in at {times[last]:g} s: "
                          f"at {times[i]:g} s its rate is {rates[i]:g} m^2/s")

    if rates[last + 1] > max(least, 0.99 * rates[last]):
        refuse(last + 1)
    end = last + 1
    while end < len(times) and rates[end] <= rates[end - 1] + max(least, 0.01 * rates[last]):
        if rates[end] < -least:
            raise ResultError(f"the first well flows back, at {times[end]:g} s with {rates[end]:g} m^2/s: "
                              "that is no shut-in")
        end += 1
    if end < last + 4:
        refuse(end)
    if rates[end - 1] > max(least, 0.1 * rates[last]):
        refuse(end - 1)
    return end


def g_function(delta):
    """Nolte's G of the time since shut-in over that of pumping, high efficiency."""
    return 4. / math.pi * (4. / 3. * ((1. + delta) ** 1.5 - delta ** 1.5) - 4. / 3.)


def crossing(x, y, level):
    """x where y first falls to a level, between points in a straight line, and the change of x
    between these points; None: never."""
    for i in range(1, len(y)):
        if y[i] <= level < y[i - 1]:
            share = (y[i - 1] - level) / (y[i - 1] - y[i])
            return x[i - 1] + (x[i] - x[i - 1]) * share, abs(x[i] - x[i - 1])
    return None, 0.


def end_of_line(g, rising):
    """Index into the falloff of the last point on the straight line of G dp/dG; None: it does not end."""
    peak = rising.index(max(rising))
    slopes = sorted(value / x for x, value in zip(g[:peak // 2 + 1], rising))
    line = slopes[len(slopes) // 2]
    if rising[peak] > 4. * line * g[peak]:
        ends = [i for i in range(peak) if rising[i] <= 2. * line * g[i]]
    else:
        ends = [i for i, value in enumerate(rising) if value >= 0.9 * rising[peak]]
    return ends[-1] + 1 if ends and ends[-1] + 1 < len(rising) else None


def closure(table, shut=None):
    """{quantity: pressure [Pa] or None}, the time of shut-in [s], by how much the pressure falls within
    the step in which the faces meet [Pa], and the time at which the well pumps again [s] or None."""
    times, pressures = table["time"], table["inlet_pressure"]
    last = shut_in(times, table["well_1_rate"]) if shut is None else step_at(times, shut)
    end = end_of_rest(times, table["well_1_rate"], last) if "well_1_rate" in table else len(times)
    again = times[end] if end < len(times) else None
    start = times[last]
    since = [time - start for time in times[last + 1:end]]
    falloff = pressures[last + 1:end]
    roots = [math.sqrt(time) for time in since]

    n = max(2, min(5, len(roots) // 4))
    mean_x, mean_y = sum(roots[:n]) / n, sum(falloff[:n]) / n
    slope = (sum((x - mean_x) * (y - mean_y) for x, y in zip(roots[:n], falloff[:n])) /
             sum((x - mean_x) ** 2 for x in roots[:n]))
    result = {"isip": mean_y - slope * mean_x}

    aperture = table["inlet_aperture"]
    if not aperture[last] > 0.:
        raise ResultError(f"at the shut-in, {start:g} s, the fracture is not open at the well")
    result["first_contact"], fall = crossing(
        [pressures[last]] + falloff, aperture[last:end], 0.01 * aperture[last])

    g = [g_function(time / start) for time in since]
    rising = [g[i] * (falloff[i + 1] - falloff[i - 1]) / (g[i - 1] - g[i + 1])
              for i in range(1, len(g) - 1)]
    # G dp/dG falls in open fractures, too: closed are only faces that have met.
    closed = None if result["first_contact"] is None else end_of_line(g[1:-1], rising)
    result["g_function"] = None if closed is None else falloff[closed]
    return result, start, fall, again


def main():
    parser = argparse.ArgumentParser(description=__doc__,
                                     formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("directory")
    parser.add_argument("--shut-in", type=float, help="time [s], where the rate does not say it")
    options = parser.parse_args()
    result, start, fall, again = closure(read_statistics(options.directory), options.shut_in)
    taken = options.shut_in is not None and abs(options.shut_in - start) > 1e-6 * start
    print(f"shut-in taken at the step at {start:g} s" if taken else f"shut-in at {start:g} s")
    if again is not None:
        print(f"the well pumps again at {again:g} s; what comes then is left out")
    for name, value in result.items():
        print(f"{LABELS[name]}: " + ("not in this run" if value is None else f"{value / 1e6:.4f} MPa"))
    if fall > 0.02 * abs(result["first_contact"] or 0.):
        print(f"The pressure falls by {fall / 1e6:.2f} MPa within the step in which the faces meet: what is read "
              "there is no better. Run again with a smaller 'Time/Maximum step'.")


if __name__ == "__main__":
    script(main)
