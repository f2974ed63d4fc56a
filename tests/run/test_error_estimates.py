"""Output/Error estimates: what a run tells of its own error, beside its true error."""

import unittest

from isochor_case import IsochorCase, read_csv

# A block between smooth walls, pressed down by a traction that varies: nothing is singular, so that
# estimates tend to errors.
BLOCK = """
subsection Scene
  set Dimension        = 2
  set Mesh             = rectangle(1, 1)
  set Cells            = {{{{8, 8|16, 16}}}}
  set Young's modulus  = 1
  set Poisson ratio    = {poisson_ratio}
  set Fixed components = left: x; right: x; bottom: y
  set Traction         = top: 0, -0.1*(1 - cos(pi*x))
  set Probes           = {probes}
end
subsection Method
  set Element          = {{{{P1-P1s|P2|P2-P1|Q2|Q2-P1}}}}
  set Newton tolerance = 1e-11
  set Linear solver    = {solver}
end
subsection Output
  set VTU             = none
  set Error estimates = true
end
subsection Study
  set Reference = Scene/Cells = 24, 24; Method/Element = P3-P2; Method/Linear solver = automatic
end
"""


class ErrorEstimates(IsochorCase):
    def solve(self, poisson_ratio=0.3, probes="body: mean displacement y", solver="automatic",
              **keywords):
        """The rows of results.csv, by element and cells."""
        text = BLOCK.format(poisson_ratio=poisson_ratio, probes=probes, solver=solver)
        self.run_isochor(text, "--overwrite", **keywords)
        return {(row["Method/Element"], row["Scene/Cells"]): row
                for row in read_csv(self.out / "results.csv") if row["role"] == "run"}

    def ratios(self, **keywords):
        return {key: float(row["body estimated error"]) / float(row["body error"])
                for key, row in self.solve(**keywords).items()}

    def test_smooth(self):
        for ranks, allowed in ((1, 0.1), (2, 0.15)):  # patches end where a rank's cells do
            with self.subTest(ranks=ranks):
                ratios = self.ratios(ranks=ranks)
                self.assertEqual(len(ratios), 10)
                for (element, cells), ratio in ratios.items():
                    with self.subTest(element=element, cells=cells):
                        self.assertAlmostEqual(ratio, 1, delta=0.3)
                        if cells == "16, 16":
                            self.assertAlmostEqual(ratio, 1, delta=allowed)

    def test_nearly_incompressible(self):
        for (element, cells), ratio in self.ratios(poisson_ratio=0.4999).items():
            with self.subTest(element=element, cells=cells):
                self.assertAlmostEqual(ratio, 1, delta=0.6)
                if cells == "16, 16":  # P2 and Q2 lock
                    self.assertAlmostEqual(ratio, 1, delta=0.25)

    def test_directions(self):
        """A vector's components are estimated each, relative to its length; the magnitude at once."""
        rows = self.solve(probes="p: displacement at 0.3, 1; m: displacement magnitude at 0.3, 1; "
                                 "x: max displacement x on top")
        for key, row in rows.items():
            with self.subTest(key):
                components = [float(row[f"p {c} estimated error"]) for c in "xy"]
                self.assertGreater(min(components), 0)
                size = sum(c * c for c in components) ** 0.5
                self.assertLessEqual(float(row["m estimated error"]), size)
                self.assertGreater(float(row["x estimated error"]), 0)

    def test_not_known(self):
        """Of what has no derivative here, and without a matrix."""
        rows = self.solve(probes="body: mean displacement y; area: volume; force: reaction y on bottom")
        for row in rows.values():
            self.assertGreater(float(row["body estimated error"]), 0)
            self.assertEqual([row["area estimated error"], row["force estimated error"]], ["", ""])
        self.run_isochor(BLOCK.format(poisson_ratio=0.3, probes="body: mean displacement y",
                                      solver="CG").replace("{P1-P1s|P2|P2-P1|Q2|Q2-P1}", "{P2}"),
                         "--overwrite")
        for row in read_csv(self.out / "results.csv"):
            self.assertEqual(row["body estimated error"] == "", row["role"] == "run")

    def test_only_if_asked_for(self):
        text = BLOCK.format(poisson_ratio=0.3, probes="body: mean displacement y", solver="automatic")
        self.run_isochor(text.replace("Error estimates = true", "Error estimates = false"))
        self.assertFalse([name for name in read_csv(self.out / "results.csv")[0]
                          if "estimated" in name])

    def test_console(self):
        text = BLOCK.format(poisson_ratio=0.3, probes="body: mean displacement y", solver="automatic")
        text = text[:text.index("subsection Study")].replace("{{8, 8|16, 16}}", "8, 8")
        self.assertIn("body [m]  estimated %", self.run_isochor(text))
        printed = self.run_isochor(text.replace("{{P1-P1s|P2|P2-P1|Q2|Q2-P1}}", "P2"), "--overwrite")
        self.assertRegex(printed, r"body \[m\] .*, estimated error 0\.00\d+ %\n")


if __name__ == "__main__":
    unittest.main()
