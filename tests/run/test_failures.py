"""What asks for failure: every run ends in a result (exit code 0) or in a reason with a name (1 for
what the user must mend, 2 for no equilibrium), never in a crash; the last converged state is on
disk, and results.csv says how far the load got and why no further."""

import unittest
from pathlib import Path

from isochor_case import CONVERGED, IsochorCase, read_csv

CANTILEVER = Path(__file__).resolve().parents[2] / "meshes" / "cantilever.geo"
SCENE = """
subsection Scene
  set Mesh            = {mesh}
  set Cells           = {cells}
  set Young's modulus = 66e3
  set Poisson ratio   = {poisson_ratio}
  set Fixed           = {fixed}
  {loads}
  set Probes          = volume: volume
end
subsection Method
  set Element           = {element}
  set Load steps        = {steps}
  set Minimum load step = {minimum}
end
"""


def scene(mesh="box(0.2, 0.2, 0.2)", cells="3, 3, 3", poisson_ratio=0.49, fixed="bottom", loads="",
          element="P1-P1", steps=1, minimum=0.02):
    return SCENE.format(**locals())


def thin_layer_mesh(n, thickness):
    """A box of 0.1 x 0.1 x 0.1 m in gmsh's format, n x n x n blocks of six tetrahedra, in the
    middle of its height a layer of this thickness (m): edges from it to the blocks' diagonals."""
    def number(i, j, k):
        return 1 + i + (n + 1) * (j + (n + 2) * k)

    flat = [0.1 * i / n for i in range(n + 1)]
    middle = n // 2
    heights = flat[:middle + 1] + [flat[middle] + thickness] + flat[middle + 1:]
    nodes = [(number(i, j, k), x, y, z) for i, x in enumerate(flat)
             for j, y in enumerate(heights) for k, z in enumerate(flat)]
    steps = [((1, 0, 0), (0, 1, 0), (0, 0, 1)), ((0, 1, 0), (0, 0, 1), (1, 0, 0)),
             ((0, 0, 1), (1, 0, 0), (0, 1, 0)), ((0, 1, 0), (1, 0, 0), (0, 0, 1)),
             ((1, 0, 0), (0, 0, 1), (0, 1, 0)), ((0, 0, 1), (0, 1, 0), (1, 0, 0))]
    elements = []
    for i in range(n):
        for j in range(n + 1):
            for k in range(n):
                for path in steps:
                    corner, tetrahedron = (i, j, k), [number(i, j, k)]
                    for step in path:
                        corner = tuple(a + b for a, b in zip(corner, step))
                        tetrahedron.append(number(*corner))
                    if path in steps[3:]:  # mirrored
                        tetrahedron[2:] = tetrahedron[:1:-1]
                    elements.append((4, 3, tetrahedron))
    for i in range(n):
        for k in range(n):
            for tag, j in ((1, 0), (2, n + 1)):
                a, b, c, d = (number(i, j, k), number(i + 1, j, k), number(i + 1, j, k + 1),
                              number(i, j, k + 1))
                elements += [(2, tag, [a, b, c]), (2, tag, [a, c, d])]
    lines = ["$MeshFormat", "2.2 0 8", "$EndMeshFormat", "$PhysicalNames", "3", '2 1 "bottom"',
             '2 2 "top"', '3 3 "body"', "$EndPhysicalNames", "$Nodes", str(len(nodes))]
    lines += [" ".join(map(str, node)) for node in nodes]
    lines += ["$EndNodes", "$Elements", str(len(elements))]
    lines += [f"{e} {kind} 2 {tag} {tag} " + " ".join(map(str, vertices))
              for e, (kind, tag, vertices) in enumerate(elements, 1)]
    return "\n".join([*lines, "$EndElements", ""])


class Failures(IsochorCase):
    def end(self, text, *arguments, **keywords):
        """A run that converges or says why not: its row, exit code and words."""
        process = self.start(text, *arguments, **keywords)
        out, err = process.communicate(timeout=300)
        self.assertIn(process.returncode, (0, 2), out + err)
        status = CONVERGED if process.returncode == 0 else "not converged"
        row = self.check_files(status)
        self.assertIn(status, out)
        if process.returncode == 0:
            self.assertEqual(float(row["load factor"]), 1)
            self.assertGreater(float(row["min J"]), 0)
        else:
            self.assertLess(float(row["load factor"]), 1)
            self.assertIn(f"from load factor {float(row['load factor']):.4g}"[:20], row["reason"])
            self.assertRegex(row["reason"], "Newton|line search|inverts|pivots|singular|residual")
        return row, process.returncode, out + err

    def test_load_hundred_times_too_big(self):
        # Figure 12 of the paper has 15 kPa.
        loads = "set Traction = top: 0, -15e5, 0"
        for ranks in (1, 2):
            with self.subTest(ranks=ranks):
                self.out = self.folder / f"out_{ranks}"
                # A dead load finds an equilibrium in the end, with the body turned over.
                row = self.end(scene(loads=loads), ranks=ranks)[0]
                self.assertGreater(float(row["load factor"]), 0)

    def test_flattened_in_the_end(self):
        # At two thirds of the load the top is where the bottom is: inverted cells, no limit point.
        row, code, _ = self.end(scene(cells="2, 2, 2", poisson_ratio=0.3, element="P1", steps=4,
                                      loads="set Prescribed displacement = top: 0, -0.3*load, 0"))
        self.assertEqual(code, 2)
        self.assertIn("inverted cell", row["reason"])
        self.assertNotIn("limit point", row["reason"])

    def test_crushed_cells(self):
        # A load 25 times its own stretches the beam to several times its length.
        for gravity, is_crushed in ((9.8, False), (245, True)):
            row, code, told = self.end(
                scene(mesh="box(1, 0.1, 0.1)", cells="10, 1, 1", fixed="left", poisson_ratio=0.4999,
                      element="P2-P1",
                      loads=f"set Gravity = 0, -{gravity}, 0\n set Density = 1070"),
                "--overwrite")
            self.assertEqual(code, 0)
            self.assertAlmostEqual(float(row["volume ratio"]), 1, 3)
            self.assertEqual(float(row["min J"]) < 0.5, is_crushed)
            self.assertEqual("cells are nearly crushed" in told, is_crushed, told)

    def test_stalls_without_the_filter(self):
        # Quadratics close to nu = 0.5: Newton's first step stretches the beam, from where its next ones
        # lead nowhere; the tip is that of shorter load steps, which need no filter.
        def beam(steps, minimum):
            return scene(mesh=CANTILEVER, cells="", fixed="left", element="P2",
                         poisson_ratio=0.499, steps=steps, minimum=minimum,
                         loads="set Mesh size = 0.1\n set Gravity = 0, -2.4, 0\n"
                               "set Density = 1070").replace(
                             "volume: volume", "tip: mean displacement y on right")

        unfiltered = "Method/Curvature filter=none"
        row, code, _ = self.end(beam(10, 0.1), "--set", unfiltered)
        self.assertEqual((code, row["failed steps"]), (2, "1"))
        row, code, _ = self.end(beam(10, 0.1), "--overwrite")
        self.assertEqual((code, row["failed steps"]), (0, "0"))
        fine, code, _ = self.end(beam(16, 0.001), "--overwrite", "--set", unfiltered)
        self.assertEqual(code, 0)
        self.assertAlmostEqual(float(row["tip [m]"]), float(fine["tip [m]"]), 6)

    def test_singular_pressure(self):
        # Three spurious pressure modes, whatever the load.
        row, _, told = self.end(scene(poisson_ratio=0.5, fixed="bottom",
                                      loads="set Traction = top: 0, -1e3, 0"))
        self.assertIn("null pivots", told)
        self.assertIn("P1-P1s", told)
        self.assertGreater(int(row["null pivots"]), 0)
        row, code, told = self.end(scene(poisson_ratio=0.5, element="P1-P1s",
                                         loads="set Traction = top: 0, -1e3, 0"), "--overwrite")
        self.assertEqual((code, row["null pivots"]), (0, "0"))
        self.assertNotIn("null pivots", told)

    def test_full_turn(self):
        bar = dict(mesh="box(1, 0.2, 0.2)", cells="8, 2, 2", fixed="left", poisson_ratio=0.45)
        turn = "set Prescribed rotation = right: 360 about 1, 0.1, 0.1 axis 1, 0, 0"
        formula = ("set Prescribed displacement = right: 0, "
                   "(cos(2*pi*load) - 1)*(y - 0.1) - sin(2*pi*load)*(z - 0.1), "
                   "sin(2*pi*load)*(y - 0.1) + (cos(2*pi*load) - 1)*(z - 0.1)")
        for loads in (turn, formula):
            with self.subTest(loads=loads):
                self.out = self.folder / loads.split()[2]
                # In one step a full turn is none at all.
                told = self.run_isochor(scene(loads=loads, **bar), code=1)
                self.assertIn("Method/Load steps", told)
                row, _, _ = self.end(scene(loads=loads, steps=12, **bar))
                self.assertGreater(float(row["load factor"]), 0.25)

    def test_later_turn(self):
        bar = dict(mesh="box(1, 0.2, 0.2)", cells="8, 2, 2", fixed="left", poisson_ratio=0.45)
        # 22 degrees in the first half, 338 in the second; of six equal steps, the last has 186.
        angle = "2*pi*load^4"
        turn = (f"set Prescribed displacement = right: 0, (cos({angle}) - 1)*(y - 0.1) - "
                f"sin({angle})*(z - 0.1), sin({angle})*(y - 0.1) + (cos({angle}) - 1)*(z - 0.1)")
        for ranks in (1, 2):
            told = self.run_isochor(scene(loads=turn, steps=2, **bar), ranks=ranks, code=1)
            self.assertIn("in one of 2, from load factor 0.5 on, the prescribed displacements turn "
                          "by more than half a turn; allowed for this scene: at least 7", told)
        # To and fro is no turn, wherever steps begin and end.
        for steps in (2, 3, 10):
            with self.subTest(steps=steps):
                self.out = self.folder / f"to_and_fro_{steps}"
                loads = "set Prescribed displacement = right: 0.1*sin(2*pi*load), 0, 0"
                _, code, _ = self.end(scene(loads=loads, steps=steps, **bar))
                self.assertEqual(code, 0)

    def test_flattened_start(self):
        for start in ("0, -y, 0", "0, -1.5*y, 0"):
            told = self.run_isochor(scene(
                loads=f"set Gravity = 0, -1, 0\n set Initial displacement = {start}"), code=1)
            self.assertIn("Scene/Initial displacement: it flattens or inverts cells", told)
            self.assertFalse(self.out.exists())
        # Flat, but not quite: the way back is found, or a reason.
        row, code, _ = self.end(scene(
            loads="set Gravity = 0, -1, 0\n set Initial displacement = 0, -0.5*y, 0"))
        if code == 0:
            self.run_isochor(scene(loads="set Gravity = 0, -1, 0"), out=self.folder / "plain")
            plain = read_csv(self.folder / "plain" / "results.csv")[0]
            self.assertAlmostEqual(float(row["volume [m^3]"]) / float(plain["volume [m^3]"]), 1, 6)

    def test_slivers(self):
        (self.folder / "layer.msh").write_text(thin_layer_mesh(4, 0.025 * 2**0.5 / 67))
        for element in ("P1", "P1-P1"):
            with self.subTest(element=element):
                self.out = self.folder / element
                row, code, _ = self.end(scene(mesh="layer.msh", cells="", element=element,
                                              loads="set Traction = top: 0, -3e3, 0"))
                self.assertEqual(code, 0)
                self.assertLess(float(row["min angle [deg]"]), 1.5)
                self.assertGreater(float(row["max aspect"]), 60)


if __name__ == "__main__":
    unittest.main()
