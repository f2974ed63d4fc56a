"""Element = auto: what it chooses is as accurate as asked for, and costs little more than needed."""

import unittest

from isochor_case import CONVERGED, IsochorCase, read_csv

# Cook's membrane, energy (30), nu = 0.4999: the corner rises by 6.932 mm (convergence/cook).
COOK = """
subsection Scene
  set Dimension          = 2
  set Mesh               = quadrilateral(0,0, 48e-3,44e-3, 48e-3,60e-3, 0,44e-3)
  set Cells              = 16, 16
  set Young's modulus    = 240.565e6
  set Poisson ratio      = 0.4999
  set Energy             = Bonet-Wood
  set Volumetric modulus = K
  set Fixed              = left
  set Traction           = right: 0, {traction}
  set Probes             = corner: displacement y at 48e-3, 60e-3
end
subsection Method
  set Element  = auto
  set Accuracy = {accuracy}
end
"""
TRUTH = 6.932e-3

# A thick plate between two smooth walls bends under its weight.
PLATE = """
subsection Scene
  set Mesh             = box(1, 0.1, 0.3)
  set Cells            = 10, 1, 3
  set Young's modulus  = 266e3
  set Poisson ratio    = 0.4999
  set Density          = 1070
  set Fixed            = left
  set Fixed components = back: z; front: z
  set Gravity          = {gravity}
  set Probes           = tip: mean displacement y on right; volume: volume; support: reaction y on left
end
subsection Method
  set Element    = {element}
  set Load steps = 2
end
"""


class Automatic(IsochorCase):
    def solve(self, text, *arguments, **keywords):
        """The row of results.csv, and what was tried."""
        self.run_isochor(text, "--overwrite", *arguments, **keywords)
        return read_csv(self.out / "results.csv")[0], read_csv(self.out / "automatic.csv")

    def test_accuracy(self):
        unknowns = []
        for accuracy in (0.1, 0.01, 0.003):
            with self.subTest(accuracy=accuracy):
                row, tried = self.solve(COOK.format(traction=6.25e6, accuracy=accuracy))
                error = abs(float(row["corner [m]"]) / TRUTH - 1)
                self.assertLess(error, 2 * accuracy)
                self.assertLessEqual(float(row["auto estimated error"]), accuracy)
                self.assertEqual(row["status"], CONVERGED)
                self.assertEqual([t["verdict"] for t in tried].count("chosen"), 1)
                self.assertEqual(int(row["auto trials"]), len(tried))
                self.assertLess(float(row["auto seconds chosen"]), float(row["seconds total"]))
                unknowns.append(int(row["unknowns"]))
        # No more than the request needs.
        self.assertEqual(unknowns, sorted(unknowns))
        self.assertLess(unknowns[0], unknowns[-1])

    def test_files_of_the_chosen_run(self):
        row, _ = self.solve(COOK.format(traction=6.25e6, accuracy="10%"))
        self.check_files(CONVERGED)
        self.assertEqual(list(self.out.glob("trial_*")), [])
        self.assertIn(row["auto choice"].split(",")[0], ("Q2-P1", "P2-P1"))

    def test_small_strain(self):
        # A ten-thousandth of the load, and an energy whose small-strain limit is Hooke's law.
        text = COOK.replace("Bonet-Wood", "neo-Hookean").replace("= K", "= consistent")
        row, _ = self.solve(text.format(traction=625, accuracy="1%"))
        self.assertIn("small strain", row["auto choice"])
        large, _ = self.solve(text.format(traction=6.25e6, accuracy="1%"))
        self.assertNotIn("small strain", large["auto choice"])
        # Proportional to the load, but for the strain of the large one.
        self.assertAlmostEqual(float(row["corner [m]"]) / float(large["corner [m]"]), 1e-4, delta=3e-5)

    def test_plane_strain(self):
        row, _ = self.solve(PLATE.format(gravity="0, -0.5, 0", element="auto"))
        self.assertIn("plane strain", row["auto choice"])
        self.run_isochor(PLATE.format(gravity="0, -0.5, 0", element="Q2-P1"), "--overwrite")
        solid = read_csv(self.out / "results.csv")[0]
        # Figures of the body, not per metre; its weight exactly.
        for column, delta in (("tip [m]", 0.02), ("volume [m^3]", 1e-3), ("support [N]", 1e-6)):
            self.assertAlmostEqual(float(row[column]) / float(solid[column]), 1, delta=delta)
        self.assertAlmostEqual(float(row["support [N]"]), 1070 * 0.03 * 0.5, places=4)

    def test_not_plane(self):
        row, _ = self.solve(PLATE.format(gravity="0, -0.5, 0.1", element="auto"))
        self.assertNotIn("plane strain", row["auto choice"])

    def test_two_ranks(self):
        one, _ = self.solve(COOK.format(traction=6.25e6, accuracy="1%"))
        two, _ = self.solve(COOK.format(traction=6.25e6, accuracy="1%"), ranks=2)
        # Seconds decide between elements; the answer is the same within what was asked for.
        self.assertAlmostEqual(float(two["corner [m]"]) / float(one["corner [m]"]), 1, delta=0.02)

    def test_in_a_study(self):
        self.run_isochor(COOK.format(traction=6.25e6, accuracy="10%").replace(
            "Element  = auto", "Element  = {{auto|P1}}"))
        automatic, fixed = read_csv(self.out / "results.csv")
        self.assertNotEqual(automatic["auto choice"], "")
        self.assertEqual(fixed["auto choice"], "")
        self.assertTrue((self.out / "run_001" / "automatic.csv").is_file())

    def test_equal_meshes(self):
        # From one block to three quarters of two: still one, and no second run on it.
        _, tried = self.solve(COOK.format(traction=6.25e6, accuracy="10%"), "--set", "Scene/Cells=4, 4")
        solved = [(t["element"], t["unknowns"]) for t in tried if t["values"]]
        self.assertEqual(len(solved), len(set(solved)))
        self.assertTrue(any("hardly a finer mesh" in t["verdict"] for t in tried))

    def test_not_reached(self):
        # From four blocks there is no way to a millionth.
        told = self.run_isochor(COOK.format(traction=6.25e6, accuracy=1e-6), "--set", "Scene/Cells=2, 2")
        self.assertIn("not reached", told)


if __name__ == "__main__":
    unittest.main()
