#!/usr/bin/env python3
"""How fast the solver is, and how far it gets: one thread, P1-P1 and others.

  benchmark.py               run all, write the tables of README.md and baseline*.csv
  benchmark.py --only tube   some cases; print the tables, write nothing

speed: whole nonlinear solves of four scenes by each linear solver. reach: load factor that each element
gets to in each way of stepping.
"""

import sys
from pathlib import Path
from typing import NamedTuple

HERE = Path(__file__).resolve().parent
ROOT = HERE.parents[1]
sys.path.insert(0, str(ROOT / "scripts"))

from benchmark_runs import (Failed, checked, figure, interleaved, markdown, numbers,  # noqa: E402
                            options_of, publish, record, run)


class Case(NamedTuple):
    name: str
    file: str
    settings: tuple = ()

    def __str__(self):
        return self.name


# Of the cantilever: where plain Newton needs a divided step, and where it needs none.
LOAD_STEPS = [5, 10]


def cantilever(size, poisson_ratio, load_steps):
    return Case(f"cantilever, edge {size}, nu {poisson_ratio}, {load_steps} steps",
                "cantilever.prm",
                (("Scene/Mesh size", size), ("Scene/Poisson ratio", poisson_ratio),
                 ("Scene/Gravity", "0, -9.8, 0"), ("Method/Load steps", load_steps),
                 ("Study/Reference", ""), ("Study/Reference check", "")))


SPEED_CASES = [*(cantilever(size, nu, steps)
                 for size in (0.025, 0.0125) for nu in (0.4999, 0.5) for steps in LOAD_STEPS),
               Case("inflated tube", "inflated_tube.prm"),
               Case("compressed box", "compressed_box.prm")]
# The first is what the others are compared with.
PLAIN = {"Method/Newton tangent": "consistent", "Method/Curvature filter": "none",
         "Method/Extrapolation": "false"}
SPEED_METHODS = {"kept": {"Method/Linear solver": "kept"},
                 "MUMPS": {"Method/Linear solver": "direct"},
                 "plain Newton, MUMPS": {"Method/Linear solver": "direct", **PLAIN},
                 "plain Newton, UMFPACK": {"Method/Linear solver": "UMFPACK", **PLAIN}}

REACH_CASE = cantilever(0.05, 0.4999, 1)
REACH_ELEMENTS = ["P1", "P2", "P3", "P1-P1", "P2-P1"]
# A step that fails is halved, unless the half is below the minimum.
REACH_STEPPING = {"1 step": {"Method/Load steps": 1, "Method/Minimum load step": 1},
                  "10 steps": {"Method/Load steps": 10, "Method/Minimum load step": 0.1},
                  "1 step, halved": {"Method/Load steps": 1, "Method/Minimum load step": 1e-3},
                  "adaptive": {"Method/Stepping": "adaptive", "Method/Load steps": 4,
                               "Method/Minimum load step": 1e-3}}
LIMIT = 40 # seconds of a run

COUNTS = ["load steps", "failed steps", "newton iterations", "factorisations", "krylov iterations"]
PHASES = ["assembly", "factorisation", "solve"]


def measured(options, case, settings, limit=None):
    row = run(options.isochor, ROOT / "prm" / case.file, {**dict(case.settings), **settings},
              limit=limit)
    return numbers(row) if row else None


def speed(options):
    def one(case, method):
        return measured(options, case, {"Method/Element": "P1-P1", **SPEED_METHODS[method]})

    cases = [case for case in SPEED_CASES if options.only in f"speed {case}"]
    results = interleaved(options.repeat, cases, lambda _: SPEED_METHODS, one)
    rows, lines = [], []
    for (case, method), found in results.items():
        fastest = results[case, next(iter(SPEED_METHODS))]["seconds"]
        rows.append({"case": case, "method": method,
                     **{name: found[name] for name in ["unknowns", *COUNTS, "seconds"]},
                     **{f"seconds {phase}": found[f"seconds {phase}"] for phase in PHASES},
                     "peak memory MB": found["peak memory MB"], "status": found["status"]})
        lines.append([case, found["unknowns"], method, figure(found["seconds"], 3),
                      f"{found['seconds'] / fastest:.2f}",
                      *(round(found[name]) for name in COUNTS),
                      *(figure(found[f"seconds {phase}"], 3) for phase in PHASES),
                      round(found["peak memory MB"]), found["status"]])
    header = ["scene", "unknowns", "solver", "seconds", "ratio", *COUNTS, *PHASES, "peak MB",
              "status"]
    return rows, markdown(header, lines)


def reach(options):
    stuck = {"load factor": "", "status": "killed", "seconds": ""}

    def one(element, stepping):
        found = measured(options, REACH_CASE,
                         {"Method/Element": element, **REACH_STEPPING[stepping]}, LIMIT)
        if found and found["status"] == "interrupted":
            found["status"] = f"stopped after {LIMIT} s"
        return found or stuck

    elements = [name for name in REACH_ELEMENTS if options.only in f"reach {name}"]
    results = interleaved(1, elements, lambda _: REACH_STEPPING, one)
    columns = ["load factor", "status", *COUNTS[:3], "tip [m]", "seconds"]
    rows = [{"element": element, "stepping": stepping,
             **{name: found.get(name, "") for name in columns}}
            for (element, stepping), found in results.items()]

    def shown(value):
        return figure(value, 3) if isinstance(value, float) else value

    lines = [[shown(value) for value in row.values()] for row in rows]
    return rows, markdown(["element", "stepping", *columns], lines)


def main():
    options = options_of("Speed and reach of the solver.").parse_args()
    try:
        checked(options)
        speed_rows, speed_table = speed(options)
        reach_rows, reach_table = reach(options)
        publish(HERE, speed_rows,
                {"speed": speed_table, "speed measured": record(options.isochor, options.repeat)},
                options.show)
        publish(HERE, reach_rows,
                {"reach": reach_table, "reach measured": record(options.isochor, 1)},
                options.show, "baseline_reach.csv")
    except (Failed, OSError) as error:
        sys.exit(f"benchmark.py: error: {error}")


if __name__ == "__main__":
    main()
