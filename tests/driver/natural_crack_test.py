"""contrib/natural_crack: the published criteria against what they follow from, and what a run's fracture has done."""
import math
import os
import sys
import unittest

HERE = os.path.dirname(os.path.abspath(__file__))
sys.path.insert(0, os.path.join(HERE, "..", "..", "contrib"))
from natural_crack import criteria, outcome  # noqa: E402


class TipsField(unittest.TestCase):
    def test_renshaw_and_pollard_is_the_tips_field_at_a_right_angle(self):
        # Where yy is the rock's strength, the natural crack slips with |xy| = -mu xx.
        least, strength = 2., 1.5
        xx, yy, xy = criteria.tip_stress(0., 0., 1., math.pi / 2)
        intensity = (strength + least) / yy
        for mu in (0.3, 0.6, 1.2):
            greatest = intensity * (xx + abs(xy) / mu)
            # They round to 0.35 and 1.06, which is 0.95 per cent.
            self.assertAlmostEqual(criteria.renshaw_pollard(mu) * (strength + least) / greatest, 1., delta=0.01)

    def test_it_is_a_third_of_one_and_one_over_mu(self):
        for mu in (0.2, 0.5, 1.):
            self.assertAlmostEqual(criteria.renshaw_pollard(mu), (1. + 1. / mu) / 3., delta=0.01 * (1. + 1. / mu) / 3.)

    def test_without_friction_nothing_is_crossed(self):
        self.assertGreater(criteria.renshaw_pollard_contrast(1., 1., 1e-6), 1e5)
        self.assertEqual(criteria.gu_weng_contrast(90., 1., 1., 1e-3), criteria.NEVER)

    def test_the_greatest_principal_stress_is_the_strength(self):
        for theta in (0.3, 1.2, math.pi / 2, -2., -2.8):
            intensity = criteria.intensity_at_strength(5., 2., 1.5, theta)
            xx, yy, xy = criteria.tip_stress(5., 2., intensity, theta)
            self.assertAlmostEqual(0.5 * (xx + yy) + math.hypot(0.5 * (xx - yy), xy), 1.5, places=9)

    def test_a_smaller_angle_is_harder_to_cross(self):
        contrasts = [criteria.gu_weng_contrast(angle, 1., 1.5, 0.8) for angle in (90., 75., 60., 45.)]
        self.assertEqual(contrasts, sorted(contrasts))

    def test_at_a_right_angle_gu_and_weng_are_renshaw_and_pollard_but_for_the_shear(self):
        # They ask for the greatest principal stress, which is more than that along the crack by tau^2/(yy - xx) at most:
        # the rock breaks sooner, and the less the contrast is, the more so.
        strength = 1.
        for mu in (0.3, 0.4, 0.6):
            for least in (0., 0.5, 2.):
                first = criteria.renshaw_pollard_contrast(least, strength, mu)
                then = criteria.gu_weng_contrast(90., least, strength, mu)
                self.assertLessEqual(then, first)
                self.assertLess(first - then, 0.12 * (strength + least))

    def test_cohesion_holds(self):
        self.assertGreater(criteria.gu_weng_margin(60., 3., 1., 1., 0.5, 1.), criteria.gu_weng_margin(60., 3., 1., 1., 0.5))


class Pressure(unittest.TestCase):
    def test_at_a_right_angle_the_contrast_is_the_strength(self):
        for mu in (0.1, 0.6, 2.):
            self.assertAlmostEqual(criteria.blanton_contrast(90., 1.5, mu), 1.5)

    def test_b_is_the_greatest_stress_along_the_slipping_part(self):
        # Blanton (1986) with the natural crack open nowhere (l = 0): b of a place y = x_0/c.
        def b(y, mu):
            v = (2. * y * math.log((1. + y) * (1. - y) / y**2) + 2. * math.log((1. + y) / (1. - y))) / math.pi
            return 0.5 * (v - y / mu)
        for mu in (0.2, 0.6, 1.5):
            greatest = max(b(1e-3 * i, mu) for i in range(1, 1000))
            self.assertAlmostEqual(criteria.blanton_b(mu), greatest, places=5)

    def test_limits_of_b(self):
        self.assertLess(criteria.blanton_b(0.01), 1e-12)  # it slips along all of its length
        root = math.sqrt(0.5)
        self.assertAlmostEqual(criteria.blanton_b(1e6), math.log((1. + root) / (1. - root)) / math.pi, places=5)

    def test_at_small_angles_it_never_crosses(self):
        self.assertEqual(criteria.blanton_contrast(30., 1., 0.6), criteria.NEVER)
        self.assertAlmostEqual(criteria.blanton_contrast(45., 1., 0.6), 1. / criteria.blanton_b(0.6))
        self.assertAlmostEqual(criteria.blanton_contrast(60., 1., 1e-3), 2.)


def line(first, last, n, aperture):
    """Pieces along a line: [(ends, aperture)]."""
    step = [(b - a) / n for a, b in zip(first, last)]
    return [([[first[0] + k * step[0], first[1] + k * step[1]], [first[0] + (k + 1) * step[0], first[1] + (k + 1) * step[1]]],
             aperture) for k in range(n)]


class WhatHasHappened(unittest.TestCase):
    def outcome(self, *groups):
        pieces = [piece for group in groups for piece in group]
        ends, apertures = zip(*pieces)
        return outcome.Outcome(outcome.Pieces(ends, apertures), 90.)

    def natural(self, aperture):
        return line((1.7, -1.4), (1.7, 1.4), 15, aperture)

    def test_it_has_not_arrived(self):
        self.assertEqual(self.outcome(line((0., 0.), (1.5, 0.), 7, 1e-4), self.natural(0.)).name(), "not there")

    def test_it_stops(self):
        self.assertEqual(self.outcome(line((0., 0.), (1.7, 0.), 8, 1e-4), self.natural(0.)).name(), "stops")

    def test_it_turns_along(self):
        found = self.outcome(line((0., 0.), (1.7, 0.), 8, 1e-4), self.natural(1e-5), line((1.7, 1.4), (1.7, 1.8), 2, 1e-5))
        self.assertEqual(found.name(), "turns")
        self.assertAlmostEqual(found.opened, 2.8)
        self.assertAlmostEqual(found.tips, 0.4)

    def test_it_crosses(self):
        found = self.outcome(line((0., 0.), (1.7, 0.), 8, 1e-4), self.natural(0.), line((1.7, 0.), (2.5, 0.1), 4, 1e-5))
        self.assertEqual(found.name(), "crosses")
        self.assertAlmostEqual(found.beyond, math.hypot(0.8, 0.1))


if __name__ == "__main__":
    unittest.main()
