#!/usr/bin/env python3
"""The decks that --help and the README name exist, --list has a line for every case and model, and
--print-parameters json-schema is a schema that knows the entries of the deck.

    command_line_test.py PROGRAM"""
import glob
import json
import os
import re
import subprocess
import sys

ROOT = os.path.abspath(os.path.join(os.path.dirname(__file__), "..", ".."))


def said(*arguments):
    return subprocess.run([sys.argv[1], *arguments], capture_output=True, text=True, check=True).stdout


def main():
    with open(os.path.join(ROOT, "README.md"), encoding="utf-8") as file:
        named = re.findall(r"prm/[\w/]+\.prm", said("--help") + file.read())
    assert len(named) >= 3, named
    for deck in named:
        assert os.path.exists(os.path.join(ROOT, deck)), f"{deck} does not exist"

    listing = said("--list")
    for model in ("cohesive_xfem", "peridynamics", "prescribed", "none"):
        assert re.search(rf"^  {model} +\S", listing, re.M), f"--list has no model {model}"
    decks = [name for name in glob.glob(os.path.join(ROOT, "prm", "**", "*.prm"), recursive=True)
             if not name.endswith(".part.prm")]
    for deck in decks:
        case, model = os.path.split(os.path.relpath(deck, os.path.join(ROOT, "prm")))
        assert re.search(rf"^  {re.escape(case)} .*\b{model[:-4]}\b", listing, re.M), \
            f"--list does not name {case}, {model}"

    schema = json.loads(said("--print-parameters", "json-schema"))
    modulus = schema["properties"]["Rock"]["properties"]["Young modulus"]
    assert modulus["x-unit"] == "Pa" and modulus["default"] == "", modulus
    assert "string" in modulus["type"] and modulus["description"], modulus
    assert "cohesive_xfem" in schema["properties"]["Fracture"]["properties"]["Model"]["enum"]
    assert "Cell size" in schema["properties"]["Fracture"]["properties"]["cohesive_xfem"]["properties"]
    assert "Rate" in schema["properties"]["Wells"]["properties"]["Well 1"]["properties"]
    print(f"{len(decks)} decks, {len(named)} named")


if __name__ == "__main__":
    main()
