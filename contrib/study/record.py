"""run.json, which the study tool leaves in the directory of each run beside what the program writes."""
import json
import os

from results import ResultError

NAME = "run.json"


def write(directory, record):
    """All or nothing: whoever is killed here leaves no half a record."""
    path = os.path.join(directory, NAME)
    with open(path + ".part", "w", encoding="utf-8") as file:
        json.dump(record, file, indent=2)
    os.replace(path + ".part", path)


def read(directory):
    """The record of a directory; None if no run of a study has ended there."""
    path = os.path.join(directory, NAME)
    if not os.path.exists(path):
        return None
    try:
        with open(path, encoding="utf-8") as file:
            return json.load(file)
    except ValueError as error:
        raise ResultError(f"{path}: {error}") from None


def remove(directory):
    path = os.path.join(directory, NAME)
    if os.path.exists(path):
        os.remove(path)
