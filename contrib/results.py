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


def read_deck(directory):
    """effective.prm as {"Section/Entry": value}; empty if there is none."""
    entries, path = {}, []
    try:
        with open(os.path.join(directory, "effective.prm"), encoding="utf-8") as file:
            lines = [line.split("#")[0].strip() for line in file]
    except OSError:
        return entries
    for line in lines:
        if line.startswith("subsection "):
            path.append(line[len("subsection "):].strip())
        elif line == "end":
            path.pop()
        elif line.startswith("set ") and "=" in line:
            name, value = line[len("set "):].split("=", 1)
            entries["/".join([*path, name.strip()])] = value.strip()
    return entries


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
