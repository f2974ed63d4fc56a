#!/usr/bin/env python3
"""Writes the parameter files of this folder: make_study.py.

A uniform deformation x = F X with J = 1 and a uniform pressure p are in equilibrium: the neo-Hookean
energy (32) with p Phi(J) gives P = mu (F - F^-T) + p F^-T everywhere. For pairs the side x = 0 takes
the displacement, all others the traction P N: no cell has all its vertices where the displacement is
prescribed, and no pressure mode is free; p = 0.7 Pa keeps all tractions in tension and the body
stable. Displacement elements have p = kappa (J - 1) = 0, hence sides under compression that would
buckle: only the side x = 1 takes the traction.
"""

from fractions import Fraction
from pathlib import Path

FOLDER = Path(__file__).parent
# det F = 1 in fractions.
F = {2: [["6/5", "3/10"], ["1/10", "103/120"]],
     3: [["5/4", "3/10", "0"], ["1/10", "103/125", "1/5"], ["0", "3/20", "83/80"]]}
SIDES = ["left", "right", "bottom", "top", "back", "front"]  # x = 0, x = 1, y = 0, ...
MESH = {2: "distorted_square.geo", 3: "distorted_cube.geo"}
PAIRS = "P1-P1|P1-P1s|MINI|P2-P0|P2-P1|P3-P2"
SIZES = {2: "{{0.4|0.2}}", 3: "{{0.5|0.3}}"}


def minor(matrix, i, j):
    rows = [[entry for J, entry in enumerate(row) if J != j]
            for I, row in enumerate(matrix) if I != i]
    return rows[0][0] if len(rows) == 1 else rows[0][0] * rows[1][1] - rows[0][1] * rows[1][0]


def parameter_file(dim, p, youngs_modulus, poisson_ratio, elements, what, free,
                   mesh=None):
    gradient = [[Fraction(entry) for entry in row] for row in F[dim]]
    cofactor = [[(-1) ** (i + j) * minor(gradient, i, j) for j in range(dim)] for i in range(dim)]
    assert sum(gradient[0][j] * cofactor[0][j] for j in range(dim)) == 1
    mu = 1
    stress = [[mu * (gradient[i][j] - cofactor[i][j]) + Fraction(p) * cofactor[i][j]
               for j in range(dim)] for i in range(dim)]
    pull = "; \\\n    ".join(
        f"{side}: " + ", ".join(str((-1) ** (k + 1) * stress[i][k // 2]) for i in range(dim))
        for k, side in enumerate(SIDES[:2 * dim]) if side in free)
    u = [" + ".join(f"({gradient[i][j] - (i == j)})*{'xyz'[j]}" for j in range(dim))
         for i in range(dim)]
    moved = ", ".join(f"load*({part})" for part in u)
    exact = ", ".join(u)
    return f"""\
# Patch test, {what}: a uniform deformation on a distorted mesh.
# Written by make_study.py, which says where the figures come from.

subsection Scene
  set Dimension               = {dim}
  set Mesh                    = {mesh or MESH[dim]}
  set Mesh size               = {SIZES[dim]}
  set Young's modulus         = {youngs_modulus}  # Pa: mu = 1
  set Poisson ratio           = {poisson_ratio}
  set Prescribed displacement = {"; ".join(f"{side}: {moved}" for side in SIDES[:2 * dim] if side not in free)}
  set Traction                = {pull}
  set Probes                  = u L2: displacement L2 error against {exact}; \\
    u H1: displacement H1 error against {exact}; \\
    p L2: pressure L2 error against {p}
end

subsection Method
  set Element          = {{{{{elements}}}}}
  set Newton tolerance = 1e-13
end

subsection Output
  set VTU = none
end

subsection Study
  set Title = Patch test, {what}
end
"""


def main():
    files = {
        "study": (2, "0.7", 3, 0.5, PAIRS, "plane strain, nu = 0.5", SIDES[1:]),
        "square_displacement": (2, "0", 2.6, 0.3, "P1|P2|P3|P1-P0", "plane strain, nu = 0.3",
                                ["right"]),
        "quadrilaterals": (2, "0.7", 3, 0.5, "Q1-P0|Q2-P1", "quadrilaterals, nu = 0.5",
                           SIDES[1:], "distorted_quadrilaterals.geo"),
        "quadrilaterals_displacement": (2, "0", 2.6, 0.3, "Q1|Q2", "quadrilaterals, nu = 0.3",
                                        ["right"], "distorted_quadrilaterals.geo"),
        "cube": (3, "0.7", 3, 0.5, PAIRS, "three dimensions, nu = 0.5",
                 SIDES[1:]),
        "cube_displacement": (3, "0", 2.6, 0.3, "P1|P2|P3|P1-P0", "three dimensions, nu = 0.3",
                              ["right"]),
    }
    for name, arguments in files.items():
        (FOLDER / f"{name}.prm").write_text(parameter_file(*arguments))


if __name__ == "__main__":
    main()
