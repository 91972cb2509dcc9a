"""Read the .pvd, .pvtu and .vtu files which Stockwork writes: unstructured grids with inline ascii
or base64 data, plain or zlib-compressed. Nothing else of VTK's formats."""
import base64
import os
import struct
import sys
import zlib
from xml.etree import ElementTree

import numpy as np

sys.path.insert(0, os.path.join(os.path.dirname(os.path.abspath(__file__)), ".."))
from results import nothing  # noqa: E402

TYPES = {"Int8": "i1", "UInt8": "u1", "Int32": "i4", "UInt32": "u4", "Int64": "i8", "UInt64": "u8",
         "Float32": "f4", "Float64": "f8"}

# VTK's cell types, as used here.
LINE, QUAD, HEXAHEDRON, LAGRANGE_QUAD = 3, 9, 12, 70


class Grid:
    """points (n, 3); cells as connectivity and offsets (ends); types; arrays at points and cells."""

    def __init__(self, points, connectivity, offsets, types, point_data, cell_data):
        self.points, self.connectivity, self.offsets = points, connectivity, offsets
        self.types, self.point_data, self.cell_data = types, point_data, cell_data

    def cells(self, *types):
        """(corner indices (n_cells, n_corners), cell numbers) of all cells of these types, which
        must have equally many corners."""
        chosen = np.flatnonzero(np.isin(self.types, types))
        begins = np.concatenate(([0], self.offsets[:-1]))
        if chosen.size == 0:
            return np.zeros((0, 0), int), chosen
        size = self.offsets[chosen[0]] - begins[chosen[0]]
        return self.connectivity[begins[chosen][:, None] + np.arange(size)], chosen

    def quadrilaterals(self):
        """(corner indices (n, 4), cell numbers) of all quadrilaterals of any order."""
        kinds = [self.cells(kind) for kind in (QUAD, LAGRANGE_QUAD)]
        return (np.concatenate([c[:, :4] for c, _ in kinds if len(c)] or [np.zeros((0, 4), int)]),
                np.concatenate([n for _, n in kinds]))


def read(path):
    """The grid of a .vtu, or of all pieces of a .pvtu together."""
    root = ElementTree.parse(path).getroot()
    if root.get("type") == "PUnstructuredGrid":
        folder = os.path.dirname(path)
        return _join([read(os.path.join(folder, piece.get("Source")))
                      for piece in root.iter("Piece")])
    return _join([_read_piece(piece, root) for piece in root.iter("Piece")])


def read_pvd(path):
    """[(time, file)] of a .pvd, in its order."""
    folder = os.path.dirname(path)
    return [(float(entry.get("timestep")), os.path.join(folder, entry.get("file")))
            for entry in ElementTree.parse(path).getroot().iter("DataSet")]


def series(directory, name):
    """[(time, file)] of DIRECTORY/NAME.pvd."""
    path = os.path.join(directory, name + ".pvd")
    if not os.path.exists(path):
        raise nothing(directory, name + ".pvd")
    entries = read_pvd(path)
    if not entries:
        raise nothing(directory, f"file in {name}.pvd")
    return entries


def at_time(entries, time=None):
    """The entry nearest to a time; without one, the last."""
    return entries[-1] if time is None else min(entries, key=lambda entry: abs(entry[0] - time))


def _read_piece(piece, root):
    def arrays(parent):
        found = piece.find(parent)
        return {} if found is None else {a.get("Name"): _decode(a, root)
                                         for a in found.findall("DataArray")}

    cells = arrays("Cells")
    (points,) = arrays("Points").values()
    return Grid(points.reshape(-1, 3), cells["connectivity"].astype(int),
                cells["offsets"].astype(int), cells["types"].astype(int),
                arrays("PointData"), arrays("CellData"))


def _decode(array, root):
    order = ">" if root.get("byte_order") == "BigEndian" else "<"
    dtype = np.dtype(order + TYPES[array.get("type")])
    components = int(array.get("NumberOfComponents") or 1)
    text = array.text or ""
    if array.get("format") == "ascii":
        values = np.array(text.split(), dtype=float).astype(dtype)
    elif array.get("format") == "binary":
        values = np.frombuffer(_unpack("".join(text.split()), root, order), dtype)
    else:
        raise ValueError(f"data of format '{array.get('format')}' is not read here")
    return values.reshape(-1, components) if components > 1 else values


def _unpack(text, root, order):
    """The bytes behind base64: a header of lengths, then one block, or several compressed ones."""
    word = order + ("Q" if root.get("header_type") == "UInt64" else "I")
    size = struct.calcsize(word)

    def encoded(n):  # characters of n bytes in base64
        return 4 * ((n + 2) // 3)

    if not text:
        return b""
    if root.get("compressor") is None:
        data = base64.b64decode(text[:encoded(size)])
        if len(data) > size or text[encoded(size) - 1] != "=":  # header and data in one go
            return base64.b64decode(text)[size:]
        return base64.b64decode(text[encoded(size):])
    (blocks,) = struct.unpack(word, base64.b64decode(text[:encoded(size)])[:size])
    header = encoded((3 + blocks) * size)
    lengths = np.frombuffer(base64.b64decode(text[:header]), word)[3:3 + blocks]
    data = base64.b64decode(text[header:])
    ends = np.cumsum(lengths)
    return b"".join(zlib.decompress(data[int(e - n):int(e)]) for e, n in zip(ends, lengths))


def _join(grids):
    if len(grids) == 1:
        return grids[0]
    grids = [g for g in grids if len(g.points)] or grids[:1]
    first_point = np.cumsum([0] + [len(g.points) for g in grids])
    first_corner = np.cumsum([0] + [len(g.connectivity) for g in grids])

    def together(pieces):
        return {name: np.concatenate([p[name] for p in pieces]) for name in pieces[0]}

    return Grid(np.concatenate([g.points for g in grids]),
                np.concatenate([g.connectivity + n for g, n in zip(grids, first_point)]),
                np.concatenate([g.offsets + n for g, n in zip(grids, first_corner)]),
                np.concatenate([g.types for g in grids]),
                together([g.point_data for g in grids]), together([g.cell_data for g in grids]))
