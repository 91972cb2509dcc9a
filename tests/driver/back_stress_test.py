"""contrib/back_stress.py: the stress in situ across a plane, by the deck."""
import os
import sys
import tempfile
import unittest

ROOT = os.path.join(os.path.dirname(os.path.abspath(__file__)), "..", "..")
sys.path.insert(0, os.path.join(ROOT, "contrib"))
from back_stress import in_situ  # noqa: E402


class InSitu(unittest.TestCase):
    def compression(self, entry):
        with tempfile.TemporaryDirectory() as directory:
            with open(os.path.join(directory, "effective.prm"), "w", encoding="utf-8") as file:
                file.write(f"subsection In situ\n  set Stress = {entry}\nend\n")
            return in_situ(directory, (0.6, 0.8))

    def test_deck_without_stress(self):
        self.assertEqual(self.compression(""), 0.)

    def test_deck_with_stress(self):
        self.assertAlmostEqual(self.compression("-23 MPa, -17 MPa"), 0.36 * 23e6 + 0.64 * 17e6, delta=1e-3)
        self.assertAlmostEqual(self.compression("0, 0, -1 MPa"), 0.96e6, delta=1e-3)


if __name__ == "__main__":
    unittest.main()
