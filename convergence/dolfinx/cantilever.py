#!/usr/bin/python3
"""The cantilever of prm/cantilever.prm in dolfinx 0.5: one run, its figures on stdout as JSON.

  cantilever.py MESH.msh ELEMENT POISSON_RATIO GRAVITY LOAD_STEPS PIVOTS

ELEMENT   P1-P1 or P2-P1
GRAVITY   in m/s^2, along -y
PIVOTS    what PETSc tells MUMPS: cholesky (LDL^T, symmetric and indefinite) or lu
Plain Newton: full steps, an exact tangent and new factors in each, from the last load step's state.

The energy, the quadrature and the measure of the residual are those of Isochor, so that both codes
solve the same equations equally well. Seconds leave out mesh and compilation of the forms; FFCx
keeps what it compiled, and the problem is set up twice, the second time on the clock.
"""

import json
import resource
import sys
import time

try:
    import dolfinx
    import gmsh_mesh
    import numpy as np
    import ufl
    from dolfinx import fem
    from dolfinx.fem import petsc
    from mpi4py import MPI
    from petsc4py import PETSc
except ImportError as error:
    sys.exit(f"error: {error}; Debian has it: apt-get install python3-dolfinx")

YOUNGS_MODULUS, DENSITY = 266e3, 1070.  # Pa, kg/m^3
TOLERANCE, MAX_ITERATIONS = 1e-8, 25    # Isochor's
COMPILER = {"cffi_extra_compile_args": ["-O3", "-march=native", "-g0"], "timeout": 120}
# Isochor's points: one is exact where F is constant; else Witherden and Vincent's 14.
RULE = {1: {"quadrature_degree": 1}, 2: {"quadrature_degree": 5, "quadrature_rule": "Xiao-Gimbutas"}}


class Stopwatch:
    """Seconds by phase."""

    def __init__(self):
        self.seconds = {}

    def measure(self, phase, action, *arguments):
        begin = time.perf_counter()
        result = action(*arguments)
        self.seconds[phase] = self.seconds.get(phase, 0.) + time.perf_counter() - begin
        return result


def on_plane(x):
    """Marks points of the face at X = x."""
    return lambda points: np.isclose(points[0], x, rtol=0, atol=1e-9)


class Problem:
    """Forms, supports and matrices of the scene."""

    def __init__(self, mesh, degree, poisson_ratio, gravity):
        P1, Pk = (ufl.FiniteElement("Lagrange", mesh.ufl_cell(), k) for k in (1, degree))
        space = fem.FunctionSpace(mesh, ufl.MixedElement(ufl.VectorElement(Pk), P1))
        self.state = fem.Function(space)
        u, p = ufl.split(self.state)
        # Constants, so that the compiled forms serve any value.
        mu = fem.Constant(mesh, YOUNGS_MODULUS / (2 * (1 + poisson_ratio)))
        compliance = fem.Constant(mesh, ((1 + poisson_ratio) * (1 - 2 * poisson_ratio)
                                         / (YOUNGS_MODULUS * poisson_ratio))) # 1 / lambda
        weight = fem.Constant(mesh, (0., -DENSITY * gravity, 0.))
        F = ufl.Identity(3) + ufl.grad(u)
        J = ufl.det(F)
        energy = mu / 2 * (ufl.inner(F, F) - 3) - mu * ufl.ln(J) + p * (J - 1)
        self.load = fem.Constant(mesh, 0.)
        dx, dx_of_p = ufl.dx(metadata=RULE[degree]), ufl.dx(metadata={"quadrature_degree": 2})
        v, q = ufl.TestFunctions(space)
        # FFCx 0.5 takes a coefficient that stands under two rules at the points of one of them: a
        # form for each.
        parts = [energy * dx, -compliance * p**2 / 2 * dx_of_p]
        internal = [ufl.derivative(part, self.state) for part in parts]

        def compiled(form):
            return fem.form(form, jit_params=COMPILER)

        self.internal = [compiled(part) for part in internal]
        self.external = compiled(self.load * ufl.inner(weight, v) * dx_of_p)
        self.tangent = compiled(ufl.derivative(sum(internal), self.state)) # the second is linear
        self.n_pressures = compiled(q * ufl.dx)

        displacements, _ = space.sub(0).collapse()
        faces = dolfinx.mesh.locate_entities_boundary(mesh, 2, on_plane(0.))
        held = fem.locate_dofs_topological((space.sub(0), displacements), 2, faces)
        self.supports = [fem.dirichletbc(fem.Function(displacements), held, space.sub(0))]
        self.held = np.unique(held[0])
        self.is_pressure = np.zeros(space.dofmap.index_map.size_local * space.dofmap.bs, dtype=bool)
        self.is_pressure[space.sub(1).dofmap.list.array] = True
        self.matrix = petsc.create_matrix(self.tangent)
        self.matrix.setOption(PETSc.Mat.Option.SYMMETRIC, True)
        self.residual, self.weight = (petsc.create_vector(self.external) for _ in range(2))
        self.volume = np.linalg.norm(petsc.assemble_vector(self.n_pressures).array)

    def assemble_residual(self):
        """Isochor's size of the residual: unbalanced forces against those that act, and volume."""
        for vector, forms in ((self.residual, self.internal), (self.weight, [self.external])):
            vector.set(0.)
            for form in forms:
                petsc.assemble_vector(vector, form)
        r, loads = self.residual.array, self.weight.array
        r -= loads
        scale = max(np.linalg.norm(loads), np.linalg.norm(r[self.held]))
        r[self.held] = 0.
        force = np.linalg.norm(r[~self.is_pressure])
        constraint = np.linalg.norm(r[self.is_pressure])
        return np.hypot(force / scale, constraint / self.volume)

    def assemble_tangent(self):
        self.matrix.zeroEntries()
        petsc.assemble_matrix(self.matrix, self.tangent, self.supports)
        self.matrix.assemble()

    def mean_on_right(self):
        """Mean displacement (x, y, z) of the face at X = 1 m."""
        mesh = self.state.function_space.mesh
        faces = np.sort(dolfinx.mesh.locate_entities_boundary(mesh, 2, on_plane(1.)))
        tags = dolfinx.mesh.meshtags(mesh, 2, faces, np.ones(len(faces), dtype=np.int32))
        ds = ufl.Measure("ds", mesh, subdomain_data=tags, subdomain_id=1)
        u = ufl.split(self.state)[0]
        area = fem.assemble_scalar(fem.form(fem.Constant(mesh, 1.) * ds))
        return [fem.assemble_scalar(fem.form(u[c] * ds)) / area for c in range(3)]


def make_solver(problem, pivots):
    solver = PETSc.KSP().create(MPI.COMM_SELF)
    solver.setOperators(problem.matrix)
    solver.setType("preonly")
    solver.getPC().setType(pivots)
    solver.getPC().setFactorSolverType("mumps")
    return solver


def newton(problem, solver, stopwatch):
    """Iterations, or None if it does not converge."""
    step = problem.residual.duplicate()
    for iteration in range(MAX_ITERATIONS + 1):
        size = stopwatch.measure("assembly", problem.assemble_residual)
        if size <= TOLERANCE:
            return iteration
        if not np.isfinite(size) or iteration == MAX_ITERATIONS:
            return None
        stopwatch.measure("assembly", problem.assemble_tangent)
        solver.setOperators(problem.matrix)
        stopwatch.measure("factorisation", solver.setUp)
        stopwatch.measure("solve", solver.solve, problem.residual, step)
        problem.state.vector.axpy(-1., step)
    return None


def main():
    if len(sys.argv) != 7:
        sys.exit(__doc__)
    file, element, pivots = sys.argv[1], sys.argv[2], sys.argv[6]
    poisson_ratio, gravity, load_steps = float(sys.argv[3]), float(sys.argv[4]), int(sys.argv[5])
    degree = {"P1-P1": 1, "P2-P1": 2}[element]
    points, cells = gmsh_mesh.read_tetrahedra(file)
    domain = ufl.Mesh(ufl.VectorElement("Lagrange", ufl.Cell("tetrahedron", 3), 1))
    mesh = dolfinx.mesh.create_mesh(MPI.COMM_SELF, cells, points, domain)
    mesh.topology.create_connectivity(2, 3)

    Problem(mesh, degree, poisson_ratio, gravity)
    stopwatch = Stopwatch()
    problem = stopwatch.measure("setup", Problem, mesh, degree, poisson_ratio, gravity)
    solver = stopwatch.measure("setup", make_solver, problem, pivots)
    iterations = []
    for step in range(1, load_steps + 1):
        problem.load.value = step / load_steps
        iterations.append(newton(problem, solver, stopwatch))
        if iterations[-1] is None:
            break
    converged = iterations[-1] is not None
    factors = solver.getPC().getFactorMatrix()
    print(json.dumps({
        "cells": len(cells),
        "unknowns": len(problem.is_pressure),
        "load factor": (len(iterations) - (not converged)) / load_steps,
        "newton iterations": sum(n or 0 for n in iterations),
        "status": "converged" if converged else "not converged",
        "tip": problem.mean_on_right(),
        "seconds": dict(stopwatch.seconds, total=sum(stopwatch.seconds.values())),
        "GFlop": factors.getMumpsRinfog(3) / 1e9,
        "ordering": {2: "AMF", 3: "Scotch", 4: "PORD", 5: "METIS", 6: "QAMD"}.get(
            factors.getMumpsInfog(7), "other"),
        "peak memory MB": resource.getrusage(resource.RUSAGE_SELF).ru_maxrss / 1024,
        "version": f"dolfinx {dolfinx.__version__}, PETSc "
                   + ".".join(map(str, PETSc.Sys.getVersion())),
    }))


if __name__ == "__main__":
    main()
