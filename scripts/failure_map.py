#!/usr/bin/python3
"""Where a method fails: failure_map.py FOLDER_OR_TABLE... draws, for each study of one load and the
Poisson ratio, a panel per method with a cell for each run, and prints how far each came and why.

FOLDER is a study's output folder, or TABLE a baseline such as convergence/NAME/baseline_tube.csv.
Beside it is written, as SVG and PNG, failure_map, with the prefix tube_ for baseline_tube.csv. A run
that found a stable equilibrium is coloured by its seconds; any other says why not, and how much of
the load it bore. Beside seconds, min J tells of a cell that has lost nine tenths of its volume.
"""

import argparse
import sys
from pathlib import Path

from matplotlib.cm import ScalarMappable
from matplotlib.colors import LinearSegmentedColormap, LogNorm
from matplotlib.patches import Rectangle

from chart_style import log_ticks, new_figure, plain, plt, save
from failures import Loads, failures_rows, outcome, text_of
from results_table import POISSON, BadTable
from study_files import StudyFiles
from study_tables import markdown

# Light enough for black text; blue, so that it is told from the warm colours of failures by all.
SECONDS = LinearSegmentedColormap.from_list("seconds", ["#F2F8FC", "#9CCBE3", "#4C9CC9"])
LOOKS = {"unstable": dict(facecolor="#FCE3B0", edgecolor="#C98A1B", hatch="///"),
         "failed": dict(facecolor="#F6CFC4", edgecolor="#C2593A", hatch="xx"),
         "refused": dict(facecolor="#E4E4E4", edgecolor="#E4E4E4", hatch="")}
MEANINGS = {"unstable": "unstable equilibrium", "failed": "not converged", "refused": "refused"}
SQUASHED = 0.1  # a stable equilibrium of such cells is hardly the body's
plt.rcParams["hatch.linewidth"] = 0.5


def scale(outcomes):
    """Of the colours; of a study without a stable run, any."""
    seconds = [found.seconds for found in outcomes if found.kind == "stable" and found.seconds]
    low, high = min(seconds, default=0.1), max(seconds, default=1.)
    return LogNorm(low, max(high, 1.01 * low))


def draw_cell(axes, place, found, norm):
    if found.kind == "stable":
        look = dict(facecolor=SECONDS(norm(found.seconds)), edgecolor="white", hatch="")
        text = f"{found.seconds:.2g} s"
        if found.least_j is not None and found.least_j < SQUASHED:
            text += f"\nmin J {found.least_j:.2g}"
    else:
        look = LOOKS[found.kind]
        text = found.word.replace(", ", ",\n")
        if found.kind == "failed" and found.reached:
            text += f"\nat {100 * found.reached / found.amount:.3g} %"
    corner = place[0] - 0.5, place[1] - 0.5
    axes.add_patch(Rectangle(corner, 1, 1, linewidth=0, **look))
    axes.add_patch(Rectangle(corner, 1, 1, linewidth=1.5, fill=False, edgecolor="white"))
    box = dict(facecolor=look["facecolor"], edgecolor="none", pad=1.5)
    axes.text(*place, text, ha="center", va="center", fontsize=8, color="#111111",
              linespacing=1.1, bbox=box)


def chart(study, files, title):
    """The files written."""
    loads = Loads(study)
    ratios = sorted({row[POISSON] for row in study.runs}, key=float)
    texts = list(loads.amounts)
    panels = [(method, [row for row in study.runs if study.method(row) == method])
              for method in study.methods]
    figure, pairs = new_figure(f"{title}: loads that each method bears", panels)
    norm = scale([outcome(row, loads) for row in study.runs])
    kinds = set()
    for axes, rows in pairs:
        axes.grid(False)
        axes.tick_params(length=0)
        axes.spines[["left", "bottom"]].set_visible(False)
        for row in rows:
            found = outcome(row, loads)
            kinds.add(found.kind)
            place = ratios.index(row[POISSON]), texts.index(row[loads.parameter])
            draw_cell(axes, place, found, norm)
    first = pairs[0][0]
    first.set_xlim(-0.5, len(ratios) - 0.5)
    first.set_ylim(-0.5, len(texts) - 0.5)
    first.set_xticks(range(len(ratios)), ratios)
    first.set_yticks(range(len(texts)), list(map(text_of, loads.amounts.values())))
    figure.supxlabel("Poisson ratio ν", fontsize=10)
    figure.supylabel(loads.label, fontsize=10)
    if "stable" in kinds:
        bar = figure.colorbar(ScalarMappable(norm, SECONDS), ax=[axes for axes, _ in pairs],
                              label="stable: time of the whole run [s]", fraction=0.04, pad=0.02)
        log_ticks(bar.ax.yaxis, norm.vmin, norm.vmax, plain)
        bar.outline.set_visible(False)
    handles = [Rectangle((0, 0), 1, 1, linewidth=0, label=MEANINGS[kind], **look)
               for kind, look in LOOKS.items() if kind in kinds]
    if handles:
        # Beside the axis label, whose line is free there.
        figure.legend(handles=handles, loc="lower right", ncols=len(handles), frameon=False,
                      fontsize=9, borderpad=0, borderaxespad=0.4, columnspacing=1.2)
    return save(figure, files.folder, files.prefix + "failure_map")


def main():
    parser = argparse.ArgumentParser(description="Where the methods of a study fail.")
    parser.add_argument("places", nargs="+", type=Path, metavar="FOLDER_OR_TABLE",
                        help="a study's output folder, or a .csv of its runs")
    parser.add_argument("--title", help="default: the study's title, or the folder's name")
    options = parser.parse_args()
    for place in options.places:
        try:
            files = StudyFiles(place)
            study = files.read()
            table = failures_rows(study)
        except BadTable as error:
            sys.exit(f"failure_map.py: error: {files.blamed(error)}")
        written = chart(study, files, options.title or files.title())
        print("\n".join(map(str, written)))
        print("\n" + markdown(*table))


if __name__ == "__main__":
    main()
