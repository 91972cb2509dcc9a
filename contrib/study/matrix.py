"""The runs of a study: what each is, its command and its directory."""
import dataclasses
import itertools
import os
import re

from results import ResultError
from study import names
from study.study_file import DECKS


@dataclasses.dataclass(frozen=True)
class Job:
    case: str
    model: str           # empty: as the deck of one's own says
    deck: str            # empty: the case has none for the model
    resolution: str      # empty: as the deck says
    ranks: int
    set: tuple           # ((entry, value), ...)
    time_limit: float
    apart: str = ""      # in the name of its directory, where it would else be that of another run

    @property
    def name(self):
        """Of its directory below that of the study."""
        last = (self.resolution or "default") + (f"_{self.ranks}_ranks" if self.ranks > 1 else "")
        variant = names.part(describe(self.set) or "as_in_the_deck") + self.apart
        return os.path.join(*map(names.part, self.case.split("/")), names.part(self.model or "deck"), variant,
                            names.part(last))

    @property
    def old_name(self):
        """As it was when a '/' in a value made directories; nothing where that would have led out of the study."""
        parts = [self.case, self.model or "deck", describe(self.set) or "as_in_the_deck", self.resolution or "default"]
        parts[-1] += f"_{self.ranks}_ranks" if self.ranks > 1 else ""
        name = "/".join(re.sub(r"[^\w.+/-]+", "_", part) for part in parts)
        return name if all(part.strip(".") for part in name.split("/")) else ""

    def settings(self):
        settings = [f"Resolution={self.resolution}"] if self.resolution else []
        return settings + [f"{entry}={value}" for entry, value in self.set]

    def about(self):
        """What a record says of it."""
        return {"case": self.case, "model": self.model, "resolution": self.resolution, "ranks": self.ranks,
                "deck": self.deck, "settings": self.settings()}


def describe(pairs):
    """A short text for `Section/Entry = value` pairs: words stand for themselves, numbers with their entry. What brings a
    model is not said beside the model."""
    def one(entry, value):
        word = re.match(r"[A-Za-z]", value) and value not in ("on", "off", "true", "false", "auto")
        return value if word else f"{entry.split('/')[-1]} {value}"
    return ", ".join(one(*pair) for pair in pairs if pair[0] != "Additional shared libraries")


def models_of(case):
    """The models that the case has a deck for."""
    folder = os.path.join(DECKS, case)
    there = os.listdir(folder) if os.path.isdir(folder) else []
    return sorted(n[:-4] for n in there if n.endswith(".prm") and not n.endswith(".part.prm"))


def jobs(study):
    """All runs of a study, each once, in the order of the file."""
    found = {}
    own = {case: own_deck(study, case) for block in study.blocks for case in block.cases if case.endswith(".prm")}
    named = names.of_decks(dict.fromkeys(own.values()))
    for block in study.blocks:
        for case in block.cases:
            if case in own and block.models:
                raise ResultError(f"models = {block.models!r}, but '{case}' is a deck of one's own, which names its model "
                                  "itself: leave 'models' out, or vary the model by \"Fracture/Model\" below [runs.set]")
        offered = {case: models_of(case) for case in block.cases}
        for model in block.models:
            if not any(model in there for there in offered.values()):
                there = sorted(set(itertools.chain(*offered.values())))
                raise ResultError(f"none of the cases {', '.join(block.cases)} has a deck for the model '{model}'; "
                                  f"there is: {', '.join(there) or 'none'}")
        products = list(itertools.product(*([(e, v) for v in values] for e, values in block.set.items())))
        for case in block.cases:
            pairs = [("", own[case])] if case in own else decks(block, case, offered[case])
            for (model, deck), its, resolution, ranks in itertools.product(pairs, products, block.resolutions, block.ranks):
                add(found, Job(named[deck] if case in own else case, model, deck, resolution, ranks, its, block.time_limit))
    return list(found.values())


def add(found, job):
    """A run that is not among those found; where another has its name, it gets one of its own."""
    if job.name in found and not same(found[job.name], job):
        job = dataclasses.replace(job, apart="-" + names.mark(repr((job.deck, job.set))))
    found.setdefault(job.name, job)


def same(one, other):
    return (one.deck, one.settings()) == (other.deck, other.settings())


def own_deck(study, case):
    """The path of a deck of one's own."""
    path = next((p for p in (os.path.join(study.folder, case), os.path.join(DECKS, case)) if os.path.isfile(p)), None)
    if path is None:
        raise ResultError(f"there is no deck '{case}' in {study.folder} or {DECKS}")
    return os.path.normpath(path)


def decks(block, case, offered):
    """(model, deck) pairs of a case."""
    if not offered:
        raise ResultError(f"there is no case '{case}': {os.path.join(DECKS, case)} holds no deck")
    return [(model, os.path.join(DECKS, case, model + ".prm") if model in offered else "")
            for model in block.models or offered]
