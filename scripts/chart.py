#!/usr/bin/python3
"""Charts of a study: chart.py FOLDER reads FOLDER/results.csv and writes SVG and PNG beside it.

For each probe PROBE and each parameter NAME of the scene that takes several numbers:
  PROBE_error_against_NAME    relative error, a line per method
  PROBE_value_against_NAME    the probe itself, with the reference
and for each probe:
  PROBE_error_against_seconds, PROBE_error_against_unknowns
                              cost and accuracy, a panel per scene, a colour per method
Failed runs are crosses at the upper edge. Colours and markers are a method's own in all charts.
"""

import argparse
import sys
from pathlib import Path

from matplotlib.lines import Line2D
from matplotlib.ticker import FixedLocator, LogLocator, NullFormatter

from chart_style import (draw_failed, draw_uncertainty, errors, leave_room_for_strip, legend,
                         log_axis, new_figure, percent, place_labels, plain, plt, save, style)
from results_table import (POISSON, RESOLUTION, UNITS, BadTable, failed, groups, number, setting,
                           short, slug)
from study_files import StudyFiles


class Axis:
    """Where a parameter's values stand on the x axis, and how the axis names them.

    Poisson ratios stand at 0.5 - nu on a reversed logarithmic axis, nu = 0.5 one decade beyond
    the largest other; positive values over more than a factor 4 on a logarithmic axis.
    """

    def __init__(self, study, parameter):
        self.parameter = parameter
        self.values = sorted({number(row[parameter]) for row in study.runs})
        self.texts = {number(row[parameter]): row[parameter] for row in study.runs}
        self.poisson = parameter == POISSON
        gaps = [0.5 - v for v in self.values if v < 0.5]
        self.at_half = min(gaps) / 10 if gaps else 0.1
        unit = UNITS.get(short(parameter), "")
        self.label = ("Poisson ratio ν  (spaced by log(0.5 − ν))" if self.poisson
                      else short(parameter) + (f" [{unit}]" if unit else ""))
        self.log = self.poisson or (self.values[0] > 0 and self.values[-1] > 4 * self.values[0])

    def position(self, row):
        value = number(row[self.parameter])
        if not self.poisson:
            return value
        return 0.5 - value if value < 0.5 else self.at_half

    def apply(self, axes):
        if self.log:
            axes.set_xscale("log")
        positions = [self.position({self.parameter: text}) for text in self.texts.values()]
        if len(positions) <= 10:
            axes.xaxis.set_major_locator(FixedLocator(positions))
            axes.set_xticks(positions, list(self.texts.values()))
            axes.xaxis.set_minor_locator(FixedLocator([]))
        if self.poisson:
            axes.invert_xaxis()


def split_in_panels(study, apart_from):
    """(title, runs) of each panel: runs that differ in nothing but the method and APART_FROM."""
    names = [n for n in study.varied if not n.startswith("Method/") and n not in apart_from]
    panels = groups(study.runs, lambda row: tuple(row[n] for n in names)).values()
    return [(", ".join(setting(rows[0], n) for n in names), rows) for rows in panels]


def chart_against_parameter(study, folder, title, probe, parameter, what):
    """Error or value of a probe against a number of the scene, a line per method."""
    def figures(rows):
        if what == "error":
            return errors(rows, probe)
        pairs = [(row, number(row[probe.column])) for row in rows if not failed(row)]
        return [(row, value) for row, value in pairs if value is not None]

    if not figures(study.runs):
        return []
    # An error norm, or whatever else is positive and spans orders of magnitude.
    values = [value for _, value in figures(study.runs)]
    logarithmic = what == "value" and min(values) > 0 and max(values) > 30 * min(values)
    figure, panels = new_figure(title, split_in_panels(study, [parameter]))
    first = panels[0][0]
    axis = Axis(study, parameter)
    for axes, rows in panels:
        if what == "error" or logarithmic:
            axes.set_yscale("log")
        for method, pairs in groups(figures(rows), lambda pair: study.method(pair[0])).items():
            points = sorted((axis.position(row), value) for row, value in pairs)
            axes.plot(*zip(*points), linewidth=1.8, markersize=6, **style(study, method))
    label = (f"relative error of {probe.name}" if what == "error"
             else probe.name + (f" [{probe.unit}]" if probe.unit else ""))
    finish(figure, study, panels, axis.label, label, axis.position,
           lambda axes, rows: draw_uncertainty(axes, rows, probe, axis.position)
           if what == "error" else draw_reference(axes, study, rows, probe, axis))
    if what == "error":
        log_axis(first.yaxis, percent)
    if logarithmic:
        first.yaxis.set_major_locator(LogLocator(numticks=12))
        first.yaxis.set_minor_formatter(NullFormatter())
    axis.apply(first)
    return save(figure, folder, f"{slug(probe.name)}_{what}_against_{slug(short(parameter))}")


def finish(figure, study, panels, x_label, y_label, position, draw_extra):
    """Labels, failed runs and the legend; DRAW_EXTRA(axes, rows) returns legend entries."""
    first = panels[0][0]
    any_failed = any(map(failed, study.runs))
    first.margins(y=0.1)
    if any_failed:
        leave_room_for_strip(first)
    extra = []
    for axes, rows in panels:
        extra = draw_extra(axes, rows) or extra
        draw_failed(axes, study, list(filter(failed, rows)), position)
    figure.supxlabel(x_label, fontsize=10)
    figure.supylabel(y_label, fontsize=10)
    legend(figure, study, any_failed, extra)


def draw_reference(axes, study, rows, probe, axis):
    """The reference runs of the same scene as ROWS, which may be finer.

    A run that only checks the reference has no error of its own."""
    same = [n for n in study.varied if n not in [*RESOLUTION, axis.parameter]
            and not n.startswith("Method/")]
    points = sorted((axis.position(row), number(row[probe.column])) for row in study.reference
                    if number(row[axis.parameter]) is not None
                    and number(row[probe.column]) is not None and not failed(row)
                    and (not probe.error or number(row[probe.error]) is not None)
                    and all(row[n] == rows[0][n] for n in same))
    if not points:
        return []
    look = dict(color="black", linewidth=1.3, linestyle=(0, (3, 2)))
    if len(points) == 1:
        axes.axhline(points[0][1], zorder=6, **look)
    else:
        axes.plot(*zip(*points), zorder=6, **look)
    return [Line2D([], [], label="reference", **look)]


def chart_against_cost(study, folder, title, probe, column, label, name):
    """Accuracy against cost: a panel per scene, a colour per method."""
    if not errors(study.runs, probe):
        return []
    figure, panels = new_figure(title, split_in_panels(study, RESOLUTION))
    first = panels[0][0]
    ends = {axes: [] for axes, _ in panels}
    for axes, rows in panels:
        axes.set_xscale("log")
        axes.set_yscale("log")
        for method, pairs in groups(errors(rows, probe), lambda p: study.method(p[0])).items():
            points = sorted((number(row[column]), error) for row, error in pairs
                            if number(row[column]))
            if points:
                axes.plot(*zip(*points), linewidth=1.4, markersize=7, **style(study, method))
                ends[axes].append((points[-1], method))
    first.margins(x=0.15)
    log_axis(first.xaxis, plain)
    finish(figure, study, panels, label, f"relative error of {probe.name}",
           lambda row: number(row[column]) or None,
           lambda axes, rows: draw_uncertainty(axes, rows, probe))
    log_axis(first.yaxis, percent)
    place_labels(figure, ends)
    return save(figure, folder, f"{slug(probe.name)}_error_against_{name}")


def main():
    parser = argparse.ArgumentParser(description="Charts of a study, from its results.csv.")
    parser.add_argument("folder", type=Path, help="output folder of the study")
    parser.add_argument("--title", help="default: the study's title, or the folder's name")
    options = parser.parse_args()
    try:
        files = StudyFiles(options.folder)
        study = files.read()
    except BadTable as error:
        sys.exit(f"chart.py: error: {error}")

    name = options.title or files.title()
    written = []
    for probe in study.probes:
        for parameter in study.numeric_parameters():
            against = "Poisson ratio" if parameter == POISSON else short(parameter).lower()
            if probe.error:
                written += chart_against_parameter(
                    study, options.folder, f"{name}: error against {against}", probe, parameter,
                    "error")
            written += chart_against_parameter(
                study, options.folder, f"{name}: {probe.name} against {against}", probe, parameter,
                "value")
        if probe.error and study.varied:
            for column, label, cost in (("seconds total", "time of the whole run [s]", "seconds"),
                                        ("unknowns", "unknowns", "unknowns")):
                written += chart_against_cost(
                    study, options.folder, f"{name}: error against {cost}", probe, column, label,
                    cost)
    print("\n".join(map(str, written)) or "Nothing varies, or no run succeeded: no chart drawn.")


if __name__ == "__main__":
    main()
