"""Errors that runs estimate of themselves (Output/Error estimates) over their true ones."""

import math

from cost_and_accuracy import largest_uncertainty, probe_with_error
from results_table import BadTable, Study, failed, number, scene_baselines

CLEAR = 3  # a true error this many times the reference's uncertainty is one


def components(study, probe):
    """The probes of STUDY that are PROBE's vector: "tip x", "tip y"; PROBE alone if it is none."""
    stem, _, component = probe.name.rpartition(" ")
    return [p for p in study.probes
            if p is probe or (component in "xyz" and p.name in (f"{stem} {c}" for c in "xyz"))]


def judged(file, fixed_folder):
    """(study, [(row, true error, estimated error)]) of the runs of FILE that have both, the true one well
    above the uncertainty that the reference has in the file of the same name in FIXED_FOLDER. Errors of
    a vector's components are relative to its length and count together."""
    study, fixed = Study(file), Study(fixed_folder / file.name)
    probe = probe_with_error(study)
    fixed_probe = probe_with_error(fixed, probe.name)
    doubt = largest_uncertainty(fixed.runs + fixed.reference, fixed_probe)
    probes = components(study, probe)
    estimates = [f"{p.name} estimated error" for p in probes]
    if estimates[0] not in study.columns:
        raise BadTable(f"{file}: has no column '{estimates[0]}'; set Output/Error estimates = true")

    def length(row, columns):
        values = [number(row[column]) for column in columns]
        return None if None in values else math.hypot(*values)

    pairs = [(row, length(row, [p.error for p in probes]), length(row, estimates))
             for row in study.runs if not failed(row)]
    return study, [(row, true, estimate) for row, true, estimate in pairs
                   if estimate is not None and true > CLEAR * doubt]


def estimate_rows(folder, fixed_folder):
    """The header and the rows of the table: for each baseline_SCENE.csv of FOLDER one, with the range of
    estimated over true error of each element."""
    ratios = {}
    for scene, file in scene_baselines(folder):
        study, pairs = judged(file, fixed_folder)
        for row, true, estimate in pairs:
            line = ratios.setdefault(scene.replace("_", " "), {})
            line.setdefault(study.method(row), []).append(estimate / true)
    methods = sorted({method for line in ratios.values() for method in line})

    def cell(values):
        ends = [f"{end:.2g}" for end in (min(values), max(values))]
        return " to ".join(dict.fromkeys(ends))

    return ["scene", *methods], [
        [scene, *(cell(line[method]) if method in line else "-" for method in methods)]
        for scene, line in ratios.items()]
