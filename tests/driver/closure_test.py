"""contrib/closure.py on made-up falloffs, contrib/back_stress.py on a made-up field."""
import os
import sys
import unittest

import numpy as np

ROOT = os.path.join(os.path.dirname(os.path.abspath(__file__)), "..", "..")
sys.path.insert(0, os.path.join(ROOT, "contrib"))
import back_stress  # noqa: E402
import closure  # noqa: E402
from results import ResultError  # noqa: E402

CLOSES_AT = 18e6


def falloff(after):
    """A well shut in at 100 s: the pressure falls in proportion to G until closure at 150 s, and by
    after(G past closure) more from there on."""
    at_closure = closure.g_function(0.5)
    table = {"time": [], "inlet_pressure": [], "well_1_rate": [], "inlet_aperture": []}
    for time in range(1, 400):
        g = closure.g_function(max(0., time / 100. - 1.))
        lost = 0.4e6 * min(g, at_closure) / at_closure + after(max(0., g - at_closure))
        for column, value in zip(table, (float(time), CLOSES_AT + 0.4e6 - lost, 1. if time <= 100 else 0.,
                                         max(0., 1e-3 * (1. - g / at_closure)))):
            table[column].append(value)
    return table


class Closure(unittest.TestCase):
    def test_slower_after_closure(self):
        result = closure.closure(falloff(lambda g: 0.05e6 * g))[0]
        self.assertLess(abs(result["g_function"] - CLOSES_AT), 0.02 * 0.4e6)
        self.assertLess(abs(result["first_contact"] - CLOSES_AT), 0.02 * 0.4e6)

    def test_leap_after_closure(self):
        result = closure.closure(falloff(lambda g: 3e6 * (1. - np.exp(-g / 0.1))))[0]
        self.assertLess(abs(result["g_function"] - CLOSES_AT), 0.02 * 0.4e6)

    def test_never_closes(self):
        table = falloff(lambda g: 0.)
        table = {name: column[:145] for name, column in table.items()}
        self.assertIsNone(closure.closure(table)[0]["g_function"])

    def test_open_to_the_end(self):
        """G dp/dG falls as if at closure, but the faces have not met."""
        table = falloff(lambda g: 0.05e6 * g)
        table["inlet_aperture"] = [max(2e-5, aperture) for aperture in table["inlet_aperture"]]
        result = closure.closure(table)[0]
        self.assertIsNone(result["first_contact"])
        self.assertIsNone(result["g_function"])

    def refused(self, table, text, *shut):
        with self.assertRaisesRegex(ResultError, text):
            closure.closure(table, *shut)

    def test_what_is_no_shut_in(self):
        table = falloff(lambda g: 0.05e6 * g)
        back = [rate if rate > 0. else -1. for rate in table["well_1_rate"]]
        self.refused({**table, "well_1_rate": back}, "flows back, at 101 s")
        self.refused({**table, "well_1_rate": back}, "flows back, at 101 s", 100.)
        self.refused(table, "not shut in at 50 s", 50.)
        self.refused({**table, "well_1_rate": [1.] * 399}, "not shut in")
        self.refused({**table, "inlet_aperture": [0.] * 399}, "not open at the well")
        for outside in (0.5, 500., float("nan")):
            self.refused(table, "the run is from 1 to 399 s", outside)

    def test_pumps_again(self):
        table = falloff(lambda g: 0.05e6 * g)
        expected = closure.closure({name: column[:249] for name, column in table.items()})[0]
        for column, value in (("inlet_pressure", 30e6), ("inlet_aperture", 2e-3)):
            table[column] = table[column][:249] + [value] * 150
        for rate in (1., 0.5):
            table["well_1_rate"] = table["well_1_rate"][:249] + [rate] * 150
            result, start, _, again = closure.closure(table, 100.)
            self.assertEqual((result, start, again), (expected, 100., 250.))
        self.refused(table, "'--shut-in' names an earlier rest")
        table["well_1_rate"] = table["well_1_rate"][:102] + [1.] * 297
        self.refused(table, "not shut in at 100 s: at 103 s", 100.)
        table["well_1_rate"] = table["well_1_rate"][:100] + [0.5] * 299
        self.refused(table, "not shut in at 100 s: at 399 s", 100.)

    def test_trickle_of_a_well_that_stores(self):
        table = falloff(lambda g: 0.05e6 * g)
        table["well_1_rate"] = [rate if rate > 0. else 0.5 ** (i - 99) for i, rate in enumerate(table["well_1_rate"])]
        result, start = closure.closure(table, 100.)[:2]
        self.assertEqual(start, 100.)
        self.assertLess(abs(result["g_function"] - CLOSES_AT), 0.02 * 0.4e6)


class Grid:
    """Squares of 1 m with one stress; twice the compression within 1 m of a line at 30 degrees."""

    def __init__(self, stress, normal):
        x, y = np.meshgrid(np.arange(-20., 21.), np.arange(-20., 21.), indexing="ij")
        self.points = np.stack([x.ravel(), y.ravel(), 0. * x.ravel()], axis=1)
        number = np.arange(x.size).reshape(x.shape)
        self.corners = np.stack([number[:-1, :-1], number[1:, :-1], number[1:, 1:], number[:-1, 1:]],
                                axis=2).reshape(-1, 4)
        tensor = np.zeros(9)
        tensor[[0, 1, 3, 4]] = stress[0], stress[2], stress[2], stress[1]
        near = np.abs(self.points[self.corners][:, :, :2].mean(axis=1) @ normal) < 1.
        self.cell_data = {"total_stress": np.where(near[:, None], 2., 1.) * tensor}
        self.point_data = {"pore_pressure": 3. + 0. * x.ravel()}

    def quadrilaterals(self):
        return self.corners, np.arange(len(self.corners))


class BackStress(unittest.TestCase):
    def test_compression_across_a_line(self):
        along = np.array([np.sqrt(3.) / 2., 0.5])
        normal = np.array([-along[1], along[0]])
        stress = -24e6 * np.outer(along, along) - 18e6 * np.outer(normal, normal)
        grid = Grid((stress[0, 0], stress[1, 1], stress[0, 1]), normal)
        line = np.zeros(2), along, 30.
        across, pores, n = back_stress.mean_beside(grid, line, (1., 4.), 0.5)
        self.assertAlmostEqual(across / 18e6, 1.)
        self.assertAlmostEqual(pores, 3.)
        self.assertTrue(70 < n < 110)  # two bands of 3 m by 15 m
        self.assertGreater(back_stress.mean_beside(grid, line, (0., 4.), 0.5)[0], 20e6)


if __name__ == "__main__":
    unittest.main()
