"""How long runs will take: the program's own estimate (--check), corrected by how wrong it was so far."""
import re
import statistics
import subprocess

from study.fingerprint import fingerprint
from study.runner import said

SECONDS = {"ms": 1e-3, "s": 1., "min": 60., "h": 3600., "days": 86400.}
START = 0.5    # seconds until a program has loaded its libraries
AT_MOST = "if none were longer than the first"    # what the program says of steps whose growth it cannot tell


def check(program, job, record):
    """{"audit": what --check prints, "fingerprint", "seconds": or None, "refused": why the program will not run it, or
    nothing}. The record of an earlier run saves asking, if the deck is still the same."""
    mark = fingerprint(job)
    if not job.deck:
        return {"audit": "", "fingerprint": mark, "seconds": START, "refused": ""}
    if record and record["fingerprint"] == mark:
        return {"audit": record["audit"], "fingerprint": mark, "seconds": record["estimate"],
                "refused": record.get("refused", "")}
    command = [program, job.deck, "--check"]
    for setting in job.settings():
        command += ["--set", setting]
    done = subprocess.run(command, stdout=subprocess.PIPE, stderr=subprocess.STDOUT, stdin=subprocess.DEVNULL,
                          check=False, text=True, errors="replace")
    audit = done.stdout
    found = re.search(r"would take (\S+) (ms|s|min|h|days) on one core", audit)
    seconds = max(START, float(found[1]) * SECONDS[found[2]]) if found else None
    return {"audit": audit, "fingerprint": mark, "seconds": seconds,
            "refused": (said(audit) or f"exit status {done.returncode}, without a word") if done.returncode else ""}


def guess(job, checked, records):
    """(seconds, from what) of a run; records are those of runs that have finished. Nothing known: (None, "")."""
    for record in records:
        if record["fingerprint"] == checked["fingerprint"]:
            return record["wall_seconds"], "an earlier run"
    if checked["seconds"] is None:
        return None, ""
    known = [r for r in records if r.get("estimate")]
    for alike in ("case", "model"), ("model",), ():  # steps grow by as much in the same scene; more or less
        ratios = [r["wall_seconds"] * r["ranks"] / r["estimate"] for r in known
                  if all(r[key] == getattr(job, key) for key in alike)]
        if ratios:
            return statistics.median(ratios) * checked["seconds"] / job.ranks, "earlier runs like it"
    return checked["seconds"] / job.ranks, "--check, at most" if AT_MOST in checked["audit"] else "--check"


def in_time(seconds):
    for unit, size in (("h", 3600.), ("min", 60.)):
        if seconds >= 1.5 * size:
            return f"{seconds / size:.2g} {unit}"
    return f"{seconds:.2g} s"
