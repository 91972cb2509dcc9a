"""What runs have left behind: of a study, or in any directories."""
import dataclasses
import functools
import os
import re

import study.record
from results import ResultError, read_deck, read_summary
from study.matrix import describe


RESOLUTIONS = ("coarse", "medium", "fine")
NOT_RUN = "not run"


@dataclasses.dataclass
class Result:
    """A run that has ended, one way or the other, or that a study has yet to make."""
    directory: str
    case: str
    model: str
    resolution: str      # that was taken
    ranks: int
    status: str          # finished, failed or NOT_RUN
    reason: str
    summary: dict        # of the program; empty if it wrote none
    record: dict         # of the study tool; empty if it did not start the run
    deck: dict           # Section/Entry: value, everything spelt out
    variant: str = ""    # what tells it from others of the case and the model

    @functools.cached_property
    def settings(self):
        """{entry: value} of the study, the resolution among them."""
        return dict(text.split("=", 1) for text in self.record.get("settings", []))

    @property
    def asked(self):
        """The resolution, as it was asked for and, where this was another, as it was taken."""
        asked = self.settings.get("Resolution", self.resolution)
        return asked if asked == self.resolution or not self.resolution else f"{asked}: {self.resolution}"

    @property
    def curve(self):
        """What is joined by a line through its resolutions."""
        return ", ".join(filter(None, (self.model, self.variant, f"{self.ranks} ranks" if self.ranks > 1 else "")))

    @property
    def label(self):
        return ", ".join(filter(None, (self.curve, self.asked)))

    def log(self):
        path = os.path.join(self.directory, "log")
        if not os.path.exists(path):
            return ""
        with open(path, encoding="utf-8", errors="replace") as file:
            return file.read()


def below(directories):
    """The directories in and below those given in which a run has ended; at least one each."""
    found = []
    for top in directories:
        if not os.path.isdir(top):
            raise ResultError(f"there is no directory '{top}'")
        here = [path for path, folders, files in sorted(os.walk(top)) if study.record.NAME in files
                or "summary.json" in files]
        if not here:
            raise ResultError(f"no run has ended in '{top}' or below: there is no summary.json")
        found += here
    return list(dict.fromkeys(os.path.normpath(path) for path in found))


def planned(directories):
    """{directory: what is known} of the runs that the studies in these directories have still to make."""
    runs = {os.path.normpath(os.path.join(top, run["name"])): run
            for top in directories for run in study.record.about(top).get("runs", [])}
    return {directory: run for directory, run in runs.items() if study.record.read(directory) is None}


def results(directories):
    missing = planned(directories)
    found = [result(directory) for directory in below(directories) if directory not in missing]
    found += [not_run(directory, run) for directory, run in missing.items()]
    tell_apart(found)
    curves = list(dict.fromkeys((r.case, r.curve) for r in found))
    return sorted(found, key=lambda r: (curves.index((r.case, r.curve)),
                                        RESOLUTIONS.index(r.resolution) if r.resolution in RESOLUTIONS else -1))


def result(directory):
    record = study.record.read(directory) or {}
    summary = read_summary(directory) if os.path.exists(os.path.join(directory, "summary.json")) else {}
    deck = read_deck(directory)
    model = summary.get("fracture_model") or model_of(record)
    case = record.get("case") or re.sub(rf"/{re.escape(model)}$", "", summary.get("case", ""))
    status = record.get("status") or summary.get("status", "finished")
    return Result(directory, case or os.path.basename(directory), model,
                  deck.get("Resolution") or record.get("resolution", ""), summary.get("ranks") or record.get("ranks", 1),
                  status, record.get("reason") or summary.get("reason", ""), summary, record, deck)


def not_run(directory, run):
    return Result(directory, run["case"], model_of(run), run["resolution"], run["ranks"], NOT_RUN, "", {}, run, {})


def model_of(record):
    """As far as a study knows it that has not seen a summary."""
    settings = dict(text.split("=", 1) for text in record.get("settings", []))
    return record.get("model") or settings.get("Fracture/Model", "")


def tell_apart(found):
    """Runs of a case are told apart by what the study has set differently in them: in short, in full where this is not
    enough, and by their directories where nothing else is known."""
    for case in dict.fromkeys(r.case for r in found):
        here = [r for r in found if r.case == case]
        varied = [entry for entry in dict.fromkeys(e for r in here for e in r.settings) if entry != "Resolution"
                  and len({r.settings.get(entry) for r in here}) > 1]
        for one in here:
            pairs = [(e, one.settings[e]) for e in varied if e in one.settings]
            one.variant = describe(pair for pair in pairs if pair != ("Fracture/Model", one.model))
        for one in same_name(here):
            one.variant = ", ".join(f"{e} = {one.settings[e]}" for e in varied if e in one.settings)
    shared = os.path.commonpath([os.path.abspath(r.directory) for r in found])
    unclear = same_name(found)
    for one in [r for r in found if r in unclear or not r.record and r.case in {u.case for u in unclear}]:
        one.variant = ", ".join(filter(None, (one.variant, os.path.relpath(one.directory, shared))))


def same_name(found):
    """Those that are not the only ones with their name."""
    names = [(r.case, r.label) for r in found]
    return [one for one, name in zip(found, names) if names.count(name) > 1]
