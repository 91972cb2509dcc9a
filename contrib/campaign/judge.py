"""Say whether a run agrees with its control, and by how much not."""
import os
import sys

import numpy as np

HERE = os.path.dirname(os.path.abspath(__file__))
sys.path[:0] = [os.path.join(HERE, ".."), os.path.join(HERE, "..", "plot")]
import vtu  # noqa: E402
from results import read_statistics, read_summary  # noqa: E402

# Bounds: relative, in cells, in degrees.
LENGTH, CELLS_PER_WING, APERTURE, PRESSURE = 0.04, 1.5, 0.02, 0.03
CELLS_OFF, SHARE_OFF, REJECTED, DEGREES_OFF = 1., 0.02, 0.2, 5.


class Run:
    """What the judge looks at, in the scales of the scene: lengths in cells, times in end times,
    apertures and pressures as those of a fracture at rest would scale."""

    def __init__(self, scene, directory):
        table, self.summary = read_statistics(directory), read_summary(directory)
        share = 2 if scene.side else 1
        self.time = np.array(table["time"]) / scene.end_time
        width = scene.rate * scene.end_time / scene.length
        self.wing = 0.5 * share * np.array(table["fracture_length"]) / scene.cell
        self.aperture = np.array(table["inlet_aperture"]) / width
        self.pressure = (np.array(table["net_inlet_pressure"])
                         * scene.length / (scene.plane_modulus * width))
        fracture = vtu.read(vtu.at_time(vtu.series(directory, "fracture"))[1])
        ends, cells = fracture.cells(vtu.LINE)
        self.pieces = fracture.points[ends][:, :, :2] / scene.cell
        self.minimum_aperture = (fracture.cell_data["aperture"][cells] if "aperture" in fracture.cell_data
                               else fracture.point_data["aperture"][ends]).min() / width

    def late(self, values):
        """The average over the last half of the time."""
        return np.interp(np.linspace(0.5, 1., 501), self.time, values).mean()

    @property
    def rejected(self):
        tried = self.summary["steps"] + self.summary["rejected_steps"]
        return self.summary["rejected_steps"] / max(tried, 1)


def judge(scene, run, control):
    """(what was found, what is wrong): a text and a list of words."""
    found, wrong = [], []

    def holds(good, word, text):
        found.append(text)
        if not good:  # not a number is wrong, too
            wrong.append(word)

    if control is None:
        holds(run.minimum_aperture > -0.01, "overlap", f"least aperture {run.minimum_aperture:+.3f}")
        off = degrees_off(scene, run)
        holds(off < DEGREES_OFF, "direction", f"tips {off:.1f} deg off")
    else:
        cells = run.wing[-1] - control.wing[-1]
        length = cells / control.wing[-1]
        holds(abs(length) < LENGTH or abs(cells) < CELLS_PER_WING, "length",
              f"length {100 * length:+5.1f} % of {control.wing[-1]:.1f} cells")
        for word, bound in (("aperture", APERTURE), ("pressure", PRESSURE)):
            change = run.late(getattr(run, word)) / control.late(getattr(control, word)) - 1
            holds(abs(change) < bound, word, f"{word} {100 * change:+5.1f} %")
        off = cells_off(scene, run)
        holds(off < CELLS_OFF + SHARE_OFF * run.wing[-1], "direction", f"{off:.2f} cells off")
    holds(run.rejected < REJECTED, "rejected", f"rejected {100 * run.rejected:.0f} %")
    return ", ".join(found), wrong


def cells_off(scene, run):
    """The greatest distance of the fracture from its line."""
    t = scene.direction
    return np.abs((run.pieces - scene.centre) @ np.array([-t[1], t[0]])).max(initial=0.)


def degrees_off(scene, run):
    """The greater angle of the two tips' last eight cells to the greatest compression."""
    points = run.pieces.reshape(-1, 2) - scene.centre
    place = points @ scene.direction
    worst = 0.
    for sign in (-1, 1):
        tip = points[np.argmax(sign * place)]
        near = points[np.linalg.norm(points - tip, axis=1) < 8.]
        chord = tip - near[np.argmax(np.linalg.norm(near - tip, axis=1))]
        turned = np.degrees(np.arctan2(chord[1], chord[0])) - scene.angle
        worst = max(worst, abs((turned + 90.) % 180. - 90.))
    return worst
