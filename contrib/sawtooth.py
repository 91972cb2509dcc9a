#!/usr/bin/env python3
"""How much the inlet pressure of runs swings as their fractures grow cell by cell.

    contrib/sawtooth.py DIRECTORY...

For each run with a reference: the amplitude (half of the way from a local extremum of pressure over
reference to the next), its median and greatest value over the second half of the time [%].
"""
import os
import statistics
import sys

sys.path.insert(0, os.path.dirname(os.path.abspath(__file__)))
from results import read_statistics  # noqa: E402


def amplitudes(ratios):
    """Half of the differences between successive local extrema."""
    extrema = [b for a, b, c in zip(ratios, ratios[1:], ratios[2:]) if (b - a) * (c - b) < 0]
    return [abs(b - a) / 2 for a, b in zip(extrema, extrema[1:])]


def main():
    if len(sys.argv) < 2 or sys.argv[1] in ("-h", "--help"):
        sys.exit(__doc__)
    for directory in sys.argv[1:]:
        columns = read_statistics(directory)
        end = columns["time"][-1]
        found = amplitudes([p / r for t, p, r in zip(columns["time"], columns["inlet_pressure"],
                                                     columns["reference_inlet_pressure"])
                            if t > end / 2])
        if found:
            print(f"{directory}: {100 * statistics.median(found):.2g} (median), "
                  f"{100 * max(found):.2g} (greatest) %")
        else:
            print(f"{directory}: the pressure does not swing")


if __name__ == "__main__":
    main()
