"""Runs of a case without a reference solution, measured against the most refined one that has finished."""
import numpy as np

from results import ResultError, read_statistics

# What is compared, as far as it is there.
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


def differences(results):
    """({directory: {quantity: {"final", "mean"}}}, label of the baseline): relative to the greatest value of the
    baseline, over the time that both have run; the mean is over time."""
    base = baseline(results)
    if base is None or len(results) < 2:
        return {}, ""
    its = histories(base)
    found = {}
    for result in results:
        own = histories(result)
        if result is base or "time" not in own or "time" not in its:
            continue
        begin, end = max(own["time"][0], its["time"][0]), min(own["time"][-1], its["time"][-1])
        times = np.linspace(begin, end, 401)
        found[result.directory] = {}
        for name in QUANTITIES:
            if name not in own or name not in its or not np.nanmax(np.abs(its[name])) > 0.:
                continue
            apart = np.abs(np.interp(times, own["time"], own[name]) - np.interp(times, its["time"], its[name]))
            apart /= np.nanmax(np.abs(its[name]))
            found[result.directory][name] = {"final": apart[-1], "mean": np.nanmean(apart)}
    return found, base.label
