"""Which runs of a case solve the same physical problem, so that they may be subtracted from one another.

Rock, fluid, stress, wells, cracks, boundary conditions, leak-off and the time at which all ends make a problem; cells, steps,
solvers, elements and the fracture model are ways to solve it."""
import os
import re

SECTIONS = ("Rock", "Fluid", "In situ", "Wells", "Cracks", "Boundary conditions", "Fracture flow")
ENTRIES = ("Dimension", "Time/Start time", "Time/End time", "Time/Inertia", "Mesh/Region boxes", "Mesh/Side boxes")
OF_NUMERICS = ("Fracture flow/Minimum aperture",)    # the least that conducts, whatever the opening

# Decks choose it by their cells, so that these resolve the cohesive length: it counts where it was set, or where it differs
# between runs of one model and resolution.
STRENGTH = "Rock/Tensile strength"

NUMBER = re.compile(r"(?<![\w.])[-+]?(\d+\.?\d*|\.\d+)(e[-+]?\d+)?", re.IGNORECASE)


def physical(entry):
    return (entry.split("/")[0] in SECTIONS or entry in ENTRIES) and entry not in OF_NUMERICS


def problems(results):
    """The runs of a case in groups, each of one problem."""
    entries = counted(results)
    found = {}
    for result in results:
        found.setdefault(tuple(value(result, entry) for entry in entries), []).append(result)
    return list(found.values())


def counted(results):
    """The entries that make a problem. Of runs of a study, whose decks are those of one case: what was set, and the time at
    which they end; what else the decks differ in is how their author solves the problem with a model or a resolution. Of any
    others: all that is physical."""
    given = list(dict.fromkeys(entry for r in results for entry in r.settings if physical(entry)))
    if len({origin(r) for r in results}) == 1 and origin(results[0]):
        return list(dict.fromkeys([*given, "Time/End time"]))
    every = dict.fromkeys(entry for r in results for entry in [*r.settings, *r.deck] if physical(entry))
    alike = {}
    for r in results:
        alike.setdefault((r.model, r.resolution), set()).add(value(r, STRENGTH))
    if STRENGTH not in given and all(len(its) == 1 for its in alike.values()):
        every.pop(STRENGTH, None)
    return list(every)


def origin(result):
    """The folder of a case's decks, or the deck of one's own; nothing where no study has run it."""
    deck = result.record.get("deck", "")
    return os.path.dirname(deck) if result.record.get("model") else deck


def value(result, entry):
    """As the study has set it or the deck says, whatever 'Physics = auto' has made of it, however its numbers are written."""
    text = result.settings.get(entry, result.summary.get("before_physics", {}).get(entry, result.deck.get(entry, "")))
    return NUMBER.sub(lambda match: repr(float(match[0])), " ".join(text.split()))
