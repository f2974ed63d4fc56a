"""Method/Nested levels: the same equilibrium as without, with fewer Newton iterations on the mesh
itself; a coarse start that leads nowhere is told and costs nothing but time."""

import unittest

from isochor_case import CONVERGED, IsochorCase

SCENE = """
subsection Scene
  set Mesh            = box(1, 0.1, 0.1)
  set Cells           = 16, 2, 2
  set Young's modulus = 266e3
  set Poisson ratio   = {poisson_ratio}
  set Fixed           = left
  {loads}
  set Probes          = tip: mean displacement y on right; volume: volume
end
subsection Method
  set Element          = {element}
  set Load steps       = {steps}
  set Newton tolerance = 1e-9
end
"""


class Nested(IsochorCase):
    def run_in(self, folder, text, *arguments, **keywords):
        told = self.run_isochor(text, *arguments, out=self.folder / folder, **keywords)
        return self.check_files(CONVERGED, self.folder / folder), told

    def assert_same(self, nested, plain):
        for name in ("tip [m]", "volume [m^3]", "min J"):
            self.assertAlmostEqual(float(nested[name]) / float(plain[name]), 1, 6, name)

    def test_same_result_in_fewer_iterations(self):
        for element, ranks in (("P1-P1", 1), ("P1-P1", 2), ("P2-P1", 1), ("Q2-P1", 1)):
            with self.subTest(element=element, ranks=ranks):
                text = SCENE.format(poisson_ratio=0.499, element=element, steps=1,
                                    loads="set Gravity = 0, -9.8, 0")
                name = f"{element}_{ranks}"
                arguments = ["--set", "Scene/Cells=8, 2, 2"] if element == "Q2-P1" else []
                plain, _ = self.run_in(name, text, *arguments, ranks=ranks)
                nested, _ = self.run_in(f"{name}_nested", text, *arguments, "--set",
                                        "Method/Nested levels=1", ranks=ranks)
                self.assert_same(nested, plain)
                self.assertLess(int(nested["newton iterations"]), int(plain["newton iterations"]))
                self.assertGreater(int(nested["coarse newton iterations"]), 0)
                self.assertEqual(plain["coarse newton iterations"], "0")
                self.assertEqual(nested["load steps"], "1")

    def test_prescribed_displacements(self):
        text = SCENE.format(poisson_ratio=0.4, element="P1-P1", steps=4, loads="set Prescribed "
                            "rotation = right: 180 about 1, 0.05, 0.05 axis 1, 0, 0")
        plain, _ = self.run_in("plain", text)
        nested, _ = self.run_in("nested", text, "--set", "Method/Nested levels=2")
        self.assertAlmostEqual(float(nested["min J"]), float(plain["min J"]), 6)

    def test_no_equilibrium(self):
        text = SCENE.format(poisson_ratio=0.4, element="P1-P1", steps=1,
                            loads="set Traction = right: -1e9, 0, 0")
        told = self.run_isochor(text, "--set", "Method/Nested levels=1", "--set",
                                "Method/Minimum load step=0.5", code=2)
        self.assertIn("nested iteration: no equilibrium on the mesh of 48 cells", told)
        self.assertIn("begun from rest", told)

    def test_useless_start(self):
        # The coarse mesh has no node where the displacement is, and sees nothing of it.
        text = SCENE.format(poisson_ratio=0.4, element="P1-P1", steps=1, loads="set Prescribed "
                            "displacement = right: 0.2*load*if(abs(y - 0.05) < 0.03, 1, 0), 0, 0")
        told = self.run_isochor(text, "--set", "Method/Nested levels=1", "--set",
                                "Method/Maximum Newton iterations=1", "--set",
                                "Method/Minimum load step=0.5", code=2)
        self.assertIn("nested iteration: the interpolated state led to no equilibrium on the mesh "
                      "of 384 cells; begun from rest", told)

    def test_refused(self):
        text = SCENE.format(poisson_ratio=0.4, element="P1", steps=1, loads="")
        (self.folder / "body.msh").write_text("")
        told = self.run_isochor(text, "--set", "Method/Nested levels=1", "--set",
                                "Scene/Mesh=body.msh", code=1)
        self.assertIn("Method/Nested levels: the mesh", told)


if __name__ == "__main__":
    unittest.main()
