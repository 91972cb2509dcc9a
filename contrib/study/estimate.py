"""How long runs will take: the program's own estimate (--check), corrected by how wrong it was so far."""
import hashlib
import re
import statistics
import subprocess

SECONDS = {"s": 1., "min": 60., "h": 3600., "days": 86400.}


def check(program, job, record):
    """{"audit": what --check prints, "fingerprint": of the deck as the program reads it, "seconds": or None}. The
    record of an earlier run saves asking, if the deck is still the same."""
    if not job.deck:
        return {"audit": "", "fingerprint": "no deck", "seconds": 0.}
    deck = said(program, job, "--print-parameters", "prm")
    fingerprint = hashlib.sha256(deck.encode()).hexdigest()
    if record and record["fingerprint"] == fingerprint:
        return {"audit": record["audit"], "fingerprint": fingerprint, "seconds": record["estimate"]}
    audit = said(program, job, "--check")
    found = re.search(r"would take (\S+) (s|min|h|days) on one core", audit)
    return {"audit": audit, "fingerprint": fingerprint,
            "seconds": float(found[1]) * SECONDS[found[2]] if found else None}


def said(program, job, *asked):
    command = [program, job.deck, *asked]
    for setting in job.settings():
        command += ["--set", setting]
    return subprocess.run(command, stdout=subprocess.PIPE, stderr=subprocess.STDOUT, stdin=subprocess.DEVNULL,
                          check=False, text=True, errors="replace").stdout


def guess(job, checked, records):
    """(seconds, from what) of a run; records are those of runs that have finished. Nothing known: (None, "")."""
    for record in records:
        if record["fingerprint"] == checked["fingerprint"] and record["ranks"] == job.ranks:
            return record["wall_seconds"], "an earlier run"
    if checked["seconds"] is None:
        return None, ""
    known = [r for r in records if r.get("estimate")]
    for alike in ("case", "model"), ("model",), ():  # steps grow by as much in the same scene; more or less
        ratios = [r["wall_seconds"] * r["ranks"] / r["estimate"] for r in known
                  if all(r[key] == getattr(job, key) for key in alike)]
        if ratios:
            return statistics.median(ratios) * checked["seconds"] / job.ranks, "earlier runs like it"
    return checked["seconds"] / job.ranks, "--check, at most"


def in_time(seconds):
    for unit, size in (("h", 3600.), ("min", 60.)):
        if seconds >= 1.5 * size:
            return f"{seconds / size:.2g} {unit}"
    return f"{seconds:.2g} s"
