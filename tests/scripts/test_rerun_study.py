"""scripts/rerun_study.py with a program that answers at once: what it must notice, and what not."""

import csv
import subprocess
import sys
import tempfile
import unittest
from pathlib import Path

ROOT = Path(__file__).parents[2]
SCRIPT = ROOT / "scripts" / "rerun_study.py"
HEADER = ["Scene/Mesh size", "Method/Element", "cells", "unknowns", "newton iterations",
          "krylov iterations", "seconds total", "peak memory MB", "tip [m]", "tip error",
          "tip reference uncertainty", "volume ratio", "null pivots", "status", "reason", "role",
          "folder"]
# Errors of first and second order against a tip of 2.
ROWS = [[size, element, int(1 / size**2), 100, 12, 3, 1.5, 90, 2 - error, error / 2, "", 1, 0,
         "converged", "", "run", f"run_{size}_{element}"]
        for element, order in (("P1", 1), ("P2", 2)) for size in (0.4, 0.2, 0.1)
        for error in [size**order]]
# A stand-in for isochor: copies the table that lies beside it into the output folder.
PROGRAM = f"""#!{sys.executable}
import shutil, sys
from pathlib import Path
if "--version" in sys.argv:
    print("isochor 9.9")
else:
    output = Path(sys.argv[sys.argv.index("--output") + 1])
    shutil.copyfile(Path(__file__).parent / "found.csv", output / "results.csv")
    (output / "parameters.prm").write_text("")
"""
README = """# A beam

<!-- begin: baseline -->
<!-- end -->
<!-- begin: orders baseline.csv: tip -->
<!-- end -->
<!-- begin: values baseline.csv: tip [m] by Mesh size -->
<!-- end -->
<!-- begin: cheapest baseline.csv: tip -->
<!-- end -->
<!-- begin: figures baseline.csv: unknowns, tip error %, tip [m] change % -->
<!-- end -->
![Error](tip_error_against_mesh_size.png)
![Work](work_precision.png) ![The same](tip_work_precision.png) ![By hand](picture.png)
"""


def write(file, rows, header=None):
    with open(file, "w", newline="") as stream:
        csv.writer(stream).writerows([header or HEADER, *rows])


class RerunStudy(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.folder = Path(folder.name)
        self.study = self.folder / "convergence" / "beam"
        self.study.mkdir(parents=True)
        (self.study / "study.prm").write_text("")
        self.isochor = self.folder / "isochor"
        self.isochor.write_text(PROGRAM)
        self.isochor.chmod(0o755)
        write(self.study / "baseline.csv", ROWS)

    def run_script(self, rows, *arguments, header=None):
        write(self.folder / "found.csv", rows, header)
        return subprocess.run([SCRIPT, *(arguments or ["beam"]), "--isochor", self.isochor,
                               "--studies", self.folder / "convergence"],
                              capture_output=True, text=True)

    def changed(self, column, value, row=2):
        rows = [list(line) for line in ROWS]
        rows[row][HEADER.index(column)] = value
        return rows

    def accepted(self, rows):
        result = self.run_script(rows)
        self.assertEqual((result.returncode, result.stderr), (0, ""), result.stdout)
        self.assertIn("nothing deviates", result.stdout)

    def noticed(self, rows, *words, header=None):
        result = self.run_script(rows, header=header)
        self.assertEqual((result.returncode, result.stderr), (1, ""), result.stdout)
        for word in words:
            self.assertIn(word, result.stdout)

    def test_the_same(self):
        self.accepted(ROWS)

    def test_another_order_of_rows(self):
        self.accepted(ROWS[::-1])

    def test_what_may_differ(self):
        self.accepted(self.changed("seconds total", 77))
        self.accepted(self.changed("peak memory MB", 1234))
        self.accepted(self.changed("krylov iterations", 9))
        self.accepted(self.changed("newton iterations", 14))
        self.accepted(self.changed("tip [m]", 1.9 * (1 + 9e-6)))
        self.accepted(self.changed("volume ratio", 1 + 1e-6))

    def test_a_figure(self):
        self.noticed(self.changed("tip [m]", 1.90004), "Mesh size 0.1, Element P1",
                     "tip [m]", "1.90004", "1 deviations")
        self.noticed(self.changed("volume ratio", 1.001), "volume ratio")
        self.noticed(self.changed("tip error", 0.051), "tip error")

    def test_counts_and_words(self):
        self.noticed(self.changed("unknowns", 101), "unknowns")
        self.noticed(self.changed("newton iterations", 15), "newton iterations")
        self.noticed(self.changed("null pivots", 3), "null pivots")
        self.noticed(self.changed("status", "not converged"), "not converged")
        self.noticed(self.changed("tip [m]", ""), "tip [m]")
        self.noticed(self.changed("tip [m]", "nan"), "tip [m]")

    def test_a_run_that_ran_out_of_time(self):
        rows = self.changed("status", "not converged")
        row = next(row for row, before in zip(rows, ROWS) if row != before)
        row[HEADER.index("reason")] = "time limit of 15 s: interrupted"
        self.accepted(rows)
        row[HEADER.index("reason")] = "step below minimum"
        self.noticed(rows, "not converged")

    def test_rounding_is_no_figure(self):
        rounding = self.changed("tip [m]", 3e-15)
        write(self.study / "baseline.csv", rounding)
        self.accepted(self.changed("tip [m]", -2e-14))

    def test_runs_and_columns(self):
        self.noticed(ROWS[1:], "Mesh size 0.4, Element P1", "not run")
        self.noticed(ROWS + [[0.05] + ROWS[0][1:]], "not in the baseline")
        place = HEADER.index("null pivots")
        self.noticed([row[:place] + row[place + 1:] for row in ROWS], "null pivots",
                     header=HEADER[:place] + HEADER[place + 1:])
        self.noticed([row + [1] for row in ROWS], "min J", header=HEADER + ["min J"])

    def test_published_values(self):
        write(self.study / "expected.csv", [["P2", 0.1, 1.985, 0.005], ["P3", 0.1, 2, 0.005]],
              ["Method/Element", "Scene/Mesh size", "tip [m]", "tolerance"])
        result = self.run_script(ROWS)
        self.assertEqual(result.returncode, 0, result.stdout)
        self.assertIn("+0.252 %", result.stdout)  # 1.99 / 1.985 - 1
        self.assertIn("not run", result.stdout)
        write(self.study / "expected.csv", [["P2", 0.1, 1.975, 0.005]],
              ["Method/Element", "Scene/Mesh size", "tip [m]", "tolerance"])
        self.noticed(ROWS, "DEVIATES")

    def test_update(self):
        (self.study / "README.md").write_text(README)
        (self.study / "tip_error_against_mesh_size.png").write_text("an old chart")
        rows = self.changed("tip [m]", 1.7)
        result = self.run_script(rows, "beam", "--update")
        self.assertEqual((result.returncode, result.stderr), (0, ""), result.stdout)
        self.accepted(rows)
        text = (self.study / "README.md").read_text()
        self.assertIn("isochor 9.9: 6 runs in 9 s.", text)
        self.assertIn("| tip | P1 | 0.0500 | 1.00 | 1.00 |", text)
        self.assertIn("| tip | P2 | 0.00500 | 2.00 | 2.00 |", text)
        self.assertIn("| P1 | 1.600 | 1.800 | 1.700 |", text)
        self.assertIn("| 1 % | P2 | 0.1 | 100 | 1.5 | 0.5 % |", text)
        for name in ("tip_error_against_mesh_size", "work_precision", "tip_work_precision"):
            self.assertGreater((self.study / f"{name}.png").stat().st_size, 10000)
        self.assertFalse((self.study / "tip_error_against_seconds.png").exists())
        self.assertIn("| mesh size | element | unknowns | tip error | tip [m] change |", text)
        self.assertIn("| 0.1 | P1 | 100 | 5 % | 70 % |", text)

    def test_readme_edited_by_hand(self):
        (self.study / "README.md").write_text(README)
        self.run_script(ROWS, "beam", "--update")
        readme = self.study / "README.md"
        readme.write_text(readme.read_text().replace("| 2.00 |", "| 3.00 |"))
        self.noticed(ROWS, "README.md")

    def test_all(self):
        other = self.folder / "convergence" / "plate"
        other.mkdir()
        (other / "study.prm").write_text("")
        write(other / "baseline.csv", self.changed("tip [m]", 5))
        for jobs in ("1", "3"):
            with self.subTest(jobs=jobs):
                result = self.run_script(ROWS, "all", "--jobs", jobs)
                self.assertEqual(result.returncode, 1)
                self.assertIn("beam: 6 runs, 0 deviations", result.stdout)
                self.assertIn("plate: 6 runs, 1 deviations", result.stdout)

    def refused(self, result, *words):
        self.assertEqual(result.returncode, 1)
        self.assertEqual(len(result.stderr.splitlines()), 1, result.stderr)
        for word in words:
            self.assertIn(word, result.stderr)

    def test_bad_input(self):
        self.refused(self.run_script(ROWS, "beem"), "'beem'", "beam")
        (self.study / "baseline.csv").unlink()
        self.refused(self.run_script(ROWS), "baseline.csv", "--update")
        self.isochor.unlink()
        self.refused(self.run_script(ROWS), "no such program")


class Committed(unittest.TestCase):
    def test_tables_are_those_of_the_baselines(self):
        readmes = sorted((ROOT / "convergence").glob("*/README.md"))
        result = subprocess.run([ROOT / "scripts" / "study_tables.py", "--check", *readmes],
                                capture_output=True, text=True)
        self.assertEqual((result.returncode, result.stdout, result.stderr), (0, "", ""))


if __name__ == "__main__":
    unittest.main()
