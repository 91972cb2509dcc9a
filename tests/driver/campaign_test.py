#!/usr/bin/python3
"""Tests of contrib/campaign: what is drawn, and that the judge says no to what is wrong."""
import dataclasses
import math
import os
import sys
import unittest

import numpy as np

sys.path.insert(0, os.path.join(os.path.dirname(os.path.abspath(__file__)), "..", "..", "contrib"))
from campaign.deck import WALLS, corners, deck  # noqa: E402
from campaign.judge import Run, cells_off, degrees_off, judge  # noqa: E402
from campaign.scene import FAMILIES, control, draw  # noqa: E402


def straight_run(scene, turned=0.):
    """As if the fracture had run exactly along its line, or along one that is turned against it."""
    run = object.__new__(Run)
    run.time = np.linspace(0.01, 1., 100)
    run.wing = scene.wing * run.time**(2 / 3)
    run.aperture = run.time**(1 / 3)
    run.pressure = run.time**(-1 / 3)
    run.minimum_aperture = 0.
    run.summary = {"steps": 100, "rejected_steps": 0}
    low, high = scene.straight(scene.wing, turned)
    places = low + np.linspace(0., 1., 81)[:, None] * (high - low)
    run.pieces = np.stack([places[:-1], places[1:]], axis=1)
    return run


class CampaignTest(unittest.TestCase):
    def test_scenes(self):
        for family in FAMILIES:
            for number in range(40):
                scene = draw(family, 5, number)
                self.assertEqual(scene, draw(family, 5, number))
                self.assertNotEqual(scene, draw(family, 6, number))
                self.assertTrue(0.5 <= scene.K_m <= 8)
                scaled = (4 * math.sqrt(2 / math.pi) * scene.toughness
                          / (scene.plane_modulus**3 * 12 * scene.viscosity * scene.rate)**0.25)
                self.assertAlmostEqual(scaled, scene.K_m)
                self.assertTrue(60 >= scene.along >= scene.across >= 0)
                low, high = corners(scene, 8)
                for place in (*scene.straight(scene.wing), *scene.straight(scene.notch, scene.turn)):
                    self.assertTrue((place >= low).all() and (place <= high).all())
                xx, yy, xy = scene.stress
                n = np.array([-scene.direction[1], scene.direction[0]])
                self.assertAlmostEqual(n @ np.array([[xx, xy], [xy, yy]]) @ n, -scene.across)
                self.assertIn(f"{WALLS * scene.length:.9g} m", deck(scene))
                if family != "turning":
                    self.assertEqual(control(scene).K_m, scene.K_m)

    def test_families(self):
        for number in range(40):
            self.assertEqual(draw("moved", 1, number).angle % 90, 0)
            self.assertEqual(draw("stressed", 1, number).centre, (0.5, 0.5))
            self.assertTrue(0.01 <= draw("scaled", 1, number).length <= 100)
            wing = draw("one_wing", 1, number)
            self.assertEqual(wing.centre[0 if wing.side in ("left", "right") else 1], 0.)
            self.assertIn("Fraction in model = 0.5", deck(wing))
            self.assertGreater(draw("turning", 1, number).along, draw("turning", 1, number).across)

    def test_end_time(self):
        # The toughness vertex, l = 0.9324 (E' Q t/K')^(2/3), is close to K_m = 8.
        scene = dataclasses.replace(draw("turned", 1, 0), K_m=8.)
        K = 4 * math.sqrt(2 / math.pi) * scene.toughness
        length = 0.9324 * (scene.plane_modulus * scene.rate * scene.end_time / K)**(2 / 3)
        self.assertAlmostEqual(length / scene.length, 1., delta=0.003)

    def test_judge(self):
        scene = draw("turned", 1, 0)
        aligned = control(scene)
        beside = straight_run(aligned)
        self.assertEqual(judge(scene, straight_run(scene), beside)[1], [])
        for name, factor, word in (("wing", 0.95, "length"), ("aperture", 1.021, "aperture"),
                                   ("pressure", 1.031, "pressure"), ("pressure", math.nan, "pressure")):
            run = straight_run(scene)
            setattr(run, name, factor * getattr(run, name))
            self.assertEqual(judge(scene, run, beside)[1], [word])
        run = straight_run(scene)
        run.summary = {"steps": 70, "rejected_steps": 30}
        self.assertEqual(judge(scene, run, beside)[1], ["rejected"])
        self.assertEqual(judge(scene, straight_run(scene, 3.), beside)[1], ["direction"])
        self.assertAlmostEqual(cells_off(scene, straight_run(scene, 3.)), 42 * math.sin(math.radians(3)))

    def test_turning(self):
        scene = draw("turning", 1, 0)
        self.assertAlmostEqual(degrees_off(scene, straight_run(scene, -7.)), 7.)
        self.assertEqual(judge(scene, straight_run(scene, 4.), None)[1], [])
        self.assertEqual(judge(scene, straight_run(scene, 6.), None)[1], ["direction"])
        overlapping = straight_run(scene)
        overlapping.minimum_aperture = -0.02
        self.assertEqual(judge(scene, overlapping, None)[1], ["overlap"])


if __name__ == "__main__":
    unittest.main()
