#!/usr/bin/env python3
"""Run the decks that the charts of 'Fracture/Model = auto' and 'Resolution = auto' are made of.

    contrib/make_charts.py [--program build/source/stockwork] [--into prm/charts.csv] [--kind KIND] [--deck DECK] [--model MODEL]
    contrib/make_charts.py --count      count cells and look up K_m and what leaks again; errors and seconds stay

A row is one run: the kind of scene, deck, model and resolution, by the scene audit the dimensionless toughness of a
fracture that grows, the share of the fluid that leaks off and how many cells make up half of the fracture's length at
the end; the error there (the worst of what is compared), seconds of the processor, and whether the run reached its end.
Errors are those against the reference; where a deck has none, the greatest difference from the finest runs of all
models. With --kind, --deck and --model, each as often as one likes, the other rows stay as they are.
"""
import argparse
import csv
import os
import re
import resource
import subprocess
import sys
import tempfile

HERE = os.path.dirname(os.path.abspath(__file__))
sys.path.insert(0, HERE)
from results import read_summary  # noqa: E402

FIELDS = ["kind", "deck", "model", "resolution", "K_m", "leaked", "cells", "error", "seconds", "status"]

STATIC, VOLUME = ("fracture_volume", "displacement"), ("fracture_volume",)
GROWING = ("equivalent_length", "inlet_aperture", "net_inlet_pressure")
AREA = ("equivalent_length", "inlet_aperture")  # the pressure at the inlet of a disc is none

# Displacements near a disc are compared in cracked cells too, where those of both faces are one ('damage').
# Kind of scene: decks, what is compared, resolutions.
KINDS = {
    "static": (["sneddon", "inclined/0"], STATIC, ["coarse", "medium", "fine"]),
    "static, turned": (["inclined/15", "inclined/30", "inclined/45"], STATIC, ["coarse", "medium", "fine"]),
    "static, disc": (["sneddon/penny"], VOLUME, ["coarse", "medium"]),
    "growing": (["kgd/toughness", "kgd/viscosity", "kgd/sun/large", "kgd/wang"], GROWING, ["coarse", "medium", "fine"]),
    "growing, carter": (["kgd/carter"], GROWING, ["coarse", "medium"]),
    "growing, porous": (["kgd/sun/permeable"], GROWING, ["coarse", "medium", "fine"]),
    "growing, turned": (["kgd/rotated/15", "kgd/rotated/30", "kgd/rotated/45"], GROWING, ["coarse", "medium"]),
    "growing, disc": (["radial/toughness", "radial/viscosity", "radial/small"], AREA, ["coarse", "medium"]),
}
MODELS = ["prescribed", "damage", "cohesive_xfem", "peridynamics"]

# In no chart: 372 s, of a scene of its own; and one that holds by the stress in situ, which charts do not know.
LEFT_OUT = [("radial/toughness", "peridynamics"), ("kgd/viscosity", "peridynamics")]

# A deck's own is not that which a model takes for its cells, and 'auto' refuses it.
STRENGTH = "Rock/Tensile strength="

# Of the processor [s]. A run that takes longer is none, nor are finer ones; the coarsest counts as one that does not end.
LONGEST = {"growing, disc": 3600}
LONGEST_OF_OTHERS = 150


def path_of(deck, model):
    return os.path.join(HERE, "..", "prm", deck, model + ".prm")


def audited(program, deck, resolution):
    """What the audit says of a scene; nothing where it does not count cells."""
    done = subprocess.run([program, deck, "--check", "--set", f"Resolution={resolution}", "--set", STRENGTH],
                          capture_output=True, text=True)

    def number(name):
        found = re.search(rf"^  {name}.*? {{2,}}(\S+) ", done.stdout, re.MULTILINE)
        return float(found[1]) if found else None

    cells, K_m, efficiency = (number(name) for name in ("cells in the final half length", "dimensionless toughness",
                                                        "efficiency at the end"))
    if cells is None:
        return None
    return {"cells": f"{cells:.3g}", "K_m": "" if K_m is None else f"{K_m:.3g}",
            "leaked": "" if efficiency is None else f"{1 - efficiency:.2g}"}


def longest(kind):
    return LONGEST.get(kind, LONGEST_OF_OTHERS)


def row(program, kind, deck, model, resolution, compared):
    """One run; under `finals` what a run without a reference is compared by."""
    scene = audited(program, path_of(deck, model), resolution)
    if scene is None:
        return None
    one = {"kind": kind, "deck": deck, "model": model, "resolution": resolution, **scene}
    with tempfile.TemporaryDirectory() as directory:
        command = [program, path_of(deck, model), "--output", directory, "--set", f"Resolution={resolution}",
                   "--set", "Output/Fields=false", "--set", STRENGTH]
        done = subprocess.run(command, capture_output=True, check=False,
                              preexec_fn=lambda: resource.setrlimit(resource.RLIMIT_CPU, (longest(kind), longest(kind) + 5)),
                              env={**os.environ, "OMP_NUM_THREADS": "1", "OPENBLAS_NUM_THREADS": "1"})
        if done.returncode < 0:
            return {**one, "error": "", "seconds": longest(kind), "status": "stopped"}
        summary = read_summary(directory)
    errors = [summary["errors"][name]["final"] for name in compared if name in summary["errors"]]
    return {**one, "error": f"{max(errors):.2g}" if errors else "", "seconds": f"{summary['cpu_seconds']:.2g}",
            "status": summary["status"], "finals": [summary["final"].get(name) for name in compared]}


def compare(rows):
    """Errors of a deck without a reference: the greatest difference from the finest run of each model that has ended,
    of the only one from the run before it."""
    ended = [one for one in rows if one["status"] == "finished"]
    finest = {one["model"]: one for one in ended}
    for one in ended:
        others = [other for other in finest.values() if other is not one]
        if not others:
            others = [other for other in ended if other is not one][-1:]
        off = [abs(a / b - 1) for other in others for a, b in zip(one["finals"], other["finals"])]
        one["error"] = f"{max(off):.2g}" if off else ""


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--program", default=os.path.join(HERE, "..", "build", "source", "stockwork"))
    parser.add_argument("--into", default=os.path.join(HERE, "..", "prm", "charts.csv"))
    parser.add_argument("--kind", action="append", choices=KINDS)
    parser.add_argument("--deck", action="append", choices=[deck for decks, *_ in KINDS.values() for deck in decks])
    parser.add_argument("--model", action="append", choices=MODELS)
    parser.add_argument("--count", action="store_true")
    options = parser.parse_args()

    def chosen(kind, deck, model):
        return all(not wanted or one in wanted for wanted, one in ((options.kind, kind), (options.deck, deck),
                                                                   (options.model, model)))
    rows = []
    if (options.kind or options.deck or options.model or options.count) and os.path.exists(options.into):
        with open(options.into, encoding="utf-8", newline="") as file:
            rows = list(csv.DictReader(file))
    if options.count:
        for old in rows:
            old.update(audited(options.program, path_of(old["deck"], old["model"]), old["resolution"]))
        return write(rows, options.into)
    rows = [old for old in rows if not chosen(old["kind"], old["deck"], old["model"])]
    for kind, (decks, compared, resolutions) in KINDS.items():
        for deck in decks:
            of_deck = [new for model in MODELS
                       if chosen(kind, deck, model) and os.path.exists(path_of(deck, model)) and (deck, model) not in LEFT_OUT
                       for new in runs(options.program, kind, deck, model, resolutions, compared)]
            if of_deck and not any(new["error"] or new["status"] != "finished" for new in of_deck):
                if options.model:
                    parser.error(f"{deck} has no reference: its models are compared with one another, and run together")
                compare(of_deck)
            rows += of_deck
            write(sorted(rows, key=place), options.into)


def place(one):
    return (list(KINDS).index(one["kind"]), KINDS[one["kind"]][0].index(one["deck"]), MODELS.index(one["model"]),
            ["coarse", "medium", "fine"].index(one["resolution"]))


def runs(program, kind, deck, model, resolutions, compared):
    rows = []
    for resolution in resolutions:
        new = row(program, kind, deck, model, resolution, compared)
        print(new or f"nothing from {deck}, {model}, {resolution}", flush=True)
        if new and new["status"] == "stopped":
            return rows or [new]
        rows += [new] if new else []
    return rows


def write(rows, path):
    with open(path, "w", encoding="utf-8", newline="") as file:
        writer = csv.DictWriter(file, FIELDS, lineterminator="\n", extrasaction="ignore")
        writer.writeheader()
        writer.writerows(rows)


if __name__ == "__main__":
    main()
