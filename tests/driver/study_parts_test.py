#!/usr/bin/python3
"""Tests of the parts that stockwork-study is made of, without a run."""
import os
import sys
import unittest

HERE = os.path.dirname(os.path.abspath(__file__))
sys.path[:0] = [os.path.join(HERE, "..", "..", "contrib")]
import numpy as np  # noqa: E402
import pandas  # noqa: E402

from plot import vtu  # noqa: E402
from results import ResultError  # noqa: E402
from study import (charts, collect, cost, difference, estimate, fields, look, matrix, names, problem, report,  # noqa: E402
                   section, study_file)


class Parts(unittest.TestCase):
    def test_what_makes_a_problem(self):
        def run(settings, deck, model="damage", case="", resolution="coarse"):
            record = {"settings": settings, "deck": case and f"prm/{case}/{model}.prm", "model": case and model}
            return collect.Result("", case, model, resolution, 1, "finished", "", {}, record, deck)

        def number(*runs):
            return len(problem.problems(list(runs)))
        for entry in ("Rock/Young modulus", "Rock/Region 1/Porosity", "Fluid/Viscosity", "In situ/Stress", "Cracks/Open",
                      "Wells/Well 1/Rate", "Boundary conditions/Drained", "Fracture flow/Leak-off", "Time/End time"):
            self.assertEqual(number(run([], {entry: "1"}), run([], {entry: "2"}, "peridynamics")), 2, entry)
        for entry in ("Mesh/Box/X spacing", "Resolution", "Discretisation/Elements", "Linear solver/Type", "Coupling/Scheme",
                      "Time/Scheme", "Time/Initial step", "Fracture/Model", "Fracture/damage/Cell size", "Title"):
            self.assertEqual(number(run([], {entry: "1"}), run([], {entry: "2"})), 1, entry)
        # Less physics for the same problem.
        less = run([], {"Rock/Bulk model": "elastic", "Fluid/Viscosity": "1"})
        less.summary["before_physics"] = {"Rock/Bulk model": "auto"}
        self.assertEqual(number(less, run([], {"Rock/Bulk model": "auto", "Fluid/Viscosity": "1"})), 1)
        self.assertEqual(number(less, run([], {"Rock/Bulk model": "auto", "Fluid/Viscosity": "2"})), 2)
        # Written in another way; the decks of a case, and what a study has set in them.
        self.assertEqual(number(run([], {"Fluid/Viscosity": "1e-3 Pa s"}), run([], {"Fluid/Viscosity": "0.001  Pa s"})), 1)
        soft, hard = {"Rock/Young modulus": "1 GPa"}, {"Rock/Young modulus": "2 GPa"}
        self.assertEqual(number(run([], soft, case="rod"), run([], hard, "peridynamics", "rod")), 1)
        self.assertEqual(number(run([], soft, case="rod"), run(["Rock/Young modulus=2 GPa"], hard, case="rod")), 2)
        self.assertEqual(number(run([], soft, case="rod"), run([], hard, case="beam")), 2)
        # Strength that decks choose by their cells, and strength that differs.
        weak, strong = {"Rock/Tensile strength": "1 MPa"}, {"Rock/Tensile strength": "2 MPa"}
        self.assertEqual(number(run([], weak), run([], strong, resolution="fine"), run([], {}, "peridynamics")), 1)
        self.assertEqual(number(run([], weak), run([], strong)), 2)
        self.assertEqual(number(run(["Rock/Tensile strength={1|2} MPa"], weak, case="a"), run(
            ["Rock/Tensile strength={1|2} MPa"], strong, case="a", resolution="medium")), 1)

    def test_names(self):
        self.assertEqual(names.part("Young modulus 10 GPa, x"), "Young_modulus_10_GPa_x")
        texts = ["..", ".", "", "/", "a/b", "a/../b", "../b", "x" * 400, "x" * 401, "é" * 200]
        for name in map(names.part, texts):
            self.assertRegex(name, r"^[^/]*[^./][^/]*$")
            self.assertLess(len(name.encode()), 200)
        self.assertEqual(len(set(map(names.part, texts))), len(texts))
        self.assertEqual(names.of_decks(["/p/a/x.prm", "/p/b/x.prm", "/p/y.prm", "/q/b/x.prm"]),
                         {"/p/a/x.prm": "a/x", "/p/b/x.prm": "p/b/x", "/p/y.prm": "y", "/q/b/x.prm": "q/b/x"})

    def test_axes_that_are_shared(self):
        """Both panels of error against cost have one scale, though the right one has more points; numbers are outside."""
        rows = pandas.DataFrame({"status": ["finished"] * 3, "curve": ["a"] * 3, "resolution": ["coarse"] * 3, "problem": [0] * 3,
                                 "cpu_seconds": [1., 8., None], "unknowns": [1e3, 1e4, 1e5], "error": [0.08, 0.02, 1e-5]})
        figure = charts.error_against_cost(rows, "error", "error [%]", {"a": {"marker": "o", "linestyle": "-", "color": "k"}})
        left, right = figure.axes
        self.assertEqual(left.get_ylim(), right.get_ylim())
        self.assertLessEqual(left.get_ylim()[0], 1e-3)
        self.assertGreaterEqual(left.get_ylim()[1], 8.)
        look.plt.close(figure)
        figure, axes = look.plt.subplots(2, 3, sharex=True, sharey=True)
        axes[1, 2].remove()
        fields.numbers_outside(axes, "xy")
        figure.canvas.draw()
        for (line, column), ax in [((i, j), axes[i, j]) for i in (0, 1) for j in (0, 1, 2) if (i, j) != (1, 2)]:
            last = line == 1 or column == 2
            self.assertEqual([bool(ax.get_xlabel()), any(t.get_visible() and t.get_text() for t in ax.get_xticklabels())],
                             [last, last])
            self.assertEqual([bool(ax.get_ylabel()), any(t.get_visible() and t.get_text() for t in ax.get_yticklabels())],
                             [column == 0, column == 0])
        look.plt.close(figure)

    def test_matrix(self):
        block = study_file.Block(["mandel", "column/rod"], ["none", "peridynamics"], ["coarse", "fine"], [1, 2],
                                 {"Coupling/Scheme": ["monolithic", "undrained"], "Time/Initial step": ["1"]})
        jobs = matrix.jobs(study_file.Study("s", [block, block]))
        self.assertEqual(len(jobs), 2 * 2 * 2 * 2 * 2)
        self.assertEqual([j.case for j in jobs if not j.deck], ["mandel"] * 8)  # a hole that is said
        self.assertEqual(jobs[0].name, "mandel/none/monolithic_Initial_step_1/coarse")
        self.assertEqual(len({j.name for j in jobs}), len(jobs))

    def test_studies_that_ship(self):
        for name in study_file.shipped_names():
            jobs = matrix.jobs(study_file.read(study_file.find(name)))
            self.assertGreater(len(jobs), 1)

    def test_cost(self):
        rows = pandas.DataFrame({"status": ["finished"] * 4 + ["failed"], "curve": list("aabba"),
                                 "cpu_seconds": [1., 8., 2., 16., 0.1], "error": [0.08, 0.02, 0.03, 0.03, 0.001],
                                 "cell_size": [1., 0.5, 1., 0.5, 2.]})
        front = cost.front(cost.points(rows, "cpu_seconds", "error"))
        self.assertEqual([p[:2] for p in front], [(1., 0.08), (2., 0.03), (8., 0.02)])
        self.assertEqual([best and best[0] for _, best in cost.cheapest(rows, "error")], [1., 2., 8., None])
        orders = cost.orders(rows, "error")
        self.assertAlmostEqual(orders["a"][0][2], 2.)
        self.assertAlmostEqual(orders["b"][0][2], 0.)

    def test_estimate(self):
        job = matrix.Job("c", "m", "d", "fine", 2, (), 0.)
        checked = {"seconds": 100., "fingerprint": "new", "audit": "about 5 steps", "refused": ""}
        record = {"case": "c", "model": "m", "ranks": 1, "wall_seconds": 5., "estimate": 50., "fingerprint": "old"}
        self.assertEqual(estimate.guess(job, checked, []), (50., "--check"))
        self.assertEqual(estimate.guess(job, {**checked, "audit": "5 steps if none were longer than the first"}, []),
                         (50., "--check, at most"))
        self.assertEqual(estimate.guess(job, checked, [record, {**record, "case": "other", "wall_seconds": 50.}]),
                         (5., "earlier runs like it"))
        self.assertEqual(estimate.guess(job, checked, [{**record, "fingerprint": "new"}]),
                         (5., "an earlier run"))
        self.assertEqual(estimate.guess(job, {**checked, "seconds": None}, []), (None, ""))

    def test_a_section(self):
        """Two cubes above one another, the upper one cracked: planes between them, through one, and beyond."""
        cube = np.array([[0, 0, 0], [1, 0, 0], [1, 1, 0], [0, 1, 0], [0, 0, 1], [1, 0, 1], [1, 1, 1], [0, 1, 1]], float)
        grid = vtu.Grid(np.concatenate([cube, cube + [0, 0, 1]]), np.arange(16), np.array([8, 16]), np.array([12, 12]),
                        {"opening": np.repeat([0., 1e-3], 8)}, {})
        self.assertEqual([len(section.cut(grid, 2, at)[0]) for at in (0.5, 1., 1.7, 2.1)], [1, 2, 1, 0])
        polygons, numbers = section.cut(grid, 2, 1.7)
        self.assertEqual(list(numbers), [1])
        np.testing.assert_array_equal(polygons[0], [[0, 0], [1, 0], [1, 1], [0, 1]])
        self.assertEqual([len(section.cracked(grid, 0, 0.2)), len(section.cracked(grid, 2, 0.5))], [1, 0])
        self.assertEqual(section.plane({"Cracks/Open": "disc (0, 0, 0.5) normal (0, 0, 1) radius 25 m"}), (2, 0.5))
        self.assertEqual(section.plane({"Cracks/Open": "disc (1, 2, 3) normal (-1, 1, 0) radius 4 m"}), (2, 3.))
        self.assertEqual(section.plane({}, grid.points), (1, 0.))

    def test_the_window_of_a_fracture_that_has_closed(self):
        block = vtu.Grid(np.array([[-9., -9, 0], [9, 9, 0]]), [], [], [], {}, {})
        line = np.array([[[0., 0.], [2., 0.]]])
        self.assertEqual(fields.drawing.window_of(block, line, np.array([-1e-9])), (-0.5, 2.5, -1., 1.))

    def test_no_chart_of_what_has_failed(self):
        rows = pandas.DataFrame({"status": ["failed", "finished"], "curve": ["a", "b"], "differs": [False] * 2,
                                 "cpu_seconds": [1., 2.], "error_mean_load": [0.1, float("nan")],
                                 "error_final_load": [0.1, float("nan")]})
        self.assertEqual(report.charted(rows, [])[1], [])
        rows.loc[1, ["error_mean_load", "error_final_load"]] = 0.2
        self.assertEqual(report.charted(rows, [])[1], [("error_mean_load", "load")])

    def test_quantities_that_are_compared(self):
        self.assertIn("net_inlet_pressure", difference.QUANTITIES)
        with self.assertRaisesRegex(ResultError, "there is no study"):
            study_file.find("nowhere")


if __name__ == "__main__":
    unittest.main()
