"""What deviates between the results of a study and its baseline, or published values.

Stable is what every machine must find again: settings, cells, unknowns, probes, the figures that
go with them, status. Iteration counts may differ a little, because rounding decides the last one.
Seconds, memory and counts of linear algebra belong to the machine, and so does how far a run comes that
Method/Time limit stops, here or in the baseline.
"""

import csv
import math
import re
from collections import namedtuple

from results_table import BadTable, number, short

UNSTABLE = re.compile(r"seconds|memory|factorisations|krylov|^reason$|^folder$")
ITERATIONS = ["newton iterations", "load steps", "failed steps"]
EXACT = ["cells", "unknowns", "negative pivots excess", "null pivots", "status", "role"]
RELATIVE = re.compile(r" (error|reference uncertainty)$")  # a probe against its reference

TOLERANCE = 1e-5       # relative, of a figure
ROUNDING = 1e-11       # absolute: a smaller figure is rounding
ITERATION_SLACK = 2    # or a tenth, if that is more

Deviation = namedtuple("Deviation", "run column expected found")


def run_name(row, parameters):
    return ", ".join(f"{short(name)} {row[name]}" for name in parameters) or "the run"


def agrees(column, expected, found):
    a, b = number(expected), number(found)
    if column in EXACT or a is None or b is None:
        return expected == found
    if column in ITERATIONS:
        return abs(a - b) <= max(ITERATION_SLACK, 0.1 * a)
    if RELATIVE.search(column):
        return abs(a - b) <= 2 * TOLERANCE
    return abs(a - b) <= TOLERANCE * abs(a) + ROUNDING


def out_of_time(row):
    return (row.get("reason") or "").startswith("time limit")


def compare(study, baseline):
    """Deviations of a study from its baseline, row by row; the rows may be in any order."""
    if study.parameters != baseline.parameters:
        return [Deviation("all", "parameters", ", ".join(baseline.parameters),
                          ", ".join(study.parameters))]
    deviations = []
    columns = [name for name in baseline.columns
               if not UNSTABLE.search(name) and name not in baseline.parameters]
    missing = [name for name in columns if name not in study.columns]
    new = [name for name in study.columns if name not in baseline.columns]
    deviations += [Deviation("all", name, "a column", "none") for name in missing]
    deviations += [Deviation("all", name, "none", "a column") for name in new]
    rows = {(row["role"], *(row[n] for n in study.parameters)): row
            for row in study.runs + study.reference}
    for row in baseline.runs + baseline.reference:
        run = run_name(row, baseline.parameters)
        found = rows.pop((row["role"], *(row[n] for n in baseline.parameters)), None)
        if found is None:
            deviations.append(Deviation(run, "run", "in the baseline", "not run"))
            continue
        if out_of_time(row) or out_of_time(found):
            continue
        deviations += [Deviation(run, name, row[name], found[name])
                       for name in columns
                       if name in found and not agrees(name, row[name], found[name])]
    deviations += [Deviation(run_name(row, study.parameters), "run", "not in the baseline", "run")
                   for row in rows.values()]
    return deviations


Published = namedtuple("Published", "settings column expected found deviation tolerance")


def relative_deviation(found, expected):
    """Of a zero, which a count may be, anything else is infinitely far."""
    if found is None:
        return None
    if expected == 0:
        return 0. if found == 0 else math.inf
    return found / expected - 1


def against_published(study, file):
    """The entries of FILE, a table with columns of settings, of figures, and "tolerance"
    (relative); found and deviation are None if the study has no such run that converged."""
    with open(file, newline="", encoding="utf-8") as stream:
        reader = csv.DictReader(stream)
        columns, rows = reader.fieldnames or [], list(reader)
    settings = [name for name in columns if name in study.parameters]
    figures = [name for name in columns if name not in settings and name != "tolerance"]
    unknown = [name for name in figures if name not in study.columns]
    if unknown or "tolerance" not in columns or not figures:
        raise BadTable(f"{file}: needs columns of the study's settings and figures, and tolerance; "
                       f"not known are {', '.join(unknown) or 'none'}")
    entries = []
    for row in rows:
        runs = [run for run in study.runs if all(run[n] == row[n] for n in settings)]
        if len(runs) > 1:
            raise BadTable(f"{file}: {run_name(row, settings)} are {len(runs)} runs, not one")
        for column in figures:
            expected = number(row[column])
            if expected is None:
                continue
            found = number(runs[0][column]) if runs else None
            entries.append(Published({n: row[n] for n in settings}, column, expected, found,
                                     relative_deviation(found, expected),
                                     float(row["tolerance"])))
    return entries
