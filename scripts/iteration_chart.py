#!/usr/bin/python3
"""Charts of how the iterations of a study went: iteration_chart.py FOLDER reads FOLDER/results.csv and the
iterations.csv of its runs (Output/Iterations = true), and writes SVG and PNG beside them:

  residual_against_iterations        all iterations that were made, a line per load step
  volume_error_against_iterations    likewise, of dual ascent

A panel for each setting but the element. The target is dotted; load steps that failed are dashed and end
in a cross.
"""

import argparse
import csv
import sys
from pathlib import Path

from matplotlib.lines import Line2D

from chart_style import COLOURS, ELEMENTS, log_axis, percent, plt, save
from results_table import BadTable, groups, number, setting, slug
from study_files import StudyFiles

ELEMENT = "Method/Element"
NEEDED = ["iteration", "iterations so far", "target", "outcome"]
FIGURES = {"residual": "relative residual", "volume error": "volume error"}


def attempts(file):
    """The rows of iterations.csv, a list for every load step that was tried."""
    try:
        with open(file, newline="", encoding="utf-8") as stream:
            reader = csv.DictReader(stream)
            missing = [n for n in [*NEEDED, *FIGURES] if n not in (reader.fieldnames or [])]
            if missing:
                raise BadTable(f"{file}: no column named {', '.join(map(repr, missing))}")
            found = []
            for row in reader:
                if not found or int(row["iteration"]) <= int(found[-1][-1]["iteration"]):
                    found.append([])
                found[-1].append(row)
    except (OSError, ValueError, csv.Error) as error:
        raise BadTable(f"{file}: cannot be read: {error}")
    return found


def histories(study, folder):
    """(row of results.csv, its attempts) of each run that has written them."""
    files = [(row, folder / row.get("folder", ".") / "iterations.csv") for row in study.runs]
    found = [(row, attempts(file)) for row, file in files if file.is_file()]
    return [(row, steps) for row, steps in found if steps]


def draw_history(axes, steps, name, colour):
    for rows in steps:
        points = [(int(row["iterations so far"]), number(row[name])) for row in rows]
        points = [(x, y) for x, y in points if y]  # a logarithmic axis has no zero
        if not points:
            continue
        failed = rows[0]["outcome"] != "converged"
        axes.plot(*zip(*points), color=colour, linewidth=1.5, linestyle="--" if failed else "-")
        axes.plot(*points[-1], color=colour, marker="x" if failed else "o", markersize=5)


def draw(study, runs, name, title):
    """The figure, a panel for each setting but the element."""
    others = [n for n in study.varied if n != ELEMENT]
    panels = groups(runs, lambda run: tuple(run[0][n] for n in others))
    figure, all_axes = plt.subplots(len(panels), 1, figsize=(8.8, 1.2 + 3 * len(panels)),
                                    squeeze=False, sharex=True, sharey=True, layout="constrained")
    handles = {}
    for axes, here in zip(all_axes.flat, panels.values()):
        for i, (row, steps) in enumerate(here):
            element = row.get(ELEMENT, "run")
            colour = COLOURS[ELEMENTS.index(element) % len(COLOURS)] if element in ELEMENTS \
                else COLOURS[i % len(COLOURS)]
            draw_history(axes, steps, name, colour)
            handles[element] = Line2D([], [], color=colour, label=element)
        axes.set_yscale("log")
        if name == "residual":
            axes.axhline(number(here[0][1][0][0]["target"]), color="#666666", linewidth=1,
                         linestyle=":")
        axes.grid(True, color="#DDDDDD", linewidth=0.7)
        axes.spines[["top", "right"]].set_visible(False)
        axes.set_title(", ".join(setting(here[0][0], n) for n in others), fontsize=10)
    if name == "volume error":
        low, high = all_axes[0][0].get_ylim()
        log_axis(all_axes[0][0].yaxis, percent)
        all_axes[0][0].set_ylim(low, high)
    figure.suptitle(title, fontsize=12, fontweight="bold")
    figure.supxlabel("iterations, all load steps", fontsize=10)
    figure.supylabel(FIGURES[name], fontsize=10)
    if any(rows[0]["outcome"] != "converged" for _, steps in runs for rows in steps):
        handles["failed"] = Line2D([], [], color="#444444", linestyle="--", marker="x",
                                   label="failed step")
    all_axes[0][0].legend(handles=list(handles.values()), bbox_to_anchor=(1.02, 1),
                          loc="upper left", borderaxespad=0, frameon=False, title="Element")
    return figure


def main():
    parser = argparse.ArgumentParser(description="Charts of how the iterations of a study went.")
    parser.add_argument("folder", type=Path, help="output folder of the study")
    options = parser.parse_args()
    try:
        files = StudyFiles(options.folder)
        study = files.read()
        runs = histories(study, options.folder)
        if not runs:
            raise BadTable(f"{options.folder}: no run has an iterations.csv; Output/Iterations = "
                           "true asks for it")
    except BadTable as error:
        sys.exit(f"iteration_chart.py: error: {error}")
    for name in FIGURES:
        known = [(row, steps) for row, steps in runs if number(steps[0][0][name]) is not None]
        if known:
            figure = draw(study, known, name, f"{files.title()}: {FIGURES[name]}")
            print("\n".join(map(str, save(figure, options.folder,
                                          f"{slug(name)}_against_iterations"))))


if __name__ == "__main__":
    main()
