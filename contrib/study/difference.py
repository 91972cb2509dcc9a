"""Runs without a reference solution, measured against the most refined one of the same problem that has finished."""
import numpy as np

from results import ResultError, read_statistics
from study.problem import problems

# What is compared, as far as it is there, besides the columns that a study asks for.
QUANTITIES = ("equivalent_length", "fracture_volume", "inlet_aperture", "net_inlet_pressure", "leaked_volume",
              "displacement", "pore_pressure", "load", "dissipated_energy")


def histories(result):
    """{column: values at the accepted steps}; empty if there is none."""
    try:
        table = read_statistics(result.directory)
    except ResultError:
        return {}
    return {name: np.array([x if isinstance(x, float) else np.nan for x in column])
            for name, column in table.items()}


def baseline(results):
    """The run that the others are measured against."""
    finished = [r for r in results if r.status == "finished"]
    return max(finished, key=lambda r: r.summary.get("unknowns", 0), default=None)


def differences(results, wanted=()):
    """{directory: ({quantity: {"final", "mean"}}, the run measured against, until when)} of the runs of a case; the baseline of
    a problem is measured against itself, with no quantities, and a run that is alone is not among them. Relative to the
    greatest value of the baseline, over the time that both have run; the mean is over time. Until when: the end of that time
    [s] where one of them went on, else None."""
    found = {}
    for group in problems([r for r in results if histories(r)]):
        base = baseline(group)
        if base is None or len(group) < 2:
            continue
        its = histories(base)
        found[base.directory] = ({}, base, None)
        for result in group:
            own = histories(result)
            if result is not base and "time" in own and "time" in its:
                found[result.directory] = apart(own, its, base, dict.fromkeys([*QUANTITIES, *wanted]))
    return found


def apart(own, its, base, names):
    begin, end = max(own["time"][0], its["time"][0]), min(own["time"][-1], its["time"][-1])
    last = max(own["time"][-1], its["time"][-1])
    times = np.linspace(begin, end, 401)
    found = {}
    for name in names:
        if name not in own or name not in its or not np.nanmax(np.abs(its[name])) > 0.:
            continue
        distance = np.abs(np.interp(times, own["time"], own[name]) - np.interp(times, its["time"], its[name]))
        distance /= np.nanmax(np.abs(its[name]))
        found[name] = {"final": distance[-1], "mean": np.nanmean(distance)}
    return found, base, end if end < last - 1e-6 * abs(last) else None
