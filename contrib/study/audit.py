"""What the program has said of a scene: the numbers before the first step, the assumptions after the last."""
import re


def scene(result):
    """[(number, value, what it decides)] of the scene audit; other lines stand in the last place."""
    text = result.log() or result.record.get("audit", "")
    lines = text.split("Scene audit\n", 1)[1].splitlines() if "Scene audit\n" in text else []
    found = []
    for line in lines:
        if not line.startswith("  ") or re.match(r"  +(step +time|s +s)", line):
            if line.startswith("Warning"):
                continue
            break
        cells = [cell for cell in re.split(r" {2,}", line.strip())]
        name_value = re.fullmatch(r"(.*\S) ([-+.\de]+)", cells[0]) if len(cells) == 2 else None
        if len(cells) >= 3:
            found.append((cells[0], cells[1], " ".join(cells[2:])))
        elif name_value:
            found.append((name_value[1], name_value[2], cells[1]))
        else:
            found.append(("", "", line.strip()))
    return found


def assumptions(result):
    """[(holds, text)] after the run."""
    text = result.log()
    if "Assumptions after the run\n" not in text:
        return []
    found = []
    for line in text.split("Assumptions after the run\n", 1)[1].splitlines():
        match = re.match(r"  (holds    |DOES NOT ) (.*)", line)
        if not match:
            break
        found.append((match[1].startswith("holds"), match[2]))
    return found


def warnings(result):
    """Those of the summary, or, where there is none, of the log."""
    return (result.summary.get("warnings") if result.summary else None) or \
        [line[len("Warning: "):] for line in result.log().splitlines() if line.startswith("Warning: ")]


def given(result):
    """The entries that the deck gives, other than where results go: {entry: value}."""
    entries, path = {}, []
    try:
        with open(f"{result.directory}/effective.prm", encoding="utf-8") as file:
            lines = file.read().splitlines()
    except OSError:
        return entries
    for line in map(str.strip, lines):
        if line.startswith("subsection "):
            path.append(line[len("subsection "):])
        elif line == "end":
            path.pop()
        elif line.startswith("set ") and "# default:" in line:
            name, value = line[len("set "):].split("#")[0].split("=", 1)
            entries["/".join([*path, name.strip()])] = value.strip()
    return {e: v for e, v in entries.items() if e not in ("Output directory", "Title")}
