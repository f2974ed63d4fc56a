"""How much of an answer each element gives: its probe over that of the reference, for each scene."""

from cost_and_accuracy import largest_uncertainty, probe_with_error
from results_table import BadTable, Study, failed, number, scene_baselines


def ratio_rows(folder):
    """The header and the rows of the table: for each baseline_SCENE.csv of FOLDER one, of the first probe
    that has an error; the truth is the reference run that has one, too."""
    studies = [(scene, file, Study(file)) for scene, file in scene_baselines(folder)]
    methods = list(dict.fromkeys(method for _, _, study in studies for method in study.methods))
    table = []
    for scene, file, study in studies:
        probe = probe_with_error(study)
        truth = next((row for row in study.reference if number(row[probe.error]) is not None), None)
        if truth is None:
            raise BadTable(f"{file}: its reference has no value of {probe.name}")
        value = number(truth[probe.column])
        doubt = largest_uncertainty(study.runs + study.reference, probe)
        line = [scene.replace("_", " "), probe.name,
                f"{value:.4g} {probe.unit}", f"{100 * doubt:.1g} %"]
        by_method = {study.method(row): row for row in study.runs}
        for method in methods:
            row = by_method.get(method)
            line.append("-" if row is None else "failed" if failed(row)
                        else f"{number(row[probe.column]) / value:.3f}")
        table.append(line)
    return ["scene", "probe", "truth", "uncertain by", *methods], table
