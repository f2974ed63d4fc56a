"""Where pivots are in doubt, factors in double precision come beside those in single precision only
if both are within the memory limit; otherwise in their place. The result is the same."""

import unittest

from isochor_case import IsochorCase

# A column that is pressed far beyond buckling, and stays straight: two modes too many.
COLUMN = """
subsection Scene
  set Mesh                    = box(1, 0.1, 0.1)
  set Cells                   = 20, 4, 4
  set Young's modulus         = 1e6
  set Poisson ratio           = 0.49
  set Fixed                   = left
  set Prescribed displacement = right: -0.06*load, 0, 0
  set Probes                  = force: reaction x on right
end
subsection Method
  set Element          = P2-P1
  set Curvature filter = none
end
"""


class MemoryLimit(IsochorCase):
    def press(self, limit, *settings):
        self.out = self.folder / "_".join([str(limit), *settings]).replace("/", " ")
        arguments = [word for setting in (f"Method/Memory limit={limit}", *settings)
                     for word in ("--set", setting)]
        self.run_isochor(COLUMN, *arguments)
        return self.check_files("unstable (2 modes)")

    def test_both_or_one(self):
        both = self.press(1000)
        double = float(both["factors memory MB"])
        self.assertGreater(double, 40)
        one = self.press(1.1 * double)
        self.assertAlmostEqual(float(one["force [N]"]) / float(both["force [N]"]), 1, 9)
        self.assertEqual(one["negative pivots excess"], "2")
        self.assertEqual(one["factors memory MB"], both["factors memory MB"])
        # Single precision takes half as much, and that goes before the pattern is analysed again.
        spared = float(both["peak memory MB"]) - float(one["peak memory MB"])
        self.assertGreater(spared, 0.4 * double / 2)

    def test_goes_on(self):
        # Along a path pivots are counted after every step, and the next begins without factors.
        path = ("Method/Stepping=arc length", "Method/Load steps=3")
        both = self.press(1000, *path)
        one = self.press(1.1 * float(both["factors memory MB"]), *path)
        self.assertAlmostEqual(float(one["force [N]"]) / float(both["force [N]"]), 1, 9)
        self.assertEqual(one["load steps"], both["load steps"])
        self.assertGreater(int(one["factorisations"]), int(both["factorisations"]))


if __name__ == "__main__":
    unittest.main()
