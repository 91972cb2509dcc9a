#!/usr/bin/env python3
"""How much the inlet pressure of runs swings as their fractures grow cell by cell.

    contrib/sawtooth.py DIRECTORY...

For each run with a reference: the amplitude (half of the way from a local extremum of pressure over
reference to the next), its median and greatest value over the second half of the time [%].
"""
import argparse
import os
import statistics
import sys

sys.path.insert(0, os.path.dirname(os.path.abspath(__file__)))
from results import read_statistics, script  # noqa: E402


def amplitudes(ratios):
    """Half of the differences between successive local extrema."""
    extrema = [b for a, b, c in zip(ratios, ratios[1:], ratios[2:]) if (b - a) * (c - b) < 0]
    return [abs(b - a) / 2 for a, b in zip(extrema, extrema[1:])]


def main():
    parser = argparse.ArgumentParser(description=__doc__,
                                     formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("directories", nargs="+", metavar="DIRECTORY")
    for directory in parser.parse_args().directories:
        columns = read_statistics(directory)
        end = columns["time"][-1]
        late = [row for row in zip(columns["time"], columns["inlet_pressure"], columns["reference_inlet_pressure"])
                if row[0] > end / 2]
        found = amplitudes([p / r for _, p, r in late if isinstance(r, float)])
        if found:
            print(f"{directory}: {100 * statistics.median(found):.2g} (median), "
                  f"{100 * max(found):.2g} (greatest) %")
        else:
            print(f"{directory}: the pressure does not swing")


if __name__ == "__main__":
    script(main)
