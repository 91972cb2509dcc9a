#!/usr/bin/python3
"""Run Stockwork on a deck and check what it did.

    run_case.py --program build/source/stockwork --scratch DIR MODE ...

    case     one run; every --expect must hold. With --negative, every bound on an error must be
             broken against a reference solution that is off by twice that bound, up or down.
    order    one run per --series value; the observed order of a quantity in the last pair of runs
    same     two runs on different numbers of ranks (or with different settings) agree; with --in-time, those columns
             alone, at the times of the first run, however long the steps are
    restart  a run that is interrupted and restarted agrees with the run that is not, and has its warnings
    no_restart  a restart must be refused with every --says, because of --second-set or --damage
    steps    the run takes --steps steps, whose numbers are finite, and is then interrupted
    stop     the run must end on its way, with exit status 2 and every --says
    error    a deck which must be refused with given sentences and the place of the mistake, before
             anything is computed

An expectation is `PATH OP VALUE [within TOLERANCE]`: PATH is a name of contrib/measures.py
(`errors/pore_pressure/final`, `maximum/inlet_pressure`); OP is one of
< <= > >= ==, or = which needs the relative TOLERANCE;
VALUE is a number or another path. A list stands for its length (`warnings == 0`), and what is
missing, null or not finite fails.
"""
import argparse
import bisect
import glob
import math
import operator
import os
import re
import shutil
import signal
import subprocess
import sys
import threading
import time

HERE = os.path.dirname(os.path.abspath(__file__))
sys.path[:0] = [os.path.join(HERE, "..", "contrib"), os.path.join(HERE, "loaded_once")]
from loaded_once import Program  # noqa: E402
from measures import with_measures  # noqa: E402
from results import ResultError, lookup, read_statistics, read_summary  # noqa: E402

MPIRUN = "mpirun --allow-run-as-root --oversubscribe -np"

# Columns and finals that differ between equal computations.
NOT_PHYSICS = re.compile(
    r"wall|second|iteration|memory|relative_error|residual|time_left|fluid_volume_defect")

OPERATORS = {"<": operator.lt, "<=": operator.le, ">": operator.gt, ">=": operator.ge,
             "==": operator.eq}


class Failure(Exception):
    """The test failed; the message says why."""


# ---------------------------------------------------------------------------------- expectations

class Expectation:
    """One line of what must hold in summary.json."""

    def __init__(self, text):
        self.text = text
        match = re.fullmatch(
            r"\s*([^\s<>=]+)\s*(<=|>=|==|<|>|=)\s*(\S+)(?:\s+within\s+(\S+))?\s*", text)
        if not match:
            raise Failure(f"'{text}' is not of the form PATH OP VALUE [within TOLERANCE]")
        self.path, self.operator, self.value, self.within = match.groups()
        if (self.operator == "=") != (self.within is not None):
            raise Failure(f"'{text}': '=' and 'within' belong together")

    def tolerance(self):
        """The relative tolerance of an upper bound on an error, or None if this is none."""
        if self.path.startswith("errors/") and self.operator in ("<", "<="):
            return float(self.value)
        return None

    def check(self, summary):
        """(holds, what was found)."""
        try:
            found = _measure(lookup(summary, self.path))
            try:
                wanted = float(self.value)
            except ValueError:
                wanted = _measure(lookup(summary, self.value))
        except (KeyError, TypeError) as error:
            return False, str(error).strip('"')
        if not (math.isfinite(found) and math.isfinite(wanted)):
            return False, f"{self.path} is {found}"
        if self.operator == "=":
            holds = abs(found - wanted) <= float(self.within) * abs(wanted)
        else:
            holds = OPERATORS[self.operator](found, wanted)
        return holds, f"{self.path} is {found:.6g}"


def _measure(entry):
    """A number for any entry that has one; TypeError for the others."""
    if isinstance(entry, (list, dict)):
        return len(entry)
    if entry is None or isinstance(entry, str):
        raise TypeError(f"{entry!r} is not a number")
    return float(entry)


def check_all(expectations, summary):
    """The expectations which do not hold, each with what was found instead."""
    failed = []
    for expectation in expectations:
        holds, found = expectation.check(summary)
        print(f"  {'holds' if holds else 'FAILS'}: {expectation.text}   ({found})")
        if not holds:
            failed.append(f"{expectation.text}: {found}")
    return failed


# ------------------------------------------------------------------------------------------ runs

class Runner:
    """Starts the program in a scratch directory which is empty at the beginning."""

    def __init__(self, options):
        self.program = os.path.abspath(options.program)
        self.loaded = Program(options.program, options.loaded_once) if options.loaded_once else None
        self.scratch = os.path.abspath(options.scratch)
        self.mpirun = options.mpirun.split()
        self.timeout = options.timeout
        shutil.rmtree(self.scratch, ignore_errors=True)
        os.makedirs(self.scratch)

    def output(self, name):
        return os.path.join(self.scratch, name)

    def command(self, name, deck, settings=(), ranks=1, extra=()):
        command = [self.program, os.path.abspath(deck), "--output", self.output(name), *extra]
        for setting in settings:
            command += ["--set", setting]
        return ([*self.mpirun, str(ranks)] if ranks > 1 else []) + command

    def start(self, name, command):
        print("$ " + " ".join(f"'{a}'" if " " in a or "=" in a else a for a in command), flush=True)
        environment = dict(os.environ, OMP_NUM_THREADS="1", OPENBLAS_NUM_THREADS="1",
                           DEAL_II_NUM_THREADS="1", OMPI_MCA_btl_vader_single_copy_mechanism="none",
                           OMPI_MCA_pml="ob1")
        with open(self.output(name + ".stdout"), "w") as out, \
                open(self.output(name + ".stderr"), "w") as err:
            if self.loaded and command[0] == self.program:
                return self.loaded.start(command[1:], out, err, self.scratch, environment)
            return subprocess.Popen(command, stdout=out, stderr=err, cwd=self.scratch,
                                    env=environment)

    def wait(self, process, command):
        try:
            return process.wait(self.timeout)
        except subprocess.TimeoutExpired:
            process.kill()
            process.wait()
            raise Failure(f"not finished after {self.timeout} s: {' '.join(command)}") from None

    def text(self, name, stream):
        with open(self.output(f"{name}.{stream}"), encoding="utf-8", errors="replace") as file:
            return file.read()

    def run(self, name, *args, **kwargs):
        """Run to the end, which must be reached; the summary."""
        command = self.command(name, *args, **kwargs)
        started = time.time()
        status = self.wait(self.start(name, command), command)
        if status != 0:
            raise Failure(f"exit status {status}\n{self.tail(name)}")
        try:
            summary = read_summary(self.output(name))
        except (OSError, ValueError) as error:
            raise Failure(f"exit status 0, but no readable summary.json: {error}") from None
        print(f"  {name}: {time.time() - started:.1f} s, {summary.get('steps')} steps, "
              f"{summary.get('unknowns')} unknowns")
        return summary

    def tail(self, name, lines=25):
        return "\n".join(
            f"--- {stream}\n" + "\n".join(self.text(name, stream).splitlines()[-lines:])
            for stream in ("stdout", "stderr"))


# ----------------------------------------------------------------------------------------- modes

def run_case(runner, options):
    expectations = [Expectation(text) for text in options.expect]
    bounds = [e for e in expectations if e.tolerance() is not None]
    if options.negative and not bounds:
        raise Failure("--negative needs an expectation like errors/QUANTITY/final < TOLERANCE")
    settings = list(options.set)
    if options.negative:
        factors = sorted({f for e in bounds for f in wrong_factors(e)})
        settings.append("Verification/Wrong factors=" + ",".join(map(repr, factors)))
    summary = runner.run("run", options.deck, settings, options.ranks)
    summary = with_measures(runner.output("run"), summary, [name for e in expectations for name in (e.path, e.value)])
    failed = check_all(expectations, summary)
    failed += [f"no warning says '{text}', but {summary['warnings']}" for text in options.warns
               if not any(text in warning for warning in summary["warnings"])]
    if options.negative:
        failed += [f"holds against a reference that is off by twice the bound as well: {e.text}"
                   for e in bounds if not can_fail(e, summary)]
    if failed:
        raise Failure("\n".join(failed))


def wrong_factors(bound):
    """Of references that are off by twice the bound. Those of opposite sign would do as well where
    it is not small, and a reference of zero is none."""
    shift = 2 * bound.tolerance()
    return [1 + shift] + ([1 - shift] if shift < 0.99 else [])


def can_fail(bound, summary):
    """A comparison that cannot fail proves nothing: with the reference off by twice the bound it must
    be violated. A result on one side of the reference may by chance be as close to the wrong
    reference on that side, hence the other side."""
    against = {float(factor): errors
               for factor, errors in summary.get("errors_against", {}).items()}
    for factor in wrong_factors(bound):
        if factor not in against:
            raise Failure(f"summary.json has no errors_against/{factor!r}")
        if not bound.check({**summary, "errors": against[factor]})[0]:
            return True
    return False


def run_order(runner, options):
    """Errors e(h) of successive runs, each finer by --ratio: order = log(e1/e2) / log(ratio)."""
    summaries = [runner.run(f"run{i}", options.deck, [*options.set, *setting.split(",")],
                            options.ranks)
                 for i, setting in enumerate(options.series)]
    failed = []
    for text in options.order:
        path, wanted = text.split("=")
        errors = [_measure(lookup(summary, path)) for summary in summaries]
        orders = [math.log(a / b) / math.log(options.ratio) if a > 0 and b > 0 else math.nan
                  for a, b in zip(errors, errors[1:])]
        print(f"  {path}: errors {' '.join(f'{e:.3e}' for e in errors)}"
              f"  orders {' '.join(f'{o:.2f}' for o in orders)}  expected {wanted}")
        if not orders[-1] >= float(wanted) - options.tolerance:
            failed.append(f"{path}: order {orders[-1]:.2f}, expected {wanted}")
    if failed:
        raise Failure("\n".join(failed))


def differences(first, second, tolerance, ignore=None):
    """Where two output directories differ by more than `tolerance`, relative to the greatest value
    in a column (a single value: to itself)."""
    def skip(name):
        return NOT_PHYSICS.search(name) or (ignore and re.search(ignore, name))

    found = []
    one, two = read_summary(first)["final"], read_summary(second)["final"]
    table_one, table_two = read_statistics(first), read_statistics(second)
    pairs = {f"final/{k}": ([one.get(k)], [two.get(k)]) for k in {**one, **two} if not skip(k)}
    pairs.update({f"column {k}": (table_one.get(k, []), table_two.get(k, []))
                  for k in {**table_one, **table_two} if not skip(k)})
    compared, greatest = 0, 0.
    for name, (a, b) in sorted(pairs.items()):
        if len(a) != len(b):
            found.append(f"{name}: {len(a)} against {len(b)} values")
            continue
        numbers = [(x, y) for x, y in zip(a, b)
                   if isinstance(x, (int, float)) and isinstance(y, (int, float))]
        if len(numbers) < len(a) and a != b:
            found.append(f"{name}: {a[-1]} against {b[-1]}")
        if not all(math.isfinite(x) and math.isfinite(y) for x, y in numbers):
            found.append(f"{name}: not finite")
            continue
        scale = max((abs(x) for x, _ in numbers), default=0.)
        worst = max((abs(x - y) for x, y in numbers), default=0.)
        compared += len(numbers)
        if scale > 0:
            greatest = max(greatest, worst / scale)
        if not worst <= tolerance * scale:
            found.append(f"{name}: differ by {worst:.3e}, {worst / scale if scale else math.inf:.1e}"
                         f" of the greatest value")
    if not compared:
        found.append("nothing to compare")
    print(f"  {compared} values compared, greatest difference {greatest:.1e}")
    return found


def between(time, table, name):
    """A column at a time between two steps."""
    times, values = table["time"], table[name]
    after = min(max(bisect.bisect_left(times, time), 1), len(times) - 1)
    share = (time - times[after - 1]) / (times[after] - times[after - 1])
    return values[after - 1] + min(max(share, 0.), 1.) * (values[after] - values[after - 1])


def apart_in_time(first, second, columns, tolerance):
    """Where columns differ by more than `tolerance`, relative to the greatest value, at any time of the first table."""
    one, two = read_statistics(first), read_statistics(second)
    found = []
    for name in columns:
        scale = max(abs(x) for x in one[name])
        worst, time = max((abs(x - between(time, two, name)), time) for time, x in zip(one["time"], one[name]))
        print(f"  {name}: at {time:.6g} s they are {worst:.3e} apart, {worst / scale if scale else 0.:.1e} of the greatest value")
        if not worst <= tolerance * scale:
            found.append(f"{name}: at {time:.6g} s {worst:.3e} apart, {worst / scale if scale else math.inf:.1e} of the "
                         "greatest value")
    return found


def run_same(runner, options):
    first, second = options.ranks_pair
    runner.run("first", options.deck, options.set, first)
    runner.run("second", options.deck, [*options.set, *options.second_set], second)
    if options.in_time:
        found = apart_in_time(runner.output("first"), runner.output("second"), options.in_time, options.tolerance)
        if found:
            raise Failure("\n".join(found))
    else:
        _require_same(runner, "first", "second", options)


def _require_same(runner, first, second, options):
    found = differences(runner.output(first), runner.output(second), options.tolerance,
                        options.ignore)
    if found:
        raise Failure("\n".join(found[:20]))


def run_restart(runner, options):
    runner.run("straight", options.deck, options.set, options.ranks_pair[0])
    # On a loaded machine the signal may come after the end of a short run.
    in_time = any(_interrupt(runner, options) for _ in range(5 if options.interrupt_after else 1))
    if not in_time:
        raise Failure("the run reached its end before it was interrupted")
    runner.run("restarted", options.deck, [*options.set, *options.restart_set], options.ranks_pair[1],
               extra=["--restart"])
    _require_same(runner, "straight", "restarted", options)
    straight, restarted = (read_summary(runner.output(name))["warnings"] for name in ("straight", "restarted"))
    lost = [warning for warning in straight if warning not in restarted]
    if lost:
        raise Failure("the restarted run does not know the warning: " + lost[0])


def _interrupt(runner, options):
    """The first part of the run; true if it stopped before the end of the straight one."""
    command = runner.command("restarted", options.deck, [*options.set, *options.interrupt_set],
                             options.ranks_pair[0])
    # The table of an attempt before would be taken for that of this one.
    shutil.rmtree(runner.output("restarted"), ignore_errors=True)
    process = runner.start("restarted", command)
    if options.interrupt_after:
        _terminate_after(runner, process, "restarted", options.interrupt_after, options.ranks_pair[0])
    status = runner.wait(process, command)
    steps = _steps_of(runner, "restarted")
    print(f"  interrupted: exit status {status}, {steps} steps")
    return steps < _steps_of(runner, "straight")


def _steps_of(runner, name):
    """Rows of the statistics so far."""
    try:
        return len(next(iter(read_statistics(runner.output(name)).values())))
    except (OSError, ResultError):
        return 0


def _processes_of(program, launcher):
    """Ids of the processes that run the program, the launcher itself or started by it."""
    table = subprocess.run(["ps", "-A", "-o", "pid=,ppid=,comm="], capture_output=True, text=True,
                           check=True).stdout
    rows = [line.split(None, 2) for line in table.splitlines()]
    parents = {int(pid): int(parent) for pid, parent, _ in rows}

    def descends(pid):
        while pid in parents and pid != launcher:
            pid = parents[pid]
        return pid == launcher

    name = os.path.basename(program)[:15]
    return [int(pid) for pid, _, command in rows if command == name and descends(int(pid))]


def _terminate_after(runner, process, name, steps, ranks):
    """SIGTERM once the statistics hold `steps` rows."""
    rank = process.pid if ranks == 1 else None
    while process.poll() is None:
        if rank is None and _steps_of(runner, name) > 0:
            # To one rank, not to mpirun, which would end all of them at once. Found early, for that takes as long as
            # some steps of a short run.
            rank = next(iter(_processes_of(runner.program, process.pid)), None)
        if rank is not None:
            try:
                # The run waits while its table is read.
                os.kill(rank, signal.SIGSTOP)
                done = _steps_of(runner, name) >= steps
                if done:
                    os.kill(rank, signal.SIGTERM)
                os.kill(rank, signal.SIGCONT)
            except ProcessLookupError:  # it has ended
                return
            if done:
                return
        time.sleep(0.01)


def run_no_restart(runner, options):
    """One byte in the middle of each file of the checkpoint that matches --damage is changed."""
    runner.run("run", options.deck, [*options.set, "Checkpoint/Steps between=1"], options.ranks)
    if options.damage:
        files = glob.glob(os.path.join(runner.output("run"), "checkpoint", options.damage))
        if not files:
            raise Failure(f"the checkpoint has no file like '{options.damage}'")
        for name in files:
            with open(name, "r+b") as file:
                file.seek(os.path.getsize(name) // 2)
                byte = file.read(1)[0]
                file.seek(-1, os.SEEK_CUR)
                file.write(bytes([byte ^ 1]))
    def results():
        with open(os.path.join(runner.output("run"), "statistics.csv"), encoding="utf-8") as file:
            return file.read()

    before = results()
    command = runner.command("run", options.deck, [*options.set, *options.second_set],
                             options.ranks, ["--restart"])
    status = runner.wait(runner.start("run", command), command)
    said = " ".join(runner.text("run", "stderr").split())
    if status != 1:
        raise Failure(f"exit status {status}, should be 1\n{runner.tail('run')}")
    for sentence in options.says:
        if sentence not in said:
            raise Failure(f"stderr does not say\n  {sentence}\nbut\n{runner.tail('run')}")
    if results() != before:
        raise Failure("the refused restart has changed the results of the run")
    print(f"  restart refused: {said}")


def run_steps(runner, options):
    """A run that is at its end before that many steps is as good."""
    command = runner.command("run", options.deck, options.set, options.ranks)
    started = time.time()
    process = runner.start("run", command)
    deadline = threading.Timer(runner.timeout, process.kill)
    deadline.start()
    _terminate_after(runner, process, "run", options.steps, options.ranks)
    status = runner.wait(process, command)
    deadline.cancel()
    print(f"  run: {time.time() - started:.1f} s, exit status {status}")
    if status != 0 and not (status == 2 and "by a signal" in runner.text("run", "stderr")):
        raise Failure(f"exit status {status}\n{runner.tail('run')}")
    table = read_statistics(runner.output("run"))
    rows = len(table["step"])
    if status != 0 and rows < options.steps:
        raise Failure(f"{rows} steps, should be {options.steps}")
    wrong = [name for name, column in table.items()
             if any(isinstance(x, float) and not math.isfinite(x) for x in column)]
    if not rows or wrong:
        raise Failure(f"{rows} steps; not finite: {', '.join(wrong)}")


def run_stop(runner, options):
    command = runner.command("run", options.deck, options.set, options.ranks)
    status = runner.wait(runner.start("run", command), command)
    if status != 2:
        raise Failure(f"exit status {status}, should be 2\n{runner.tail('run')}")
    said = " ".join((runner.text("run", "stdout") + runner.text("run", "stderr")).split())
    for sentence in options.says:
        if sentence not in said:
            raise Failure(f"it does not say\n  {sentence}\nbut\n{runner.tail('run')}")
    print(f"  ended with {len(options.says)} expected sentence(s)")


def run_error(runner, options):
    """NAME.message holds one sentence per line; all must be on stderr, in any line breaks."""
    with open(os.path.splitext(options.deck)[0] + ".message", encoding="utf-8") as file:
        sentences = [line.strip() for line in file if line.strip()]
    if not sentences:
        raise Failure("the .message file is empty")
    ways = [("check", ["--check"]), ("run", [])]
    if options.no_directory:
        ways = [("run", [])]
        with open(runner.output("run"), "w", encoding="utf-8"):
            pass
    for name, extra in ways:
        command = runner.command(name, options.deck, options.set, options.ranks, extra)
        status = runner.wait(runner.start(name, command), command)
        said = " ".join(runner.text(name, "stderr").split())
        if status != 1:
            raise Failure(f"exit status {status}, should be 1\n{runner.tail(name)}")
        for sentence in sentences:
            if " ".join(sentence.split()) not in said:
                raise Failure(f"stderr does not say\n  {sentence}\nbut\n{runner.tail(name)}")
        if not re.search(r"(\.prm:\d+|command line): ", said):
            raise Failure(f"the message does not say where the mistake was read:\n{said}")
        if os.path.isdir(runner.output(name)):
            raise Failure("a refused deck left an output directory behind")
    print(f"  refused with {len(sentences)} expected sentence(s)")


MODES = {"case": run_case, "order": run_order, "same": run_same, "restart": run_restart,
         "no_restart": run_no_restart, "steps": run_steps, "stop": run_stop, "error": run_error}


def parse(arguments):
    parser = argparse.ArgumentParser(description=__doc__,
                                     formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--program", required=True, help="the stockwork executable")
    parser.add_argument("--scratch", required=True, help="directory of this test; emptied first")
    parser.add_argument("--loaded-once", metavar="LIBRARY", help="of tests/loaded_once: runs on one rank start sooner")
    parser.add_argument("--mpirun", default=MPIRUN, help="how to start several ranks")
    parser.add_argument("--timeout", type=float, default=1500., help="seconds per run")
    parser.add_argument("mode", choices=MODES)
    parser.add_argument("--deck", required=True)
    parser.add_argument("--set", action="append", default=[], metavar="SECTION/ENTRY=VALUE")
    parser.add_argument("--ranks", default="1", help="N, or FIRST,SECOND where two runs compare")
    parser.add_argument("--expect", action="append", default=[])
    parser.add_argument("--no-directory", action="store_true",
                        help="error: a file is where the output directory should be")
    parser.add_argument("--warns", action="append", default=[],
                        help="case: part of one of the run's warnings")
    parser.add_argument("--negative", action="store_true")
    parser.add_argument("--series", action="append", default=[], metavar="SETTING[,SETTING]")
    parser.add_argument("--order", action="append", default=[], metavar="PATH=ORDER")
    parser.add_argument("--ratio", type=float, default=2.)
    parser.add_argument("--tolerance", type=float, default=None)
    parser.add_argument("--in-time", action="append", default=[], metavar="COLUMN", help="same: compare this in time")
    parser.add_argument("--ignore", help="regular expression of columns not to compare")
    parser.add_argument("--second-set", action="append", default=[])
    parser.add_argument("--damage", metavar="PATTERN", help="files of the checkpoint")
    parser.add_argument("--says", action="append", default=[], help="part of the message")
    parser.add_argument("--steps", type=int, default=2, help="steps: so many")
    parser.add_argument("--interrupt-set", action="append", default=[],
                        help="setting that ends the first part early")
    parser.add_argument("--restart-set", action="append", default=[], help="setting of the second part")
    parser.add_argument("--interrupt-after", type=int, default=0, metavar="STEPS",
                        help="send SIGTERM after so many steps instead")
    options = parser.parse_args(arguments)
    ranks = [int(n) for n in options.ranks.split(",")]
    options.ranks, options.ranks_pair = ranks[0], (ranks[0], ranks[-1])
    if options.tolerance is None:
        options.tolerance = 0.2 if options.mode == "order" else 1e-8
    return options


def main(arguments=None):
    options = parse(arguments)
    try:
        MODES[options.mode](Runner(options), options)
    except Failure as failure:
        print(f"FAILED: {failure}")
        return 1
    print("passed")
    return 0


if __name__ == "__main__":
    sys.exit(main())
