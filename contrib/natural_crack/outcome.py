"""What the fracture of a run has done at the natural crack, from the pieces of fracture that it wrote."""
import math
import os
import sys

import numpy as np

HERE = os.path.dirname(os.path.abspath(__file__))
sys.path[:0] = [os.path.join(HERE, ".."), os.path.join(HERE, "..", "plot")]
import vtu  # noqa: E402

LINE = 3
HALF_LENGTH, MIDDLE = 1.4, 1.7  # of the natural crack, on the x axis [m]
LEAST_LENGTH = 0.5             # what counts as new fracture, or as a natural crack that has opened [m]
LEAST_APERTURE = 3e-6          # what counts as open [m]
SAME = 1e-3                    # places that are nearer are the same [m]


class Pieces:
    """Ends (n, 2, 2) and aperture (n) of the pieces of fracture at a time."""

    def __init__(self, ends, aperture):
        self.ends, self.aperture = np.asarray(ends), np.asarray(aperture)

    @classmethod
    def read(cls, directory, time=None):
        """(time, pieces) nearest to a time; without one, the last."""
        time, path = vtu.at_time(vtu.series(directory, "fracture"), time)
        grid = vtu.read(path)
        lines, _ = grid.cells(LINE)
        return time, cls(grid.points[lines][:, :, :2], grid.point_data["aperture"][lines].mean(axis=1))

    def lengths(self):
        return np.linalg.norm(self.ends[:, 1] - self.ends[:, 0], axis=1)


class Outcome:
    """Of pieces, with a natural crack at an angle [degrees]. `parts` says of each what it belongs to."""

    def __init__(self, pieces, angle):
        self.pieces = pieces
        along = np.array([math.cos(math.radians(angle)), math.sin(math.radians(angle))])
        away = pieces.ends - np.array([MIDDLE, 0.])
        off = away @ np.array([-along[1], along[0]])
        self.place = away @ along  # along the natural crack, of both ends
        # By the middle, for cracks that cut cells end between two of them, half of a piece from where the deck has it.
        natural = (np.abs(off) < SAME).all(axis=1) & (np.abs(self.place.mean(axis=1)) < HALF_LENGTH + SAME)
        self.parts = np.where(natural, "natural crack", "")
        self.extent = self.place[natural].min(), self.place[natural].max()
        for group in self._groups(np.flatnonzero(~natural)):
            self.parts[group] = self._part(group, off)
        lengths = pieces.lengths()
        # Cells may be cut and hold.
        is_open = pieces.aperture > LEAST_APERTURE
        of = {name: lengths[(self.parts == name) & is_open].sum() for name in ("fracture", "beyond", "tips")}
        self.beyond, self.tips = of["beyond"], of["tips"]
        self.opened = lengths[natural & is_open].sum()
        fracture = pieces.ends[self.parts == "fracture"].reshape(-1, 2) - np.array([MIDDLE, 0.])
        self.arrived = bool((np.abs(fracture @ np.array([-along[1], along[0]])) < SAME).any())

    def _groups(self, numbers):
        """Pieces that hang together without the natural crack."""
        left = set(numbers.tolist())
        while left:
            group, edge = [], [left.pop()]
            while edge:
                i = edge.pop()
                group.append(i)
                for j in list(left):
                    gaps = np.linalg.norm(self.pieces.ends[i][:, None] - self.pieces.ends[j][None], axis=2)
                    # Two that meet at the natural crack, from its two sides, do not hang together without it.
                    at = np.argwhere(gaps < SAME)
                    if len(at) and not self._is_on_natural(self.pieces.ends[i][at[0][0]]):
                        left.remove(j)
                        edge.append(j)
            yield np.array(group)

    def _is_on_natural(self, point):
        numbers = np.flatnonzero(self.parts == "natural crack")
        for i in numbers:
            first, last = self.pieces.ends[i]
            step = last - first
            share = np.clip((point - first) @ step / (step @ step), 0., 1.)
            if np.linalg.norm(point - first - share * step) < SAME:
                return True
        return False

    def _part(self, group, off):
        """'fracture' from the well; 'beyond' where it begins within the natural crack, 'tips' at its ends."""
        if np.linalg.norm(self.pieces.ends[group], axis=2).min() < SAME:
            return "fracture"
        places = self.place[group][np.abs(off[group]) < SAME]
        within = (places > self.extent[0] + 0.1) & (places < self.extent[1] - 0.1)
        return "beyond" if within.any() else "tips"

    def name(self):
        """In a word."""
        crosses, along = self.beyond >= LEAST_LENGTH, self.opened >= LEAST_LENGTH
        if crosses and along:
            return "both"
        if crosses or along:
            return "crosses" if crosses else "turns"
        return "stops" if self.arrived else "not there"
