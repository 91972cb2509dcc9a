#!/usr/bin/env python3
"""Tests of the test driver: each mode must pass where it should, and fail where it should."""
import contextlib
import io
import os
import sys
import tempfile
import unittest

HERE = os.path.dirname(os.path.abspath(__file__))
sys.path.insert(0, os.path.join(HERE, ".."))
import run_case  # noqa: E402


class DriverTest(unittest.TestCase):
    def setUp(self):
        self.directory = tempfile.TemporaryDirectory()
        self.addCleanup(self.directory.cleanup)

    def drive(self, mode, deck, *arguments, message=None):
        """(exit status, what was printed) of the driver on a deck with this text."""
        path = os.path.join(self.directory.name, "deck.prm")
        with open(path, "w", encoding="utf-8") as file:
            file.write(deck)
        if message is not None:
            with open(os.path.join(self.directory.name, "deck.message"), "w",
                      encoding="utf-8") as file:
                file.write(message)
        printed = io.StringIO()
        with contextlib.redirect_stdout(printed):
            status = run_case.main(["--program", os.path.join(HERE, "fake_stockwork"),
                                    "--scratch", os.path.join(self.directory.name, "scratch"),
                                    "--mpirun", f"{os.path.join(HERE, 'fake_mpirun')}",
                                    mode, "--deck", path, *arguments])
        return status, printed.getvalue()

    def passes(self, *arguments, **named):
        status, printed = self.drive(*arguments, **named)
        self.assertEqual(status, 0, printed)
        return printed

    def fails(self, why, *arguments, **named):
        status, printed = self.drive(*arguments, **named)
        self.assertEqual(status, 1, printed)
        self.assertIn(why, printed)

    def test_expectations(self):
        for text in ("errors/y/final < 0.11", "errors/y/final <= 0.11", "final/y == 9", "steps>=3",
                     "final/y = 9.05 within 0.01", "warnings == 0", "final/y > errors/y/final"):
            self.passes("case", "steps 3", "--expect", text)
        for text in ("errors/y/final < 0.09", "final/y = 9.2 within 0.01", "warnings > 0",
                     "steps > 3", "final/y < errors/y/final"):
            self.fails(text, "case", "steps 3", "--expect", text)
        self.fails("no 'z' in errors; there is: y", "case", "", "--expect", "errors/z/final < 1")
        self.fails("is nan", "case", "nan", "--expect", "errors/y/final > 0")
        self.fails("not of the form", "case", "", "--expect", "errors/y/final 0.1")
        self.fails("belong together", "case", "", "--expect", "errors/y/final = 0.1")

    def test_warnings(self):
        self.passes("case", "warn too coarse by far", "--warns", "too coarse")
        self.fails("no warning says 'too fine'", "case", "warn too coarse", "--warns", "too fine")

    def test_exit_status(self):
        self.fails("exit status 2", "case", "status 2")

    def test_stop(self):
        self.passes("stop", "status 2")
        self.fails("exit status 0, should be 2", "stop", "")
        self.fails("does not say", "stop", "status 2", "--says", "no way on")

    def test_steps(self):
        self.passes("steps", "steps 40\nslow")
        self.passes("steps", "steps 1")
        self.fails("exit status 2", "steps", "status 2")

    def test_negative(self):
        bound = ("--expect", "errors/y/final < 0.11", "--negative")
        self.passes("case", "", *bound)
        self.fails("off by twice the bound", "case", "blind", *bound)
        self.fails("--negative needs", "case", "", "--expect", "steps == 3", "--negative")

    def test_order(self):
        series = ("--series", "Mesh/Size=1", "--series", "Mesh/Size=0.5")
        self.passes("order", "", *series, "--order", "errors/y/final=2")
        self.fails("order 2.00, expected 3", "order", "", *series, "--order", "errors/y/final=3")

    def test_same(self):
        self.passes("same", "", "--ranks", "1,2")
        self.passes("same", "noise 1e-9", "--second-set", "Again=1")
        self.fails("column y", "same", "noise 1e-7", "--second-set", "Again=1")
        self.fails("3 against 4 values", "same", "", "--second-set", "Time/Steps=4")
        in_time = ("--in-time", "y", "--second-set", "Time/Steps=4", "--second-set", "Again=1")
        self.passes("same", "noise 1e-9", *in_time)
        self.fails("y: at 3 s", "same", "noise 1e-7", *in_time)

    def test_restart(self):
        early = ("--interrupt-set", "Time/Steps=2")
        self.passes("restart", "steps 5", *early)
        self.fails("column y", "restart", "steps 5\nnoise 1e-3", *early)
        self.passes("restart", "steps 40\nslow", "--interrupt-after", "3")
        self.fails("reached its end", "restart", "steps 3", "--interrupt-after", "9")

    def test_error(self):
        deck = "bad deck.prm:1: Poisson's ratio is 0.7, must be below 0.5"
        self.passes("error", deck, message="ratio is 0.7,\nmust be below 0.5\n")
        self.fails("does not say", "error", deck, message="must be below 0.4")
        self.fails("where the mistake was read", "error", "bad ratio is 0.7", message="0.7")
        self.fails("exit status 3", "error", deck + "\nstatus 3", message="0.7")
        self.fails("exit status 0", "error", "steps 3", message="0.7")
        self.fails("left an output directory", "error", deck + "\nlate", message="0.7")
        self.fails("is empty", "error", deck, message="\n")


if __name__ == "__main__":
    unittest.main()
