"""What Element = auto made of scenes whose fixed methods were measured, too: its estimate, its true error
and its cost, beside the cheapest fixed method that hindsight knows (cost_and_accuracy.py)."""

from cost_and_accuracy import assured_errors, cheapest, probe_with_error, uncertainty
from results_table import Study, failed, number, scene_baselines

HEADER = ["scene", "wanted", "chosen", "estimated error", "true error", "seconds", "cheapest fixed",
          "its error", "its seconds", "ratio"]
ACCURACY = "Method/Accuracy"


def request_of(row):
    text = row[ACCURACY]
    return number(text[:-1]) / 100 if text.endswith("%") else number(text)


def figure(value):
    return f"{value:.2g}" if value < 100 else f"{value:.0f}"


def percent(value):
    return "-" if value is None else f"{100 * value:.2g} %"


def fixed_words(study, row):
    sizes = [row[name] for name in study.varied if not name.startswith("Method/")]
    return ", ".join([study.method(row), *sizes])


def baselines(folder, fixed_folder):
    """(scene, study, study of the fixed methods) of each baseline_SCENE.csv of FOLDER; the fixed methods
    of the scene are in the file of the same name in FIXED_FOLDER."""
    return [(scene, Study(file), Study(fixed_folder / file.name))
            for scene, file in scene_baselines(folder)]


def best_in_hindsight(automatic, fixed):
    """(row, best) of each run of the study AUTOMATIC: the cheapest run of the study FIXED that meets what
    the row asks for, or None."""
    probe = probe_with_error(automatic)
    assured = assured_errors(fixed, fixed.runs, probe_with_error(fixed, probe.name))
    return [(row, cheapest(assured, request_of(row))) for row in automatic.runs]


def automatic_rows(folder, fixed_folder):
    """The rows of the table: for each scene of baselines() and each accuracy one."""
    table = []
    for scene, automatic, fixed in baselines(folder, fixed_folder):
        probe = probe_with_error(automatic)
        for row, best in best_in_hindsight(automatic, fixed):
            request, seconds = request_of(row), number(row["seconds total"])
            error = None if failed(row) else number(row[probe.error])
            doubt = uncertainty(row, probe)
            line = [scene.replace("_", " "), percent(request), row["auto choice"] or row["status"],
                    percent(number(row["auto estimated error"])),
                    percent(error) + (f" ± {percent(doubt)}" if doubt > request / 4 else ""),
                    figure(seconds)]
            if best is None:
                line += ["none", "-", "-", "-"]
            else:
                cost = number(best["seconds total"])
                line += [fixed_words(fixed, best), percent(abs(number(best[probe.error]))),
                         figure(cost), f"{seconds / cost:.1f}"]
            table.append(line)
    return table
