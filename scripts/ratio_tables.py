"""How much of an answer each element gives: its probe over that of the reference, for each scene."""

from cost_and_accuracy import probe_with_error, uncertainty
from results_table import BadTable, Study, failed, number


def ratio_rows(folder):
    """The header and the rows of the table: for each baseline_SCENE.csv of FOLDER one, of the first probe
    that has an error; the truth is the reference run that has one, too."""
    files = sorted(folder.glob("baseline_*.csv"))
    if not files:
        raise BadTable(f"{folder}: holds no baseline_SCENE.csv")
    methods = list(dict.fromkeys(method for file in files for method in Study(file).methods))
    table = []
    for file in files:
        study = Study(file)
        probe = probe_with_error(study)
        truth = next((row for row in study.reference if number(row[probe.error]) is not None), None)
        if truth is None:
            raise BadTable(f"{file}: its reference has no value of {probe.name}")
        value = number(truth[probe.column])
        doubt = max(uncertainty(row, probe) for row in study.runs + study.reference)
        line = [file.stem.removeprefix("baseline_").replace("_", " "), probe.name,
                f"{value:.4g} {probe.unit}", f"{100 * doubt:.1g} %"]
        by_method = {study.method(row): row for row in study.runs}
        for method in methods:
            row = by_method.get(method)
            line.append("-" if row is None else "failed" if failed(row)
                        else f"{number(row[probe.column]) / value:.3f}")
        table.append(line)
    return ["scene", "probe", "truth", "uncertain by", *methods], table
