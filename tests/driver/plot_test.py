#!/usr/bin/python3
"""Tests of contrib/plot: the .vtu reader on each encoding, and the scripts on a small directory."""
import base64
import os
import struct
import subprocess
import sys
import tempfile
import unittest
import zlib

import numpy as np

PLOT = os.path.join(os.path.dirname(os.path.abspath(__file__)), "..", "..", "contrib", "plot")
sys.path.insert(0, PLOT)
import vtu  # noqa: E402


def encode(values, how):
    raw = values.tobytes()
    if how == "ascii":
        return " ".join(repr(v) for v in values.ravel().tolist())
    if how == "binary":
        return base64.b64encode(struct.pack("<I", len(raw)) + raw).decode()
    blocks = [raw[i:i + 64] for i in range(0, len(raw), 64)]
    packed = [zlib.compress(block) for block in blocks]
    header = struct.pack(f"<{3 + len(blocks)}I", len(blocks), 64, len(blocks[-1]),
                         *(len(p) for p in packed))
    return (base64.b64encode(header) + base64.b64encode(b"".join(packed))).decode()


def write_vtu(path, points, cells, kind, fields, how="zlib"):
    def array(name, values):
        types = {"f": "Float32", "i": "Int32", "u": "UInt8"}
        components = values.shape[1] if values.ndim == 2 else 1
        return (f'<DataArray type="{types[values.dtype.kind]}" Name="{name}" '
                f'NumberOfComponents="{components}" format='
                f'"{"ascii" if how == "ascii" else "binary"}">{encode(values, how)}</DataArray>')

    compressor = 'compressor="vtkZLibDataCompressor"' if how == "zlib" else ""
    points = np.pad(points, ((0, 0), (0, 1))).astype("f4")
    size = cells.shape[1]
    with open(path, "w", encoding="utf-8") as file:
        file.write(
            f'<VTKFile type="UnstructuredGrid" byte_order="LittleEndian" {compressor}>'
            f'<UnstructuredGrid><Piece NumberOfPoints="{len(points)}" NumberOfCells="{len(cells)}">'
            f'<Points>{array("Points", points)}</Points><Cells>'
            + array("connectivity", cells.ravel().astype("i4"))
            + array("offsets", (size * np.arange(1, len(cells) + 1)).astype("i4"))
            + array("types", np.full(len(cells), kind, "u1"))
            + "</Cells><PointData>" + "".join(array(n, v) for n, v in fields.items())
            + "</PointData></Piece></UnstructuredGrid></VTKFile>")


def write_run(directory):
    """A crack along y = 0 in a box of 20 x 20 cells, two times."""
    x, y = np.meshgrid(np.linspace(0, 8, 21), np.linspace(-4, 4, 21))
    points = np.stack([x.ravel(), y.ravel()], axis=1)
    n = np.arange(20 * 21).reshape(20, 21)[:, :-1].ravel()
    cells = np.stack([n, n + 1, n + 22, n + 21], axis=1)
    displacement = np.stack([0 * x, np.sign(y) * np.exp(-abs(y)) * 1e-3, 0 * x], axis=-1)
    crack = np.linspace(0, 4, 9)
    for i in range(2):
        write_vtu(f"{directory}/fields-{i}.vtu", points, cells, vtu.QUAD,
                  {"displacement": displacement.reshape(-1, 3).astype("f4"),
                   "pore_pressure": (1e6 * np.exp(-x**2 - y**2)).ravel().astype("f4")})
        write_vtu(f"{directory}/fracture-{i}.vtu", np.stack([crack, 0 * crack], axis=1),
                  np.stack([np.arange(8), np.arange(1, 9)], axis=1), vtu.LINE,
                  {"aperture": (1e-3 * np.sqrt(1 - (crack / 4)**2)).astype("f4"),
                   "fluid_pressure": (1e6 + 0 * crack).astype("f4")})
    for name in ("fields", "fracture"):
        with open(f"{directory}/{name}.pvd", "w", encoding="utf-8") as file:
            file.write("<VTKFile><Collection>" + "".join(
                f'<DataSet timestep="{i}" file="{name}-{i}.vtu"/>' for i in range(2))
                + "</Collection></VTKFile>")
    with open(f"{directory}/statistics.csv", "w", encoding="utf-8") as file:
        file.write("# s, m, m, m\ntime,fracture_length,equivalent_length,reference_equivalent_length\n0,,,\n1,3,2,2.1\n2,4,3,3.1\n")
    with open(f"{directory}/summary.json", "w", encoding="utf-8") as file:
        file.write('{"case": "test", "fracture_model": "none", "final": {"fracture_length": 4, "equivalent_length": 3, "reference_equivalent_length": 3.1},'
                   '"errors": {"equivalent_length": {"final": 0.03, "mean": null, "reference": "KGD"}},'
                   '"fluid_balance": {"injected": 1, "relative_error": 1e-12}}')


class PlotTest(unittest.TestCase):
    def setUp(self):
        temporary = tempfile.TemporaryDirectory()
        self.addCleanup(temporary.cleanup)
        self.directory = temporary.name

    def test_encodings(self):
        points = np.random.default_rng(1).random((12, 2))
        cells = np.arange(12).reshape(3, 4)
        values = np.arange(36).reshape(12, 3).astype("f4")
        for how in ("ascii", "binary", "zlib"):
            path = os.path.join(self.directory, how + ".vtu")
            write_vtu(path, points, cells, vtu.QUAD, {"u": values}, how)
            grid = vtu.read(path)
            np.testing.assert_array_equal(grid.point_data["u"], values)
            np.testing.assert_allclose(grid.points[:, :2], points, atol=1e-7)
            np.testing.assert_array_equal(grid.cells(vtu.QUAD)[0], cells)
        with open(os.path.join(self.directory, "all.pvtu"), "w", encoding="utf-8") as file:
            file.write('<VTKFile type="PUnstructuredGrid"><Piece Source="ascii.vtu"/>'
                       '<Piece Source="zlib.vtu"/></VTKFile>')
        both = vtu.read(os.path.join(self.directory, "all.pvtu"))
        np.testing.assert_array_equal(both.cells(vtu.QUAD)[0], np.arange(24).reshape(6, 4))
        np.testing.assert_array_equal(both.point_data["u"], np.concatenate([values, values]))

    def test_scripts(self):
        write_run(self.directory)
        for script in ("history.py", "field.py --mirror", "field.py --field displacement "
                       "--component y --window 0,2,-1,1 --time 0.1", "profile.py"):
            name, *options = script.split()
            picture = os.path.join(self.directory, "picture.png")
            subprocess.run([sys.executable, os.path.join(PLOT, name), self.directory, *options,
                            "--output", picture], check=True, stdout=subprocess.DEVNULL)
            self.assertLess(os.path.getsize(picture), 300e3)
            os.remove(picture)
        unknown = subprocess.run([sys.executable, os.path.join(PLOT, "field.py"), self.directory,
                                  "--field", "temperature"], capture_output=True, text=True)
        self.assertIn("there is: displacement, pore_pressure", unknown.stderr)
        report = subprocess.run([sys.executable, os.path.join(PLOT, "..", "report.py"),
                                 self.directory], check=True, capture_output=True, text=True)
        self.assertRegex(report.stdout, r"equivalent_length +3 +3\.1 +3 % +-\n *fracture_length +4 +- +- +-")


if __name__ == "__main__":
    if len(sys.argv) == 3 and sys.argv[1] == "--write":
        os.makedirs(sys.argv[2], exist_ok=True)
        write_run(sys.argv[2])
    else:
        unittest.main()
