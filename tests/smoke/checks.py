#!/usr/bin/env python3
"""See that decks which ship pass `--check` at a resolution.

    checks.py PROGRAM LOADED_ONCE DECKS RESOLUTION FOLDER

The decks are those of DECKS/FOLDER and below, or the one deck DECKS/FOLDER.prm."""
import glob
import os
import sys

sys.path.insert(0, os.path.join(os.path.dirname(__file__), "..", "loaded_once"))

from loaded_once import Program  # noqa: E402


def main():
    name, library, root = (os.path.abspath(name) for name in sys.argv[1:4])
    resolution, folder = sys.argv[4:6]
    decks = [deck for pattern in (f"{folder}.prm", f"{folder}/**/*.prm")
             for deck in sorted(glob.glob(os.path.join(root, pattern), recursive=True))
             if not deck.endswith(".part.prm")]
    failures = []
    program = Program(name, library)
    for deck in decks:
        status, _, complained = program.run([deck, "--check", "--set", f"Resolution={resolution}"], ".")
        if status != 0:
            failures.append(f"{deck}: exit status {status}: {complained}")
    print(f"{len(decks)} decks")
    if failures or not decks:
        sys.exit("\n".join(failures) or f"no decks in {folder}")


if __name__ == "__main__":
    main()
