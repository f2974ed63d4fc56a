"""scripts/iteration_chart.py on tables made by hand."""

import csv
import subprocess
import tempfile
import unittest
from pathlib import Path

SCRIPT = Path(__file__).parents[2] / "scripts" / "iteration_chart.py"
RESULTS = ["Method/Element", "Method/Newton tangent", "cells", "unknowns", "seconds total",
           "peak memory MB", "volume ratio", "status", "role", "folder"]
ITERATIONS = ["step", "load factor", "iteration", "iterations so far", "residual", "target",
              "step length", "gap [m]", "volume error", "outcome"]


def history(volume_error=""):
    """A load step that failed, and one of half its size."""
    yield from ([1, 1, k, k, 10.**-k, 1e-8, 1, 0, volume_error, "failed"] for k in range(3))
    yield from ([1, 0.5, k, 3 + k, 100.**-k, 1e-8, 1, 0, volume_error, "converged"]
                for k in range(5))


class IterationChart(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.folder = Path(folder.name)
        rows = [[element, tangent, 6, 24, 1, 90, 1, "stable", "run", f"run_{element}_{tangent}"]
                for element in ("P1", "P1-P1") for tangent in ("consistent", "predicted stress")]
        self.runs = [row[-1] for row in rows]
        self.write("results.csv", RESULTS, rows)

    def write(self, name, header, rows):
        (self.folder / name).parent.mkdir(exist_ok=True)
        with open(self.folder / name, "w", newline="") as stream:
            csv.writer(stream).writerows([header, *rows])

    def run_script(self):
        return subprocess.run([SCRIPT, self.folder], capture_output=True, text=True)

    def test_residuals(self):
        for run in self.runs:
            self.write(f"{run}/iterations.csv", ITERATIONS, history())
        result = self.run_script()
        self.assertEqual((result.returncode, result.stderr), (0, ""))
        self.assertEqual([Path(line).name for line in result.stdout.split()],
                         ["residual_against_iterations.svg", "residual_against_iterations.png"])
        svg = (self.folder / "residual_against_iterations.svg").read_text()
        for words in ("P1-P1", "failed step", "Newton tangent = predicted stress"):
            self.assertIn(f"<!-- {words} -->", svg)

    def test_volume_errors(self):
        self.write(f"{self.runs[0]}/iterations.csv", ITERATIONS, history(0.002))
        result = self.run_script()
        self.assertEqual((result.returncode, result.stderr), (0, ""))
        self.assertTrue((self.folder / "volume_error_against_iterations.png").is_file())

    def test_wrong_input_is_one_line(self):
        self.refused("Output/Iterations = true")
        self.write(f"{self.runs[0]}/iterations.csv", ITERATIONS[:2], [[1, 1]])
        self.refused("iterations.csv")

    def refused(self, words):
        result = self.run_script()
        self.assertEqual(result.returncode, 1)
        self.assertEqual(len(result.stderr.splitlines()), 1, result.stderr)
        self.assertIn(words, result.stderr)


if __name__ == "__main__":
    unittest.main()
