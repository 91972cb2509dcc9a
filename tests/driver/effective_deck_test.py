#!/usr/bin/python3
"""The deck as it was used, effective.prm, can be read back and is the same.

    effective_deck_test.py PROGRAM DECK SCRATCH"""
import os
import shutil
import subprocess
import sys

program, deck, scratch = sys.argv[1:]
shutil.rmtree(scratch, ignore_errors=True)
os.makedirs(scratch)


def run(path, output):
    done = subprocess.run([program, path, "--output", output, "--set", "Time/End time=2 s"], cwd=scratch,
                          stdin=subprocess.DEVNULL, capture_output=True, text=True, check=False)
    if done.returncode != 0:
        sys.exit(f"{path}: exit status {done.returncode}\n{done.stderr}")
    with open(os.path.join(scratch, output, "effective.prm"), encoding="utf-8") as file:
        return [line for line in file if not line.startswith("set Output directory")]


first = run(deck, "first")
again = run("first/effective.prm", "again")
if first != again:
    sys.exit("effective.prm of a run of effective.prm is another")
