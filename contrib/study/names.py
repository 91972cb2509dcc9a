"""Names of decks and of directories: such that no two are the same, and none leads elsewhere."""
import hashlib
import os
import re

# Of a directory; file systems take 255 bytes.
LONGEST = 120


def part(text):
    """Text as the name of one directory. What had to be bent beyond spaces and signs is told apart by its hash."""
    plain = re.sub(r"[^\w.+-]+", "_", text.replace("/", "_"))
    if "/" not in text and plain.strip(".") and len(plain.encode()) <= LONGEST:
        return plain
    return f"{plain.strip('.')[:LONGEST // 4]}-{mark(text)}"


def mark(text):
    return hashlib.sha256(text.encode()).hexdigest()[:8]


def of_decks(paths):
    """{path: name}: that of the file, after as many of its folders as tell it from others of the same name."""
    parts = {path: os.path.abspath(path)[:-len(".prm")].split("/")[1:] for path in paths}
    found = {}
    for path, its in parts.items():
        others = [other for other in parts.values() if other != its]
        depth = next((n for n in range(1, len(its)) if its[-n:] not in (o[-n:] for o in others)), len(its))
        found[path] = "/".join(its[-depth:])
    return found
