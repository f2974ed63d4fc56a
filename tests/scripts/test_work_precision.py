"""scripts/work_precision.py and cost_and_accuracy.py on tables made by hand: what counts as the cheapest
run, which points are on the Pareto front, what the chart shows, what a wrong table is told."""

import csv
import subprocess
import sys
import tempfile
import unittest
from pathlib import Path

SCRIPTS = Path(__file__).parents[2] / "scripts"
sys.path.insert(0, str(SCRIPTS))
sys.dont_write_bytecode = True

from cost_and_accuracy import (assured_errors, cheapest_rows, pareto_front,  # noqa: E402
                               probe_with_error, problems)
from results_table import Study  # noqa: E402

HEADER = ["Scene/Mesh size", "Method/Element", "cells", "unknowns", "seconds total",
          "peak memory MB", "tip [m]", "tip error", "tip reference uncertainty", "lid [m]",
          "lid error", "volume ratio", "status", "reason", "role"]
SIZES = {"0.4": 100, "0.2": 1000, "0.1": 10000}  # cells
# Errors on the three meshes, coarse to fine. P1 crosses zero on the middle one.
ERRORS = {"P1": [0.2, 0.0005, 0.05], "P2": [0.08, 0.02, 0.004], "P3": [0.025, 0.002, None]}
COST = {"P1": 1, "P2": 3, "P3": 10}


def row(size, element, error, uncertainty=0.002):
    unknowns = SIZES[size] * COST[element]
    return [size, element, SIZES[size], unknowns, unknowns / 1000, 90, "" if error is None else 1 - error,
            "" if error is None else error, "" if error is None else uncertainty, 3, "", 1,
            "not converged" if error is None else "stable", "", "run"]


def rows(errors=None, **more):
    return [row(size, element, error, **more) for element, line in (errors or ERRORS).items()
            for size, error in zip(SIZES, line)]


class WorkPrecision(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.folder = Path(folder.name)
        self.file = self.folder / "baseline_beam.csv"
        self.write(rows())

    def write(self, table, header=None):
        with open(self.file, "w", newline="") as stream:
            csv.writer(stream).writerows([header or HEADER, *table])

    def assured(self):
        study = Study(self.file)
        probe = probe_with_error(study)
        [(_, runs)] = problems(study)
        return {(r["Method/Element"], r["Scene/Mesh size"]): error
                for r, error in assured_errors(study, runs, probe)}

    def table(self):
        """The method, its size and its error by wanted error."""
        study = Study(self.file)
        header, lines = cheapest_rows(study, probe_with_error(study))
        self.assertEqual(header, ["error of tip wanted", "cheapest", "mesh size", "unknowns",
                                  "seconds", "its error"])
        return {line[0]: (line[1], line[2], line[5]) for line in lines}

    def test_assured_error(self):
        assured = self.assured()
        self.assertAlmostEqual(assured["P1", "0.2"], 0.052)  # luck; the reference adds 0.002
        self.assertAlmostEqual(assured["P1", "0.4"], 0.202)
        self.assertAlmostEqual(assured["P2", "0.1"], 0.006)
        self.assertNotIn(("P3", "0.2"), assured)      # its finer run failed
        self.write(rows(uncertainty=0.03))
        self.assertAlmostEqual(self.assured()["P2", "0.1"], 0.034)

    def test_cheapest(self):
        self.assertEqual(self.table(), {"10 %": ("P2", "0.4", "8 %"),
                                        "3 %": ("P2", "0.2", "2 %"),
                                        "1 %": ("P2", "0.1", "0.4 %"),
                                        "0.3 %": ("none: at best 0.6 %", "-", "-"),
                                        "0.1 %": ("none: the reference is uncertain by 0.2 %", "-",
                                                  "-")})

    def test_a_method_that_comes_there_for_good_counts(self):
        self.write(rows({**ERRORS, "P1": [0.2, 0.0005, 0.0008]}, uncertainty=0))
        self.assertEqual(self.table()["0.1 %"], ("P1", "0.2", "0.05 %"))

    def test_reference_is_no_candidate(self):
        self.write(rows({"P1": [0.2, 0.09, 0.05], "P2": [0.08, 0.02, 0]}, uncertainty=0))
        self.assertEqual(self.table()["1 %"][0], "none: at best 2 %")
        self.assertEqual(self.table()["3 %"], ("P2", "0.2", "2 %"))

    def test_unstable_equilibria_are_named(self):
        table = rows()
        table[5][HEADER.index("status")] = "unstable (2 modes)"
        self.write(table)
        self.assertEqual(self.table()["1 %"], ("P2, unstable (2 modes)", "0.1", "0.4 %"))
        self.assertEqual(self.run_script().returncode, 0)
        self.assertIn("<!-- unstable -->",
                      (self.folder / "beam_work_precision.svg").read_text())

    def test_refused_run_says_nothing(self):
        refused = row("0.1", "P3", None)
        for name, text in (("cells", 0), ("unknowns", 0), ("status", "refused")):
            refused[HEADER.index(name)] = text
        self.write(rows()[:-1] + [refused])
        self.assertAlmostEqual(self.assured()["P3", "0.2"], 0.004)
        self.assertEqual(self.run_script().returncode, 0)
        self.assertNotIn("<!-- failed -->",
                         (self.folder / "beam_work_precision.svg").read_text())

    def test_pareto_front(self):
        points = [(1, 0.2), (2, 0.3), (3, 0.1), (3, 0.1), (3, 0.15), (9, 0.01), (10, 0.01)]
        self.assertEqual(pareto_front(points), [(1, 0.2), (3, 0.1), (3, 0.1), (9, 0.01)])

    def run_script(self, *arguments):
        return subprocess.run([SCRIPTS / "work_precision.py", self.file, *arguments],
                              capture_output=True, text=True)

    def test_chart(self):
        (self.folder / "beam.prm").write_text("include base.prm\nsubsection Scene\nend\n")
        (self.folder / "base.prm").write_text(
            "subsection Scene\n  set Title = no\nend\nsubsection Study\n  set Title = A beam # x\nend\n")
        result = self.run_script()
        self.assertEqual((result.returncode, result.stderr), (0, ""))
        self.assertIn("| 3 % | P2 | 0.2 | 3000 | 3 | 2 % |", result.stdout)
        svg = (self.folder / "beam_work_precision.svg").read_text()
        for text in ("A beam: error of tip against work", "failed", "unknowns",
                     "relative error of tip"):
            self.assertIn(f"<!-- {text} -->", svg)
        self.assertIn("reference's own", svg)
        self.assertIn("Pareto front,", svg)
        self.assertNotIn("unstable", svg)
        self.assertGreater((self.folder / "beam_work_precision.png").stat().st_size, 10000)

    def test_named_probe(self):
        self.assertEqual(self.run_script("--probe", "tip").returncode, 0)
        self.assertTrue((self.folder / "beam_tip_work_precision.png").is_file())

    def refused(self, result, *words):
        self.assertEqual(result.returncode, 1)
        self.assertEqual(len(result.stderr.splitlines()), 1, result.stderr)
        for word in words:
            self.assertIn(word, result.stderr)

    def test_bad_input(self):
        self.refused(self.run_script("--probe", "lid"), "baseline_beam.csv", "'lid'", "Reference")
        self.refused(self.run_script("--probe", "top"), "'top'", "tip, lid")
        place = HEADER.index("tip error")
        self.write([line[:place] + line[place + 2:] for line in rows()],
                   HEADER[:place] + HEADER[place + 2:])
        self.refused(self.run_script(), "Reference values")
        self.file.unlink()
        self.refused(self.run_script(), "No such file")


if __name__ == "__main__":
    unittest.main()
