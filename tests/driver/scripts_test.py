#!/usr/bin/python3
"""What the scripts in contrib say of directories without results and of arguments that make no sense: a
sentence and an exit status, never a traceback."""
import contextlib
import io
import json
import os
import runpy
import sys
import tempfile
import unittest
import unittest.mock

HERE = os.path.dirname(os.path.abspath(__file__))
CONTRIB = os.path.join(HERE, "..", "..", "contrib")
sys.path[:0] = [HERE]
from plot_test import write_run  # noqa: E402

OF_A_DIRECTORY = ("closure.py", "report.py", "sawtooth.py", "back_stress.py", "plot/history.py",
                  "plot/profile.py", "plot/field.py", "plot/paths.py")

# In place of the program: it has something against every deck.
PROGRAM = """#!/usr/bin/python3
import sys
print("one line")
sys.exit("no | such deck")
"""


class ScriptsTest(unittest.TestCase):
    def setUp(self):
        temporary = tempfile.TemporaryDirectory()
        self.addCleanup(temporary.cleanup)
        self.top = temporary.name
        self.addCleanup(os.chdir, os.getcwd())
        os.chdir(self.top)
        self.run_directory = os.path.join(self.top, "run")
        os.makedirs(self.run_directory)
        write_run(self.run_directory)

    def call(self, script, *arguments, status, says):
        """The output of a script, which must end with an exit status and say something."""
        # In this process, for matplotlib takes a second to be imported; any other exception is an error.
        out, code = io.StringIO(), 0
        with unittest.mock.patch.object(sys, "argv", [script, *arguments]), \
                contextlib.redirect_stdout(out), contextlib.redirect_stderr(out):
            try:
                runpy.run_path(os.path.join(CONTRIB, script), run_name="__main__")
            except SystemExit as end:
                code = end.code or 0
        if isinstance(code, str):
            print(code, file=out)
            code = 1
        text = out.getvalue()
        self.assertEqual(code, status, text)
        self.assertIn(says, text)
        return text

    def failed_run(self):
        directory = os.path.join(self.top, "failed")
        os.makedirs(directory)
        open(os.path.join(directory, "statistics.csv"), "w", encoding="utf-8").close()
        with open(os.path.join(directory, "summary.json"), "w", encoding="utf-8") as file:
            json.dump({"case": "test", "status": "failed", "reason": "Step 1 fails.", "final": {}, "errors": {}},
                      file)
        return directory

    def program(self):
        path = os.path.join(self.top, "program")
        with open(path, "w", encoding="utf-8") as file:
            file.write(PROGRAM)
        os.chmod(path, 0o755)
        return path

    def test_directories(self):
        failed = self.failed_run()
        empty = os.path.join(self.top, "empty")
        os.makedirs(empty)
        for script in OF_A_DIRECTORY:
            with self.subTest(script):
                self.call(script, "nowhere", status=1, says="there is no directory 'nowhere'")
                self.call(script, failed, status=1, says="Step 1 fails.")
        for script in ("closure.py", "report.py", "plot/field.py"):
            self.call(script, empty, status=1, says="no run has ended there")
        for script in ("report.py", "sawtooth.py"):
            self.call(script, "--help", status=0, says="usage:")

    def test_report_of_a_failure(self):
        self.call("report.py", self.failed_run(), status=1, says="status: failed. Step 1 fails.")
        self.call("report.py", self.run_directory, status=0, says="equivalent_length")

    def test_columns(self):
        for script in ("sawtooth.py", "closure.py"):
            self.call(script, self.run_directory, status=1,
                      says="has no column 'inlet_pressure'; there is: time, fracture_length")
        self.call("plot/history.py", self.run_directory, "--columns", "fracture_length,foo", status=1,
                  says="no run has the column 'foo'; there is: equivalent_length, fracture_length")

    def test_sawtooth(self):
        with open(os.path.join(self.run_directory, "statistics.csv"), "w", encoding="utf-8") as file:
            file.write("time,inlet_pressure,reference_inlet_pressure\n1,5,\n")
            file.writelines(f"{time},{5 + 0.1 * (time % 2)},5\n" for time in range(2, 9))
        self.call("sawtooth.py", self.run_directory, status=0, says="1 (median), 1 (greatest) %")

    def test_closure_says_which_step(self):
        with open(os.path.join(self.run_directory, "statistics.csv"), "w", encoding="utf-8") as file:
            file.write("time,well_1_rate,inlet_pressure,inlet_aperture\n")
            file.writelines(f"{time},{float(time < 5)},{10 - 0.1 * time},{1e-3}\n" for time in range(1, 20))
        self.call("closure.py", self.run_directory, status=0, says="shut-in at 4 s")
        self.call("closure.py", self.run_directory, "--shut-in", "6", status=0, says="shut-in at 6 s")
        text = self.call("closure.py", self.run_directory, "--shut-in", "6.9", status=0,
                         says="shut-in taken at the step at 6 s")
        self.assertIn("closure pressure (G function): not in this run", text)

    def test_fields(self):
        def field(*arguments, status, says):
            return self.call("plot/field.py", self.run_directory, *arguments, status=status, says=says)

        field("--window", "1,2", status=2, says="'1,2' is not four numbers")
        field("--window", "1,0,0,1", status=2, says="x0 < x1")
        field("--time", "99", status=0, says="drawn are those at 1 s")
        self.assertNotIn("no fields", field("--time", "1", status=0, says="pore_pressure.png"))
        field("--field", "displacement", "--component", "yy", status=1, says="has x, y and z")
        field("--component", "yy", status=1, says="is a number")
        for name in ("fields-0.vtu", "fields-1.vtu"):  # an elastic run
            path = os.path.join(self.run_directory, name)
            with open(path, encoding="utf-8") as file:
                text = file.read().replace("pore_pressure", "temperature")
            with open(path, "w", encoding="utf-8") as file:
                file.write(text)
        field(status=0, says="displacement.png")
        os.remove(os.path.join(self.run_directory, "fields.pvd"))
        field(status=1, says="has no fields.pvd")
        self.call("plot/profile.py", self.run_directory, "--times", "0", status=2, says="0 is less than 1")

    def test_campaign(self):
        program = ("--program", self.program())
        self.call("campaign.py", "--program", "nothing", status=2, says="there is no program")
        self.call("campaign.py", *program, "--km-from", "8", "--km-to", "0.5", status=2,
                  says="--km-from 8 is greater than --km-to 0.5")
        self.call("campaign.py", *program, "--km-from", "-1", status=2, says="-1 is not greater than zero")
        for n in ("0", "-3"):
            self.call("campaign.py", *program, "--n", n, status=2, says=f"{n} is less than 1")
        text = self.call("campaign.py", *program, "--n", "1", "--family", "turned", status=1,
                         says="0 of 1 right")
        self.assertIn("no | such deck", text)


if __name__ == "__main__":
    unittest.main()
