#!/usr/bin/env python3
"""Seconds and memory of one linear solve, with factors and with multigrid, as the mesh is refined.

  growth.py                run all, write the tables of README.md and baseline_growth.csv
  growth.py --only "12"    some cases; print the tables, write nothing

The cube of study.prm at nu = 0.4999, small strain: one Newton iteration, so one factorisation. A mesh on
which a linear solver is expected to take more than LIMIT seconds, were they to grow like the square
of the unknowns, is left out.
"""

import math
import sys
from pathlib import Path
from typing import NamedTuple

HERE = Path(__file__).resolve().parent
sys.path.insert(0, str(HERE.parents[1] / "scripts"))

from benchmark_runs import (Failed, checked, figure, interleaved, markdown, numbers,  # noqa: E402
                            options_of, publish, record, run)

BLOCKS = {"P1-P1s": [8, 12, 18, 27, 40], "P2-P1": [4, 6, 9, 13, 20]}
SOLVERS = ["direct", "kept", "block"]
LIMIT = 400
COLUMNS = ["unknowns", "krylov iterations", "seconds assembly", "seconds factorisation",
           "seconds solve", "linear algebra", "predicted factors memory MB", "factors memory MB",
           "peak memory MB"]


class Case(NamedTuple):
    element: str
    blocks: int

    def __str__(self):
        return f"{self.element}, {self.blocks} blocks"


def measured(options):
    taken = {}  # seconds and blocks by element and solver

    def one(case, solver):
        seconds, blocks = taken.get((case.element, solver), (0, 1))
        if seconds * (case.blocks / blocks)**6 > LIMIT and case.blocks > blocks:
            return None
        found = numbers(run(options.isochor, HERE / "study.prm",
                            {"Scene/Cells": ", ".join([str(case.blocks)] * 3),
                             "Scene/Poisson ratio": 0.4999, "Method/Element": case.element,
                             "Method/Linear solver": solver}))
        if found["status"] not in ("stable", "converged"):
            raise Failed(f"{case}, {solver}: {found['reason']}")
        found["linear algebra"] = found["seconds factorisation"] + found["seconds solve"]
        taken[case.element, solver] = found["seconds"], case.blocks
        return found
    return one


def exponent(points):
    """Least squares of log y = a + b log x; b."""
    logs = [(math.log(x), math.log(y)) for x, y in points]
    mean_x, mean_y = (sum(values) / len(logs) for values in zip(*logs))
    return (sum((x - mean_x) * (y - mean_y) for x, y in logs)
            / sum((x - mean_x) ** 2 for x, _ in logs))


def growth(results):
    """Exponents over the three finest meshes of each element and solver."""
    lines = []
    for element in BLOCKS:
        for solver in SOLVERS:
            found = [figures for (case, name), figures in results.items()
                     if case.element == element and name == solver][-3:]
            if len(found) < 3:
                continue
            lines.append([element, solver, found[0]["unknowns"], found[-1]["unknowns"]]
                         + [f"{exponent([(f['unknowns'], f[name]) for f in found]):.2f}"
                            for name in ("linear algebra", "peak memory MB")])
    return markdown(["element", "linear solver", "from unknowns", "to", "seconds grow like n^",
                     "memory like n^"], lines)


def main():
    options = options_of("Growth of seconds and memory.").parse_args()
    try:
        checked(options)
        cases = [case for case in (Case(element, n) for element in BLOCKS for n in BLOCKS[element])
                 if options.only in str(case)]
        results = interleaved(options.repeat, cases, lambda _: SOLVERS, measured(options))
        rows = [{"element": case.element, "blocks": case.blocks, "linear solver": solver,
                 **{name: found[name] for name in COLUMNS}}
                for (case, solver), found in results.items()]
        table = markdown(["element", "unknowns", "linear solver", "iterations", "assembly [s]",
                          "factors or multigrid [s]", "solve [s]", "factors [MB]", "peak [MB]"],
                         [[row["element"], row["unknowns"], row["linear solver"],
                           row["krylov iterations"], figure(row["seconds assembly"], 3),
                           figure(row["seconds factorisation"], 3),
                           figure(row["seconds solve"], 3), row["factors memory MB"],
                           round(row["peak memory MB"])] for row in rows])
        publish(HERE, rows, {"growth": table, "exponents": growth(results),
                             "growth measured": record(options.isochor, options.repeat)},
                options.show, "baseline_growth.csv")
    except (Failed, OSError) as error:
        sys.exit(f"growth.py: error: {error}")


if __name__ == "__main__":
    main()
