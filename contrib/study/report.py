"""The report: what the page holds, in its order."""
import os
import re

from study import audit, charts, place, verdict
from study.collect import NOT_RUN
from study.cost import WANTED, cheapest, orders, points, worst_of
from study.fields import fields
from study.look import styles
from study.maps import chosen_map, maps
from study.page import Page
from study.sketch import sketch

WORST = "error_mean_the_worst_quantity"
CHART = ("Circles: the cheapest setting for the error beside them. Grey: the Pareto front. The finer the mesh, the larger "
         "the mark.")


def write(results, folder, title, text="", wanted=(), chosen=None, map_file=None):
    """(path of the page, table of all runs). CSV, Markdown and pictures stand beside the page; chosen: what the study's
    map shows, which is written into a file of its own besides if one is named."""
    rows = verdict.table(results, wanted)
    page = Page(title, place.folder(folder))
    if text:
        page.text(text)
    look = styles(results)
    results = [r for r in results if r.status != NOT_RUN]
    cases = {case: [r for r in results if r.case == case] for case in dict.fromkeys(r.case for r in results)}
    if chosen:
        page.section("map", "Where it holds")
        page.picture("map", chosen_map(results, chosen, map_file), "; ".join(
            [chosen.get("label", chosen["measure"])] + (["hatched where it fails: more than "
             f"{chosen['limit']:g}, or the run did not end"] if "limit" in chosen else ["hatched where runs did not end"])))
    problem(page, cases)
    table_of_runs(page, rows, wanted)
    if not chosen:  # else there are dozens of runs whose curves nobody wants
        cost(page, rows, wanted, look)
        curves(page, cases, look)
    assumptions(page, cases, rows, draws_maps=not chosen)
    repeat(page, results)
    rows.drop(columns=["curve", "label"]).to_csv(os.path.join(folder, "results.csv"), index=False)
    with open(os.path.join(folder, "results.md"), "w", encoding="utf-8") as file:
        file.write(verdict.by_case(rows, wanted, verdict.markdown) + "\n")
    return page.write(), rows


def file_name(*parts):
    return re.sub(r"[^\w.-]+", "_", "_".join(parts))


def problem(page, cases):
    page.section("problem", "The problem")
    for case, results in cases.items():
        one = next((r for r in charts.finest(results) if r.status == "finished"), results[0])
        page.heading(f"{case}: {one.deck['Title']}" if one.deck.get("Title") else case)
        page.picture(file_name(case, "sketch"), sketch(one), f"{case} to scale, {one.label}. Labels on the sides: "
                     "their boundary conditions.")
        names = list(dict.fromkeys(name for r in results for name in audit.given(r)))
        entries = {r.label: {n: audit.entry(r, n) for n in names} for r in results if r.deck}
        common = {n: v for n in names for v in [next(iter(entries.values()))[n]]
                  if all(its[n] == v for its in entries.values())}
        references = sorted({e["reference"] for r in results for e in (r.summary.get("errors") or {}).values()
                             if e.get("reference")})
        page.text("Reference: " + ("; ".join(references) or "none; the runs are compared with one another") + ".")
        page.table(["what all decks say", "value"], common.items())
        differing = [n for n in names if n not in common]
        if differing:
            page.text("What differs between the decks:")
            groups = {}
            for label, its in entries.items():
                groups.setdefault(tuple(its[n] for n in differing), []).append(label)
            if len(groups) > len(differing):
                page.table(["run", *differing], [["; ".join(labels), *values] for values, labels in groups.items()])
            else:
                page.table(["entry", *("; ".join(labels) for labels in groups.values())],
                           [[name, *(values[i] for values in groups)] for i, name in enumerate(differing)])
        numbers = audit.scene(one)
        if numbers:
            page.text(f"Scene audit ({one.label}):")
            page.table(["number", "value", "what it decides"], numbers)


def table_of_runs(page, rows, wanted):
    page.section("verdict", "The verdict")
    if verdict.missing(rows, wanted):
        page.text(f"Of the quantities that were asked for, {verdict.missing(rows, wanted)}.")
    for case, here in rows.groupby("case", sort=False):
        page.heading(case)
        texts = verdict.shown(here, wanted).drop(columns=["case"])
        page.table(texts.columns, texts.values)
        page.text(verdict.measured_against(here) + " Errors are relative, at the end and, in brackets, on average over the "
                  "history. CPU: seconds of the processor on all ranks. " + verdict.ALONE, note=True)


def charted(rows, wanted):
    """(rows with the worst of several errors, [(column of the error, name)], "error" or "difference")."""
    names = verdict.quantities(rows, wanted)
    rows = rows.copy()
    columns = [(f"error_mean_{name}", name.replace("_", " ")) for name in names]
    if len(names) > 1:
        rows[WORST] = worst_of(rows, names)
        columns.insert(0, (WORST, "the worst of " + ", ".join(n.replace("_", " ") for n in names)))
    columns = [column for column in columns if points(rows, "cpu_seconds", column[0])]    # one that has finished has it
    return rows, columns, "difference" if rows["differs"].any() else "error"


def axis_label(error, name, what):
    return f"mean {what} [%]" if error == WORST else f"mean {what} of the\n{name} [%]"


def overview(rows, wanted, look):
    """The first chart of each case, in one picture; None without any."""
    cases = [(case, *charted(here, wanted)) for case, here in rows.groupby("case", sort=False)]
    panels = [(case, here, columns[0][0], axis_label(*columns[0], what)) for case, here, columns, what in cases if columns]
    return charts.all_cases(panels, look) if panels else None


def cost(page, rows, wanted, look):
    page.section("cost", "Error against cost")
    cases = list(rows.groupby("case", sort=False))
    if len(cases) > 1:
        page.picture("overview", overview(rows, wanted, look), "All cases: the first chart of each. " + CHART)
    for case, here in cases:
        page.heading(case)
        here, columns, what = charted(here, wanted)
        if not columns:
            page.text("No errors and no differences: one run, or none that has finished.")
            continue
        disturbed = (here["others_share"].fillna(0.) > verdict.ALONE_BELOW).sum()
        if disturbed:
            page.text(f"Of {len(here)} runs, {disturbed} had to share their core with others while they ran: their times are "
                      "too long, and not fit to be compared.")
        for error, name in columns:
            figure = charts.error_against_cost(here, error, axis_label(error, name, what), look)
            page.picture(file_name(case, "cost", error[len("error_mean_"):]), figure,
                         f"{case}: mean {what} of {name} against CPU time and unknowns. " + CHART)
        error, name = columns[0]
        if here["problem"].nunique() > 1:
            page.text(f"These runs solve {here['problem'].nunique()} physical problems: the cheapest setting is that of one, and is "
                      "not told.")
        else:
            page.text(f"The cheapest setting for a mean {what} of {name}:")
            page.table(["wanted [%]", "setting", f"{what} [%]", "CPU [s]", "unknowns"],
                       [[f"{100 * w:g}", *(setting(best) if best else ["none of these runs", "", "", ""])]
                        for w, best in cheapest(here, error)])
        found = [[curve, f"{a['asked']} → {b['asked']}", *order]
                 for curve, pairs in orders(here, error).items()
                 for (a, b, _), order in zip(pairs, zip(*(orders_of(here, e, curve) for e, _ in columns)))]
        if found:
            page.text("Observed orders in the size of the cells (time steps as the decks refine them):")
            page.table(["model", "between", *(n if e != WORST else "worst" for e, n in columns)], found)


def setting(best):
    cpu, error, row = best
    return [row["label"], verdict.per_cent(error), f"{cpu:.3g}",
            f"{row['unknowns']:.0f}"]


def orders_of(rows, error, curve):
    return [f"{order:.2f}" for _, _, order in orders(rows, error).get(curve, [])] or [""]


def curves(page, cases, look):
    page.section("results", "Histories, profiles, paths, fields")
    for case, results in cases.items():
        page.heading(case)
        before = len(page.parts)
        page.picture(file_name(case, "history"), charts.history(results, look),
                     f"{case}: histories, at the finest resolution of each, over the reference where there is one.")
        page.picture(file_name(case, "profile"), charts.profiles(results, look),
                     f"{case}: along the fracture at a time that all have reached.")
        page.picture(file_name(case, "paths"), charts.paths(results, look),
                     f"{case}: where the fractures are at a time that all have reached.")
        for title, figure in fields(results):
            page.picture(file_name(case, title), figure, f"{case}: {title}, on one scale.")
        if len(page.parts) == before:
            page.text("No run has written histories or fields.")


def assumptions(page, cases, rows, draws_maps):
    page.section("assumptions", "Assumptions that did not hold, warnings, stability")
    names = verdict.quantities(rows)
    errors = dict(zip(rows["directory"], worst_of(rows, names))) if names else {}
    for case, results in cases.items():
        page.heading(case)
        said = {}
        for r in results:
            broken = ["did not hold: " + text for holds, text in audit.assumptions(r) if not holds]
            for text in broken + ["warning: " + text for text in audit.warnings(r) if text not in "\n".join(broken)] + (
                    [f"failed: {r.reason}"] if r.status == "failed" else []):
                said.setdefault(text, []).append(r.label)
        page.items([f"{text} ({len(labels)} of {len(results)} runs: {'; '.join(labels)})"
                    for text, labels in said.items()] or ["Nothing: all assumptions held, and nothing was warned of."])
        for title, figure in maps(results, errors) if draws_maps else []:
            page.picture(file_name(case, "map", title), figure, f"{case}, {title}: which runs end, and with what error.")


def repeat(page, results):
    page.section("repeat", "Versions, machine, command lines")
    made = {(s.get("version", ""), s.get("dealii_version", ""), s.get("machine", ""), s.get("date", "")[:10])
            for s in (r.summary for r in results) if s}
    page.table(["Stockwork", "deal.II", "machine", "date"], sorted(made))
    page.code("\n".join(r.record.get("command") or f"# {r.directory}: {r.summary.get('deck', 'deck not known')}"
                        for r in results))
