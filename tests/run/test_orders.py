"""Orders of convergence of every element on the manufactured solution of convergence/manufactured,
two sizes of unstructured triangles: k + 1 and k in the displacement (L2, H1), and in the pressure of
the stable pairs one more than its degree, all known from theory."""

import os
import subprocess
import sys
import tempfile
import unittest
from pathlib import Path

ROOT = Path(__file__).parents[2]
sys.path.insert(0, str(ROOT / "scripts"))
from results_table import Study  # noqa: E402

ISOCHOR = os.environ["ISOCHOR"]
SLACK = 0.15  # the meshes of 0.2 and 0.1 m are not similar


class Orders(unittest.TestCase):
    def orders(self, file, elements):
        with tempfile.TemporaryDirectory() as folder:
            result = subprocess.run(
                [ISOCHOR, ROOT / "convergence" / "manufactured" / file, "--output", folder,
                 "--set", "Scene/Mesh=unit_square.geo", "--set", "Scene/Mesh size={{0.2|0.1}}",
                 "--set", f"Method/Element={{{{{elements}}}}}"], capture_output=True, text=True)
            self.assertEqual(result.returncode, 0, result.stdout + result.stderr)
            study = Study(Path(folder) / "results.csv")
        return {(probe.name, settings["Method/Element"]): line[-1][2]
                for probe in study.probes for settings, line in study.orders(probe)}

    def check(self, orders, element, **expected):
        for probe, order in expected.items():
            with self.subTest(element=element, probe=probe):
                self.assertAlmostEqual(orders[probe.replace("_", " "), element], order, delta=SLACK)

    def test_pairs_at_half(self):
        orders = self.orders("study.prm", "P2-P1|P3-P2")
        self.check(orders, "P2-P1", u_L2=3, u_H1=2, p_L2=2)
        self.check(orders, "P3-P2", u_L2=4, u_H1=3, p_L2=3)

    def test_displacement_elements(self):
        orders = self.orders("compressible.prm", "P1|P2|P3")
        self.check(orders, "P1", u_L2=2, u_H1=1)
        self.check(orders, "P2", u_L2=3, u_H1=2)
        self.check(orders, "P3", u_L2=4, u_H1=3)


if __name__ == "__main__":
    unittest.main()
