"""What of a study is left to run, how long that will take, and running it."""
import concurrent.futures
import os
import sys

import study.record
from results import ResultError
from study.cores import Cores
from study.estimate import check, guess, in_time
from study.place import folder
from study.progress import Progress
from study.runner import Runner

REASONS = 3    # that are told of runs which the program refuses


def run_jobs(jobs, options, output, begin=lambda: None):
    """Records of all jobs, in their order, also of those that had run before; None after --estimate. begin: what is called
    before the first run starts."""
    cores = Cores(options.cores)
    records = {job.name: study.record.read(os.path.join(output, job.name)) or moved(job, output, options.estimate)
               for job in jobs}
    with concurrent.futures.ThreadPoolExecutor(len(cores.all)) as pool:
        checks = dict(zip(records, pool.map(lambda job: check(options.program, job, records[job.name]), jobs)))
    changed = [name for name, record in records.items()
               if record and record["fingerprint"] != checks[name]["fingerprint"]]
    left = [job for job in jobs if job.name in changed or to_do(records[job.name], options.again)]
    refused = {job.name: checks[job.name]["refused"] for job in left if checks[job.name]["refused"]}
    if refused and (options.estimate or len(refused) == len(jobs)):
        raise ResultError(refusal(refused, len(jobs)))
    announce(jobs, left, changed, checks, earlier(records), cores)
    if options.estimate:
        return None
    begin()
    expected = {job.name: guess(job, checks[job.name], earlier(records))[0] or 60. for job in left}
    runner = Runner(options.program, output, cores, Progress(expected, len(cores.all)))
    for job, record in zip(left, runner.run_all(left, checks)):
        records[job.name] = record
    return [records[job.name] for job in jobs]


def moved(job, output, looks_only):
    """The record of a run that stands where the tool had put it before names were made safe; it is moved to its place."""
    old = os.path.join(output, job.old_name)
    if not job.old_name or job.old_name == job.name or not os.path.realpath(old).startswith(os.path.realpath(output) + os.sep):
        return None
    record = study.record.read(old)
    if record is None or record["settings"] != job.settings() or record["deck"] != job.deck:
        return None
    if not looks_only:
        folder(os.path.dirname(os.path.join(output, job.name)))
        os.rename(old, os.path.join(output, job.name))
    return record


def to_do(record, again):
    return (record is None or "not_tried" in record or again == "all"
            or again == "failed" and record["status"] == "failed")


def earlier(records):
    return [r for r in records.values() if r and r["status"] == "finished"]


def refusal(refused, number):
    """Why the program refuses runs, each reason once."""
    names = {}
    for name, reason in refused.items():
        names.setdefault(reason, []).append(name)
    text = f"the program refuses {f'all {number}' if len(refused) == number else f'{len(refused)} of {number}'} runs:"
    for reason, its in list(names.items())[:REASONS]:
        text += f"\n  {reason} ({its[0]}" + (f" and {len(its) - 1} more)" if len(its) > 1 else ")")
    return text + (f"\n  and for {len(names) - REASONS} reasons more" if len(names) > REASONS else "")


def announce(jobs, left, changed, checks, finished, cores):
    guesses = [guess(job, checks[job.name], finished) for job in left]
    known = [seconds for seconds, _ in guesses if seconds is not None]
    text = f"{len(jobs)} runs, {len(left)} of them to do"
    if changed:
        text += f" ({len(changed)} again, for the deck has changed)"
    if known:
        text += f": about {in_time(max(sum(known) / len(cores.all), max(known)))} on {len(cores.all)} core(s)"
        sources = [source for _, source in guesses if source]
        text += " (" + ", ".join(f"{sources.count(s)} by {s}" for s in dict.fromkeys(sources)) + ")"
    unknown = len(guesses) - len(known)
    print(text + (f"; of {unknown} the time is not known" if unknown else ""), file=sys.stderr, flush=True)
