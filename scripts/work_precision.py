#!/usr/bin/python3
"""Accuracy against work: work_precision.py FOLDER_OR_TABLE... draws, for each study, the relative error
of a probe against seconds and against unknowns, and prints the cheapest run for each accuracy.

FOLDER is a study's output folder, or TABLE a baseline such as convergence/NAME/baseline_tube.csv.
Beside it are written, as SVG and PNG,
  work_precision          of the first probe that has an error, or
  PROBE_work_precision    with --probe
with the prefix tube_ for baseline_tube.csv. A line per method joins its meshes; a row of panels per
problem. Rings mark the Pareto front of the errors that finer meshes of the same method bear out
(cost_and_accuracy.py): nothing is both cheaper and more accurate. Failed runs are crosses; a white dot
marks an unstable equilibrium.
"""

import argparse
import sys
from pathlib import Path

from matplotlib.lines import Line2D

from chart_style import (draw_failed, draw_uncertainty, errors, leave_room_for_strip, legend,
                         log_axis, new_figure, percent, plain, save, style)
from cost_and_accuracy import (assured_errors, cheapest_rows, is_unstable, pareto_front,
                               probe_with_error, problems)
from results_table import BadTable, failed, groups, number, setting, slug
from study_files import StudyFiles
from study_tables import markdown

COSTS = {"seconds total": "time of the whole run [s]", "unknowns": "unknowns"}


def draw_lines(axes, study, rows, probe, column):
    axes.set_xscale("log")
    axes.set_yscale("log")
    for method, pairs in groups(errors(rows, probe), lambda pair: study.method(pair[0])).items():
        points = sorted((number(row["unknowns"]), number(row[column]), error)
                        for row, error in pairs if number(row[column]))
        if points:
            _, costs, values = zip(*points)
            axes.plot(costs, values, linewidth=1.4, markersize=6.5, **style(study, method))


def draw_unstable(axes, study, rows, probe, column):
    """White dots in the markers of equilibria that the body would leave."""
    look = dict(marker="o", markersize=2.6, color="white", linestyle="", zorder=7)
    points = [(number(row[column]), error) for row, error in errors(rows, probe)
              if is_unstable(row)]
    if not points:
        return []
    axes.plot(*zip(*points), **look)
    return [Line2D([], [], label="unstable", marker="o", markersize=7, color="#777777",
                   markerfacecolor="white", markeredgewidth=2.2, linestyle="")]


def draw_front(axes, study, rows, probe, column):
    """Rings around the runs of the Pareto front, drawn at their own errors."""
    points = [(number(row[column]), error, abs(number(row[probe.error])))
              for row, error in assured_errors(study, rows, probe) if number(row[column])]
    front = pareto_front(points)
    look = dict(marker="o", markersize=13, markerfacecolor="none", markeredgecolor="#222222",
                markeredgewidth=1.2, linestyle="")
    axes.plot([cost for cost, _, _ in front], [own for _, _, own in front], zorder=6, **look)
    return [Line2D([], [], label="Pareto front,\nluck left out", **look)]


def chart(study, files, probe, name, title):
    """The files written."""
    panels = [(", ".join(setting(rows[0], n) for n in settings), rows)
              for settings, rows in problems(study) for _ in COSTS]
    figure, pairs = new_figure(f"{title}: error of {probe.name} against work", panels,
                               n_columns=len(COSTS), share_x="col")
    columns = list(COSTS) * (len(panels) // len(COSTS))
    for (axes, rows), column in zip(pairs, columns):
        draw_lines(axes, study, rows, probe, column)
    # One that was refused has no place on these axes.
    any_failed = any(failed(row) and number(row["unknowns"]) for row in study.runs)
    for axes, _ in pairs[:len(COSTS)]:
        axes.margins(x=0.1, y=0.1)
        log_axis(axes.xaxis, plain)
    if any_failed:
        leave_room_for_strip(pairs[0][0])
    extra = {}
    for (axes, rows), column in zip(pairs, columns):
        handles = (draw_front(axes, study, rows, probe, column)
                   + draw_unstable(axes, study, rows, probe, column)
                   + draw_uncertainty(axes, rows, probe))
        extra.update({handle.get_label(): handle for handle in handles})
        draw_failed(axes, study, list(filter(failed, rows)),
                    lambda row, column=column: number(row[column]) or None)
    for (axes, _), column in zip(pairs[-len(COSTS):], columns):
        axes.set_xlabel(COSTS[column])
    figure.supylabel(f"relative error of {probe.name}", fontsize=10)
    log_axis(pairs[0][0].yaxis, percent)
    legend(figure, study, any_failed, extra.values())
    return save(figure, files.folder, files.prefix + name)


def main():
    parser = argparse.ArgumentParser(description="Accuracy of a study's runs against their work.")
    parser.add_argument("places", nargs="+", type=Path, metavar="FOLDER_OR_TABLE",
                        help="a study's output folder, or a .csv of its runs")
    parser.add_argument("--probe", help="default: the first that has an error")
    parser.add_argument("--title", help="default: the study's title, or the folder's name")
    options = parser.parse_args()
    for place in options.places:
        try:
            files = StudyFiles(place)
            study = files.read()
            probe = probe_with_error(study, options.probe)
        except BadTable as error:
            sys.exit(f"work_precision.py: error: {files.blamed(error)}")
        name = (f"{slug(probe.name)}_" if options.probe else "") + "work_precision"
        written = chart(study, files, probe, name, options.title or files.title())
        print("\n".join(map(str, written)))
        print("\n" + markdown(*cheapest_rows(study, probe)))


if __name__ == "__main__":
    main()
