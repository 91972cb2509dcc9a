"""contrib/three_layers: the formulas against the equations that they solve, a zone, the stages of a made-up run."""
import csv
import io
import math
import os
import sys
import tempfile
import unittest
from contextlib import redirect_stdout

import numpy as np

ROOT = os.path.join(os.path.dirname(os.path.abspath(__file__)), "..", "..")
sys.path.insert(0, os.path.join(ROOT, "contrib"))
from deck_runs import run_deck  # noqa: E402
from results import ResultError  # noqa: E402
from three_layers import figures, formulas, zone  # noqa: E402

RATE, HEIGHT, CARTER, SHEAR, POISSON, VISCOSITY = 0.08, 10., 5e-4, 1.2e9, 0.3, 1e-3


class Formulas(unittest.TestCase):
    def test_what_leaks_is_what_is_injected(self):
        """2 h C/sqrt(t - t0) along the wing; t0 = (x/A)^2, x = L sin(a): the integrand is constant."""
        time = 50.
        length = formulas.length(RATE, time, HEIGHT, CARTER)
        angle = (np.arange(1000) + 0.5) / 1000. * math.pi / 2.
        x = length * np.sin(angle)
        lost = 2. * HEIGHT * CARTER / np.sqrt(time - time * (x / length)**2)
        self.assertAlmostEqual((lost * length * np.cos(angle)).sum() * math.pi / 2000. / RATE, 1., places=6)

    def test_width_and_pressure_by_poiseuille_in_an_ellipse(self):
        """q = -pi h w^3/(64 mu) dp/dx with q(x) of the leak-off above."""
        time, n = 50., 200000
        length = formulas.length(RATE, time, HEIGHT, CARTER)
        x = (np.arange(n) + 0.5) / n
        flow = RATE * (1. - 2. / math.pi * np.arcsin(x))
        per_width = formulas.pressure_of_width(1., HEIGHT, SHEAR, POISSON)
        fourth = 4. * 64. * VISCOSITY / (math.pi * HEIGHT * per_width) * flow.sum() * length / n
        width = formulas.width(RATE, time, HEIGHT, CARTER, SHEAR, POISSON, VISCOSITY)
        self.assertAlmostEqual(width / fourth**0.25, 1., places=4)

    def test_stored_fracture_holds_what_is_injected(self):
        """Of its width at the well a fracture without leak-off has 0.59 in the mean (pi/4 of the height)."""
        volume = (formulas.stored_length(RATE, 20., HEIGHT, SHEAR, POISSON, VISCOSITY) * HEIGHT
                  * formulas.stored_width(RATE, 20., HEIGHT, SHEAR, POISSON, VISCOSITY))
        self.assertAlmostEqual(RATE * 20. / volume, 0.59, delta=0.01)

    def test_tip_is_driven_by_its_fluid(self):
        """w^2/(12 mu) dp/dx is the tip's speed, x from the tip."""
        speed, modulus, x, d = 2., 3e9, 0.7, 1e-5
        slope = (formulas.tip_pressure(x + d, speed, modulus, VISCOSITY)
                 - formulas.tip_pressure(x - d, speed, modulus, VISCOSITY)) / (2. * d)
        width = formulas.tip_width(x, speed, modulus, VISCOSITY)
        self.assertAlmostEqual(width**2 / (12. * VISCOSITY) * slope / speed, 1., places=6)

    def test_plane_strain_pressure(self):
        """Geertsma & de Klerk: the pressure falls with the root of the length, grows with G^(3/4)."""
        one = formulas.pressure(RATE, 20., HEIGHT, SHEAR, POISSON, VISCOSITY)
        self.assertAlmostEqual(formulas.pressure(RATE, 80., HEIGHT, SHEAR, POISSON, VISCOSITY) / one, 0.5)
        self.assertAlmostEqual(formulas.pressure(RATE, 20., HEIGHT, 16. * SHEAR, POISSON, VISCOSITY) / one, 8.)


class MadeUpCells:
    """Cracked cells of 1 m in a line at 27 degrees, 4 m high, among others."""

    def __init__(self):
        along = np.linspace(-30., 30., 61)
        line = np.stack([np.round(along * math.cos(math.radians(27.))),
                         np.round(along * math.sin(math.radians(27.)))], axis=1)
        cracked = np.concatenate([np.column_stack([line, np.full(61, z)]) for z in (-1.5, -0.5, 0.5, 1.5)])
        whole = np.column_stack([line + [0., 5.], np.full(61, 0.5)])
        self.centre = np.concatenate([cracked, whole])
        self.size = np.ones_like(self.centre)
        damage = np.concatenate([np.ones(len(cracked)), np.zeros(61)])
        self.fields = {"damage": damage, "opening": 1e-3 * damage}


class Zone(unittest.TestCase):
    def test_direction_and_section(self):
        found = zone.Zone(MadeUpCells(), 27.)
        self.assertEqual(len(found.centre), 4 * 61)
        self.assertAlmostEqual(found.direction(), 27., delta=0.5)
        self.assertLess(np.abs(found.off).max(), 0.75)
        edges, low, high = found.section(10)
        self.assertAlmostEqual(edges[-1] - edges[0], 60., delta=1.)
        self.assertTrue((low == -2.).all() and (high == 2.).all())


class Stages(unittest.TestCase):
    @staticmethod
    def stages(time, pressure, half_length):
        with tempfile.TemporaryDirectory() as directory:
            with open(os.path.join(directory, "statistics.csv"), "w", encoding="utf-8", newline="") as file:
                rows = csv.writer(file)
                rows.writerow(["time", "inlet_pressure", "inlet_aperture", "extent_x", "extent_y"])
                for t, p, length in zip(time, pressure, half_length):
                    rows.writerow([t, p, 1e-3, 2. * length, 0.])
            return figures.Run(directory, 0).stages()

    def test_pressure_of_four_stages(self):
        """Up to 1 s, down to 3 s, then slowly up; the fracture stays from 60 s on."""
        time = np.concatenate([np.linspace(0.1, 10., 100), np.linspace(11., 100., 90)])
        pressure = np.interp(time, [0., 1., 3., 60., 100.], [7e6, 9e6, 8e6, 8.5e6, 8.4e6])
        peak, end, stays = self.stages(time, pressure, np.minimum(time, 60.))
        self.assertAlmostEqual(peak, 1., delta=0.11)
        self.assertAlmostEqual(end, 3., delta=0.11)
        self.assertAlmostEqual(stays, 60., delta=1.1)

    def test_what_has_not_come_is_not_a_number(self):
        """Cut short while the pressure rises, before anything has grown, and while it falls."""
        rising = self.stages([0.1, 0.2], [7e6, 8e6], [5., 5.])
        self.assertTrue(all(math.isnan(t) for t in rising), rising)
        falling = self.stages([0.5, 1., 2., 2.5], [8e6, 9e6, 8.4e6, 8.2e6], [5., 5., 6., 7.])
        self.assertEqual(falling[0], 1.)
        self.assertTrue(math.isnan(falling[1]), falling)


class Runs(unittest.TestCase):
    def test_finished_run_with_other_settings(self):
        """It is neither run again nor taken for what is asked for."""
        with tempfile.TemporaryDirectory() as directory:
            with open(os.path.join(directory, "summary.json"), "w", encoding="utf-8") as file:
                file.write('{"status": "finished"}')
            with open(os.path.join(directory, "settings"), "w", encoding="utf-8") as file:
                file.write("Time/End time=1 s")
            with redirect_stdout(io.StringIO()):
                self.assertTrue(run_deck("false", "a.prm", directory, ["Time/End time=1 s"]))
            with self.assertRaisesRegex(ResultError, "not 'Time/End time=2 s'"):
                run_deck("false", "a.prm", directory, ["Time/End time=2 s"])


if __name__ == "__main__":
    unittest.main()
