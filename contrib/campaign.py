#!/usr/bin/python3
"""Run random scenes whose answer is known by symmetry: KGD fractures that lie anywhere in the mesh.

    contrib/campaign.py [--family NAME...] [--n 10] [--seed 1] [--model cohesive_xfem]
                        [--km-from 0.5] [--km-to 8] [--jobs 2] [--keep DIR]

Each runs beside the aligned fracture of the same K_m. Right means: length within 4 % or a cell and a
half per wing; aperture and net pressure, averaged over the last half of the time, within 2 and 3 %;
no part further from the line than a cell and 2 % of the length of a wing; less than a fifth of the
steps rejected. `turning` has no control: both tips must end within 5 degrees of the greatest
compression. --n is the number of scenes of each family; those of one number have the same K_m and one
control. The decks, logs and results of failures stay in DIR; for their control, add --keep-all. The exit
status is 0 if all scenes are right. A scene takes one to three minutes of a processor.
"""
import argparse
import concurrent.futures
import os
import shutil
import subprocess
import sys
import threading
import time

HERE = os.path.dirname(os.path.abspath(__file__))
sys.path.insert(0, HERE)
from arguments import PROGRAM, not_negative, positive, program, whole_from  # noqa: E402
from campaign.deck import deck  # noqa: E402
from campaign.judge import Run, judge  # noqa: E402
from campaign.scene import FAMILIES, control, draw  # noqa: E402


def run(options, scene, directory, name, number):
    """(Run, "") or (None, why there is none)."""
    output = os.path.join(directory, name)
    path = output + ".prm"
    os.makedirs(directory, exist_ok=True)
    with open(path, "w", encoding="utf-8") as file:
        file.write(deck(scene, options.model, options.seed, number))
    command = [options.program, path, "--output", output]
    for setting in options.set:
        command += ["--set", setting]
    try:
        with open(output + ".log", "w", encoding="utf-8") as log:
            status = subprocess.run(command, stdout=log, stderr=subprocess.STDOUT, check=False,
                                    timeout=options.timeout, stdin=subprocess.DEVNULL,
                                    env=dict(os.environ, OMP_NUM_THREADS="1", OPENBLAS_NUM_THREADS="1",
                                             DEAL_II_NUM_THREADS="1")).returncode
    except subprocess.TimeoutExpired:
        return None, f"{name}: not finished after {options.timeout:g} s"
    if status != 0:
        return None, f"{name}: exit status {status}: {last_words(output + '.log')}"
    try:
        return Run(scene, output), ""
    except (OSError, KeyError, ValueError, IndexError) as error:
        return None, f"{name}: exit status 0, but results cannot be read: {error!r}"


def last_words(log):
    with open(log, encoding="utf-8", errors="replace") as file:
        lines = [line.strip() for line in file if line.strip()]
    errors = [i for i, line in enumerate(lines) if "rror" in line]
    return " ".join(lines[errors[-1]:] if errors else lines[-2:])[:400]


class Controls:
    """The aligned fractures: scenes of one number have one K_m, so that all families share them."""

    def __init__(self, options):
        self.options, self.lock, self.runs = options, threading.Lock(), {}

    def beside(self, scene, number):
        aligned = control(scene)
        if not aligned:
            return None, ""
        with self.lock:
            first = number not in self.runs
            mine = self.runs.setdefault(number, concurrent.futures.Future())
        if first:
            directory = os.path.join(self.options.keep, f"control_{self.options.seed}_{number}")
            try:
                mine.set_result(run(self.options, aligned, directory, "control", number))
            except BaseException as error:  # who waits for it must hear of it
                mine.set_exception(error)
        return mine.result()


def attempt(options, controls, family, number):
    """Run a scene beside its control: whether it is right."""
    began = time.time()
    scene = draw(family, options.seed, number, (options.km_from, options.km_to), options.wing,
                 options.pressed)
    directory = os.path.join(options.keep, f"{family}_{options.seed}_{number}")
    shutil.rmtree(directory, ignore_errors=True)
    beside, why = controls.beside(scene, number)
    found, wrong = why, ["control"]
    if not why:
        result, found = run(options, scene, directory, "scene", number)
        wrong = ["run"]
        if result:
            found, wrong = judge(scene, result, beside)
    with options.talk:
        print(f"{family:>15} {number:3}  {scene.describe()} | {found} | {time.time() - began:.0f} s | "
              + ("right" if not wrong else "WRONG: " + ", ".join(wrong)), flush=True)
    if not wrong and not options.keep_all:
        shutil.rmtree(directory)
    return not wrong


def main():
    parser = argparse.ArgumentParser(description=__doc__,
                                     formatter_class=argparse.RawDescriptionHelpFormatter,
                                     epilog="families:\n" + "\n".join(
                                         f"  {name:16} {text}" for name, text in FAMILIES.items()))
    parser.add_argument("--family", nargs="+", choices=FAMILIES, default=list(FAMILIES), metavar="NAME")
    parser.add_argument("--n", type=whole_from(1), default=10, help="scenes of each family")
    parser.add_argument("--first", type=whole_from(0), default=0, help="number of the first scene")
    parser.add_argument("--seed", type=whole_from(0), default=1)
    parser.add_argument("--model", default="cohesive_xfem", choices=("cohesive_xfem", "damage", "peridynamics"))
    parser.add_argument("--km-from", type=positive, default=0.5)
    parser.add_argument("--km-to", type=positive, default=8.)
    parser.add_argument("--wing", type=positive, default=42., help="length of a wing at the end, in cells")
    parser.add_argument("--pressed", type=not_negative, default=0., metavar="MPA",
                        help="compression from all sides, of scene and control alike: bonds in viscous fluid need it")
    parser.add_argument("--jobs", type=whole_from(1), default=2, help="scenes at once")
    parser.add_argument("--timeout", type=positive, default=1800., help="seconds per run")
    parser.add_argument("--program", type=program, default=PROGRAM)
    parser.add_argument("--set", action="append", default=[], metavar="SECTION/ENTRY=VALUE",
                        help="for scene and control alike")
    parser.add_argument("--keep", default="campaign-failures", metavar="DIR",
                        help="where scenes run, and failures stay")
    parser.add_argument("--keep-all", action="store_true", help="right ones stay, too, with their fields")
    options = parser.parse_args()
    if options.km_from > options.km_to:
        parser.error(f"--km-from {options.km_from:g} is greater than --km-to {options.km_to:g}")
    options.talk = threading.Lock()

    tasks = [(family, options.first + i) for family in options.family for i in range(options.n)]
    controls = Controls(options)
    with concurrent.futures.ThreadPoolExecutor(options.jobs) as pool:
        right = list(pool.map(lambda task: attempt(options, controls, *task), tasks))
    if not options.keep_all:
        for _, number in tasks:
            shutil.rmtree(os.path.join(options.keep, f"control_{options.seed}_{number}"), ignore_errors=True)
    for family in options.family:
        of_family = [ok for (name, _), ok in zip(tasks, right) if name == family]
        print(f"{family}: {sum(of_family)} of {len(of_family)} right")
    print(f"{sum(right)} of {len(right)} right ({100 * sum(right) / max(len(right), 1):.0f} %)")
    return 0 if all(right) else 1


if __name__ == "__main__":
    sys.exit(main())
