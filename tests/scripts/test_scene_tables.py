"""scripts/automatic_tables.py, ratio_tables.py and estimate_tables.py on tables made by hand: one row per
scene, against the cheapest fixed method and against the truth."""

import csv
import sys
import tempfile
import unittest
from pathlib import Path

SCRIPTS = Path(__file__).parents[2] / "scripts"
sys.path.insert(0, str(SCRIPTS))
sys.dont_write_bytecode = True

from automatic_tables import HEADER, automatic_rows  # noqa: E402
from estimate_tables import estimate_rows  # noqa: E402
from ratio_tables import ratio_rows  # noqa: E402
from results_table import BadTable  # noqa: E402

COLUMNS = ["cells", "unknowns", "seconds total", "peak memory MB", "tip [m]", "tip error",
           "tip reference uncertainty", "volume ratio", "auto choice", "auto estimated error", "status",
           "reason", "role"]


def run(seconds, tip, error, *, choice="", estimate="", role="run", status="stable", unsure=0.0005,
        cells=10):
    return [cells, 100, seconds, 90, tip, error, unsure, 1, choice, estimate, status, "", role]


class SceneTables(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.folder = Path(folder.name)
        self.fixed = self.folder / "fixed"
        self.fixed.mkdir()

    def write(self, file, parameters, rows):
        with open(file, "w", newline="") as stream:
            csv.writer(stream).writerows([parameters + COLUMNS, *rows])

    def test_automatic(self):
        self.write(self.folder / "baseline_long_beam.csv", ["Method/Accuracy", "Method/Element"],
                   [["10%", "auto", *run(0.6, 1.02, 0.02, choice="P2-P1, mesh size 0.1 m", estimate=0.05)],
                    ["0.01", "auto", *run(6, 1.004, 0.004, choice="P2-P1, mesh size 0.05 m",
                                          estimate=0.008, unsure=0.004)],
                    ["0.1%", "auto", *run(9, "", "", status="not converged", unsure="")]])
        self.write(self.fixed / "baseline_long_beam.csv", ["Scene/Mesh size", "Method/Element"],
                   [["0.1", "P1", *run(0.2, 1.3, 0.3)], ["0.1", "P2", *run(0.3, 1.05, 0.05)],
                    ["0.05", "P2", *run(3, 1.009, 0.009, cells=80)]])
        rows = [dict(zip(HEADER, row)) for row in automatic_rows(self.folder, self.fixed)]
        self.assertEqual([row["scene"] for row in rows], ["long beam"] * 3)
        self.assertEqual([row["cheapest fixed"] for row in rows], ["P2, 0.1", "P2, 0.05", "none"])
        self.assertEqual([row["ratio"] for row in rows], ["2.0", "2.0", "-"])
        self.assertEqual([row["true error"] for row in rows], ["2 %", "0.4 % ± 0.4 %", "-"])
        self.assertEqual(rows[2]["chosen"], "not converged")

    def test_ratios(self):
        self.write(self.folder / "baseline_arm.csv", ["Method/Element"],
                   [["P1", *run(1, 0.2, 0.9)], ["P1-P1", *run(1, 1.8, 0.1)],
                    ["P2", *run(1, "", "", status="not converged")],
                    ["P3-P2", *run(9, 2, 0, role="reference")]])
        self.write(self.folder / "baseline_box.csv", ["Method/Element"],
                   [["P1", *run(1, -1, 0.5)], ["P2", *run(1, -2, 0)],
                    ["P3-P2", *run(9, -2, 0, role="reference")]])
        header, rows = ratio_rows(self.folder)
        self.assertEqual(header[4:], ["P1", "P1-P1", "P2"])
        self.assertEqual(rows, [["arm", "tip", "2 m", "0.05 %", "0.100", "0.900", "failed"],
                                ["box", "tip", "-2 m", "0.05 %", "0.500", "-", "1.000"]])

    def test_estimates(self):
        self.write(self.fixed / "baseline_arm.csv", ["Method/Element"],
                   [["P1", *run(1, 2, 0.1, unsure=0.01)]])
        file = self.folder / "baseline_arm.csv"
        parameters = ["Method/Element", "Scene/Mesh size"]
        self.write(file, parameters, [["P1", "0.1", *run(1, 2, 0.1)]])
        with self.assertRaisesRegex(BadTable, "no column 'tip estimated error'"):
            estimate_rows(self.folder, self.fixed)

        def estimated(error, estimate):
            row = run(1, 2, error)
            return [*row[:7], estimate, *row[7:]]

        with open(file, "w", newline="") as stream:
            csv.writer(stream).writerows([
                [*parameters, *COLUMNS[:7], "tip estimated error", *COLUMNS[7:]],
                ["P1", "0.1", *estimated(0.2, 0.1)], ["P1", "0.05", *estimated(0.1, 0.09)],
                ["P1", "0.02", *estimated(0.02, 0.1)],  # the truth is uncertain by half of that
                ["P2", "0.1", *estimated(0.1, 0.2)], ["P2", "0.05", *estimated(0.04, "")]])
        self.assertEqual(estimate_rows(self.folder, self.fixed),
                         (["scene", "P1", "P2"], [["arm", "0.5 to 0.9", "2"]]))

    def test_no_baseline(self):
        for table in (lambda: automatic_rows(self.folder, self.fixed), lambda: ratio_rows(self.folder),
                      lambda: estimate_rows(self.folder, self.fixed)):
            with self.assertRaisesRegex(BadTable, "holds no baseline_SCENE.csv"):
                table()


if __name__ == "__main__":
    unittest.main()
