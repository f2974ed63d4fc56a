"""What a run or a study is limited to: Method/Time limit, Study/Most unknowns."""

import unittest

from isochor_case import IsochorCase, read_csv

BEAM = """
subsection Scene
  set Mesh          = box(1, 0.1, 0.1)
  set Mesh size     = {size}
  set Poisson ratio = 0.45
  set Fixed         = left
  set Traction      = right: 0, -10, 0
  set Probes        = tip: mean displacement y on right
end
subsection Method
  set Element    = {element}
  set Load steps = {steps}
end
"""


class Limits(IsochorCase):
    def test_time_limit(self):
        for ranks in (1, 2):
            with self.subTest(ranks=ranks):
                told = self.run_isochor(BEAM.format(size=0.05, element="P1", steps=100000), "--overwrite",
                                        "--set", "Method/Time limit=3", "--set", "Output/VTU=none",
                                        "--set", "Output/Checkpoint=never", ranks=ranks, code=2)
                row = read_csv(self.out / "results.csv")[0]
                self.assertEqual(row["status"], "not converged")
                self.assertRegex(row["reason"], "^time limit of 3 s: interrupted (after|on the way to)")
                self.assertIn("time limit of 3 s", told)
                self.assertLess(float(row["load factor"]), 1)
                self.assertGreater(int(row["load steps"]), 0)
                self.assertLess(float(row["seconds total"]), 20)

    def test_most_unknowns(self):
        # A reference is not left out; P2 has more unknowns than P1 on the same mesh.
        text = BEAM.format(size="{{0.1|0.05|0.025}}", element="{{P1|P2}}", steps=1) + """
subsection Study
  set Reference     = Method/Element = P2; Scene/Mesh size = 0.05
  set Most unknowns = 600
end
"""
        self.run_isochor(text)
        rows = read_csv(self.out / "results.csv")
        runs = [(r["Method/Element"], r["Scene/Mesh size"]) for r in rows]
        self.assertEqual(runs, [("P1", "0.1"), ("P1", "0.05"), ("P2", "0.1"), ("P2", "0.05")])
        self.assertGreater(int(rows[-1]["unknowns"]), 600)
        self.assertTrue(all(r["tip error"] for r in rows))


if __name__ == "__main__":
    unittest.main()
