"""What runs have left behind: of a study, or in any directories."""
import dataclasses
import os
import re

import study.record
from results import ResultError, read_deck, read_summary


@dataclasses.dataclass
class Result:
    """A run that has ended, one way or the other."""
    directory: str
    case: str
    model: str
    variant: str
    resolution: str
    ranks: int
    status: str          # finished or failed
    reason: str
    summary: dict        # of the program; empty if it wrote none
    record: dict         # of the study tool; empty if it did not start the run
    deck: dict           # Section/Entry: value, everything spelt out

    @property
    def curve(self):
        """What is joined by a line through its resolutions."""
        return ", ".join(filter(None, (self.model, self.variant, f"{self.ranks} ranks" if self.ranks > 1 else "")))

    @property
    def label(self):
        return ", ".join(filter(None, (self.curve, self.resolution)))

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


def results(directories):
    found = [result(directory) for directory in below(directories)]
    name_apart(found)
    return found


def result(directory):
    record = study.record.read(directory) or {}
    summary = read_summary(directory) if os.path.exists(os.path.join(directory, "summary.json")) else {}
    deck = read_deck(directory)
    model = summary.get("fracture_model") or record.get("model", "")
    case = record.get("case") or re.sub(rf"/{re.escape(model)}$", "", summary.get("case", ""))
    status = record.get("status") or summary.get("status", "finished")
    return Result(directory, case or os.path.basename(directory), model, record.get("variant", ""),
                  deck.get("Resolution") or record.get("resolution", ""), summary.get("ranks") or record.get("ranks", 1),
                  status, record.get("reason") or summary.get("reason", ""), summary, record, deck)


def name_apart(found):
    """Runs that no study has named, and that would else have the same name, are called after their directory."""
    names = [(r.case, r.label) for r in found]
    shared = os.path.commonpath([os.path.abspath(r.directory) for r in found])
    for one, name in zip(found, names):
        if names.count(name) > 1 and not one.record:
            one.variant = os.path.relpath(one.directory, shared)
