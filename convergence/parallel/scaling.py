#!/usr/bin/env python3
"""Strong and weak scaling: the cantilever on 1 and 2 ranks, one thread each.

  scaling.py               run all, write the tables of README.md and baseline.csv
  scaling.py --only P1-P1  some cases; print the tables, write nothing
  scaling.py --ranks 1 2 4 on a machine with more cores

strong: one mesh on all ranks. weak: half a metre of beam for each rank, under a load that bends it as
far as the others.
"""

import sys
import tempfile
from pathlib import Path
from typing import NamedTuple

HERE = Path(__file__).resolve().parent
ROOT = HERE.parents[1]
sys.path.insert(0, str(ROOT / "scripts"))

from benchmark_runs import (Failed, checked, figure, interleaved, markdown, numbers,  # noqa: E402
                            options_of, publish, record, run)

SCENE = ROOT / "prm" / "cantilever.prm"
# P2-P1 has about as many unknowns on a mesh of twice the edge length.
SIZES = {"P1-P1": 0.0125, "P2-P1": 0.025}
SOLVERS = {"P1-P1": ["kept", "direct"], "P2-P1": ["kept"]}
PHASES = ["mesh", "set-up", "assembly", "factorisation", "solve", "output"]
COUNTS = ["newton iterations", "factorisations", "krylov iterations"]


class Case(NamedTuple):
    kind: str # strong, weak
    element: str
    solver: str

    def __str__(self):
        return f"{self.kind}, {self.element}, {self.solver}"


CASES = [Case(kind, element, solver) for kind in ("strong", "weak")
         for element, solvers in SOLVERS.items() for solver in solvers]


def geometry(folder, length):
    """A file like meshes/cantilever.geo for a beam of LENGTH."""
    file = folder / f"beam_{length}.geo"
    file.write_text(f'DefineConstant[ size = 0.05 ];\nlength = {length};\n'
                    f'Include "{ROOT / "meshes" / "cantilever.geo"}";\n', encoding="utf-8")
    return file


def scene(case, ranks, folder):
    settings = {"Method/Element": case.element, "Method/Linear solver": case.solver,
                "Scene/Poisson ratio": 0.4999, "Scene/Mesh size": SIZES[case.element],
                "Study/Reference": "", "Study/Reference check": ""}
    if case.kind == "weak":
        length = ranks / 2
        settings["Scene/Mesh"] = geometry(folder, length)
        # The rotation of the end goes with g L^3.
        settings["Scene/Gravity"] = f"0, {-0.98 / length**3}, 0"
    return settings


def measure(options, folder):
    def one(case, ranks):
        figures = numbers(run(options.isochor, SCENE, scene(case, ranks, folder), ranks))
        if figures["status"] != "stable":
            raise Failed(f"{case} on {ranks} ranks: {figures['reason']}")
        return figures
    return one


def gain(kind, first, found):
    """Speed-up of the whole, or efficiency per Newton iteration."""
    if kind == "strong":
        return first["seconds"] / found["seconds"]
    return (first["seconds"] / first["newton iterations"]
            / (found["seconds"] / found["newton iterations"]))


def table(results, kind):
    lines = []
    for (case, ranks), found in results.items():
        if case.kind != kind:
            continue
        first = results[case, min(r for c, r in results if c == case)]
        lines.append([case.element, case.solver, ranks, found["cells"], found["unknowns"],
                      *(round(found[name]) for name in COUNTS),
                      *(figure(found[f"seconds {phase}"], 3) for phase in PHASES),
                      figure(found["seconds"], 3), f"{gain(kind, first, found):.2f}",
                      round(found["peak memory MB"])])
    return markdown(["element", "linear solver", "ranks", "cells", "unknowns", *COUNTS, *PHASES,
                     "all but mesh", "speed-up" if kind == "strong" else "efficiency",
                     "peak MB of a rank"], lines)


def baseline(results):
    columns = ["cells", "unknowns", *COUNTS, *(f"seconds {phase}" for phase in PHASES), "seconds",
               "peak memory MB"]
    return [{**case._asdict(), "ranks": ranks, **{name: found[name] for name in columns}}
            for (case, ranks), found in results.items()]


def main():
    parser = options_of("Strong and weak scaling.")
    parser.add_argument("--ranks", type=int, nargs="+", default=[1, 2], metavar="N",
                        help="numbers of ranks (default: 1 2)")
    options = parser.parse_args()
    try:
        checked(options)
        cases = [case for case in CASES if options.only in str(case)]
        with tempfile.TemporaryDirectory() as folder:
            results = interleaved(options.repeat, cases, lambda _: options.ranks,
                                  measure(options, Path(folder)))
        publish(HERE, baseline(results),
                {"strong": table(results, "strong"), "weak": table(results, "weak"),
                 "measured": record(options.isochor, options.repeat)}, options.show)
    except (Failed, OSError) as error:
        sys.exit(f"scaling.py: error: {error}")


if __name__ == "__main__":
    main()
