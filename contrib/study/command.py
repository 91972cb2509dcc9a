"""The command line of stockwork-study."""
import argparse
import os
import signal
import sys

from arguments import program, PROGRAM, whole_from
from results import ResultError, script

ABOUT = """Run decks over models, resolutions and settings, and report what accuracy costs.

  stockwork-study run STUDY          run what has not run yet (a file, or the name of a study that ships)
  stockwork-study report DIR...      one page of the runs in and below directories
  stockwork-study compare CASE       all models that have a deck for a case, at the deck's resolution
"""


def run(options):
    from study.study_file import find, read
    study = read(find(options.study))
    for block in study.blocks if options.resolutions else []:
        block.resolutions = [r for r in block.resolutions if r in options.resolutions]
    study.blocks = [block for block in study.blocks if block.resolutions]
    if not study.blocks:
        raise ResultError(f"the study has no runs at the resolutions {', '.join(options.resolutions)}")
    return run_study(options, study)


def compare(options):
    from study.study_file import Block, Study
    settings = {}
    for text in options.set:
        entry, equals, value = text.partition("=")
        if not equals:
            raise ResultError(f"--set '{text}' is not Section/Entry=value")
        settings[entry.strip()] = [value.strip()]
    block = Block([options.case], options.models or [], options.resolutions or [""], [1], settings)
    name = os.path.splitext(os.path.basename(options.case.rstrip("/")))[0]
    return run_study(options, Study(f"compare/{name}", [block], f"{options.case}: all models", folder=os.getcwd()))


def run_study(options, study):
    from study.campaign import run_jobs
    from study.matrix import jobs
    from study.place import held
    from study.record import write_about
    output = os.path.abspath(options.output or os.path.join("studies", study.name))
    planned = jobs(study)
    check_quantities(study, planned, output)
    if options.estimate:
        run_jobs(planned, options, output)
        return 0
    title = study.title or study.name
    with held(output):
        records = run_jobs(planned, options, output, lambda: write_about(output, {
            "title": title, "text": study.text, "quantities": study.quantities, "map": study.map,
            "runs": [{"name": job.name, **job.about()} for job in planned]}))
        show([os.path.join(output, job.name) for job in planned], os.path.join(output, "report"), title, study.text,
             study.quantities, study.map, options)
    return 1 if any(record["status"] == "failed" for record in records) else 0


def check_quantities(study, planned, output):
    """Refuse those of which it is known that no run will have them: each model has finished a run of each case, and none has
    them."""
    from study.collect import results
    from study.difference import QUANTITIES
    from study.record import read
    from study.verdict import missing, table

    def kind(job):
        return job.case, job.model, *(value for entry, value in job.set if entry in ("Fracture/Model", "Verification/Reference"))
    possible = [job for job in planned if job.deck]
    ended = [job for job in possible if (read(os.path.join(output, job.name)) or {}).get("status") == "finished"]
    if study.quantities and ended and {kind(job) for job in ended} == {kind(job) for job in possible}:
        rows = table(results([os.path.join(output, job.name) for job in ended]), study.quantities)
        wanted = [name for name in study.quantities if not rows["differs"].any() or name not in QUANTITIES]
        text = missing(rows, wanted)
        if text:
            raise ResultError(text)


def report(options):
    from study.record import about
    first = options.directories[0]
    study = about(first) if len(options.directories) == 1 else {}
    show(options.directories, options.output or os.path.join(first, "report"),
         options.title or study.get("title") or os.path.basename(os.path.abspath(first)), study.get("text", ""),
         options.quantities or study.get("quantities", []), study.get("map", {}), options)
    return 0


def show(directories, folder, title, text, quantities, chosen, options):
    """The page and, on the terminal, the table; chosen: what the map shows."""
    from study import markdown, verdict
    from study import report as pages
    from study.collect import results
    if options.map and not chosen:
        raise ResultError(f"--map {options.map}: there is no map; a study's [map] says what it shows (doc/studies/README.md)")
    found = results(directories)
    path, rows = pages.write(found, folder, title, text, quantities, chosen, options.map)
    if options.into:
        markdown.write(found, rows, options.into.removesuffix(".md"), title, text, quantities)
    print(verdict.by_case(rows, quantities, verdict.plain) + "\n\n" + path)
    text = verdict.missing(rows, quantities)
    if text:
        raise ResultError(text)


def main():
    parser = argparse.ArgumentParser(prog="stockwork-study", description=ABOUT,
                                     formatter_class=argparse.RawDescriptionHelpFormatter)
    commands = parser.add_subparsers(dest="command", required=True)
    for name, call in (("run", run), ("compare", compare)):
        sub = commands.add_parser(name)
        sub.set_defaults(call=call)
        sub.add_argument("study" if name == "run" else "case")
        sub.add_argument("--program", type=program, default=PROGRAM)
        sub.add_argument("--output", metavar="DIR", help="where runs and report go; otherwise studies/NAME")
        sub.add_argument("--cores", type=whole_from(1), default=len(os.sched_getaffinity(0)),
                         help="how many runs at once, each on its own; 1 for times that memory shared with others "
                         "does not touch")
        sub.add_argument("--again", choices=("failed", "all"), help="run these once more")
        sub.add_argument("--estimate", action="store_true", help="say how long it will take, and run nothing")
        sub.add_argument("--resolutions", nargs="+", help="only these" if name == "run" else "otherwise the deck's")
        if name == "compare":
            sub.add_argument("--models", nargs="+")
            sub.add_argument("--set", action="append", default=[], metavar="Section/Entry=value")
    sub = commands.add_parser("report")
    sub.set_defaults(call=report)
    sub.add_argument("directories", nargs="+")
    sub.add_argument("--output", metavar="DIR", help="otherwise DIRECTORY/report")
    sub.add_argument("--title")
    sub.add_argument("--quantities", nargs="+")
    for sub in commands.choices.values():
        sub.add_argument("--into", metavar="FILE", help="a page of Markdown as well, and its picture: FILE.md, FILE.png; "
                         "what its author has written above the runs is kept")
        sub.add_argument("--map", metavar="FILE", help="the study's map as a picture as well: FILE.png")
    options = parser.parse_args()

    def interrupted(*_):
        raise KeyboardInterrupt
    signal.signal(signal.SIGTERM, interrupted)
    try:
        script(lambda: options.call(options))
    except KeyboardInterrupt:
        print("\nstopped; the same command goes on with what is left", file=sys.stderr)
        sys.exit(130)
