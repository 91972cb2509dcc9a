"""What a plane cuts out of a three-dimensional mesh: through the first crack of the deck, or on the side where y is least."""
import re

import numpy as np

from plot import vtu

NUMBER = r"[-+]?[\d.]+(?:e[-+]?\d+)?"
DISC = re.compile(rf"disc \(({NUMBER}), ({NUMBER}), ({NUMBER})\) normal \(({NUMBER}), ({NUMBER}), ({NUMBER})\)")
FACES = np.array([[0, 3, 7, 4], [1, 2, 6, 5], [0, 1, 5, 4], [3, 2, 6, 7], [0, 1, 2, 3], [4, 5, 6, 7]])    # of VTK's hexahedron


def plane(deck, points=None):
    """(axis that it is normal to, where): that of a disc which lies along the mesh, else one that a disc crosses; without a disc
    and without points, where is None."""
    found = DISC.search(deck.get("Cracks/Open", ""))
    if not found:
        return 1, None if points is None else points[:, 1].min()
    numbers = np.array([float(text) for text in found.groups()])
    normal = np.abs(numbers[3:]) / np.linalg.norm(numbers[3:])
    axis = int(np.argmax(normal) if normal.max() > 0.99 else np.argmin(normal))
    return axis, numbers[axis]


def cut(grid, axis, at):
    """(polygons (n, 4, 2), cell numbers): of each hexahedron that the plane meets, the face that lies along it."""
    corners, numbers = grid.cells(vtu.HEXAHEDRON)
    if not len(corners):
        return np.zeros((0, 4, 2)), numbers
    heights = grid.points[corners][:, :, axis] - at
    small = 1e-6 * np.ptp(grid.points[:, axis])
    met = (heights.min(axis=1) <= small) & (heights.max(axis=1) >= -small)
    of_faces = heights[met][:, FACES]
    along = (np.ptp(of_faces, axis=2) + 0.1 * np.abs(of_faces.mean(axis=2))).argmin(axis=1)
    ends = np.take_along_axis(corners[met], FACES[along], axis=1)
    return np.delete(grid.points[ends], axis, axis=2), numbers[met]


def is_cracked(grid, numbers):
    """Which of these cells a crack is open in, or is broken through."""
    values = grid.point_data.get("opening", grid.point_data.get("damage"))
    if values is None:
        return np.zeros(len(numbers), bool)
    least = 0. if "opening" in grid.point_data else 0.05    # of bonds, as in plot/field.py
    of_cells = np.zeros(len(grid.types))
    corners, hexahedra = grid.cells(vtu.HEXAHEDRON)
    of_cells[hexahedra] = values[corners].mean(axis=1)
    return of_cells[numbers] > least


def cracked(grid, axis, at):
    polygons, numbers = cut(grid, axis, at)
    return polygons[is_cracked(grid, numbers)]
