"""A study as a page of Markdown with one picture, for doc/."""
import os

from study import report, verdict
from study.collect import NOT_RUN, RESOLUTIONS
from study.estimate import in_time
from study.look import plt, styles
from study.place import folder

# What stands above this line was written by hand, and is kept.
MADE = "## The runs"


def write(results, rows, path, title, text="", wanted=()):
    """Write PATH.md and PATH.png."""
    name = os.path.basename(path)
    folder(os.path.dirname(path))
    figure = report.overview(rows, wanted, styles(results))
    lines = [by_hand(path + ".md") or f"# {title}\n\n{text}".rstrip(), "", MADE, "", made(results, rows)]
    if figure:
        figure.savefig(path + ".png", dpi=100, bbox_inches="tight", metadata={"Software": None})
        plt.close(figure)
        lines += ["", f"![Error against CPU time]({name}.png)", "", report.CHART]
    for case, here in rows.groupby("case", sort=False):
        lines += ["", f"### {case}", "", verdict.measured_against(here), "",
                  verdict.markdown(verdict.shown(here, wanted).drop(columns=["case"]))]
    with open(path + ".md", "w", encoding="utf-8") as file:
        file.write("\n".join(lines) + "\n")


def by_hand(path):
    if not os.path.exists(path):
        return ""
    with open(path, encoding="utf-8") as file:
        return file.read().split(MADE)[0].rstrip()


def made(results, rows):
    """How many runs, how long, and where."""
    done = ", ".join(r for r in RESOLUTIONS if (rows["resolution"] == r).any())
    versions = sorted({f"Stockwork {s.get('version', '')} with deal.II {s.get('dealii_version', '')}, {s.get('machine', '')}, "
                       f"{s.get('date', '')[:10]}" for s in (r.summary for r in results) if s})
    failed = (rows["status"] == "failed").sum()
    absent = (rows["status"] == NOT_RUN).sum()
    counted = f"{len(rows)} runs{done and f' ({done})'}, {failed} of them failed{f', {absent} not run' if absent else ''}"
    return (f"{counted}; {in_time(rows['cpu_seconds'].sum())} of the processor in all. {'; '.join(versions)}. Errors are relative, at "
            f"the end and, in brackets, on average over the history. {verdict.ALONE}")
