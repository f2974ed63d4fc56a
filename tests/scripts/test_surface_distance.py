"""scripts/surface_distance.py on cubes of known distance."""

import math
import subprocess
import sys
import tempfile
import unittest
from pathlib import Path

import numpy as np

SCRIPTS = Path(__file__).parents[2] / "scripts"
sys.path.insert(0, str(SCRIPTS))
sys.dont_write_bytecode = True

from body_surface import Body  # noqa: E402
from surface_distance import distances, lowest, size  # noqa: E402
from vtu_files import TETRAHEDRA, vertex, write_vtu  # noqa: E402

GAP = 0.1


class SurfaceDistance(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.folder = Path(folder.name)
        cube = [np.array([vertex(i) for i in cell]) for cell in TETRAHEDRA]
        flat = [np.array([[0, 0, 0], [1, 0, 0], [1, 1, 0]])]
        write_vtu(self.folder / "rest.vtu", cube, 10, lambda points: 0 * points)
        write_vtu(self.folder / "grown.vtu", cube, 10, lambda points: 2 * GAP * (points - 0.5))
        write_vtu(self.folder / "flat.vtu", flat, 5, lambda points: 0 * points)

    def run_script(self, *arguments):
        return subprocess.run([SCRIPTS / "surface_distance.py", *arguments], cwd=self.folder,
                              capture_output=True, text=True)

    def test_cube_in_a_cube(self):
        inner, outer = (Body(self.folder / f"{name}.vtu") for name in ("rest", "grown"))
        # Every point of the inner surface is as far from the outer one.
        for found in distances(inner, outer):
            self.assertAlmostEqual(found, GAP)
        # From the outer corners, the middles of the edges, and what is opposite the inner faces.
        found = distances(outer, inner)
        self.assertAlmostEqual(found.largest, math.sqrt(3) * GAP)
        self.assertAlmostEqual(found.mean, GAP * (9 * math.sqrt(3) + 16 * math.sqrt(2) + 35) / 60)
        self.assertAlmostEqual(size(outer), math.sqrt(3))
        self.assertAlmostEqual(lowest(outer), -GAP)

    def test_none_from_itself(self):
        body = Body(self.folder / "grown.vtu")
        for found in distances(body, body):
            self.assertAlmostEqual(found, 0)

    def test_as_a_program(self):
        result = self.run_script("rest.vtu", "grown.vtu")
        self.assertEqual((result.returncode, result.stderr), (0, ""))
        self.assertIn("Hausdorff distance: 0.173205 m, 10 %\n", result.stdout)
        self.assertIn("mean, rest.vtu from grown.vtu: 0.1 m, 5.774 %\n", result.stdout)

    def test_wrong_input_is_one_line(self):
        for files, words in ((("none.vtu", "rest.vtu"), "none.vtu: no such file"),
                             (("rest.vtu", "flat.vtu"), "flat.vtu: a flat body")):
            result = self.run_script(*files)
            self.assertEqual(result.returncode, 1)
            self.assertIn(words, result.stderr)
            self.assertEqual(len(result.stderr.splitlines()), 1, result.stderr)


if __name__ == "__main__":
    unittest.main()
