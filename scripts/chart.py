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
import math
import re
import sys
from pathlib import Path

import matplotlib

matplotlib.use("Agg")
import matplotlib.pyplot as plt
from matplotlib.lines import Line2D
from matplotlib.ticker import FixedLocator, FuncFormatter, LogLocator, NullFormatter
from matplotlib.transforms import Bbox, ScaledTranslation

from results_table import (POISSON, RESOLUTION, UNITS, BadTable, Study, failed, groups, number,
                           setting, short)

# Okabe and Ito: told apart by colour-blind readers. Black is kept for the reference.
COLOURS = ["#D55E00", "#E69F00", "#009E73", "#0072B2", "#56B4E9", "#CC79A7", "#7F7F7F", "#8B5A2B"]
# A colour of its own for each of these in every study; others take colours as they come.
ELEMENTS = ["P1", "P2", "P3", "P1-P1", "P2-P1", "P3-P2", "P1-P1s", "MINI", "P1-P0", "P2-P0",
            "Q1", "Q2", "Q1-P0", "Q2-P1"]
MARKERS = ["o", "s", "^", "D", "v", "P", "X", "h"]
DASHES = ["-", (0, (4, 1.5)), (0, (1, 1)), (0, (5, 1, 1, 1))]

STRIP = 0.07  # height of the strip of failed runs, as part of the axes


def style(study, method):
    known = ELEMENTS if set(study.methods) <= set(ELEMENTS) else study.methods
    i = known.index(method)
    return dict(color=COLOURS[i % len(COLOURS)], marker=MARKERS[i % len(MARKERS)],
                linestyle=DASHES[i // len(COLOURS) % len(DASHES)])


def slug(text):
    return re.sub(r"[^a-z0-9]+", "_", text.lower()).strip("_")


def percent(value, _position=None):
    return f"{100 * value:.10g} %"


def plain(value, _position=None):
    return f"{value:.10g}"


def log_axis(axis, formatter):
    low, high = axis.get_view_interval()
    axis.set_major_locator(LogLocator(subs=(1, 2, 5) if high < 50 * low else (1,), numticks=12))
    axis.set_major_formatter(FuncFormatter(formatter))
    axis.set_minor_formatter(NullFormatter())


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


def new_figure(title, panels):
    """The figure, and pairs of axes and runs."""
    n_columns = min(len(panels), 2) if len(panels) <= 4 else 3
    n_rows = math.ceil(len(panels) / n_columns)
    size = (8.4, 4.8) if len(panels) == 1 else (2.2 + 4.1 * n_columns, 0.9 + 3.3 * n_rows)
    figure, all_axes = plt.subplots(n_rows, n_columns, figsize=size, squeeze=False, sharex=True,
                                    sharey=True, layout="constrained")
    figure.suptitle(title, fontsize=12, fontweight="bold")
    for unused in all_axes.flat[len(panels):]:
        unused.remove()
    for i, (axes, (name, _)) in enumerate(zip(all_axes.flat, panels)):
        axes.set_title(name, fontsize=10)
        axes.grid(True, which="major", color="#DDDDDD", linewidth=0.7)
        axes.set_axisbelow(True)
        axes.spines[["top", "right"]].set_visible(False)
        axes.tick_params(labelbottom=i + n_columns >= len(panels))
    return figure, [(axes, rows) for axes, (_, rows) in zip(all_axes.flat, panels)]


def draw_failed(axes, study, rows, position):
    """Crosses in a strip at the upper edge that no figure reaches; side by side at one place."""
    places = groups([row for row in rows if position(row) is not None], position)
    if not places:
        return
    axes.add_patch(plt.Rectangle((0, 1 - STRIP), 1, STRIP, transform=axes.transAxes,
                                 color="#F6E3E3", linewidth=0, zorder=0))
    for x, here in places.items():
        for i, row in enumerate(here):
            shift = ScaledTranslation((i - (len(here) - 1) / 2) * 10 / 72, 0,
                                      axes.figure.dpi_scale_trans)
            axes.plot(x, 1 - STRIP / 2, "x", markersize=7.5, markeredgewidth=2.2, zorder=5,
                      color=style(study, study.method(row))["color"],
                      transform=axes.get_xaxis_transform() + shift)


def leave_room_for_strip(axes):
    bottom, top = axes.transScale.transform([(1, y) for y in axes.get_ylim()])[:, 1]
    top = bottom + (top - bottom) / (1 - STRIP)
    axes.set_ylim(top=axes.transScale.inverted().transform((0, top))[1])


def legend(figure, study, any_failed, extra):
    handles = [Line2D([], [], label=m, markersize=6, **style(study, m)) for m in study.methods]
    handles += list(extra)
    if any_failed:
        handles.append(Line2D([], [], linestyle="", marker="x", color="#444444", markersize=8,
                              markeredgewidth=2.2, label="failed"))
    top = [axes for axes in figure.axes if axes.get_subplotspec().is_first_row()]
    top[-1].legend(handles=handles, bbox_to_anchor=(1.03, 1), loc="upper left", borderaxespad=0,
                   frameon=False, title="Method", title_fontproperties={"weight": "bold"},
                   alignment="left")


def save(figure, folder, name):
    written = []
    for ending in ("svg", "png"):
        file = folder / f"{name}.{ending}"
        figure.savefig(file, dpi=160)
        written.append(file)
    plt.close(figure)
    return written


def errors(rows, probe):
    """(row, relative error) of the runs that have one that a logarithmic axis can show."""
    pairs = [(row, number(row[probe.error])) for row in rows if not failed(row)]
    return [(row, abs(error)) for row, error in pairs if error]


def draw_uncertainty(axes, rows, probe, position=None):
    """Below this band an error says nothing: the reference itself is not known better."""
    if not probe.uncertainty:
        return []
    known = [(position(row) if position else 0, number(row[probe.uncertainty])) for row in rows]
    known = sorted((x, abs(u)) for x, u in known if x is not None and u)
    if not known:
        return []
    bottom = min(axes.get_ylim()[0], known[0][1] / 3)
    if position:
        axes.fill_between(*zip(*known), bottom, color="#BBBBBB", alpha=0.45, linewidth=0, zorder=0)
    else:
        axes.axhspan(bottom, max(u for _, u in known), color="#BBBBBB", alpha=0.45, linewidth=0,
                     zorder=0)
    axes.set_ylim(bottom=bottom)
    return [plt.Rectangle((0, 0), 1, 1, color="#BBBBBB", alpha=0.45,
                          label="reference's own\nuncertainty")]


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


def place_labels(figure, ends):
    """The method's name beside its last point, on the first side with room, if there is any."""
    sides = [((6, 4), "left", "bottom"), ((6, -4), "left", "top"), ((-6, 4), "right", "bottom"),
             ((-6, -4), "right", "top"), ((0, 7), "center", "bottom"), ((0, -7), "center", "top")]
    figure.canvas.draw()
    for axes, labels in ends.items():
        radius = 5 * figure.dpi / 72
        taken = [Bbox.from_extents(*(axes.transData.transform(point) - radius),
                                   *(axes.transData.transform(point) + radius))
                 for point, _ in labels]
        for point, method in labels:
            for offset, horizontal, vertical in sides:
                text = axes.annotate(method, point, xytext=offset, textcoords="offset points",
                                     ha=horizontal, va=vertical, fontsize=8, color="#333333")
                box = text.get_window_extent()
                inside = axes.bbox.x0 <= box.x0 and box.x1 <= axes.bbox.x1
                if inside and not any(box.overlaps(other) for other in taken):
                    taken.append(box)
                    break
                text.remove()


def title_of(folder):
    """The title that the study's parameters give, or the folder's name."""
    parameters = folder / "parameters.prm"
    text = parameters.read_text(errors="replace") if parameters.is_file() else ""
    match = re.search(r"^subsection Study$.*?^ *set Title *= *([^#\n]*?) *(?:#.*)?$.*?^end$", text,
                      re.MULTILINE | re.DOTALL)
    return match[1] if match and match[1] else (
        folder.absolute().name.replace("_", " ").capitalize())


def main():
    parser = argparse.ArgumentParser(description="Charts of a study, from its results.csv.")
    parser.add_argument("folder", type=Path, help="output folder of the study")
    parser.add_argument("--title", help="default: the study's title, or the folder's name")
    options = parser.parse_args()
    try:
        study = Study(options.folder / "results.csv")
    except BadTable as error:
        sys.exit(f"chart.py: error: {error}")

    plt.rcParams.update({"font.size": 10, "svg.hashsalt": "isochor"})
    name = options.title or title_of(options.folder)
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
