#!/usr/bin/env python3
"""A run whose disk fills up ends with status 2 and a message, keeps the checkpoint it had, and goes
on from it when there is room again, to the numbers of a run that was left alone.

    disk_full.py PROGRAM DECK SCRATCH

The full disk is a limit on the size of files, set while the run is under way: writing fails in the
same places."""

import os
import resource
import shutil
import subprocess
import sys
import time

LIMIT = 2048  # bytes: less than any mesh
# Steps enough that the run still goes on when a busy machine lets this script look at it.
OPTIONS = ["--set", "Checkpoint/Steps between=3", "--set", "Output/Fields=false",
           "--set", "Time/Initial step=0.005 s", "--set", "Time/Maximum step=0.005 s"]


def rows(output):
    """Those of statistics.csv, as numbers by column."""
    try:
        with open(os.path.join(output, "statistics.csv"), encoding="utf-8") as file:
            lines = [line.strip().split(",") for line in file if not line.startswith("#")]
    except OSError:
        return []
    return [dict(zip(lines[0], line)) for line in lines[1:]]


def start(program, deck, output, *more):
    return subprocess.Popen([program, deck, "--output", output, *OPTIONS, *more],
                            stdout=subprocess.DEVNULL, stderr=subprocess.PIPE, text=True)


def finish(process):
    message = process.communicate(timeout=600)[1]
    return process.returncode, message


def main():
    program, deck, scratch = sys.argv[1:]
    shutil.rmtree(scratch, ignore_errors=True)
    os.makedirs(scratch)
    straight, full = os.path.join(scratch, "straight"), os.path.join(scratch, "full")
    status, message = finish(start(program, deck, straight))
    assert status == 0, message

    process = start(program, deck, full)
    while len(rows(full)) < 7 and process.poll() is None:
        time.sleep(0.01)
    assert process.poll() is None, "the run ended before its disk was full"
    resource.prlimit(process.pid, resource.RLIMIT_FSIZE, (LIMIT, LIMIT))
    status, message = finish(process)
    print(message.strip())
    assert status == 2, f"exit status {status}"
    assert any(words in message for words in ("cannot write", "There is no room")), \
        "the message does not say what is wrong"
    steps = len(rows(full))

    status, message = finish(start(program, deck, full, "--restart"))
    assert status == 0, message
    end, restarted_end = rows(straight)[-1], rows(full)[-1]
    print(f"full after {steps} steps; {len(rows(full))} steps after the restart")
    for name, value in end.items():
        if name != "fluid_balance_error" and value:  # which is round-off
            a, b = float(value), float(restarted_end[name])
            assert abs(a - b) <= 1e-10 * max(abs(a), abs(b)), f"{name}: {a} and {b}"
    print("passed")


if __name__ == "__main__":
    main()
