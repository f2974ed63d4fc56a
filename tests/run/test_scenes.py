"""The scenes as they are delivered: every prm/*.prm can be read with all that it names, and every
meshes/*.geo is meshed without a complaint, coarse and as it is, with sound cells and a name on every
part of the boundary. The pressure in a closed cavity widens it."""

import csv
import os
import re
import subprocess
import sys
import tempfile
import unittest
from itertools import combinations
from pathlib import Path

import numpy as np

ROOT = Path(__file__).parents[2]
sys.path.insert(0, str(ROOT / "convergence" / "dolfinx"))
import gmsh_mesh  # noqa: E402
from gmsh_mesh import (HEXAHEDRON, LINE, QUADRILATERAL, TETRAHEDRON, TRIANGLE,  # noqa: E402
                       read_mesh)

ISOCHOR = os.environ["ISOCHOR"]
GEOMETRIES = sorted((ROOT / "meshes").glob("*.geo"))
SCENES = sorted((ROOT / "prm").glob("*.prm"))

# Of a cell, in gmsh's order of its vertices; and the type of cells that sides are.
SIDES = {TRIANGLE: (LINE, ((0, 1), (1, 2), (2, 0))),
         QUADRILATERAL: (LINE, ((0, 1), (1, 2), (2, 3), (3, 0))),
         TETRAHEDRON: (TRIANGLE, ((0, 1, 2), (0, 1, 3), (0, 2, 3), (1, 2, 3))),
         HEXAHEDRON: (QUADRILATERAL, ((0, 1, 2, 3), (4, 5, 6, 7), (0, 1, 5, 4), (1, 2, 6, 5),
                                      (2, 3, 7, 6), (3, 0, 4, 7)))}
LEAST_ANGLE = 2  # degrees, between faces of a tetrahedron; a regular one has 70


def as_set(sides):
    return set(map(tuple, np.sort(sides, axis=1)))


def boundary(cells, kind):
    """Sides of one cell only: of a conforming mesh, its boundary."""
    sides = np.sort(np.concatenate([cells[:, side] for side in SIDES[kind][1]]), axis=1)
    found, n = np.unique(sides, axis=0, return_counts=True)
    return as_set(found[n == 1]), n.max()


def least_angle(points, tetrahedra):
    """Between two faces, degrees."""
    corners = points[tetrahedra]
    a, b, c = (corners[:, i] - corners[:, 0] for i in (1, 2, 3))
    normals = [np.cross(b, c), np.cross(c, a), np.cross(a, b)]
    normals.append(-sum(normals))
    normals = [n / np.linalg.norm(n, axis=1)[:, None] for n in normals]
    cosines = [-np.einsum("ij,ij->i", m, n) for m, n in combinations(normals, 2)]
    return np.degrees(np.arccos(np.max(cosines)))


class Geometries(unittest.TestCase):
    def check(self, geometry, size, hexahedra):
        with tempfile.TemporaryDirectory() as folder:
            file = Path(folder) / "body.msh"
            told = gmsh_mesh.write_mesh(geometry, size, file, hexahedra=int(hexahedra))
            points, cells = read_mesh(file)
        self.assertEqual(told, [])
        kind = max(cells)
        wanted = (QUADRILATERAL, HEXAHEDRON) if hexahedra else (TRIANGLE, TETRAHEDRON)
        self.assertIn(kind, wanted)
        named = SIDES[kind][0]
        self.assertEqual(set(cells), {named, kind})
        outer, most = boundary(cells[kind], kind)
        self.assertEqual(most, 2, "cells that share a side")
        # With groups in the file, gmsh saves only what is in one: what has a name.
        self.assertEqual(as_set(cells[named]), outer)
        if kind == TETRAHEDRON:
            self.assertGreater(least_angle(points, cells[kind]), LEAST_ANGLE)

    def test_every_geometry(self):
        for geometry in GEOMETRIES:
            text = geometry.read_text()
            size = float(re.search(r"size\s*=\s*([0-9.]+)\s*\]", text)[1])
            for factor in (2, 1):
                for hexahedra in ([False, True] if "hexahedra" in text else [False]):
                    with self.subTest(geometry=geometry.name, size=factor * size,
                                      hexahedra=hexahedra):
                        self.check(geometry, factor * size, hexahedra)


class Scenes(unittest.TestCase):
    def run_isochor(self, file, *arguments):
        result = subprocess.run([ISOCHOR, file, *arguments], capture_output=True, text=True,
                                env=dict(os.environ, OMP_NUM_THREADS="1"))
        self.assertEqual(result.returncode, 0, result.stdout + result.stderr)

    def coarse(self, file):
        """Arguments that make the edges of the scene's mesh twice as long."""
        text = file.read_text()
        cells = re.search(r"set Cells\s*=\s*([0-9, ]+)", text)
        if cells:
            halves = [str((int(n) + 1) // 2) for n in cells[1].split(",")]
            return ["--set", "Scene/Cells=" + ", ".join(halves)]
        geometry = (file.parent / re.search(r"set Mesh\s*=\s*(\S+)", text)[1]).read_text()
        size = float(re.search(r"size\s*=\s*([0-9.]+)\s*\]", geometry)[1])
        return ["--set", f"Scene/Mesh size={2 * size}"]

    def test_every_scene_is_read(self):
        for file in SCENES:
            with self.subTest(scene=file.name):
                self.run_isochor(file, "--check", *self.coarse(file))

    def hardly_loaded(self, file, element, scale):
        """The row of the scene by this element, its pressure times SCALE."""
        pressure = re.search(r"set Pressure\s*=\s*(inner: \S+)", file.read_text())[1]
        with tempfile.TemporaryDirectory() as folder:
            self.run_isochor(file, *self.coarse(file), "--output", folder, "--overwrite",
                             "--set", f"Scene/Pressure={pressure}*{scale}",
                             "--set", f"Method/Element={element}", "--set", "Method/Load steps=1",
                             "--set", "Output/VTU=none")
            with open(Path(folder) / "results.csv", newline="") as stream:
                [row] = csv.DictReader(stream)
        return row

    def test_pressure_widens_cavities(self):
        for name in ("bubble", "cushion", "finger"):
            file = ROOT / "prm" / f"{name}.prm"
            with self.subTest(scene=name):
                volumes = [float(self.hardly_loaded(file, "P1-P1", scale)["cavity [m^3]"])
                           for scale in ("1e-6", "0.1")]
                self.assertGreater(volumes[1], 1.01 * volumes[0])

    def test_hexahedra_fill_the_same_body(self):
        file = ROOT / "prm" / "finger.prm"
        rows = [self.hardly_loaded(file, element, "1e-6") for element in ("P1-P1", "Q1-P0")]
        for column in ("volume [m^3]", "cavity [m^3]"):
            by_tetrahedra, by_hexahedra = (float(row[column]) for row in rows)
            self.assertAlmostEqual(by_hexahedra / by_tetrahedra, 1, delta=1e-5)


if __name__ == "__main__":
    unittest.main()
