"""The runs of a study: what each is, its command and its directory."""
import dataclasses
import itertools
import os
import re

from results import ResultError
from study.study_file import DECKS


@dataclasses.dataclass(frozen=True)
class Job:
    case: str
    model: str           # empty: as the deck of one's own says
    deck: str            # empty: the case has none for the model
    resolution: str      # empty: as the deck says
    ranks: int
    set: tuple           # ((entry, value), ...)
    varied: tuple        # the entries of `set` that have several values in the study
    time_limit: float

    @property
    def variant(self):
        return describe([pair for pair in self.set if pair[0] in self.varied])

    @property
    def name(self):
        """Of its directory below that of the study."""
        variant = describe(self.set) or "as_in_the_deck"
        parts = [self.case, self.model or "deck", variant, self.resolution or "default"]
        parts[-1] += f"_{self.ranks}_ranks" if self.ranks > 1 else ""
        return os.path.join(*(re.sub(r"[^\w.+/-]+", "_", part) for part in parts))

    def settings(self):
        settings = [f"Resolution={self.resolution}"] if self.resolution else []
        return settings + [f"{entry}={value}" for entry, value in self.set]


def describe(pairs):
    """A short text for `Section/Entry = value` pairs: words stand for themselves, numbers with their entry."""
    def one(entry, value):
        word = re.match(r"[A-Za-z]", value) and value not in ("on", "off", "true", "false", "auto")
        return value if word else f"{entry.split('/')[-1]} {value}"
    return ", ".join(one(*pair) for pair in pairs)


def models_of(case):
    """The models that the case has a deck for."""
    folder = os.path.join(DECKS, case)
    names = os.listdir(folder) if os.path.isdir(folder) else []
    return sorted(n[:-4] for n in names if n.endswith(".prm") and not n.endswith(".part.prm"))


def jobs(study):
    """All runs of a study, each once, in the order of the file."""
    found = {}
    for block in study.blocks:
        offered = {case: models_of(case) for case in block.cases}
        for model in block.models:
            if not any(model in there for there in offered.values()):
                there = sorted(set(itertools.chain(*offered.values())))
                raise ResultError(f"none of the cases {', '.join(block.cases)} has a deck for the model '{model}'; "
                                  f"there is: {', '.join(there) or 'none'}")
        varied = tuple(entry for entry, values in block.set.items() if len(values) > 1)
        products = list(itertools.product(*([(e, v) for v in values] for e, values in block.set.items())))
        for case in block.cases:
            for model, deck in decks(study, block, case, offered[case]):
                for pairs, resolution, ranks in itertools.product(products, block.resolutions, block.ranks):
                    job = Job(named(case), model, deck, resolution, ranks, pairs, varied, block.time_limit)
                    first = found.setdefault(job.name, job)
                    if (first.deck, first.settings()) != (job.deck, job.settings()):
                        raise ResultError(f"two runs would write into '{job.name}': "
                                          f"{first.deck} {first.settings()}, {job.deck} {job.settings()}")
    return list(found.values())


def decks(study, block, case, offered):
    """(model, deck) pairs of a case."""
    if case.endswith(".prm"):
        path = next((p for p in (os.path.join(study.folder, case), os.path.join(DECKS, case)) if os.path.isfile(p)),
                    None)
        if path is None:
            raise ResultError(f"there is no deck '{case}' in {study.folder} or {DECKS}")
        if block.models:
            raise ResultError(f"'{case}' is a deck with a model of its own: leave 'models' out")
        return [("", os.path.normpath(path))]
    if not offered:
        raise ResultError(f"there is no case '{case}': {os.path.join(DECKS, case)} holds no deck")
    return [(model, os.path.join(DECKS, case, model + ".prm") if model in offered else "")
            for model in block.models or offered]


def named(case):
    """Of a deck of one's own, the name of the file."""
    return os.path.basename(case)[:-4] if case.endswith(".prm") else case
