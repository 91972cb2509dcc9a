"""Tells whether a run would still be the same: from the deck, the decks that it includes, and the settings."""
import hashlib
import os


def fingerprint(job):
    text = hashlib.sha256("\n".join([str(job.ranks), *job.settings()]).encode())
    for path in with_included(job.deck, []) if job.deck else ["no deck"]:
        text.update(path.encode())
        if os.path.isfile(path):
            with open(path, "rb") as file:
                text.update(file.read())
    return text.hexdigest()


def with_included(path, seen):
    """The files of a deck, each once; the program says what is wrong with them."""
    path = os.path.normpath(path)
    if path in seen:
        return seen
    seen.append(path)
    if os.path.isfile(path):
        with open(path, encoding="utf-8", errors="replace") as file:
            lines = [line.split("#")[0].split(None, 1) for line in file]
        for words in lines:
            if len(words) == 2 and words[0] == "include":
                with_included(os.path.join(os.path.dirname(path), words[1].strip()), seen)
    return seen
