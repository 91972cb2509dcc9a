"""Read what a run left behind: summary.json and statistics.csv. Python standard library only."""
import csv
import json
import os


def read_summary(directory):
    """summary.json of an output directory, as nested dictionaries."""
    with open(os.path.join(directory, "summary.json"), encoding="utf-8") as file:
        return json.load(file)


def read_statistics(directory):
    """statistics.csv as {column: [one number per accepted step]}; text stays text."""
    with open(os.path.join(directory, "statistics.csv"), encoding="utf-8", newline="") as file:
        rows = list(csv.reader(line for line in file if line.strip() and not line.startswith("#")))
    names = [name.strip() for name in rows[0]]
    return {name: [_number(row[i] if i < len(row) else "") for row in rows[1:]] for i, name in enumerate(names)}


def lookup(data, path):
    """The entry `a/b/c` of nested dictionaries and lists; a KeyError says what there is instead."""
    here = data
    for i, key in enumerate(path.split("/")):
        if isinstance(here, list) and key.isdigit() and int(key) < len(here):
            here = here[int(key)]
        elif isinstance(here, dict) and key in here:
            here = here[key]
        else:
            parent = "/".join(path.split("/")[:i]) or "the summary"
            there = ", ".join(here) if isinstance(here, dict) else repr(here)
            raise KeyError(f"no '{key}' in {parent}; there is: {there or 'nothing'}")
    return here


def _number(text):
    try:
        return float(text)
    except ValueError:
        return text.strip()
