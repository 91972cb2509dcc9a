"""run.json, which the study tool leaves in the directory of each run beside what the program writes, and study.json in that
of the study."""
import json
import os

from results import ResultError

NAME = "run.json"
ABOUT = "study.json"


def write(directory, record, name=NAME):
    """All or nothing: whoever is killed here leaves no half a record."""
    path = os.path.join(directory, name)
    with open(path + ".part", "w", encoding="utf-8") as file:
        json.dump(record, file, indent=2)
    os.replace(path + ".part", path)


def write_about(directory, study):
    """Title, text and quantities, for a report of the directory."""
    write(directory, study, ABOUT)


def about(directory):
    return read(directory, ABOUT) or {}


def read(directory, name=NAME):
    """The record of a directory; None if no run of a study has ended there."""
    path = os.path.join(directory, name)
    if not os.path.exists(path):
        return None
    try:
        with open(path, encoding="utf-8") as file:
            return json.load(file)
    except ValueError as error:
        raise ResultError(f"{path}: {error}") from None
