#!/usr/bin/env python3
"""Change decks and checkpoints at random and see that Stockwork says what is wrong.

    fuzz_decks.py PROGRAM [--decks N] [--checkpoints N] [--seed S] [--scratch DIR] [--timeout SECONDS]

A deck that ships, with a few lines changed, is given to `--check`; a checkpoint of a short run, with
bytes flipped or files cut short, to `--restart`. What must not happen is a signal, a run of more
than 20 s of the processor, or an exit status other than 0, 1 and 2. What fails is kept in the scratch directory, and
its number with the seed makes it again. The long form, an hour on one core:

    tests/fuzz/fuzz_decks.py build/source/stockwork --decks 2000 --checkpoints 300
"""
import argparse
import glob
import math
import os
import random
import re
import resource
import shutil
import signal
import subprocess
import sys

ROOT = os.path.abspath(os.path.join(os.path.dirname(__file__), "..", ".."))
CHECKPOINT_DECK = os.path.join(ROOT, "tests", "data", "growing_fracture.prm")

VALUES = ["", "0", "-1", "1", "2", "1e-9", "1e-30", "1e30", "1e308", "1e999", "inf", "-inf", "nan", "1 m",
          "1e-9 m", "3 GPa", "1/0", "0/0", "{1|2|3}", "{1|2}", "{", "}", "(((((1", "1)))", "-" * 300 + "1",
          "(" * 5000 + "1" + ")" * 5000, "1" * 3000, "1, " * 3000, "x" * 20000, "0, 0", "0, 0 -> 1 m, 0",
          "0, 0 -> 0, 0", "0, 0 -> 1e-12, 0", "0, 0 -> 1 m, 0; 0, 0 -> 1 m, 0", "left", "left, left",
          "left: 0; left: 1", "top: sin(x", "f(t) = 1/t", "f(t) = " + "(" * 500, "0 s: 1; 5 s: 2; 1 s: 3",
          "none", "true", "true false", "\u00b5", "\u2212 1", "2 cells", "999999 cells", "1e-9 m at 0 m",
          "lines 0, 1", "lines 1, 0", "1: (0, 0) to (1, 1)", "1e-9 m: (0, 0) to (1, 1)", "3", "18", "20"]
BYTES = [b"\x00", b"\xff", b"\xfe\xff", b"\xe9", b"\xed\xa0\x80", b"\t", b"\r", b"#", b"\\", b"\\\n",
         b"end\n", b"subsection A\n", b"include .\n", b"include /dev/zero\n", b"include /dev/stdin\n",
         b"include deck.prm\n", b"subsection B\n" * 3000, b"set x = 1\n" * 3000, b"set = \n"]


def flattened(name, depth=0):
    """A deck with its includes in place."""
    text = ""
    with open(name, encoding="utf-8") as file:
        for line in file:
            match = re.match(r"\s*include\s+(\S+)", line)
            text += flattened(os.path.join(os.path.dirname(name), match[1])) if match else line
    return text


def mutated(text, choose):
    """The deck's bytes with one to four changes."""
    lines = text.splitlines()
    for _ in range(choose.choice([1, 1, 1, 2, 2, 4])):
        settings = [i for i, line in enumerate(lines) if re.match(r"\s*set\s", line)]
        if not settings:
            break
        i = choose.choice(settings)
        name = lines[i].split("=")[0]
        what = choose.random()
        if what < 0.45:
            lines[i] = name + "= " + choose.choice(VALUES)
        elif what < 0.6:  # a number that is another
            lines[i] = re.sub(r"[0-9.]+", lambda m: choose.choice(
                [m[0], "-" + m[0], m[0] + "0", m[0] + "e9", m[0] + "e-9", "0"]), lines[i], count=1)
        elif what < 0.7:
            del lines[i]
        elif what < 0.8:
            lines.insert(choose.randrange(len(lines) + 1), lines[i])
        elif what < 0.9:
            j = choose.choice(settings)
            lines[i] = name + "=" + lines[j].split("=", 1)[1]
        else:
            del lines[choose.randrange(len(lines))]
    data = "\n".join(lines).encode() + b"\n"
    if choose.random() < 0.25:
        at = choose.randrange(len(data))
        data = data[:at] + choose.choice(BYTES) + data[at + choose.choice([0, 1, 5]):]
    if choose.random() < 0.05:
        data = data[:choose.randrange(len(data))]
    return data


class Fuzzer:
    def __init__(self, options):
        self.options = options
        self.program = os.path.abspath(options.program)
        self.scratch = os.path.abspath(options.scratch)
        self.failures, self.statuses = [], {}
        shutil.rmtree(self.scratch, ignore_errors=True)
        os.makedirs(self.scratch)
        self.environment = dict(os.environ, OMP_NUM_THREADS="1", OPENBLAS_NUM_THREADS="1",
                                DEAL_II_NUM_THREADS="1")

    def run(self, *arguments, limit=None):
        """(status or what else happened, stderr)"""
        try:
            # On a machine that others use, a run may wait: its own seconds count, and ten times as many
            # of the clock for one that waits for something itself.
            seconds = limit or self.options.timeout
            done = subprocess.run([self.program, *arguments], cwd=self.scratch, env=self.environment,
                                  stdin=subprocess.DEVNULL, stdout=subprocess.DEVNULL,
                                  stderr=subprocess.PIPE, timeout=10 * seconds, check=False,
                                  preexec_fn=lambda: resource.setrlimit(
                                      resource.RLIMIT_CPU, (math.ceil(seconds), math.ceil(seconds))))
            if done.returncode in (-signal.SIGXCPU, -signal.SIGKILL):
                return "hang", ""
            return done.returncode, done.stderr.decode(errors="replace")
        except subprocess.TimeoutExpired:
            return "hang", ""

    def judge(self, name, result, keep):
        status, said = result
        self.statuses[status] = self.statuses.get(status, 0) + 1
        problem = None
        if status not in (0, 1, 2):
            problem = f"exit status {status}"
        elif status == 1 and not said.strip():
            problem = "refused without a word"
        elif status == 2 and "stopped on rank" in said:
            problem = "an exception that nobody expected"
        if problem:
            kept = os.path.join(self.scratch, "kept_" + name)
            (shutil.copytree if os.path.isdir(keep) else shutil.copy)(keep, kept)
            self.failures.append(f"{name}: {problem}\n    {kept}\n    {said.strip()[-400:]}")
            print("FAILED " + self.failures[-1], flush=True)

    def decks(self):
        originals = sorted(name for name in glob.glob(os.path.join(ROOT, "prm", "**", "*.prm"), recursive=True)
                           if not name.endswith(".part.prm") and "benchmark" not in name)
        for number in range(self.options.decks):
            choose = random.Random(f"{self.options.seed}/deck/{number}")
            original = choose.choice(originals)
            deck = os.path.join(self.scratch, "deck.prm")
            with open(deck, "wb") as file:
                file.write(mutated(flattened(original) + "\nset Resolution = coarse\n", choose))
            self.judge(f"deck_{number}.prm", self.run(deck, "--check", "--output", "out"), deck)
            if os.path.exists(os.path.join(self.scratch, "out")):
                self.failures.append(f"deck_{number}: --check has written an output directory")
                shutil.rmtree(os.path.join(self.scratch, "out"))

    def checkpoints(self):
        if self.options.checkpoints == 0:
            return
        settings = ["--set", "Checkpoint/Steps between=1", "--set", "Output/Fields=false"]
        status, said = self.run(CHECKPOINT_DECK, "--output", "sound", *settings,
                                "--set", "Time/End time=2 s", limit=120)
        if status != 0:
            sys.exit(f"the run that makes the checkpoint failed: {status}\n{said}")
        sound, spoilt = (os.path.join(self.scratch, name) for name in ("sound", "spoilt"))
        for number in range(self.options.checkpoints):
            choose = random.Random(f"{self.options.seed}/checkpoint/{number}")
            shutil.rmtree(spoilt, ignore_errors=True)
            shutil.copytree(sound, spoilt)
            files = sorted(glob.glob(os.path.join(spoilt, "checkpoint", "*")))
            for name in choose.sample(files, choose.choice([1, 1, 2, len(files)])):
                with open(name, "rb") as file:
                    data = bytearray(file.read())
                what = choose.random()
                if what < 0.5:
                    for _ in range(choose.choice([1, 1, 8])):
                        data[choose.randrange(len(data))] ^= 1 << choose.randrange(8)
                elif what < 0.75:
                    del data[choose.randrange(len(data)):]
                elif what < 0.9:
                    at = choose.randrange(len(data))
                    data[at:at] = bytes(choose.randrange(256) for _ in range(9))
                else:
                    data = None
                if data is None:
                    os.remove(name)
                else:
                    with open(name, "wb") as file:
                        file.write(data)
            self.judge(f"checkpoint_{number}",
                       self.run(CHECKPOINT_DECK, "--output", "spoilt", "--restart", *settings,
                                "--set", "Time/End time=2.5 s"), spoilt)


def main():
    parser = argparse.ArgumentParser(description=__doc__,
                                     formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("program")
    parser.add_argument("--decks", type=int, default=40)
    parser.add_argument("--checkpoints", type=int, default=10)
    parser.add_argument("--seed", default="1")
    parser.add_argument("--scratch", default="fuzz")
    parser.add_argument("--timeout", type=float, default=20.)
    fuzzer = Fuzzer(parser.parse_args())
    fuzzer.decks()
    fuzzer.checkpoints()
    print("exit statuses: " + ", ".join(f"{status}: {n}" for status, n in
                                        sorted(fuzzer.statuses.items(), key=str)))
    if fuzzer.failures:
        sys.exit(f"{len(fuzzer.failures)} failed")
    print("all were refused with a sentence, or ran")


if __name__ == "__main__":
    main()
