"""--restart on a path of equilibria: arc length goes on where it was killed."""

import re
import unittest
from pathlib import Path

from isochor_case import CONVERGED, read_csv
from restart_case import COSTS, RestartCase

EXAMPLES = Path(__file__).resolve().parents[2] / "prm"

# Along a path the next step follows the last one's iterations.
PATH_COSTS = re.compile(COSTS.pattern + "|steps")


def interpolated(points, x):
    """The height at X of straight lines from (0, 0) through POINTS, which ascend."""
    ends = [(0, 0), *points]
    k = next((k for k in range(1, len(points)) if ends[k][0] >= x), len(points))
    (x0, y0), (x1, y1) = ends[k - 1:k + 1]
    return y0 + (y1 - y0) * (x - x0) / (x1 - x0)


class RestartOfPaths(RestartCase):
    def test_path(self):
        """Killed twice on the way down between two limit points, and followed on that way."""
        text = (EXAMPLES / "snap_through.prm").read_text()
        short_steps = ("--set", "Method/Target Newton iterations=2")
        for ranks in (1, 2):
            with self.subTest(ranks=ranks):
                whole, self.out = self.folder / f"whole_{ranks}", self.folder / f"killed_{ranks}"
                self.run_isochor(text, *short_steps, out=whole, ranks=ranks)
                wanted, path = self.check_files(CONVERGED, whole), read_csv(whole / "steps.csv")
                loads = [float(step["load factor"]) for step in path]
                down = [k for k in range(1, len(loads)) if loads[k] < loads[k - 1]]
                self.assertGreater(len(down), 8)
                self.kill_after(text, down[1] + 1, *short_steps, ranks=ranks)
                self.kill_after(text, down[3] + 1, *short_steps, "--restart", ranks=ranks)
                self.assertLess(len(read_csv(self.out / "steps.csv")), down[-1])
                told = self.run_isochor(text, *short_steps, "--restart", ranks=ranks)
                self.assertRegex(told, r"continued from the state saved after load step \d+")
                self.assert_same(self.check_files(CONVERGED), wanted, PATH_COSTS)
                found = read_csv(self.out / "steps.csv")
                self.assertEqual([int(step["step"]) for step in found],
                                 list(range(1, len(found) + 1)))
                # The displacement grows all along: no step goes back, nor off the path.
                here, there = ([(-float(step["middle [m]"]), float(step["load factor"]))
                                for step in steps] for steps in (found, path))
                self.assertEqual(here, sorted(here))
                for displacement, load in here:
                    self.assertAlmostEqual(interpolated(there, displacement), load, delta=3e-3)

    def test_other_stepping(self):
        """What one way of stepping has left, the other does not take for its own."""
        text = (EXAMPLES / "snap_through.prm").read_text()
        self.run_isochor(text, out=self.folder / "whole")
        wanted = self.check_files(CONVERGED, self.folder / "whole")
        for first, then in (("fixed", "arc length"), ("arc length", "fixed")):
            with self.subTest(first=first):
                self.out = self.folder / first
                steps = ("--set", "Method/Load steps=40",
                         "--set", "Method/Target Newton iterations=2")
                self.kill_after(text, 4, *steps, "--set", f"Method/Stepping={first}")
                self.run_isochor(text, *steps, "--restart", "--set", f"Method/Stepping={then}")
                self.assert_same(self.check_files(CONVERGED), wanted, PATH_COSTS)


if __name__ == "__main__":
    unittest.main()
