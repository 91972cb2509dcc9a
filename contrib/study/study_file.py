"""A study as a file, in TOML:

    title       = "Element pairs and coupling schemes"
    resolutions = ["coarse", "medium"]     # none: as the deck says
    quantities  = ["pore_pressure"]        # errors that are charted; none: all there are
    time_limit  = 600                      # seconds of the processor, per rank; none: no limit

    [[runs]]                               # as many as wanted; each is a product
    cases  = ["mandel", "column/rod"]      # prm/<case>/<model>.prm, or decks of one's own
    models = ["none"]                      # not given: all that the case has a deck for; not with decks of one's own
    ranks  = [1, 2]
    [runs.set]                             # --set, each entry with its values
    "Coupling/Scheme" = ["monolithic", "fixed stress"]

    [map]                                  # where a method holds: one number of each run over two entries
    x       = "Time/Initial step"          # what varies across and up: an entry of set, or "case"
    y       = "Rock/Permeability"
    measure = "final/inlet_pressure"       # a name of contrib/measures.py
    label   = "inlet pressure [Pa]"        # none: the name
    limit   = 1e6                          # more is a failure; none: only runs that do not end are
    least   = 0                            # less is a failure
    x_names = ["1 s", "10 s"]              # what stands there for the values of x; none: themselves
    x_label = "first step"                 # and for x

cases, models, resolutions, ranks, time_limit and set may stand above, for all [[runs]].
"""
import dataclasses
import os
import tomllib

from measures import BEGINNINGS
from results import ResultError

ROOT = os.path.join(os.path.dirname(os.path.abspath(__file__)), "..", "..")
DECKS = os.path.normpath(os.path.join(ROOT, "prm"))
SHIPPED = os.path.join(DECKS, "studies")

LISTS = ("cases", "models", "resolutions", "ranks")
OF_RUNS = (*LISTS, "set", "time_limit")
OF_STUDY = ("title", "text", "quantities", "runs", "map", *OF_RUNS)
# What is taken where a list is not given.
EMPTY = {"cases": "those above [[runs]]", "models": "all that a case has a deck for", "resolutions": "what the decks say",
         "ranks": "one"}
OF_MAP = ("x", "y", "measure", "label", "limit", "least", "x_names", "x_label")


@dataclasses.dataclass
class Block:
    """One product of the matrix. An empty resolution, or no model, is what the deck says."""
    cases: list
    models: list = dataclasses.field(default_factory=list)
    resolutions: list = dataclasses.field(default_factory=lambda: [""])
    ranks: list = dataclasses.field(default_factory=lambda: [1])
    set: dict = dataclasses.field(default_factory=dict)
    time_limit: float = 0.


@dataclasses.dataclass
class Study:
    name: str
    blocks: list
    title: str = ""
    text: str = ""
    quantities: list = dataclasses.field(default_factory=list)
    map: dict = dataclasses.field(default_factory=dict)
    folder: str = "."    # that decks of one's own are relative to


def find(name):
    """The file of a study: a path, or the name of one that ships."""
    shipped = os.path.join(SHIPPED, name + ".toml")
    if os.path.isfile(name):
        return name
    if os.path.isfile(shipped):
        return shipped
    there = shipped_names()
    raise ResultError(f"there is no study '{name}'; those that ship: {', '.join(there) or 'none'}")


def shipped_names():
    return sorted(os.path.relpath(os.path.join(folder, f), SHIPPED)[:-5]
                  for folder, _, files in os.walk(SHIPPED) for f in files if f.endswith(".toml"))


def read(path):
    """The study in a file; what it does not say rightly is said in a sentence."""
    try:
        with open(path, "rb") as file:
            data = tomllib.load(file)
    except (tomllib.TOMLDecodeError, UnicodeDecodeError) as error:
        raise ResultError(f"{path}: {error}") from None
    known(path, "the study", data, OF_STUDY)
    if not isinstance(data.get("runs", []), list) or not all(isinstance(b, dict) for b in data.get("runs", [])):
        raise ResultError(f"{path}: the entries of a product of runs stand below [[runs]]")
    shared = {key: data[key] for key in OF_RUNS if key in data}
    blocks = [block(path, shared, own) for own in data.get("runs", [{}])]
    for key in ("title", "text"):
        if not isinstance(data.get(key, ""), str):
            raise ResultError(f"{path}: {key} = {data[key]!r}, but it is a text")
    if not texts(data.get("quantities", [])):
        raise ResultError(f"{path}: quantities = {data['quantities']!r}, but it is a list of texts")
    return Study(os.path.splitext(os.path.basename(path))[0], blocks, data.get("title", ""), data.get("text", ""),
                 data.get("quantities", []), map_of(path, data.get("map", {}), blocks), os.path.dirname(os.path.abspath(path)))


def map_of(path, given, blocks):
    """The map of a study; empty if it has none."""
    if not given:
        return {}
    if not isinstance(given, dict):
        raise ResultError(f"{path}: what a map shows stands below [map]")
    known(path, "[map]", given, OF_MAP)
    for key in ("x", "y", "measure"):
        if key not in given:
            raise ResultError(f"{path}: [map] has no '{key}'")
    if not all(isinstance(given.get(key, ""), str) for key in ("x", "y", "measure", "label", "x_label")):
        raise ResultError(f"{path}: x, y, measure, label and x_label of [map] are texts")
    for key in ("limit", "least"):
        if isinstance(given.get(key, 0.), bool) or not isinstance(given.get(key, 0.), (int, float)):
            raise ResultError(f"{path}: {key} = {given[key]!r}, but it is a number")
    beginning = given["measure"].split("/")[0]
    if beginning not in BEGINNINGS:
        raise ResultError(f"{path}: [map] has measure = '{given['measure']}', but a number's name begins with one of: "
                          f"{', '.join(BEGINNINGS)}")
    values = {}
    for b in blocks:
        for entry, its in {"case": b.cases, **b.set}.items():
            values.setdefault(entry, set()).update(map(str, its))
    varied = sorted(entry for entry, its in values.items() if len(its) > 1)
    for key in ("x", "y"):
        if given[key] not in varied:
            raise ResultError(f"{path}: [map] has {key} = '{given[key]}', which is not varied; there is: "
                              f"{', '.join(varied) or 'nothing'}")
    names = given.get("x_names", [])
    if not texts(names) or (names and len(names) != len(values[given["x"]])):
        raise ResultError(f"{path}: x_names = {names!r}, but it is a list of {len(values[given['x']])} texts, one for each "
                          f"value of '{given['x']}'")
    if given["x"] == given["y"]:
        raise ResultError(f"{path}: [map] has the same entry, '{given['x']}', for x and for y")
    return given


def block(path, shared, own):
    known(path, "[[runs]]", own, OF_RUNS)
    data = {**shared, **own, "set": {**shared.get("set", {}), **own.get("set", {})}}
    for key in LISTS:
        if key not in data:
            continue
        good = texts(data[key]) if key != "ranks" else (
            isinstance(data[key], list) and all(type(r) is int and r > 0 for r in data[key]))
        if data[key] == []:
            raise ResultError(f"{path}: {key} = [], but the list may not be empty; leave '{key}' out for {EMPTY[key]}")
        if not good:
            what = "a list of whole numbers from 1" if key == "ranks" else "a list of texts"
            raise ResultError(f"{path}: {key} = {data[key]!r}, but it is {what}")
        if len(set(data[key])) < len(data[key]):
            raise ResultError(f"{path}: {key} = {data[key]!r} names something twice")
    if "cases" not in data:
        raise ResultError(f"{path}: no cases are named; 'cases' is a list of names below {DECKS}, or of decks")
    for case in data["cases"]:
        if not case.endswith(".prm") and (os.path.isabs(case) or ".." in case.split("/")):
            raise ResultError(f"{path}: '{case}' is not a case below {DECKS}; a deck of one's own ends in .prm")
    for entry, values in data["set"].items():
        values = values if isinstance(values, list) else [values]
        if not values or not all(isinstance(v, (str, int, float)) for v in values):
            raise ResultError(f"{path}: '{entry}' = {values!r}, but it is a value or a list of values")
        data["set"][entry] = [str(v).lower() if isinstance(v, bool) else str(v) for v in values]
    limit = data.get("time_limit", 0.)
    if isinstance(limit, bool) or not isinstance(limit, (int, float)) or limit < 0.:
        raise ResultError(f"{path}: time_limit = {limit!r}, but it is a number of seconds")
    return Block(**data)


def texts(value):
    return isinstance(value, list) and all(isinstance(v, str) for v in value)


def known(path, where, data, names):
    for key in data:
        if key not in names:
            raise ResultError(f"{path}: {where} has no entry '{key}'; there is: {', '.join(names)}")
