#!/usr/bin/env python3
"""Run the decks that the charts of 'Fracture/Model = auto' and 'Resolution = auto' are made of.

    contrib/make_charts.py [--program build/source/stockwork] [--into prm/charts.csv] [--kind KIND ...]

A row is one run: the kind of scene, deck, model and resolution, how many cells make up half of the fracture's length
at the end, the error there (the worst of what is compared), seconds of the processor, and whether the run reached its
end. With --kind the other kinds' rows stay as they are.
"""
import argparse
import csv
import os
import re
import subprocess
import sys
import tempfile

HERE = os.path.dirname(os.path.abspath(__file__))
sys.path.insert(0, HERE)
from results import read_summary  # noqa: E402

FIELDS = ["kind", "deck", "model", "resolution", "cells", "error", "seconds", "status"]

STATIC, VOLUME = ("fracture_volume", "displacement"), ("fracture_volume",)
GROWING = ("equivalent_length", "inlet_aperture", "net_inlet_pressure")

# Displacements near a disc are compared in cracked cells too, where those of both faces are one ('damage').
# Kind of scene: decks, what is compared, resolutions.
KINDS = {
    "static": (["sneddon", "inclined/0"], STATIC, ["coarse", "medium", "fine"]),
    "static, turned": (["inclined/15", "inclined/30", "inclined/45"], STATIC, ["coarse", "medium", "fine"]),
    "static, disc": (["sneddon/penny"], VOLUME, ["coarse", "medium"]),
    "toughness": (["kgd/toughness"], GROWING, ["coarse", "medium", "fine"]),
    "transitional": (["kgd/sun/large", "kgd/wang"], GROWING, ["coarse", "medium"]),
    "viscosity": (["kgd/viscosity"], GROWING, ["coarse", "medium", "fine"]),
    "carter": (["kgd/carter"], GROWING, ["coarse", "medium"]),
    "toughness, turned": (["kgd/rotated/15", "kgd/rotated/30", "kgd/rotated/45"], GROWING, ["coarse", "medium"]),
}
MODELS = ["prescribed", "damage", "cohesive_xfem", "peridynamics"]

# Of the clock. A run that takes longer counts as one that does not end, and finer ones are not tried.
LONGEST = 150


def cells_of(program, deck, resolution):
    done = subprocess.run([program, deck, "--check", "--set", f"Resolution={resolution}"],
                          capture_output=True, text=True)
    found = re.search(r"cells in the final half length +(\S+)", done.stdout)
    return float(found[1]) if found else None


def row(program, kind, deck, model, resolution, compared):
    path = os.path.join(HERE, "..", "prm", deck, model + ".prm")
    cells = cells_of(program, path, resolution)
    if cells is None:
        return None
    with tempfile.TemporaryDirectory() as directory:
        command = [program, path, "--output", directory, "--set", f"Resolution={resolution}",
                   "--set", "Output/Fields=false"]
        try:
            subprocess.run(command, capture_output=True, timeout=LONGEST, check=False)
        except subprocess.TimeoutExpired:
            return {"kind": kind, "deck": deck, "model": model, "resolution": resolution, "cells": f"{cells:.3g}",
                    "error": "", "seconds": LONGEST, "status": "stopped"}
        summary = read_summary(directory)
    errors = [summary["errors"][name]["final"] for name in compared if name in summary["errors"]]
    return {"kind": kind, "deck": deck, "model": model, "resolution": resolution, "cells": f"{cells:.3g}",
            "error": f"{max(errors):.2g}" if errors else "", "seconds": f"{summary['cpu_seconds']:.2g}",
            "status": summary["status"]}


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--program", default=os.path.join(HERE, "..", "build", "source", "stockwork"))
    parser.add_argument("--into", default=os.path.join(HERE, "..", "prm", "charts.csv"))
    parser.add_argument("--kind", action="append", choices=KINDS)
    options = parser.parse_args()
    rows = []
    if options.kind and os.path.exists(options.into):
        with open(options.into, encoding="utf-8", newline="") as file:
            rows = [old for old in csv.DictReader(file) if old["kind"] not in options.kind]
    for kind, (decks, compared, resolutions) in KINDS.items():
        if options.kind and kind not in options.kind:
            continue
        for deck in decks:
            for model in MODELS:
                if os.path.exists(os.path.join(HERE, "..", "prm", deck, model + ".prm")):
                    rows += runs(options.program, kind, deck, model, resolutions, compared)
                write(rows, options.into)


def runs(program, kind, deck, model, resolutions, compared):
    rows = []
    for resolution in resolutions:
        new = row(program, kind, deck, model, resolution, compared)
        print(new or f"nothing from {deck}, {model}, {resolution}", flush=True)
        rows += [new] if new else []
        if new and new["status"] == "stopped":
            break
    return rows


def write(rows, path):
    with open(path, "w", encoding="utf-8", newline="") as file:
        writer = csv.DictWriter(file, FIELDS, lineterminator="\n")
        writer.writeheader()
        writer.writerows(rows)


if __name__ == "__main__":
    main()
