"""Read what a run left behind: summary.json and statistics.csv. Python standard library only."""
import csv
import json
import os
import re
import sys


class ResultError(ValueError):
    """What is asked for is not among the results; the text is a sentence for who asked."""


class Table(dict):
    """Columns of statistics.csv; one that is not there is an error that names those that are."""

    def __init__(self, path, columns):
        super().__init__(columns)
        self.path = path

    def __missing__(self, name):
        raise ResultError(f"{self.path} has no column '{name}'; there is: {', '.join(self)}")


def script(main):
    """Run the main function of a script. Results that are not there are said in a sentence, exit status 1."""
    try:
        sys.exit(main())
    except (OSError, ResultError) as error:
        sys.exit(f"{os.path.basename(sys.argv[0])}: {error}")


def nothing(directory, what):
    """The error that a directory does not have a file, or a step; why, where that is known."""
    if not os.path.isdir(directory):
        return ResultError(f"there is no directory '{directory}'")
    if not os.path.exists(os.path.join(directory, "summary.json")):
        return ResultError(f"'{directory}' has no {what}, and no summary.json: no run has ended there")
    summary = read_summary(directory)
    why = f": the run has failed. {summary.get('reason', '')}" if summary.get("status") == "failed" else ""
    return ResultError(f"'{directory}' has no {what}{why}")


def read_summary(directory):
    """summary.json of an output directory, as nested dictionaries."""
    path = os.path.join(directory, "summary.json")
    if not os.path.exists(path):
        raise nothing(directory, "results")
    with open(path, encoding="utf-8") as file:
        return json.load(file)


def read_statistics(directory):
    """statistics.csv as {column: [one number per accepted step]}; text stays text."""
    path = os.path.join(directory, "statistics.csv")
    if not os.path.exists(path):
        raise nothing(directory, "statistics.csv")
    with open(path, encoding="utf-8", newline="") as file:
        rows = list(csv.reader(line for line in file if line.strip() and not line.startswith("#")))
    if len(rows) < 2:
        raise nothing(directory, "step in statistics.csv")
    names = [name.strip() for name in rows[0]]
    return Table(path, {name: [_number(row[i] if i < len(row) else "") for row in rows[1:]]
                        for i, name in enumerate(names)})


def read_units(directory):
    """{column: SI unit} from the first line of statistics.csv; empty if it says none."""
    with open(os.path.join(directory, "statistics.csv"), encoding="utf-8") as file:
        return dict(re.findall(r"(\w+) \[([^\]]+)\]", file.readline()))


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
