"""What the scripts that run a scene and judge it have in common."""
import argparse
import os
import subprocess
import sys

HERE = os.path.dirname(os.path.abspath(__file__))
sys.path[:0] = [os.path.join(HERE, ".."), os.path.join(HERE, "..", "..", "contrib", "plot")]
from run_case import MPIRUN, Failure, Runner  # noqa: E402


def parser_of(description, timeout, *repeated):
    """A parser with a program, a scratch directory, a deck with settings, and more options that may be repeated."""
    parser = argparse.ArgumentParser(description=description, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--program", required=True)
    parser.add_argument("--loaded-once")
    parser.add_argument("--scratch", required=True)
    parser.add_argument("--timeout", type=float, default=timeout)
    parser.add_argument("--deck", required=True)
    for name in ("set", *repeated):
        parser.add_argument(f"--{name}", action="append", default=[])
    return parser


def judge(run, options):
    """Print what `run` finds wrong, a list; the exit status."""
    options.mpirun = MPIRUN
    try:
        failed = run(Runner(options), options)
    except (Failure, OSError, ValueError, KeyError, TypeError, ZeroDivisionError, subprocess.SubprocessError) as error:
        failed = [repr(error)]
    for text in failed:
        print(f"FAILED: {text}")
    print("failed" if failed else "passed")
    return 1 if failed else 0
