#!/usr/bin/env python3
"""Isochor against dolfinx: the same cantilever, mesh, elements and load steps, on one thread.

  compare.py                  run all, write the tables of README.md and baseline.csv
  compare.py --agreement      the same without seconds, each once: for a machine that is not quiet
  compare.py --only P2-P1     some cases; print the tables, write nothing

Needs Debian's python3-dolfinx. The exit code is 1 if the displacements of the two codes differ by more
than Newton's tolerance allows.
"""

import json
import math
import subprocess
import sys
import tempfile
from pathlib import Path
from typing import NamedTuple

HERE = Path(__file__).resolve().parent
ROOT = HERE.parents[1]
sys.path.insert(0, str(ROOT / "scripts"))

from benchmark_runs import (ENVIRONMENT, Failed, checked, figure, interleaved, markdown,  # noqa: E402
                            numbers, options_of, publish, record, run)

PYTHON = "/usr/bin/python3"  # Debian's, which has dolfinx
SCENE = ROOT / "prm" / "cantilever.prm"
AXES = "xyz"
ALLOWED = 1e-6  # relative difference of the mean displacement of the end
SECONDS = ["setup", "assembly", "factorisation", "solve", "seconds"]


class Case(NamedTuple):
    element: str
    size: float  # edge length, m
    poisson_ratio: float
    gravity: float  # m/s^2
    load_steps: int

    def __str__(self):
        return (f"{self.element}, edge {self.size}, nu {self.poisson_ratio}, g {self.gravity}, "
                f"{self.load_steps} steps")


MESHES = [("P1-P1", 0.05), ("P1-P1", 0.025), ("P1-P1", 0.0125), ("P2-P1", 0.05), ("P2-P1", 0.025)]
SMALL_LOAD, LARGE_LOAD = (0.98, 2), (9.8, 10)  # at 9.8, plain Newton fails in 5 steps or fewer
CASES = ([Case(*mesh, nu, *SMALL_LOAD) for mesh in MESHES for nu in (0.4999, 0.5)]
         + [Case(*mesh, 0.4999, *LARGE_LOAD) for mesh in MESHES])
ISOCHOR = {"Isochor": "automatic", "Isochor, direct": "direct"}
DOLFINX = {"dolfinx": "cholesky", "dolfinx, LU": "lu"}


def methods(case):
    """LU only where it is cheap: everywhere it takes up to twice the time of LDL^T."""
    return [*ISOCHOR, *(name for name, pivots in DOLFINX.items()
                        if pivots != "lu" or case.gravity == SMALL_LOAD[0])]


def methods_that_may_differ(case):
    """For the agreement alone: the factorisation changes nothing but rounding."""
    return [name for name in methods(case) if DOLFINX.get(name) != "lu"]


def python(*arguments):
    result = subprocess.run([PYTHON, *map(str, arguments)], env=ENVIRONMENT, capture_output=True,
                            stdin=subprocess.DEVNULL, text=True)
    if result.returncode != 0:
        raise Failed(f"{Path(arguments[0]).name}: {result.stderr}")
    return result.stdout


def run_isochor(options, case, mesh, solver):
    figures = numbers(run(options.isochor, SCENE, {
        "Scene/Mesh": mesh, "Scene/Poisson ratio": case.poisson_ratio,
        "Scene/Gravity": f"0, -{case.gravity}, 0",
        "Scene/Probes": "tip: mean displacement on right",
        "Method/Element": case.element, "Method/Load steps": case.load_steps,
        "Method/Linear solver": solver, "Study/Reference": "", "Study/Reference check": ""}))
    figures["setup"] = figures["seconds set-up"]
    for phase in ("assembly", "factorisation", "solve"):
        figures[phase] = figures[f"seconds {phase}"]
    for axis in AXES:
        figures[f"tip {axis}"] = figures[f"tip {axis} [m]"] or math.nan # none if not converged
    return figures


def run_dolfinx(case, mesh, pivots):
    figures = json.loads(python(HERE / "cantilever.py", mesh, case.element, case.poisson_ratio,
                                case.gravity, case.load_steps, pivots))
    seconds = figures.pop("seconds")
    figures.update(seconds, seconds=seconds.pop("total"))
    figures["factorisations"], figures["krylov iterations"] = figures["newton iterations"], 0
    tip = figures.pop("tip")
    for axis, value in zip(AXES, tip):
        converged = figures["status"] in ("stable", "converged")  # dolfinx does not say which
        figures[f"tip {axis}"] = float(f"{value:.10g}") if converged else math.nan # as Isochor's
    return figures


def measure(options, meshes):
    def one(case, method):
        mesh = meshes[case.size]
        if method in ISOCHOR:
            return run_isochor(options, case, mesh, ISOCHOR[method])
        return run_dolfinx(case, mesh, DOLFINX[method])
    return one


def make_meshes(folder, cases):
    """Files by edge length."""
    meshes = {size: folder / f"cantilever_{size}.msh" for size in {case.size for case in cases}}
    for size, file in meshes.items():
        python(HERE / "gmsh_mesh.py", ROOT / "meshes" / "cantilever.geo", size, file)
    return meshes


def difference(one, other):
    """Largest difference of a component, relative to the length of the displacement."""
    length = sum(other[f"tip {axis}"]**2 for axis in AXES)**.5
    return max(abs(one[f"tip {axis}"] - other[f"tip {axis}"]) for axis in AXES) / length


def differences(results):
    """By (case, method) of Isochor: against dolfinx, LDL^T."""
    return {(case, method): difference(found, results[case, "dolfinx"])
            for (case, method), found in results.items() if method in ISOCHOR}


def head(case, found):
    return [case.element, case.size, case.poisson_ratio, case.gravity, case.load_steps,
            found["unknowns"]]


HEAD = ["element", "edge [m]", "nu", "g [m/s²]", "load steps", "unknowns"]


def agreement_table(results):
    far = differences(results)
    rows = []
    for case in dict.fromkeys(case for case, _ in results):
        ours, theirs = results[case, "Isochor"], results[case, "dolfinx"]
        rows.append([*head(case, ours), f"{ours['tip y']:.8f}", f"{theirs['tip y']:.8f}",
                     f"{max(far[case, method] for method in ISOCHOR):.0e}",
                     *(results[case, method]["newton iterations"]
                       for method in ("Isochor", "Isochor, direct", "dolfinx")),
                     ours["factorisations"]])
    return markdown([*HEAD, "tip y [m]: Isochor", "dolfinx", "difference",
                     "Newton: Isochor", "direct", "dolfinx", "factorisations: Isochor"], rows)


def seconds_table(results):
    rows = []
    for case in dict.fromkeys(case for case, _ in results):
        ours = results[case, "Isochor"]
        for method in methods(case):
            found = results[case, method]
            rows.append([*head(case, found), method, *(figure(found[name], 3) for name in SECONDS),
                         f"{found['seconds'] / ours['seconds']:.1f}",
                         round(found["peak memory MB"])])
    return markdown([*HEAD, "code", "set-up", "assembly", "factorisation", "solve", "total",
                     "against Isochor", "peak MB"], rows)


def baseline(results, timed):
    measured = ["load factor", "newton iterations", "factorisations", "krylov iterations",
                *(f"tip {axis}" for axis in AXES), "status",
                *([*SECONDS, "peak memory MB"] if timed else [])]
    return [{**dict(zip(HEAD, head(case, found))), "code": method,
             **{name: found[name] for name in measured}}
            for (case, method), found in results.items()]


def main():
    parser = options_of("Isochor against dolfinx on the same cantilever.")
    parser.add_argument("--agreement", action="store_true", help="each run once, without seconds")
    options = parser.parse_args()
    try:
        checked(options)
        cases = [case for case in CASES if options.only in str(case)]
        if options.agreement:
            options.repeat = 1
        with tempfile.TemporaryDirectory() as folder:
            meshes = make_meshes(Path(folder), cases)
            one = measure(options, meshes)
            for element in {case.element for case in cases}:
                # Compiles the forms.
                smallest = max(size for name, size in MESHES if name == element)
                one(Case(element, smallest if smallest in meshes else min(meshes), 0.4999,
                         *SMALL_LOAD), "dolfinx")
            results = interleaved(options.repeat, cases,
                                  methods_that_may_differ if options.agreement else methods, one)
        versions = next(found["version"] for found in results.values() if "version" in found)
        tables = {"agreement": agreement_table(results),
                  "agreement measured": record(options.isochor, options.repeat, f", {versions}")}
        if not options.agreement:
            tables["seconds"] = seconds_table(results)
            tables["seconds measured"] = tables["agreement measured"]
        publish(HERE, baseline(results, not options.agreement), tables, options.show)
    except (Failed, OSError) as error:
        sys.exit(f"compare.py: error: {error}")
    far = {key: value for key, value in differences(results).items() if not value <= ALLOWED}
    for (case, method), value in far.items():
        print(f"{method}, {case}: differs from dolfinx by {value:.1e}")
    sys.exit(1 if far else 0)


if __name__ == "__main__":
    main()
