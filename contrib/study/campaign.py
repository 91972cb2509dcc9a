"""What of a study is left to run, how long that will take, and running it."""
import concurrent.futures
import os
import sys

import study.record
from study.cores import Cores
from study.estimate import check, guess, in_time
from study.progress import Progress
from study.runner import Runner


def run_jobs(jobs, options, output):
    """Records of all jobs, in their order, also of those that had run before; None after --estimate."""
    cores = Cores(options.cores)
    os.makedirs(output, exist_ok=True)
    records = {job.name: study.record.read(os.path.join(output, job.name)) for job in jobs}
    with concurrent.futures.ThreadPoolExecutor(len(cores.all)) as pool:
        checks = dict(zip(records, pool.map(lambda job: check(options.program, job, records[job.name]), jobs)))
    changed = [name for name, record in records.items()
               if record and record["fingerprint"] != checks[name]["fingerprint"]]
    left = [job for job in jobs if job.name in changed or to_do(records[job.name], options.again)]
    announce(jobs, left, changed, checks, earlier(records), cores)
    if options.estimate:
        return None
    expected = {job.name: max(0.5, guess(job, checks[job.name], earlier(records))[0] or 60.) for job in left}
    runner = Runner(options.program, output, cores, Progress(expected, len(cores.all)))
    for job, record in zip(left, runner.run_all(left, checks)):
        records[job.name] = record
    return [records[job.name] for job in jobs]


def to_do(record, again):
    return (record is None or "not_tried" in record or again == "all"
            or again == "failed" and record["status"] == "failed")


def earlier(records):
    return [r for r in records.values() if r and r["status"] == "finished"]


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
