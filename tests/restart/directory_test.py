#!/usr/bin/env python3
"""What a run and its output directory owe one another.

    directory_test.py PROGRAM DECK SCRATCH

A restart takes the checkpoint before the newest where that is damaged, and is refused behind its end
time; two runs cannot share a directory, and one that was killed does not keep it; a run that fails
says which equation was left and writes its summary."""
import json
import os
import shutil
import signal
import subprocess
import sys
import time

PROGRAM, DECK, SCRATCH = (os.path.abspath(name) for name in sys.argv[1:])
SETTINGS = ["Checkpoint/Steps between=1", "Output/Fields=false"]


def command(output, *more, settings=()):
    result = [PROGRAM, DECK, "--output", os.path.join(SCRATCH, output), *more]
    for setting in [*SETTINGS, *settings]:
        result += ["--set", setting]
    return result


def run(*arguments, **keywords):
    done = subprocess.run(command(*arguments, **keywords), capture_output=True, text=True,
                          timeout=300, check=False)
    return done.returncode, " ".join((done.stdout + done.stderr).split())


def expect(status, sentence, result):
    assert result[0] == status and sentence in result[1], \
        f"wanted {status} and '{sentence}', got {result[0]}:\n{result[1][-1500:]}"


def main():
    shutil.rmtree(SCRATCH, ignore_errors=True)
    os.makedirs(SCRATCH)

    expect(0, "", run("run", settings=["Time/End time=2 s"]))
    state = os.path.join(SCRATCH, "run", "checkpoint", "state")
    with open(state, "r+b") as file:
        file.truncate(os.path.getsize(state) // 2)
    expect(1, "a time after that of the checkpoint",
           run("run", "--restart", settings=["Time/End time=1 s"]))
    expect(0, "The newest checkpoint cannot be used",
           run("run", "--restart", settings=["Time/End time=2.5 s"]))

    with subprocess.Popen(command("shared", settings=["Time/End time=500 s"]),
                          stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL) as first:
        while first.poll() is None and not os.path.exists(
                os.path.join(SCRATCH, "shared", "statistics.csv")):
            time.sleep(0.05)
        assert first.poll() is None, "the first run ended by itself"
        expect(1, "that no other run writes to", run("shared"))
        first.send_signal(signal.SIGKILL)
    expect(0, "", run("shared", settings=["Time/End time=1 s"]))

    expect(2, "is left with", run("failed", settings=[
        "Time/Minimum step=0.5 s", "Nonlinear solver/Maximum iterations=1"]))
    with open(os.path.join(SCRATCH, "failed", "summary.json"), encoding="utf-8") as file:
        summary = json.load(file)
    assert summary["status"] == "failed" and "is left with" in summary["reason"], summary
    print("all as it should be")


if __name__ == "__main__":
    main()
