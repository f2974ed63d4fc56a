"""Which run of a study is the cheapest for an accuracy.

A run's own error may be small by luck: along refined meshes an error that changes its sign is near zero
at one of them. So a run counts with its assured error: the largest of its own and of those of the finer
runs of the same method on the same problem, and on top of it the reference's uncertainty, within which
the truth lies. A finer run that failed assures nothing. The finest run of a method has none behind it and
is taken at its word.
"""

import math

from results_table import RESOLUTION, BadTable, failed, groups, number, short

REQUESTS = (0.1, 0.03, 0.01, 0.003, 0.001)  # relative errors


def problems(study):
    """(settings, runs) of each problem: runs that differ in method and resolution only."""
    names = [n for n in study.varied if not n.startswith("Method/") and n not in RESOLUTION]
    return [(dict(zip(names, values)), rows)
            for values, rows in groups(study.runs, lambda r: tuple(r[n] for n in names)).items()]


def probe_with_error(study, name=None):
    """The probe NAME, or the first that has an error."""
    def has_error(probe):
        return probe.error and any(number(row[probe.error]) is not None for row in study.runs)

    probe = study.probe(name) if name else next(filter(has_error, study.probes), None)
    if probe is None or not has_error(probe):
        raise BadTable((f"the probe '{name}' has" if name else "no probe has") +
                       " an error: the study needs a Reference or Reference values")
    return probe


def is_unstable(row):
    """An equilibrium, and perhaps the wanted one, but the body would leave it."""
    return row["status"].startswith("unstable")


def uncertainty(row, probe):
    return abs(number(row[probe.uncertainty]) or 0) if probe.uncertainty else 0.


def largest_uncertainty(rows, probe):
    return max((uncertainty(row, probe) for row in rows), default=0.)


def assured_errors(study, rows, probe):
    """(row, error) of the runs ROWS of one problem that can be counted on; a run that is the
    reference itself has no error of its own and is left out, and so is one that was refused, which
    says nothing of the method on this mesh."""
    found = []
    for line in groups([row for row in rows if row["status"] != "refused"], study.method).values():
        assured = 0.
        # More cells are a finer mesh, however it was asked for.
        for row in sorted(line, key=lambda row: -number(row["cells"])):
            error = None if failed(row) else number(row[probe.error])
            if error is None:
                assured = math.inf
            else:
                assured = max(assured, abs(error) + uncertainty(row, probe))
            if error and assured < math.inf:
                found.append((row, assured))
    return found


def pareto_front(points):
    """Those of POINTS, (cost, error, ...), that no other one beats in one and equals in the other."""
    return [p for p in points
            if not any(q[0] <= p[0] and q[1] <= p[1] and q[:2] != p[:2] for q in points)]


def cheapest(assured, request):
    """The run of least seconds in ASSURED, pairs of row and error; or None."""
    rows = [row for row, error in assured if error <= request]
    return min(rows, key=lambda row: number(row["seconds total"]), default=None)


def why_none(assured, rows, probe, request):
    known = largest_uncertainty(rows, probe)
    if known > request:
        return f"none: the reference is uncertain by {100 * known:.2g} %"
    best = min((error for _, error in assured), default=None)
    return "none" if best is None else f"none: at best {100 * best:.2g} %"


def cheapest_rows(study, probe):
    """The header and the rows of a table: for each problem and request the cheapest run."""
    sizes = [name for name in study.varied if name in RESOLUTION]
    table, settings = [], {}
    for settings, rows in problems(study):
        assured = assured_errors(study, rows, probe)
        for request in REQUESTS:
            row = cheapest(assured, request)
            line = [*settings.values(), f"{100 * request:g} %"]
            if row is None:
                line += [why_none(assured, rows, probe, request), *["-"] * (len(sizes) + 3)]
            else:
                line += [study.method(row) + (f", {row['status']}" if is_unstable(row) else ""),
                         *(row[name] for name in sizes), row["unknowns"],
                         f"{number(row['seconds total']):.2g}",
                         f"{100 * abs(number(row[probe.error])):.2g} %"]
            table.append(line)
    header = [*(short(n).lower() for n in settings), f"error of {probe.name} wanted", "cheapest",
              *(short(n).lower() for n in sizes), "unknowns", "seconds", "its error"]
    return header, table
