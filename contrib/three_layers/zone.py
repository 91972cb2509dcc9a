"""The cracked cells of a run, from the fields that it wrote."""
import os
import sys

import numpy as np

HERE = os.path.dirname(os.path.abspath(__file__))
sys.path[:0] = [os.path.join(HERE, ".."), os.path.join(HERE, "..", "plot")]
import vtu  # noqa: E402

HEXAHEDRON = 12


class Cells:
    """Of a mesh of bricks along the axes: centre, size and the fields, an array each."""

    def __init__(self, path):
        grid = vtu.read(path)
        corners, _ = grid.cells(HEXAHEDRON)
        places = grid.points[corners]
        self.centre, self.size = places.mean(axis=1), np.ptp(places, axis=1)
        self.fields = {name: values[corners].mean(axis=1) for name, values in grid.point_data.items()}

    def layer(self, height):
        """The cells that a horizontal plane passes, of two layers that share it the upper."""
        half = 0.5 * self.size[:, 2]
        return (self.centre[:, 2] - half <= height) & (height < self.centre[:, 2] + half)


class Zone:
    """The cracked cells. `along` is their place along the greatest horizontal stress, `off` across it."""

    def __init__(self, cells, angle):
        cracked = cells.fields["damage"] > 0.
        self.centre, self.size = cells.centre[cracked], cells.size[cracked]
        self.fields = {name: values[cracked] for name, values in cells.fields.items()}
        turn = np.radians(angle)
        self.along = self.centre[:, 0] * np.cos(turn) + self.centre[:, 1] * np.sin(turn)
        self.off = self.centre[:, 1] * np.cos(turn) - self.centre[:, 0] * np.sin(turn)

    def direction(self):
        """Of its horizontal principal axis against x [degrees], in (-90, 90]."""
        x, y = (self.centre[:, :2] - self.centre[:, :2].mean(axis=0)).T
        return np.degrees(0.5 * np.arctan2(2. * (x * y).sum(), (x * x - y * y).sum()))

    def opening(self):
        return np.maximum(self.fields["opening"], 0.)

    def section(self, n_bins):
        """The vertical section along the fracture: (edges along, least height, greatest height) of the cells
        between the edges, NaN where there are none."""
        edges = np.linspace(self.along.min() - 1e-9, self.along.max() + 1e-9, n_bins + 1)
        place = np.digitize(self.along, edges) - 1
        low, high = np.full(n_bins, np.nan), np.full(n_bins, np.nan)
        for i in range(n_bins):
            here = place == i
            if here.any():
                low[i] = (self.centre[here, 2] - 0.5 * self.size[here, 2]).min()
                high[i] = (self.centre[here, 2] + 0.5 * self.size[here, 2]).max()
        return edges, low, high


def times(directory):
    """[(time, file)] of the fields."""
    return vtu.series(directory, "fields")


def at(directory, time=None):
    """(time, cells) nearest to a time; without one, the last."""
    time, path = vtu.at_time(times(directory), time)
    return time, Cells(path)
