"""Output/Iterations: iterations.csv has every Newton or dual iterate, of failed load steps, too, and goes
on after an interruption."""

import unittest

from isochor_case import CONVERGED, read_csv
from restart_case import RestartCase

SCENE = """
subsection Scene
  set Mesh            = box(1, 0.1, 0.1)
  set Cells           = 8, 1, 1
  set Young's modulus = 266e3
  set Poisson ratio   = 0.49
  set Fixed           = left
  set Traction        = right: 0, -300, 0
  set Probes          = tip: mean displacement y on right
end
subsection Method
  set Load steps = 20
end
subsection Output
  set Iterations = true
end
"""
DUAL = ("--set", "Method/Solver=dual ascent", "--set", "Method/Load steps=4")


class Iterations(RestartCase):
    def attempts(self, folder=None):
        """Rows of iterations.csv, a list for each solution that was tried."""
        found = []
        for row in read_csv((folder or self.out) / "iterations.csv"):
            if not found or int(row["iteration"]) <= int(found[-1][-1]["iteration"]):
                found.append([])
            found[-1].append(row)
        return found

    def check_attempt(self, rows):
        """The iterate of a converged step before the last had not yet reached the target."""
        residuals = [(float(row["residual"]), float(row["target"])) for row in rows]
        reached = [residual <= target for residual, target in residuals]
        self.assertEqual(reached, [False] * (len(rows) - 1) + [rows[0]["outcome"] == "converged"])
        self.assertEqual(float(rows[0]["step length"]), 0)
        for row in rows[1:]:
            self.assertIn(float(row["step length"]), [0.5**k for k in range(9)])

    def test_every_iterate(self):
        for ranks in (1, 2):
            with self.subTest(ranks=ranks):
                self.out = self.folder / f"ranks_{ranks}"
                self.run_isochor(SCENE, ranks=ranks)
                result, steps = self.check_files(CONVERGED), read_csv(self.out / "steps.csv")
                so_far = 0
                for step, rows in zip(steps, self.attempts(), strict=True):
                    self.check_attempt(rows)
                    self.assertEqual({row["step"] for row in rows}, {step["step"]})
                    self.assertEqual(rows[-1]["load factor"], step["load factor"])
                    self.assertEqual(rows[-1]["iteration"], step["newton iterations"])
                    self.assertEqual(rows[-1]["residual"], step["residual"])
                    so_far += int(step["newton iterations"])
                    self.assertEqual(rows[-1]["iterations so far"], str(so_far))
                self.assertEqual(str(so_far), result["newton iterations"])

    def test_not_by_default(self):
        self.run_isochor(SCENE, "--set", "Output/Iterations=false")
        self.assertFalse((self.out / "iterations.csv").exists())

    def test_failed_steps(self):
        # A step that is refused by its number of iterations, then halved.
        self.run_isochor(SCENE, "--set", "Method/Load steps=1", "--set",
                         "Scene/Traction=right: 0, -3000, 0", "--set",
                         "Method/Maximum Newton iterations=5")
        result, attempts = self.check_files(CONVERGED), self.attempts()
        failed = [rows for rows in attempts if rows[0]["outcome"] == "failed"]
        self.assertGreater(len(failed), 0)
        self.assertEqual(len(failed), int(result["failed steps"]))
        self.assertEqual(len(attempts), len(failed) + int(result["load steps"]))
        for rows in attempts:
            self.check_attempt(rows)
        # The number of the step that it should have become.
        self.assertEqual((attempts[0][0]["outcome"], attempts[0][0]["step"]), ("failed", "1"))
        self.assertEqual(attempts[-1][-1]["iterations so far"], result["newton iterations"])

    def test_last_step_failed(self):
        self.run_isochor(SCENE, "--set", "Method/Maximum Newton iterations=1", "--set",
                         "Method/Minimum load step=0.04", code=2)
        rows = self.attempts()[-1]
        self.assertEqual(rows[0]["outcome"], "failed")
        self.check_attempt(rows)

    def test_dual_ascent(self):
        self.run_isochor(SCENE, *DUAL)
        self.check_files(CONVERGED)
        for step, rows in zip(read_csv(self.out / "steps.csv"), self.attempts(), strict=True):
            self.assertEqual(rows[-1]["iteration"], step["dual iterations"])
            small = [float(row["volume error"]) <= 1e-4 for row in rows]
            self.assertEqual(str(small.index(True) + 1), step["dual iterations to 0.01 %"])

    def test_arc_length(self):
        self.run_isochor(SCENE, "--set", "Method/Stepping=arc length")
        self.check_files(CONVERGED)
        loads = [float(step["load factor"]) for step in read_csv(self.out / "steps.csv")]
        converged = [float(rows[-1]["load factor"]) for rows in self.attempts()
                     if rows[0]["outcome"] == "converged"]
        self.assertEqual([load for load in converged if load in loads], loads)

    def test_restart(self):
        whole = self.folder / "whole"
        self.run_isochor(SCENE, out=whole)
        self.kill_after(SCENE, 5)
        self.run_isochor(SCENE, "--restart")
        self.check_files(CONVERGED)
        found, wanted = self.attempts(), self.attempts(whole)
        self.assertEqual([rows[0]["step"] for rows in found], [rows[0]["step"] for rows in wanted])
        so_far = 0
        for rows in found:
            for row in rows:
                self.assertEqual(int(row["iterations so far"]), so_far + int(row["iteration"]))
            so_far += int(rows[-1]["iteration"])


if __name__ == "__main__":
    unittest.main()
