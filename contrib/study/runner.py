"""Run what a study has not run yet, each on cores of its own, and record how each run ended."""
import concurrent.futures
import datetime
import math
import os
import shlex
import shutil
import signal
import subprocess
import threading
import time

import study.record
from results import read_summary
from study.cores import busy_seconds

MPIRUN = "mpirun --allow-run-as-root --oversubscribe --bind-to none -np"
THREADS = dict(OMP_NUM_THREADS="1", OPENBLAS_NUM_THREADS="1", DEAL_II_NUM_THREADS="1")

BELOW = "    "    # what begins a line that belongs to the one above


class Runner:
    def __init__(self, program, output, cores, progress):
        self.program, self.output, self.cores, self.progress = program, output, cores, progress
        self.children, self.lock, self.stopped = set(), threading.Lock(), False

    def command(self, job):
        command = MPIRUN.split() + [str(job.ranks)] if job.ranks > 1 else []
        command += [self.program, job.deck, "--output", os.path.join(self.output, job.name)]
        for setting in job.settings():
            command += ["--set", setting]
        return command

    def run_all(self, jobs, checks):
        """Records of the runs, in their order. An interrupt ends what runs, and leaves no record of it."""
        with concurrent.futures.ThreadPoolExecutor(max(1, len(self.cores.all))) as pool:
            futures = [pool.submit(self.run, job, checks[job.name]) for job in jobs]
            try:
                return [future.result() for future in futures]
            except BaseException:
                self.stop()
                for future in futures:
                    future.cancel()
                raise

    def stop(self):
        with self.lock:
            self.stopped = True
            for child in self.children:
                os.killpg(child.pid, signal.SIGTERM)

    def run(self, job, checked):
        directory = os.path.join(self.output, job.name)
        record = {**job.about(),
                  "date": datetime.datetime.now(datetime.timezone.utc).isoformat(timespec="seconds"),
                  "estimate": checked["seconds"], "fingerprint": checked["fingerprint"], "audit": checked["audit"],
                  "refused": checked["refused"]}
        if os.path.isdir(directory):  # what an earlier run has left must not be taken for that of this one
            shutil.rmtree(directory)
        os.makedirs(directory)
        if not job.deck:
            record.update(status="failed", reason=f"The case has no deck for {job.model}.")
        elif job.ranks > len(self.cores.all):
            record.update(status="failed", not_tried=True,
                          reason=f"{job.ranks} ranks need as many cores; {len(self.cores.all)} were given (--cores).")
        else:
            taken = self.cores.take(job.ranks)
            try:
                self.progress.started(job.name)
                self.measure(job, directory, record, taken)
            finally:
                self.cores.give_back(taken)
            study.record.write(directory, record)
            self.progress.ended(job.name, record["status"], record["wall_seconds"], record["reason"])
            return record
        study.record.write(directory, record)
        self.progress.started(job.name)
        self.progress.ended(job.name, "failed", 0., record["reason"])
        return record

    def measure(self, job, directory, record, taken):
        command = self.command(job)
        record["command"] = shlex.join(command)
        busy, begin = busy_seconds(taken), time.monotonic()
        with open(os.path.join(directory, "log"), "w", encoding="utf-8") as log, self.lock:
            if self.stopped:
                raise InterruptedError("stopped")
            child = subprocess.Popen([*bounds(taken, job.time_limit), *command], stdout=log,
                                     stderr=subprocess.STDOUT, stdin=subprocess.DEVNULL, process_group=0,
                                     env=dict(os.environ, **THREADS))
            self.children.add(child)
        used = self.wait(child)
        wall = time.monotonic() - begin
        others = busy_seconds(taken) - busy - used.ru_utime - used.ru_stime
        if self.stopped:
            raise InterruptedError("stopped")
        record.update(wall_seconds=wall, cpu_seconds=used.ru_utime + used.ru_stime,
                      others_share=max(0., others / (wall * len(taken))), cores=taken, at_once=len(self.cores.all),
                      status="finished", reason="")
        if child.returncode != 0:
            late = job.time_limit and child.returncode in (-signal.SIGXCPU, 128 + signal.SIGXCPU)  # the latter of mpirun
            record.update(status="failed", reason=f"Ended by the time limit of the study, {job.time_limit:g} s."
                          if late else why(directory, child.returncode))

    def wait(self, child):
        """What the run and all that it has started have used."""
        _, status, used = os.wait4(child.pid, 0)
        with self.lock:
            self.children.discard(child)
        child.returncode = os.waitstatus_to_exitcode(status)
        return used


def bounds(cores, limit):
    """Keeps a command on its cores, and within its time: that of the processor, for a busy machine makes no run fail."""
    pinned = ["taskset", "-c", ",".join(map(str, cores))]
    soft = math.ceil(limit)  # where SIGXCPU is sent; five seconds later, what cannot be caught
    return [*pinned, "prlimit", f"--cpu={soft}:{soft + 5}"] if limit else pinned


def why(directory, status):
    """The reason of a failure in the program's own words."""
    if os.path.exists(os.path.join(directory, "summary.json")):
        summary = read_summary(directory)
        if summary.get("status") == "failed" and summary.get("reason"):
            return summary["reason"]
    with open(os.path.join(directory, "log"), encoding="utf-8", errors="replace") as log:
        text = said(log.read())
    return text or (f"Killed by signal {-status}, without a word." if status < 0 else
                    f"Exit status {status}, without a word.")


def said(text):
    """What the program has said last: its error, or the last line, with the line that it belongs to if it stands below one."""
    lines = [line.rstrip() for line in text.splitlines() if line.strip()]
    last = next((i for i in range(len(lines) - 1, 0, -1) if not lines[i].startswith(BELOW)), 0)
    first = next((i for i, line in enumerate(lines) if line.startswith("Error")), last)
    return " ".join(line.strip() for line in lines[first:][:6])
