#!/usr/bin/python3
"""Tests of stockwork-study: a program that costs nothing stands in for the real one.

    study_test.py [PROGRAM]    with the real one as well, and its page in a browser if there is one
"""
import base64
import contextlib
import html.parser
import io
import json
import os
import re
import shutil
import signal
import subprocess
import sys
import tempfile
import time
import unittest
import unittest.mock

HERE = os.path.dirname(os.path.abspath(__file__))
CONTRIB = os.path.join(HERE, "..", "..", "contrib")
sys.path[:0] = [CONTRIB]
import pandas  # noqa: E402

from study import charts, names  # noqa: E402
from study.command import main  # noqa: E402

PROGRAM = os.path.abspath(sys.argv.pop(1)) if len(sys.argv) > 1 and os.path.exists(sys.argv[1]) else None
TOOL = os.path.join(CONTRIB, "stockwork-study")

# y = t with an error h^2/100 of the model "good"; "bad" fails on its way, "slow" does not end. Young's modulus is a factor.
STAND_IN = """#!/usr/bin/python3
import json, os, sys, time
deck = open(sys.argv[1]).read().split()[0]
settings = dict(a.split("=", 1) for a in sys.argv if "=" in a)
h = {"coarse": 1., "medium": 0.5, "auto": 0.5}[settings.get("Resolution", "coarse")]
if "Rock/Yung modulus" in settings:
    print("  an audit\\ncommand line: there is no entry 'Rock/Yung modulus'\\n    there is: 'Young modulus'")
    sys.exit(1)
if "--check" in sys.argv:
    print("Scene audit\\n  a number  7  decides\\n about 5 steps would take 2 s on one core")
else:
    output = sys.argv[sys.argv.index("--output") + 1]
    open(os.path.join(os.path.dirname(sys.argv[1]), "started"), "a").write(deck + " ")
    if deck == "slow":
        print("on its way", flush=True)
        while True:
            pass
    failed = deck == "bad"
    error = {"final": h * h / 100, "mean": h * h / 50, "reference": "Thought of (2026)"}
    text = {"case": "case/" + deck, "fracture_model": deck, "status": "failed" if failed else "finished", "cells": 1 / h**2,
            "reason": "Step 3 <fails>." if failed else "", "unknowns": 4 / h**2, "steps": 5, "cpu_seconds": 0.1 / h**2,
            "errors": {} if failed or "No reference" in settings else {"inlet_aperture": error}, "final": {},
            "warnings": ["Mind the gap."]}
    json.dump(text, open(output + "/summary.json", "w"))
    with open(output + "/statistics.csv", "w") as file:
        file.write("time,inlet_aperture\\n")
        factor = (1 + h / 10) * float(settings.get("Rock/Young modulus", "1 GPa").split()[0])
        file.writelines(f"{t},{t * factor}\\n" for t in range(1, 4 if failed else 6))
    with open(output + "/effective.prm", "w") as file:
        for entry, value in settings.items():
            *sections, name = entry.split("/")
            file.writelines(f"subsection {s}\\n" for s in sections)
            file.write(f"set {name} = {'medium' if value == 'auto' else value} # default:\\n" + "end\\n" * len(sections))
    sys.exit(2 if failed else 0)
"""


def toml(value):
    if isinstance(value, dict):
        return "{" + ", ".join(f"{json.dumps(k)} = {toml(v)}" for k, v in value.items()) + "}"
    return "[" + ", ".join(map(toml, value)) + "]" if isinstance(value, list) else json.dumps(value)


class Elements(html.parser.HTMLParser):
    def __init__(self, text):
        super().__init__()
        self.images, self.ids, self.links = [], [], []
        self.feed(text)

    def handle_starttag(self, tag, attributes):
        attributes = dict(attributes)
        if tag == "img":
            self.images.append(attributes)
        if "id" in attributes:
            self.ids.append(attributes["id"])
        self.links += [v for k, v in attributes.items() if k in ("src", "href") and tag != "img"]


class InADirectory(unittest.TestCase):
    def setUp(self):
        temporary = tempfile.TemporaryDirectory()
        self.addCleanup(temporary.cleanup)
        self.addCleanup(os.chdir, os.getcwd())
        self.top = temporary.name
        os.chdir(self.top)

    def file(self, name, text, mode=0o644):
        path = os.path.join(self.top, name)
        with open(path, "w", encoding="utf-8") as file:
            file.write(text)
        os.chmod(path, mode)
        return path

    def call(self, *arguments, status):
        """What the tool says, here in this process, for it takes two seconds to import what draws."""
        said, code = io.StringIO(), 0
        with unittest.mock.patch.object(sys, "argv", ["stockwork-study", *arguments]), \
                contextlib.redirect_stdout(said), contextlib.redirect_stderr(said), \
                unittest.mock.patch("study.progress.Progress.__init__.__defaults__", (said,)):
            try:
                main()
            except SystemExit as end:
                code = end.code or 0
        text = said.getvalue() + (code if isinstance(code, str) else "")
        self.assertEqual(1 if isinstance(code, str) else code, status, text)
        return text

    def page(self, folder):
        """The page, which must have every section, and every picture in it, and want nothing from elsewhere."""
        with open(os.path.join(folder, "index.html"), encoding="utf-8") as file:
            text = file.read()
        found = Elements(text)
        self.assertEqual(found.ids, ["map", "problem", "verdict", "assumptions", "repeat"] if "map" in found.ids else
                         ["problem", "verdict", "cost", "results", "assumptions", "repeat"])
        for image in found.images:
            self.assertTrue(image["alt"])
            kind, data = image["src"].split(",", 1)
            self.assertEqual(kind, "data:image/png;base64")
            self.assertTrue(base64.b64decode(data, validate=True).startswith(b"\x89PNG"))
        for link in found.links:
            self.assertRegex(link, "^(#|data:,)")
        for kind in ("png", "svg"):
            self.assertEqual(sum(name.endswith(kind) for name in os.listdir(folder)), len(found.images))
        return text, found


class WithStandIn(InADirectory):
    def setUp(self):
        super().setUp()
        self.program = self.file("program", STAND_IN, 0o755)
        for model in ("good", "bad", "slow"):
            self.file(model + ".prm", model)

    def study(self, *decks, **entries):
        entries = {"cases": list(decks), **entries}
        return self.file("study.toml", "".join(f"{k} = {toml(v)}\n" for k, v in entries.items()))

    def started(self):
        with open("started", encoding="utf-8") as file:
            return file.read().split()

    def directory(self, name, deck="good.prm", *settings, status=0):
        """A run that no study has made."""
        os.makedirs(name)
        sets = [a for setting in ("No reference=true", *settings) for a in ("--set", setting)]
        done = subprocess.run([self.program, deck, "--output", name, *sets], check=False)
        self.assertEqual(done.returncode, status)

    def table(self, folder):
        return pandas.read_csv(folder + "/results.csv").fillna("").set_index(["variant", "asked"])


class Drawn(WithStandIn):
    def test_run_resumed_and_reported(self):
        study = self.study("good.prm", "bad.prm", resolutions=["coarse", "medium"])
        command = ("run", study, "--program", self.program, "--output", "out", "--cores", "1")
        text = self.call(*command, "--estimate", status=0)
        self.assertIn("4 runs, 4 of them to do: about 8 s on 1 core(s) (4 by --check)", text)
        self.assertFalse(os.path.exists("started"))
        text = self.call(*command, status=1)
        self.assertEqual(self.started(), ["good", "good", "bad", "bad"])
        self.assertIn("FAILED: Step 3 <fails>.", text)
        page, found = self.page("out/report")
        self.assertIn("Step 3 &lt;fails&gt;.", page)
        self.assertIn("Thought of (2026)", page)
        self.assertIn("<td>2.00</td>", page)  # the order of h^2
        self.assertIn("<td>a number</td><td>7</td><td>decides</td>", page)
        self.assertIn("warning: Mind the gap. (2 of 2 runs", page)
        self.assertGreaterEqual(len(found.images), 2)  # error against cost, histories
        table = pandas.read_csv("out/report/results.csv")
        self.assertEqual(list(table["status"]), ["finished", "finished", "failed", "failed"])
        self.assertEqual(list(table["error_mean_inlet_aperture"][:2]), [0.02, 0.005])

        text = self.call(*command, status=1)  # nothing is left to do, and what failed is still known
        self.assertIn("4 runs, 0 of them to do", text)
        self.assertEqual(len(self.started()), 4)
        self.file("part.prm", "")
        self.file("bad.prm", "good\ninclude part.prm\n")
        self.assertIn("2 of them to do (2 again, for the deck has changed)", self.call(*command, "--estimate", status=0))
        self.call(*command, status=0)
        self.assertEqual(self.started()[4:], ["good", "good"])
        self.file("part.prm", "# changed")
        self.assertIn("2 of them to do (2 again", self.call(*command, "--estimate", status=0))
        self.file("part.prm", "")
        self.assertIn("0 of them to do", self.call(*command, "--estimate", status=0))
        self.assertIn("by an earlier run", self.call(*command, "--again", "all", "--estimate", status=0))

    def test_killed_and_continued(self):
        command = ("run", self.study("good.prm", "slow.prm"), "--program", self.program, "--output", "out",
                   "--cores", "1")
        with subprocess.Popen([sys.executable, TOOL, *command], stderr=subprocess.PIPE, text=True) as tool:
            while not (os.path.exists("started") and "slow" in self.started()):
                time.sleep(0.02)
            tool.send_signal(signal.SIGTERM)
            self.assertIn("the same command goes on", tool.communicate(timeout=20)[1])
        self.assertEqual(tool.returncode, 130)
        self.file("slow.prm", "good")
        self.assertIn("2 runs, 1 of them to do", self.call(*command, status=0))
        self.assertEqual(self.started(), ["good", "slow", "good"])

    def test_map(self):
        study = self.file("study.toml", 'cases = ["good.prm"]\n[set]\nX = [1, 2, 3]\nY = [0.1, 1e-2, 1e-3]\n')
        self.call("run", study, "--program", self.program, "--output", "out", status=0)
        self.assertIn("good, good: which runs end, and with what error", self.page("out/report")[0])

    def test_map_of_a_number(self):
        text = ('cases = ["good.prm", "bad.prm"]\n[set]\nX = [1, 2]\n[map]\nx = "X"\ny = "case"\n'
                'measure = "errors/inlet_aperture/mean"\nlimit = 0.01\n')
        command = ("run", self.file("study.toml", text), "--program", self.program, "--output", "out", "--map", "map.png")
        self.call(*command, status=1)
        self.assertTrue(os.path.getsize("map.png") > 1000)
        with open("out/report/map.svg", encoding="utf-8") as file:
            drawn = file.read()
        for label in ("fails", "0.02", "good", "bad"):
            self.assertIn(f"<!-- {label} -->", drawn)
        self.assertIn("hatched where it fails: more than 0.01, or the run did not end", self.page("out/report")[0])
        self.file("study.toml", text.replace("errors/inlet_aperture/mean", "final/depth"))
        self.assertIn("the map shows 'final/depth', but", self.call(*command, status=1))

    def test_time_limit_and_too_many_ranks(self):
        text = self.call("run", self.study("slow.prm", time_limit=1), "--program", self.program, "--output", "a",
                         status=1)
        self.assertIn("Ended by the time limit of the study, 1 s.", text)
        text = self.call("run", self.study("good.prm", ranks=[2]), "--program", self.program, "--output", "b",
                         "--cores", "1", status=1)
        self.assertIn("2 ranks need as many cores; 1 were given", text)
        self.assertIn("1 runs, 1 of them to do", self.call("run", "study.toml", "--program", self.program, "--output", "b",
                                                           "--cores", "1", "--estimate", status=0))

    def test_finished_directories(self):
        for name, resolution in (("one", "coarse"), ("two", "medium")):
            os.makedirs(name)
            subprocess.run([self.program, "good.prm", "--output", name, "--set", "Resolution=" + resolution,
                            "--set", "No reference=true"], check=True)
        text = self.call("report", "one", "two", "--output", "page", status=0)
        self.assertRegex(text, r"case\n\nmodel .*\ngood +coarse +finished +4.8 \(2.9\)")  # 0.05 t of 5.25; the mean of t is 3
        self.assertIn("No reference: what is shown are differences to the run that is named", self.page("page")[0])
        self.call("run", self.study("good.prm", title="A title", quantities=["inlet_aperture"]), "--program", self.program,
                  "--output", "out", status=0)
        self.call("report", "out", "--output", "titled", status=0)
        self.assertIn("<h1>A title</h1>", self.page("titled")[0])
        self.call("report", "out", "--into", "doc/page", status=0)
        with open("doc/page.md", encoding="utf-8") as file:
            text = file.read()
        self.assertTrue(text.startswith("# A title\n\n## The runs\n"), text)
        self.assertIn("| good |  | finished | 1 (2) | 4 | 5 | 0.1 |", text)
        self.assertIn("(page.png)", text)
        self.assertTrue(os.path.exists("doc/page.png"))
        self.file("doc/page.md", text.replace("A title", "By hand"))
        self.call("report", "out", "--into", "doc/page.md", status=0)
        with open("doc/page.md", encoding="utf-8") as file:
            self.assertEqual(file.read(), text.replace("A title", "By hand"))
        self.assertIn("no run has an error of 'foo'", self.call(
            "run", self.study("good.prm", quantities=["foo"]), "--program", self.program, "--output", "out", status=1))
        self.assertIn("there is no directory 'three'", self.call("report", "three", status=1))
        os.makedirs("empty")
        self.assertIn("no run has ended in 'empty'", self.call("report", "empty", status=1))
        self.assertIn("no run has an error of 'foo'; there is: inlet_aperture",
                      self.call("report", "one", "two", "--quantities", "foo", status=1))

    def test_what_makes_no_sense(self):
        for text, says in (("cases = [", "Invalid value"), ("title = 'x'", "no cases are named"),
                           ("case = ['a']", "the study has no entry 'case'; there is: title"),
                           ("cases = 'a'", "cases = 'a', but it is a list of texts"),
                           ("cases = ['../x']", "is not a case below"),
                           ("cases = ['good.prm']\nranks = [0]", "a list of whole numbers from 1"),
                           ("cases = ['good.prm', 'good.prm']", "names something twice"),
                           ("cases = ['good.prm']\ntime_limit = 'x'", "a number of seconds"),
                           ("cases = ['good.prm']\nmodels = ['damage']",
                            "'good.prm' is a deck of one's own, which names its model itself: leave 'models' out, or"),
                           ("cases = ['mandel']\nmodels = []", "models = [], but the list may not be empty; leave 'models'"),
                           ("cases = []", "the list may not be empty"),
                           ("cases = ['nothing']", "there is no case 'nothing'"),
                           ("cases = ['good.prm']\n[map]\nx = 'case'", "[map] has no 'y'"),
                           ("cases = ['good.prm']\n[map]\nx = 'case'\ny = 'A/B'\nmeasure = 'steps'",
                            "x = 'case', which is not varied; there is: nothing"),
                           ("cases = ['good.prm']\n[set]\nX = [1, 2]\n[map]\nx = 'X'\ny = 'A/B'\nmeasure = 'steps'",
                            "y = 'A/B', which is not varied; there is: X"),
                           ("cases = ['good.prm']\n[set]\nX = [1, 2]\n[map]\nx = 'X'\ny = 'X'\nmeasure = 'steps'",
                            "the same entry, 'X', for x and for y"),
                           ("cases = ['good.prm']\n[set]\nX = [1, 2]\n[map]\nx = 'X'\ny = 'case'\nmeasure = 'stepps'",
                            "measure = 'stepps', but a number's name begins with one of: cells"),
                           ("cases = ['good.prm']\n[map]\nx = 'case'\ny = 'case'\nmeasure = 1", "are texts"),
                           ("cases = ['good.prm']\nmap = 1", "below [map]"),
                           ("cases = ['nothing.prm']", "there is no deck 'nothing.prm'"),
                           ("cases = ['good.prm']\n[set]\n'A/B' = []", "a value or a list of values"),
                           ("cases = ['mandel']\nmodels = ['dammage']", "there is: none")):
            with self.subTest(text):
                path = self.file("wrong.toml", text)
                self.assertIn(says, self.call("run", path, "--program", self.program, status=1))
        self.assertIn("there is no study 'nowhere'; those that ship: consolidation", self.call("run", "nowhere", status=1))
        self.assertIn("no runs at the resolutions fine", self.call(
            "run", self.study("good.prm"), "--resolutions", "fine", "--program", self.program, status=1))
        self.call("run", "nowhere", "--program", "nothing", status=2)
        self.call("run", "nowhere", "--cores", "0", status=2)

    def test_rows_are_told_apart(self):
        """A setting with one value in each product of runs is what differs."""
        text = "".join(f'[[runs]]\ncases = ["good.prm"]\nset = {{ "Time/End time" = "{t} s", X = 1 }}\n' for t in (5, 20))
        study = self.file("study.toml", text)
        said = self.call("run", study, "--program", self.program, "--output", "out", status=0)
        for variant in ("End time 5 s", "End time 20 s"):
            self.assertRegex(said, rf"\ngood +{variant} +finished")
            with open("out/report/good_history.svg", encoding="utf-8") as file:
                self.assertIn(f"<!-- good, {variant} -->", file.read())
        page = self.page("out/report")[0]
        for time in ("5 s", "20 s"):  # what differs between the decks
            self.assertIn(f"<tr><td>good, End time {time}</td><td>{time}</td></tr>", page)
        study = self.study("good.prm", set={"Rock/Young modulus": "1 GPa", "Rock/Region 1/Young modulus": ["1 GPa", "2 GPa"]},
                           runs=[{}, {"set": {"Rock/Young modulus": "2 GPa"}}])
        self.call("run", study, "--program", self.program, "--output", "two", status=0)
        self.assertEqual(self.table("two/report").index.nunique(), 4)


class Undrawn(WithStandIn):
    """Pages without their pictures, which are what takes time."""
    def setUp(self):
        super().setUp()
        names = ("error_against_cost", "all_cases", "history", "profiles", "paths")
        patched = unittest.mock.patch.multiple(charts, **{name: lambda *_: None for name in names})
        patched.start()
        self.addCleanup(patched.stop)

    def test_one_stand_in_for_each_problem(self):
        """Young's modulus makes another problem, the end time too, the resolution and the solver do not."""
        study = self.study("good.prm", resolutions=["coarse", "medium"], set={
            "Rock/Young modulus": ["10 GPa", "20 GPa"], "No reference": "true", "Linear solver/Type": "direct"})
        text = self.call("run", study, "--program", self.program, "--output", "out", status=0)
        self.assertRegex(text, r"Young modulus 10 GPa +coarse +finished +4.8 \(2.9\) +good, Young modulus 10 GPa, medium")
        self.assertRegex(text, r"Young modulus 10 GPa +medium +finished +stands in")
        self.assertIn("These runs solve 2 physical problems", self.page("out/report")[0])
        self.assertRegex(text, r"Young modulus 20 GPa +coarse +finished +4.8 \(2.9\) +good, Young modulus 20 GPa, medium")
        study = self.study("good.prm", set={"Rock/Young modulus": ["10 GPa", "20 GPa"], "No reference": "true"})
        self.call("run", study, "--program", self.program, "--output", "alone", status=0)
        self.assertIn("no reference, and no two runs of the same physical problem", self.page("alone/report")[0])
        self.assertNotIn("error_end_inlet_aperture", pandas.read_csv("alone/report/results.csv").columns)

    def test_problems_of_finished_directories(self):
        self.directory("a", "good.prm", "Wells/Well 1/Rate=2e-4 m^2/s", "Mesh/Box/X spacing=1 m")
        self.directory("b", "good.prm", "Wells/Well 1/Rate=0.0002 m^2/s", "Time/Initial step=1 s", "Resolution=medium")
        self.directory("c", "good.prm", "Wells/Well 1/Rate=4e-4 m^2/s", "Resolution=medium", "Fracture/Model=good")
        text = self.call("report", "a", "b", "c", "--output", "page", status=0)
        self.assertEqual(self.table("page")["against"].to_dict(), {
            ("a", ""): "good, b, medium", ("b", "medium"): "stands in", ("c", "medium"): "no other finished run of this problem"},
            text)
        self.assertIn("Nothing is shown of good, c, medium: no other run of the same problem has finished", self.page("page")[0])

    def test_the_time_of_an_error_at_the_end(self):
        """A run that stopped at 3 s is measured there, and this is said."""
        self.directory("good_one")
        self.directory("bad_one", "bad.prm", "Resolution=medium", status=2)
        text = self.call("report", "good_one", "bad_one", "--output", "page", status=0)
        self.assertRegex(text, r"bad .* 2.7 at 3 s \(\S+\) +good")

    def test_values_are_no_paths(self):
        values = ["x/../../../../../../esc1", "../../../../../../esc2", "x_.._.._.._.._.._.._esc1", "a/b", "a b", "a_b", ".."]
        study = self.study("good.prm", set={"Title": values})
        before = set(os.listdir(self.top))
        self.call("run", study, "--program", self.program, "--output", "1/2/3/out", status=0)
        self.assertEqual(set(os.listdir(self.top)) - before, {"1", "started"})
        self.assertEqual(os.listdir("1/2/3"), ["out"])
        self.assertEqual(len(os.listdir("1/2/3/out/good/deck")), len(values))
        self.assertEqual(self.table("1/2/3/out/report").index.nunique(), len(values))
        # What an older tool has made of 'a/b' is taken up.
        found = names.part("a/b")
        os.makedirs("1/2/3/out/good/deck/a")
        os.rename(f"1/2/3/out/good/deck/{found}", "1/2/3/out/good/deck/a/b")
        self.assertIn("0 of them to do", self.call("run", study, "--program", self.program, "--output", "1/2/3/out", status=0))
        self.assertTrue(os.path.exists(f"1/2/3/out/good/deck/{found}/default/run.json"))

    def test_one_study_at_a_time(self):
        command = ("run", self.study("good.prm"), "--program", self.program, "--output", "out")
        holder = f"import sys; sys.path.insert(0, {CONTRIB!r}); from study.place import held\n" \
                 "with held('out'):\n    print('held', flush=True); input()"
        with subprocess.Popen([sys.executable, "-c", holder], stdin=subprocess.PIPE, stdout=subprocess.PIPE, text=True) as other:
            self.assertEqual(other.stdout.readline(), "held\n")
            self.assertIn("another study is running in", self.call(*command, status=1))
            self.assertFalse(os.path.exists("started"))
            other.kill()
        self.call(*command, status=0)  # the lock of the dead does not count

    def test_decks_of_one_name(self):
        for folder in ("a", "b"):
            os.makedirs(folder)
            self.file(folder + "/good.prm", "good")
        self.call("run", self.study("a/good.prm", "b/good.prm"), "--program", self.program, "--output", "out", status=0)
        self.assertEqual(self.table("out/report")["case"].tolist(), ["a/good", "b/good"])
        self.assertTrue(os.path.exists("out/b/good/deck/as_in_the_deck/default/run.json"))

    def test_what_the_program_refuses(self):
        wrong = self.study("good.prm", set={"Rock/Yung modulus": ["1 GPa", "2 GPa"]})
        for more in ((), ("--estimate",)):
            text = self.call("run", wrong, "--program", self.program, "--output", "out", *more, status=1)
            self.assertIn("the program refuses all 2 runs:\n  command line: there is no entry 'Rock/Yung modulus' there is: "
                          "'Young modulus' (", text)
            self.assertFalse(os.path.exists("started"))
        some = self.study("good.prm", runs=[{}, {"set": {"Rock/Yung modulus": 1}}])
        self.assertIn("refuses 1 of 2 runs", self.call("run", some, "--program", self.program, "--output", "out", "--estimate",
                                                       status=1))
        self.assertIn("FAILED: command line: there is no entry", self.call("run", some, "--program", self.program, "--output",
                                                                         "out", status=1))

    def test_quantities_that_no_run_has(self):
        command = ("run", self.study("good.prm", quantities=["inlet_aperture", "lenght"]), "--program", self.program,
                   "--output", "out")
        self.assertIn("no run has an error of 'lenght'; there is: inlet_aperture", self.call(*command, status=1))
        self.assertIn("no run has an error of &#x27;lenght&#x27;; there is: inlet_aperture", self.page("out/report")[0])
        self.assertIn("'lenght'", self.call(*command, "--again", "all", status=1))  # now it is known before
        self.assertEqual(self.started(), ["good"])
        # A model that has not run yet may have it.
        self.study("good.prm", "bad.prm", quantities=["lenght"])
        self.call(*command, status=1)
        self.assertEqual(self.started(), ["good", "bad"])

    def test_what_has_not_run_is_listed(self):
        self.call("run", self.study("good.prm", resolutions=["coarse", "medium"]), "--program", self.program, "--output", "out",
                  status=0)
        os.remove("out/good/deck/as_in_the_deck/medium/run.json")  # as if it had been interrupted
        text = self.call("report", "out", "--into", "page", status=0)
        self.assertRegex(text, r"medium +not run\n")
        with open("page.md", encoding="utf-8") as file:
            self.assertIn("2 runs (coarse, medium), 0 of them failed, 1 not run; ", file.read())
        self.assertEqual(pandas.read_csv("out/report/results.csv")["status"].tolist(), ["finished", "not run"])
        self.page("out/report")

    def test_outputs_that_cannot_be(self):
        study = self.study("good.prm")
        self.file("afile", "")
        for output in ("afile", "afile/below", "/proc/nothing"):
            self.assertIn(f"nothing can be written into '{os.path.abspath(output)}': ",
                          self.call("run", study, "--program", self.program, "--output", output, status=1))
        self.call("run", study, "--program", self.program, "--output", "out", status=0)
        for option in ("--output", "--into"):
            self.assertIn("nothing can be written into 'afile", self.call("report", "out", option, "afile/x", status=1))

    def test_a_resolution_that_was_chosen(self):
        text = self.call("run", self.study("good.prm", resolutions=["coarse", "auto"]), "--program", self.program, "--output",
                         "out", status=0)
        self.assertRegex(text, r"good +auto: medium +finished")


@unittest.skipUnless(PROGRAM, "no program given")
class Real(InADirectory):
    def test_a_run_that_fails_and_one_that_does_not(self):
        study = self.file("splits.toml", 'cases = ["mandel"]\nresolutions = ["coarse"]\n[set]\n'
                          '"Coupling/Scheme" = ["monolithic", "drained"]\n"Time/End time" = "600"\n')
        text = self.call("run", study, "--program", PROGRAM, "--output", "out", status=1)
        self.assertRegex(text, "none +drained +coarse +FAILED: ")
        self.assertIn("this split diverges above 1", text)
        table = pandas.read_csv("out/report/results.csv")
        self.assertLess(table["error_mean_pore_pressure"][0], 0.05)
        self.assertIn("coupling strength alpha^2 M / K_dr", self.page("out/report")[0])
        browser = next(filter(None, map(shutil.which, ("chromium", "chromium-browser", "google-chrome"))), None)
        if browser is None:
            self.skipTest("no browser on this machine: the page was only parsed")
        for width in (1200, 500):
            self.seen(browser, "out/report/index.html", width)

    def seen(self, browser, path, width):
        """A browser shows every picture, nothing sticks out, and nothing is fetched."""
        with open(path, encoding="utf-8") as file:
            page = file.read()
        script = ("<script>onload = () => { const i = [...document.images]; document.title = 'seen ' + i.filter(x => "
                  "x.naturalWidth > 100).length + '/' + i.length + ' ' + (document.documentElement.scrollWidth <= "
                  "innerWidth) + ' ' + performance.getEntriesByType('resource').filter(r => !r.name.startsWith('data:'))"
                  ".length; }</script></body>")
        copy = self.file("looked_at.html", page.replace("</body>", script))
        dom = subprocess.run([browser, "--headless", "--no-sandbox", "--disable-gpu", f"--user-data-dir={self.top}/browser",
                              f"--window-size={width},1000", "--dump-dom", "file://" + copy], check=True, text=True,
                             stdout=subprocess.PIPE, stderr=subprocess.DEVNULL, timeout=60).stdout
        title = re.search("<title>(.*?)</title>", dom)[1]
        found = re.fullmatch(r"seen (\d+)/(\d+) true 0", title)
        self.assertTrue(found and found[1] == found[2] and int(found[1]) > 3, title)


if __name__ == "__main__":
    unittest.main()
