"""Study/Reference and Reference check that set what the file leaves at its default: no other run takes
their value."""

import unittest

from isochor_case import IsochorCase, read_csv

STUDY = """
subsection Scene
  set Mesh            = box(1, 0.1, 0.1)
  set Mesh size       = 0.1
  set Young's modulus = 266e3
  set Poisson ratio   = {{0.3|0.4}}
  set Fixed           = left
  set Traction        = right: 0, -300, 0
  set Probes          = tip: mean displacement y on right
end
subsection Study
  set Reference       = Method/Load steps = 2
  set Reference check = Method/Load steps = 3
end
"""


class References(IsochorCase):
    def test_defaults_stay(self):
        self.run_isochor(STUDY)
        rows = read_csv(self.out / "results.csv")
        self.assertEqual([row["Method/Load steps"] for row in rows if row["role"] == "run"],
                         ["1", "1"])
        self.assertEqual(sorted(row["Method/Load steps"] for row in rows
                                if row["role"] == "reference"), ["2", "2", "3", "3"])
        self.assertEqual([row["load steps"] for row in rows if row["role"] == "run"], ["1", "1"])


if __name__ == "__main__":
    unittest.main()
