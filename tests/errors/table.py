#!/usr/bin/env python3
"""Bad decks by the dozen: each line of a table changes a sound deck, which must then be refused.

    table.py PROGRAM LOADED_ONCE TABLE SCRATCH [FAMILY]

A line `[FAMILY DECK]` names the sound deck, relative to the source tree, of the lines after it. A
line

    Section/Entry = value && Section/Other = value | part of the sentence

is a bad deck: it includes the sound one and sets these entries. Each must end with status 1 and a
message that holds an entry, the sentence, and file and line, and leave no output behind. The sound
deck itself must pass."""
import os
import re
import shutil
import sys

ROOT = os.path.abspath(os.path.join(os.path.dirname(__file__), "..", ".."))
sys.path.insert(0, os.path.join(ROOT, "tests", "loaded_once"))

from loaded_once import Program  # noqa: E402


def read_table(name):
    """(family, deck, [(settings, sentence)])"""
    families = []
    with open(name, encoding="utf-8") as file:
        for line in file:
            line = line.strip()
            if not line or line.startswith("#"):
                continue
            head = re.fullmatch(r"\[(\S+) (\S+)\]", line)
            if head:
                families.append((head[1], os.path.join(ROOT, head[2]), []))
                continue
            changes, sentence = line.rsplit(" | ", 1) if " | " in line else (line, "")
            settings = [tuple(part.strip() for part in change.split("=", 1))
                        for change in changes.split(" && ")]
            families[-1][2].append((settings, sentence))
    return families


def deck_text(base, settings):
    text = f"include {base}\nset Resolution = coarse\n"
    for path, value in settings:
        *sections, entry = path.split("/")
        text += "".join(f"subsection {section}\n" for section in sections)
        text += f"set {entry} = {value}\n" + "end\n" * len(sections)
    return text


def check(program, scratch, name, text):
    deck = os.path.join(scratch, name + ".prm")
    with open(deck, "w", encoding="utf-8") as file:
        file.write(text)
    output = os.path.join(scratch, "output")
    status, _, complained = program.run([deck, "--check", "--output", output], scratch)
    if os.path.exists(output):
        return status, "an output directory was made"
    return status, " ".join(complained.split())


def check_families(program, scratch, families):
    """(number of bad decks, what is wrong)"""
    n, failures = 0, []
    for family, base, lines in families:
        status, said = check(program, scratch, family, deck_text(base, []))
        if status != 0:
            failures.append(f"{family}: the sound deck is refused: {said}")
        for number, (settings, sentence) in enumerate(lines):
            n += 1
            status, said = check(program, scratch, f"{family}_{number}", deck_text(base, settings))
            what = " && ".join(f"{path} = {value}" for path, value in settings)
            if status != 1:
                failures.append(f"{what}: exit status {status}, should be 1")
            elif not re.search(r"\.prm:\d+: ", said) and ".prm (default value): " not in said:
                failures.append(f"{what}: no file and line: {said}")
            elif "'" not in said or sentence not in said:
                failures.append(f"{what}: does not say '{sentence}' but: {said}")
    return n, failures


def main():
    name, library, table, scratch = (os.path.abspath(name) for name in sys.argv[1:5])
    families = [family for family in read_table(table) if len(sys.argv) < 6 or family[0] == sys.argv[5]]
    shutil.rmtree(scratch, ignore_errors=True)
    os.makedirs(scratch)
    n, failures = check_families(Program(name, library), scratch, families)
    print(f"{n} bad decks")
    if failures or n == 0:
        sys.exit("\n".join(failures) or "no such family")


if __name__ == "__main__":
    main()
