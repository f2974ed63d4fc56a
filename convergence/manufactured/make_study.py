#!/usr/bin/env python3
"""Writes the parameter files of this folder: make_study.py (needs sympy, Debian's python3-sympy).

The motion is a composition of shears, so that J = 1 exactly:
    x1 = X + a sin(k Y),  x2 = Y + b sin(k x1),  in 3D also x3 = Z + c sin(k x2).
With the neo-Hookean energy (32) and p Phi(J), P = mu (F - F^-T) + p F^-T. Body force b = -Div P and
traction P N follow; some sides take the displacement, the others the traction. For a finite bulk
modulus p = kappa (J - 1) = 0. Each set of formulas is checked against P and Div P by numbers.
"""

import random
from pathlib import Path

import sympy
from sympy import Matrix, Rational, cos, diff, pi, sin
from sympy.printing.str import StrPrinter

FOLDER = Path(__file__).parent
COORDINATES = sympy.symbols("x y z")
SIDES = ["left", "right", "bottom", "top", "back", "front"]  # x = 0, x = 1, y = 0, ...


class FormulaPrinter(StrPrinter):
    """For muParser: powers as products, because ** is none of its operators and the order of - and
    ^ is a matter of version."""

    def _print_Pow(self, power, rational=False):
        if power.exp.is_Integer and power.exp > 0:
            base = self._print(power.base)
            if not (power.base.is_Atom or power.base.is_Function):
                base = f"({base})"
            return "(" + "*".join([base] * int(power.exp)) + ")"
        raise ValueError(f"no formula for {power}")


def formula(expression):
    return FormulaPrinter().doprint(expression)


class Solution:
    """Displacement, pressure, body force and tractions, formulas of x, y, z."""

    def __init__(self, dim, wave_number, amplitude, mu, p):
        self.X = COORDINATES[:dim]
        k = wave_number * pi
        x1 = self.X[0] + amplitude * sin(k * self.X[1])
        x2 = self.X[1] + amplitude * sin(k * x1)
        x = [x1, x2] if dim == 2 else [x1, x2, self.X[2] + amplitude * sin(k * x2)]
        self.x, self.p, self.mu = x, p, mu
        F = Matrix(dim, dim, lambda i, J: diff(x[i], self.X[J]))
        cofactor = F.cofactor_matrix()  # F^-T, because J = 1
        self.u = [x[i] - self.X[i] for i in range(dim)]
        # Div F^-T = 0 by Piola's identity.
        self.force = [-sum(mu * diff(F[i, J], self.X[J]) + cofactor[i, J] * diff(p, self.X[J])
                           for J in range(dim)) for i in range(dim)]
        stress = (mu * (F - cofactor) + p * cofactor)
        self.traction = {side: [((-1) ** (k + 1) * stress[i, k // 2]).subs(self.X[k // 2], k % 2)
                                for i in range(dim)] for k, side in enumerate(SIDES[:2 * dim])}
        self.check(F)

    def check(self, F):
        """Div P at random points by differences of P with F inverted, nothing simplified."""
        dim = len(self.X)
        place = lambda expression, at: expression.subs(dict(zip(self.X, at))).evalf(40)

        def stress(at):
            at_F = F.applyfunc(lambda entry: place(entry, at))
            assert abs(at_F.det() - 1) < 1e-30
            inverse = at_F.inv().T
            return self.mu * (at_F - inverse) + place(sympy.sympify(self.p), at) * inverse

        h = Rational(1, 10**8)
        for _ in range(3):
            at = [Rational(random.randint(1, 999), 1000) for _ in self.X]
            div = Matrix([0] * dim)
            for J in range(dim):
                ahead = [c + h * int(J == d) for d, c in enumerate(at)]
                behind = [c - h * int(J == d) for d, c in enumerate(at)]
                div += (stress(ahead)[:, J] - stress(behind)[:, J]) / (2 * h)
            for i in range(dim):
                assert abs(div[i] + place(self.force[i], at)) < 1e-10
            for k, side in enumerate(SIDES[:2 * dim]):
                there = [Rational(k % 2) if d == k // 2 else c for d, c in enumerate(at)]
                for i in range(dim):
                    pull = (-1) ** (k + 1) * stress(there)[i, k // 2]
                    assert abs(pull - place(self.traction[side][i], there)) < 1e-25


def parameter_file(solution, title, comment, variations, youngs_modulus, poisson_ratio, elements,
                   free=("right",)):
    dim = len(solution.X)
    u = ", ".join(map(formula, solution.u))
    moved = ", ".join(f"load*({formula(part)})" for part in solution.u)
    sides = SIDES[:2 * dim]
    lines = [f"# {line}" for line in comment] + [
        "# Written by make_study.py, which says where the formulas come from.", "",
        "subsection Scene",
        f"  set Dimension              = {dim}",
        *(f"  set {key:22} = {value}" for key, value in variations.items()),
        f"  set Young's modulus        = {youngs_modulus}  # Pa: mu = 1",
        f"  set Poisson ratio          = {poisson_ratio}",
        f"  set Prescribed displacement = " + "; \\\n    ".join(f"{side}: {moved}" for side in sides if side not in free),
        "  set Traction               = " + "; \\\n    ".join(
            f"{side}: " + ", ".join(map(formula, solution.traction[side])) for side in free),
        "  set Body force             = " + ", ".join(map(formula, solution.force)),
        f"  set Probes                 = u L2: displacement L2 error against {u}; \\",
        f"    u H1: displacement H1 error against {u}; \\",
        f"    p L2: pressure L2 error against {formula(sympy.sympify(solution.p))}",
        "end", "",
        "subsection Method",
        f"  set Element          = {{{{{elements}}}}}",
        "  set Newton tolerance = 1e-10",
        "end", "",
        "subsection Output",
        "  set VTU = none",
        "end", "",
        "subsection Study",
        f"  set Title = {title}",
        "end", ""]
    return "\n".join(lines)


def main():
    x, y, z = COORDINATES
    square = dict(dim=2, wave_number=2, amplitude=Rational(1, 20))
    cube = dict(dim=3, wave_number=1, amplitude=Rational(1, 20))
    # Tension everywhere: sides that dead tractions compress would wrinkle.
    p = 1 + cos(pi * x) * cos(pi * y) * cos(pi * z) / 2
    cubes = {"Mesh": "{{box(1, 1, 1)|unit_cube.geo}}", "Mesh size": "{{0.5|0.3333|0.25|0.1667}}"}
    pairs = "P1-P1|P1-P1s|MINI|P2-P0|P2-P1|P3-P2"
    sizes = "{{0.2|0.1|0.05|0.025}}"
    meshes = "{{rectangle(1, 1)|unit_square.geo}}"
    quadrilaterals = "{{rectangle(1, 1)|unit_square_quadrilaterals.geo}}"
    p_square = cos(pi * x) * cos(pi * y) + x
    files = {
        "study": parameter_file(
            Solution(**square, mu=1, p=p_square),
            "Manufactured solution, plane strain, nu = 0.5",
            ["Manufactured solution with J = 1, plane strain, incompressible: the pairs."],
            {"Mesh": meshes, "Mesh size": sizes}, 3, 0.5, pairs),
        "compressible": parameter_file(
            Solution(**square, mu=1, p=0),
            "Manufactured solution, plane strain, nu = 0.3",
            ["Manufactured solution with J = 1, plane strain, nu = 0.3: the displacement elements."],
            {"Mesh": meshes, "Mesh size": sizes}, 2.6, 0.3, "P1|P2|P3"),
        "nearly_incompressible": parameter_file(
            Solution(**square, mu=1, p=0),
            "Manufactured solution, plane strain, nu = 0.4999",
            ["Manufactured solution with J = 1, plane strain, nu = 0.4999: what displacement",
             "elements lose, and pairs do not."],
            {"Mesh": "unit_square.geo", "Mesh size": sizes}, 2.9998, 0.4999,
            "P1|P2|P3|P1-P1|P1-P1s|MINI|P2-P1|P3-P2"),
        "quadrilaterals": parameter_file(
            Solution(**square, mu=1, p=p_square),
            "Manufactured solution, quadrilaterals, nu = 0.5",
            ["Manufactured solution with J = 1, plane strain, incompressible: quadrilaterals."],
            {"Mesh": quadrilaterals, "Mesh size": sizes}, 3, 0.5, "Q1-P0|Q2-P1"),
        "quadrilaterals_compressible": parameter_file(
            Solution(**square, mu=1, p=0),
            "Manufactured solution, quadrilaterals, nu = 0.3",
            ["Manufactured solution with J = 1, plane strain, nu = 0.3: quadrilaterals."],
            {"Mesh": quadrilaterals, "Mesh size": sizes}, 2.6, 0.3, "Q1|Q2"),
        "hexahedra": parameter_file(
            Solution(**cube, mu=1, p=p),
            "Manufactured solution, hexahedra, nu = 0.5",
            ["Manufactured solution with J = 1, unit cube, incompressible: hexahedra."],
            {"Mesh": "box(1, 1, 1)", "Mesh size": "{{0.5|0.3333|0.25|0.1667}}"}, 3, 0.5,
            "Q1-P0|Q2-P1", free=SIDES[1:]),
        "cube": parameter_file(
            Solution(**cube, mu=1, p=p),
            "Manufactured solution, unit cube held on one side, nu = 0.5",
            ["Manufactured solution with J = 1, unit cube, incompressible: the pairs. One side takes",
             "the displacement, so that no cell has all its vertices where it is prescribed."],
            cubes, 3, 0.5, pairs, free=SIDES[1:]),
        "cube_clamped": parameter_file(
            Solution(**cube, mu=1, p=p),
            "Manufactured solution, unit cube held on five sides, nu = 0.5",
            ["Manufactured solution with J = 1, unit cube, incompressible: five sides take the",
             "displacement, so that cells along edges have all their vertices there."],
            cubes, 3, 0.5, pairs),
        "cube_compressible": parameter_file(
            Solution(**cube, mu=1, p=0),
            "Manufactured solution, unit cube, nu = 0.3",
            ["Manufactured solution with J = 1, unit cube, nu = 0.3: the displacement elements."],
            cubes, 2.6, 0.3, "P1|P2|P3"),
    }
    for name, text in files.items():
        (FOLDER / f"{name}.prm").write_text(text)


if __name__ == "__main__":
    main()
