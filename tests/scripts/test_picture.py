"""scripts/picture.py on bodies made by hand, and without a display."""

import os
import subprocess
import sys
import tempfile
import unittest
from pathlib import Path

import matplotlib.image
import numpy as np

SCRIPTS = Path(__file__).parents[2] / "scripts"
sys.path.insert(0, str(SCRIPTS))
sys.dont_write_bytecode = True

from body_surface import BadFile, Body  # noqa: E402
from vtu_files import SIDES, TETRAHEDRA, vertex, write_vtu  # noqa: E402


def shear(points):
    return 0.3 * np.column_stack([points[:, 1] ** 2, 0 * points[:, 0], 0 * points[:, 0]])


def area(points, triangles):
    a, b, c = (points[triangles[:, i]] for i in range(3))
    return 0.5 * np.linalg.norm(np.cross(b - a, c - a), axis=1).sum()


class Picture(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.folder = Path(folder.name)
        linear = [np.array([vertex(i) for i in cell]) for cell in TETRAHEDRA]
        quadratic = [np.vstack([cell, [(cell[a] + cell[b]) / 2 for a, b in SIDES]])
                     for cell in linear]
        triangles = [np.array([[0, 0, 0], [1, 0, 0], [1, 1, 0]]),
                     np.array([[0, 0, 0], [1, 1, 0], [0, 1, 0]])]
        write_vtu(self.folder / "linear.vtu", linear, 10, shear)
        write_vtu(self.folder / "quadratic.vtu", quadratic, 24, shear)
        write_vtu(self.folder / "flat.vtu", triangles, 5, shear)

    def run_script(self, *arguments):
        environment = {k: v for k, v in os.environ.items() if k != "DISPLAY"}
        return subprocess.run([SCRIPTS / "picture.py", "-o", "out.png", *arguments],
                              cwd=self.folder, env=environment, capture_output=True, text=True)

    def test_surface_is_the_cubes(self):
        for name, n_triangles in (("linear", 12), ("quadratic", 48)):
            body = Body(self.folder / f"{name}.vtu")
            self.assertEqual(len(body.triangles), n_triangles)
            self.assertAlmostEqual(area(body.rest, body.triangles), 6)
            self.assertEqual(body.outline().GetNumberOfCells(), 12 * (n_triangles // 12) ** 0.5)

    def test_surface_follows_quadratic_displacements(self):
        body = Body(self.folder / "quadratic.vtu")
        middle = np.isclose(body.rest, [0, 0.5, 0]).all(axis=1)
        self.assertTrue(middle.any())
        self.assertTrue(np.allclose(body.deformed[middle], [0.075, 0.5, 0]))

    def test_picture_without_a_display(self):
        result = self.run_script("--label", "one", "--label", "two", "linear.vtu", "quadratic.vtu")
        self.assertEqual((result.returncode, result.stderr), (0, ""))
        image = matplotlib.image.imread(self.folder / "out.png")[..., :3]
        self.assertGreater(image.shape[1], 1.3 * image.shape[0])
        self.assertTrue((image[0] == 1).all())
        coloured = np.ptp(image, axis=2) > 0.15
        for half in np.array_split(coloured, 2, axis=1):
            self.assertGreater(half.mean(), 0.15)

    def test_flat_body_and_constant_field(self):
        result = self.run_script("--field", "J", "flat.vtu")
        self.assertEqual((result.returncode, result.stderr), (0, ""))

    def test_pvd_names_its_last_state(self):
        (self.folder / "all.pvd").write_text(
            '<VTKFile type="Collection"><Collection><DataSet timestep="0" file="none.vtu"/>'
            '<DataSet timestep="1" file="linear.vtu"/></Collection></VTKFile>')
        self.assertEqual(len(Body(self.folder / "all.pvd").triangles), 12)

    def test_runs_of_a_study_by_their_settings(self):
        (self.folder / "study" / "run_002").mkdir(parents=True)
        os.rename(self.folder / "linear.vtu", self.folder / "study" / "run_002" / "solution.vtu")
        (self.folder / "study" / "run_002" / "solution.pvd").write_text(
            '<VTKFile type="Collection"><Collection><DataSet file="solution.vtu"/></Collection>'
            "</VTKFile>")
        (self.folder / "study" / "results.csv").write_text(
            "Method/Element,cells,unknowns,seconds total,peak memory MB,volume ratio,status,role,"
            "folder\nP1,6,24,1,90,1,converged,run,run_001\nP1-P1,6,32,1,90,1,converged,run,run_002"
            "\n")
        result = self.run_script("--study", "study", "Element = P1-P1")
        self.assertEqual((result.returncode, result.stderr), (0, ""))
        result = self.run_script("--study", "study", "Element = P7")
        self.assertEqual(result.returncode, 1)
        self.assertIn("'Element = P7'", result.stderr)

    def test_wrong_input_is_one_line(self):
        (self.folder / "torn.vtu").write_text("<VTKFile")
        for arguments, words in ((["none.vtu"], "no such file"), (["torn.vtu"], "torn"),
                                 (["linear.txt"], "not a .vtu"),
                                 (["--field", "heat", "linear.vtu"], "von_Mises_stress")):
            result = self.run_script(*arguments)
            self.assertEqual(result.returncode, 1)
            self.assertIn(words, result.stderr)
            self.assertEqual(len(result.stderr.splitlines()), 1, result.stderr)
        self.assertRaises(BadFile, Body, self.folder / "none.vtu")


if __name__ == "__main__":
    unittest.main()
