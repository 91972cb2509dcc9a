#!/usr/bin/env python3
"""One problem on the scale of a laboratory and of a field. Python standard library only.

    scaling.py --program build/source/stockwork --scratch DIR --deck DECK [--set ENTRY=VALUE]...
               --size L,E,T [--size ...] [--tolerance 1e-6] [--drop ENTRY]... [--net-as=STRESS]

The deck is run as it is, and again with all its lengths times L, stresses times E and times times
T, and everything else by its unit. No default has a dimension, so steps and results must agree when
divided by these factors: all columns of statistics.csv, in every step. --net-as: and with this
in-situ stress the length, the aperture and the pressure over the closing stress must be the same to
1 % as without any.
"""
import argparse
import os
import re
import shutil
import subprocess
import sys

sys.path.insert(0, os.path.join(os.path.dirname(os.path.abspath(__file__)), "..", "contrib"))
from results import read_statistics  # noqa: E402

# Exponents of length, stress and time; the longest unit first.
UNITS = {"MPa m^0.5": (0.5, 1, 0), "Pa m^0.5": (0.5, 1, 0), "J/m^2": (1, 1, 0), "m^2/s": (2, 0, -1),
         "m/s^0.5": (1, 0, -0.5), "Pa s": (0, 1, 1), "GPa": (0, 1, 0), "MPa": (0, 1, 0),
         "kPa": (0, 1, 0), "Pa": (0, 1, 0), "um": (1, 0, 0), "mm": (1, 0, 0), "cm": (1, 0, 0),
         "m": (1, 0, 0), "s": (0, 0, 1)}
QUANTITY = re.compile(r"(?<![\w.^])([-+]?(?:\d+\.?\d*|\.\d+)(?:[eE][-+]?\d+)?)\s*("
                      + "|".join(re.escape(unit) for unit in UNITS) + r")(?![\w^])")
ALTERNATIVES = re.compile(r"\{([^{}|]*)\|[^{}]*\}")

NET = ("time", "fracture_length", "inlet_aperture", "net_inlet_pressure")

# Of the columns, by the ends of their names; what is not here has no dimension.
COLUMN_UNITS = {"[m]": (1, 0, 0), "[m^2]": (2, 0, 0), "[s]": (0, 0, 1), "[Pa]": (0, 1, 0),
                "[J/m]": (2, 1, 0), "[Pa m^0.5]": (0.5, 1, 0), "[m^2/s]": (2, 0, -1)}
SKIPPED = re.compile(r"wall|balance|dissipated")


def factor(exponents, size):
    product = 1.
    for exponent, of in zip(exponents, size):
        product *= of ** exponent
    return product


def flatten(path):
    """The deck's lines with what it includes, coarse."""
    lines = []
    with open(path, encoding="utf-8") as file:
        for line in file:
            line = line.split("#")[0].rstrip()
            if line.startswith("include "):
                lines += flatten(os.path.join(os.path.dirname(path), line.split(None, 1)[1]))
            elif line:
                lines.append(ALTERNATIVES.sub(lambda match: match.group(1), line))
    return lines


def scaled(lines, size):
    def replace(match):
        return f"{float(match.group(1)) * factor(UNITS[match.group(2)], size)!r} {match.group(2)}"
    return [QUANTITY.sub(replace, line) for line in lines]


def sections(settings):
    """Settings 'A/B/Entry=value' as lines of a deck."""
    lines = []
    for setting in settings:
        path, value = setting.split("=", 1)
        *names, entry = path.split("/")
        lines += [f"subsection {name}" for name in names] + [f"set {entry} = {value}"]
        lines += ["end"] * len(names)
    return lines


def run(options, name, lines):
    deck = os.path.join(options.scratch, name + ".prm")
    with open(deck, "w", encoding="utf-8") as file:
        file.write("\n".join(lines) + "\n")
    output = os.path.join(options.scratch, name)
    command = [os.path.abspath(options.program), deck, "--output", output]
    done = subprocess.run(command, capture_output=True, text=True, timeout=options.timeout, check=False)
    if done.returncode != 0:
        sys.exit(f"FAILED: {name}: exit status {done.returncode}\n{done.stdout[-2000:]}{done.stderr}")
    with open(os.path.join(output, "statistics.csv"), encoding="utf-8") as file:
        header = file.readline().strip().lstrip("# ").split(",")
    units = {}
    for column in header:
        column = column.strip()
        for unit, exponents in COLUMN_UNITS.items():
            if column.endswith(unit):
                units[column[:-len(unit)].strip()] = exponents
    return read_statistics(output), units


def main():
    parser = argparse.ArgumentParser(description=__doc__,
                                     formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--program", required=True)
    parser.add_argument("--scratch", required=True)
    parser.add_argument("--deck", required=True)
    parser.add_argument("--set", action="append", default=[])
    parser.add_argument("--drop", action="append", default=[], help="lines that set this entry")
    parser.add_argument("--size", action="append", required=True, help="length, stress, time")
    parser.add_argument("--tolerance", type=float, default=1e-6)
    parser.add_argument("--net-as", metavar="STRESS")
    parser.add_argument("--timeout", type=float, default=300.)
    options = parser.parse_args()
    options.scratch = os.path.abspath(options.scratch)
    shutil.rmtree(options.scratch, ignore_errors=True)
    os.makedirs(options.scratch)

    lines = flatten(options.deck) + sections(["Resolution=coarse", "Output/Fields=false",
                                              *options.set])
    lines = [line for line in lines
             if not any(re.match(rf"\s*set {re.escape(entry)}\s*=", line) for entry in options.drop)]
    control, units = run(options, "control", lines)
    bad = []
    for number, text in enumerate(options.size):
        size = [float(part) for part in text.split(",")]
        table, _ = run(options, f"scaled_{number}", scaled(lines, size))
        worst, where = 0., ""
        for name, column in control.items():
            if SKIPPED.search(name) or not all(isinstance(x, float) for x in column):
                continue
            if len(table[name]) != len(column):
                bad.append(f"{text}: {len(table[name])} steps, {len(column)} in the control")
                break
            by = factor(units.get(name, (0, 0, 0)), size)
            greatest = max((abs(x) for x in column), default=0.)
            difference = max((abs(y / by - x) for x, y in zip(column, table[name])), default=0.)
            if name.startswith("error_"):
                greatest = max(greatest, 1.)
            if greatest > 0. and difference / greatest > worst:
                worst, where = difference / greatest, name
        print(f"  size {text}: {len(column)} steps, greatest difference {worst:.1e} ({where})")
        if not worst <= options.tolerance:
            bad.append(f"{text}: {where} differs by {worst:.1e} of its greatest value")
    if options.net_as:
        table, _ = run(options, "stressed", lines + sections([f"In situ/Stress={options.net_as}"]))
        for name in NET:
            pairs = list(zip(control[name], table[name]))
            worst = max(abs(y - x) for x, y in pairs) / max(abs(x) for x, _ in pairs)
            print(f"  in situ {options.net_as}: {len(pairs)} steps, {name} differs by {worst:.1e}")
            if len(control[name]) != len(table[name]) or not worst <= 0.01:
                bad.append(f"with {options.net_as} {name} is another, by {worst:.1e}")
    if bad:
        sys.exit("FAILED: " + "; ".join(bad))
    print("passed")


if __name__ == "__main__":
    main()
