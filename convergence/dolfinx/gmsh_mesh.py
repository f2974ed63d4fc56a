#!/usr/bin/python3
"""Tetrahedra of a .geo file, by the gmsh library that Isochor meshes with, and their .msh file.

  gmsh_mesh.py GEOMETRY.geo EDGE_LENGTH TARGET.msh
"""

import ctypes
import ctypes.util
import sys
from pathlib import Path

import numpy as np


# gmsh's numbers of types of cells.
LINE, TRIANGLE, QUADRILATERAL, TETRAHEDRON, HEXAHEDRON = 1, 2, 3, 4, 5


class Failed(Exception):
    pass


def write_mesh(geometry, size, target, **constants):
    """Mesh the file GEOMETRY with edge length SIZE (m) into TARGET, version 2.2 of gmsh's format.

    CONSTANTS are those of its DefineConstant. Returns what gmsh warned of and could not do."""
    name = ctypes.util.find_library("gmsh")
    if name is None:
        raise Failed("the gmsh library is missing: apt-get install libgmsh-dev")
    gmsh = ctypes.CDLL(name)

    def call(function, *arguments):
        error = ctypes.c_int(0)
        getattr(gmsh, function)(*arguments, ctypes.byref(error))
        if error.value:
            raise Failed(f"{function}: gmsh error {error.value}")

    def option(key, value):
        call("gmshOptionSetNumber", key.encode(), ctypes.c_double(value))

    def complaints():
        lines, n = ctypes.POINTER(ctypes.c_char_p)(), ctypes.c_size_t(0)
        call("gmshLoggerGet", ctypes.byref(lines), ctypes.byref(n))
        log = [lines[i].decode() for i in range(n.value)]
        return [line for line in log if line.startswith(("Warning", "Error"))]

    # A constant that exists before DefineConstant wins.
    constants = {"size": size, **constants}
    wrapper = target.with_suffix(".geo")
    wrapper.write_text("".join(f"{key} = {value!r};\n" for key, value in constants.items())
                       + f'Include "{geometry}";\n', encoding="utf-8")
    call("gmshInitialize", 0, None, 0)
    option("General.Terminal", 0)
    option("General.NumThreads", 1)
    option("Mesh.RandomSeed", 1)
    option("Mesh.MshFileVersion", 2.2)
    call("gmshLoggerStart")
    call("gmshOpen", str(wrapper).encode())
    call("gmshModelMeshGenerate", 3)
    call("gmshWrite", str(target).encode())
    told = complaints()
    call("gmshLoggerStop")
    call("gmshFinalize")
    return told


def read_mesh(file):
    """Points (n, 3) and cells, by gmsh's number of their type (m, nodes), of a .msh file 2.2."""
    with open(file, encoding="utf-8") as stream:
        sections = {}
        for line in stream:
            if line.startswith("$") and not line.startswith("$End"):
                lines = sections[line.strip()[1:]] = []
            elif not line.startswith("$"):
                lines.append(line)
    nodes = np.array([line.split() for line in sections["Nodes"][1:]], dtype=float)
    place = np.full(int(nodes[:, 0].max()) + 1, -1, dtype=np.int64)
    place[nodes[:, 0].astype(np.int64)] = np.arange(len(nodes))
    cells = {}
    for line in sections["Elements"][1:]:
        _, kind, n_tags, *rest = map(int, line.split())
        cells.setdefault(kind, []).append(rest[n_tags:])
    return nodes[:, 1:], {kind: place[np.array(of_kind)] for kind, of_kind in cells.items()}


def read_tetrahedra(file):
    """Points (n, 3) and tetrahedra (m, 4) of a .msh file of version 2.2."""
    points, cells = read_mesh(file)
    return points, cells[TETRAHEDRON]


if __name__ == "__main__":
    write_mesh(Path(sys.argv[1]).resolve(), float(sys.argv[2]), Path(sys.argv[3]))
