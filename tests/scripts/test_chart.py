"""scripts/chart.py on tables made by hand: which charts appear, and what a wrong table is told."""

import csv
import subprocess
import tempfile
import unittest
from pathlib import Path

SCRIPT = Path(__file__).parents[2] / "scripts" / "chart.py"
COSTS = ["cells", "unknowns", "load steps", "newton iterations", "factorisations",
         "krylov iterations", "seconds mesh", "seconds set-up", "seconds assembly",
         "seconds factorisation", "seconds solve", "seconds output", "seconds total",
         "peak memory MB"]
LAST = ["volume ratio", "min J", "min angle [deg]", "negative pivots excess", "status", "reason",
        "role"]
PROBE = ["tip y [m]", "tip y [m] error", "tip y [m] reference uncertainty"]
ERRORS = {"P1": {"0.3": 0.08, "0.4999": None}, "P1-P1": {"0.3": 0.06, "0.4999": 0.07},
          "P2-P1": {"0.3": 0.01, "0.4999": 0}}


def rows():
    for method, errors in ERRORS.items():
        for nu, error in errors.items():
            value = "" if error is None else -0.4 * (1 - error)
            yield ([method, nu, 600, 450, 4, 20, 20, 0] + [0.1] * 6 + [3.5, 90]
                   + [value, "" if error is None else -error, 1e-3]
                   + [1, 1, 30, 0, "failed" if error is None else "converged", "", "run"])
    for nu in ("0.3", "0.4999"):
        yield (["P3-P2", nu, 9000, 60000, 4, 20, 20, 0] + [1] * 6 + [60, 900]
               + [-0.4, 0, 1e-3] + [1, 1, 30, 0, "converged", "", "reference"])


class Chart(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.folder = Path(folder.name) / "cantilever"
        self.folder.mkdir()
        self.header = ["Method/Element", "Scene/Poisson ratio"] + COSTS + PROBE + LAST

    def write(self, header, table):
        with open(self.folder / "results.csv", "w", newline="") as stream:
            csv.writer(stream).writerows([header, *table])

    def run_script(self):
        return subprocess.run([SCRIPT, self.folder], capture_output=True, text=True)

    def refused(self, *words):
        """One line on standard error that holds these words."""
        result = self.run_script()
        self.assertEqual(result.returncode, 1)
        self.assertEqual(len(result.stderr.splitlines()), 1, result.stderr)
        for word in words:
            self.assertIn(word, result.stderr)

    def test_study(self):
        self.write(self.header, rows())
        result = self.run_script()
        self.assertEqual((result.returncode, result.stderr), (0, ""))
        for name in ("error_against_poisson_ratio", "value_against_poisson_ratio",
                     "error_against_seconds", "error_against_unknowns"):
            for ending in ("png", "svg"):
                file = self.folder / f"tip_y_{name}.{ending}"
                self.assertIn(str(file), result.stdout)
                self.assertGreater(file.stat().st_size, 10000)
        # Standard error and return code say nothing of a chart that forgot the failed run.
        svg = (self.folder / "tip_y_error_against_poisson_ratio.svg").read_text()
        self.assertIn("<!-- failed -->", svg)
        self.assertIn("<!-- 0.4999 -->", svg)

    def test_several_parameters_make_panels(self):
        header = self.header[:2] + ["Scene/Mesh size"] + self.header[2:]
        self.write(header, [row[:2] + [h] + row[2:] for row in rows() for h in (0.05, 0.025)])
        result = self.run_script()
        self.assertEqual((result.returncode, result.stderr), (0, ""))
        svg = (self.folder / "tip_y_error_against_mesh_size.svg").read_text()
        self.assertIn("ν = 0.3", svg)
        self.assertIn("ν = 0.4999", svg)

    def test_all_failed(self):
        place = self.header.index("status")
        table = [row[:place] + ["failed"] + row[place + 1:] for row in rows()]
        self.write(self.header, table)
        result = self.run_script()
        self.assertEqual((result.returncode, result.stderr), (0, ""))

    def test_nothing_varies(self):
        self.write(self.header, [next(rows())])
        result = self.run_script()
        self.assertEqual((result.returncode, result.stderr), (0, ""))
        self.assertIn("no chart", result.stdout)

    def test_no_table(self):
        self.refused("results.csv", "No such file")

    def test_another_table(self):
        self.write(["x", "y"], [[1, 2]])
        self.refused("no column named 'cells'")

    def test_no_run(self):
        self.write(self.header, [])
        self.refused("holds no run")

    def test_torn_row(self):
        self.write(self.header, [*rows(), ["P1", "0.3"]])
        self.refused("row 10")


if __name__ == "__main__":
    unittest.main()
