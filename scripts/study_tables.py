#!/usr/bin/env python3
"""Tables of a study's README.md, made of its baseline: nothing is copied by hand.

  study_tables.py README.md           rewrite its tables
  study_tables.py --check README.md   exit code 1 if one is not what the baseline says

A table stands between <!-- begin: WHAT --> and <!-- end -->. WHAT is, with files of the README's
folder,
  orders FILE: PROBE, PROBE       errors on the finest mesh and orders of convergence
  values FILE: COLUMN by SETTING  a figure, a column per value of the setting; behind it may stand
                                  "in percent"
  figures FILE: COLUMN, COLUMN    a row per run; "tip error %": in percent; "volume ratio
                                  change %": its difference from 1
  published FILE against FILE     a baseline against published values (see compare_results.py)
  cheapest FILE: PROBE            the cheapest run for each accuracy (see cost_and_accuracy.py)
  failures FILE                   how far each method came, and why no further (see failures.py)
  ratios                          the first probe over the truth, for each scene (see ratio_tables.py)
  automatic FOLDER                Element = auto beside the fixed methods of the scenes' baselines in
                                  FOLDER (see automatic_tables.py)
  estimates FOLDER                errors that runs estimate of themselves over true ones; FOLDER as
                                  before (see estimate_tables.py)
Other blocks are left alone; rerun_study.py fills "baseline".
"""

import argparse
import re
import sys
from pathlib import Path

import automatic_tables
from compare_results import against_published
from cost_and_accuracy import cheapest_rows, probe_with_error
from estimate_tables import estimate_rows
from failures import failures_rows
from ratio_tables import ratio_rows
from results_table import BadTable, Study, failed, groups, number, short

BLOCK = re.compile(r"(<!-- begin: (.*?) -->\n)(.*?)(<!-- end -->)", re.DOTALL)


def markdown(header, rows):
    lines = [header, ["---"] * len(header), *rows]
    return "".join("| " + " | ".join(map(str, line)) + " |\n" for line in lines)


def figure(value, digits=4):
    """A number for readers; large and small ones with an exponent."""
    if value is None:
        return "-"
    if value == 0 or 1e-3 <= abs(value) < 1e4:
        return f"{value:#.{digits}g}".rstrip(".")
    return f"{value:.{digits - 2}e}"


def orders_table(study, probes):
    """A row for each group of runs and probe, a column for each step of refinement."""
    rows, steps = [], []
    for probe in probes:
        for settings, line in study.orders(probe):
            sizes = [text for text, _, _ in line]
            steps = [f"{a} to {b}" for a, b in zip(sizes, sizes[1:])]
            orders = ["-" if order is None else f"{order:.2f}" for _, _, order in line[1:]]
            unit = f" [{probe.unit}]" if probe.unit and not probe.error else ""
            rows.append([probe.name + unit, *settings.values(), figure(line[-1][1], 3), *orders])
    others = [short(name).lower() for name in study.varied if name != study.resolution()]
    return markdown(["figure", *others, "finest error", *(f"order, {step}" for step in steps)], rows)


def values_table(study, column, setting, percent=False):
    """A row for each group of runs that differ in SETTING only, a column for each value of it."""
    parameter = next((n for n in study.varied if setting in (n, short(n))), None)
    if parameter is None or column not in study.columns:
        raise BadTable(f"no table of '{column}' by '{setting}': the study varies "
                       f"{', '.join(study.varied)} and has {', '.join(study.columns)}")
    values = list(dict.fromkeys(row[parameter] for row in study.runs))
    others = [name for name in study.varied if name != parameter]

    def cell(rows, value):
        row = next((row for row in rows if row[parameter] == value), None)
        if row is None or failed(row):
            return "-" if row is None else "failed"
        found = number(row[column])
        if percent and found is not None:
            return f"{100 * found:.2g} %"
        return row[column] if row[column].isdigit() else figure(found)

    rows = [[*settings, *(cell(group, value) for value in values)]
            for settings, group in groups(study.runs, lambda r: tuple(r[n] for n in others)).items()]
    return markdown([*(short(n).lower() for n in others),
                     *(f"{short(parameter).lower()} {value}" for value in values)], rows)


def figures_table(study, columns):
    """A row for each run with its varied settings and these figures, as table() is asked for."""
    wanted = [re.fullmatch(r"(.+?)( change)?( %)?", column).groups()
              if column not in study.columns else (column, None, None) for column in columns]
    if unknown := [name for name, _, _ in wanted if name not in study.columns]:
        raise BadTable(f"no figure named {', '.join(map(repr, unknown))}; the study has "
                       f"{', '.join(study.columns)}")

    def cell(row, name, change, in_percent):
        found = number(row[name])
        if found is None:
            return row[name] or "-"
        if in_percent:
            found = 100 * (found - (1 if change else 0))
            digits = 3 if change or abs(found) >= 100 else 2
            return f"{found:.{digits}g} %" if abs(found) < 1000 else f"{found:.0f} %"
        return row[name] if row[name].isdigit() else figure(found)

    rows = [[*(row[n] for n in study.varied), *(cell(row, *which) for which in wanted)]
            for row in study.runs]
    return markdown([*(short(n).lower() for n in study.varied),
                     *(name + (change or "") for name, change, _ in wanted)], rows)


def published_table(entries):
    def digits(expected):
        return max(5, len(f"{expected:.10g}".lstrip("-0.").replace(".", "")) + 1)

    rows = [[*entry.settings.values(), f"{entry.expected:.10g}",
             figure(entry.found, digits(entry.expected)),
             "not run" if entry.found is None else f"{100 * entry.deviation:+.3f} %"]
            for entry in entries]
    settings = [short(name).lower() for name in entries[0].settings] if entries else []
    return markdown([*settings, "published", "found", "deviation"], rows)


def table(folder, what):
    """The Markdown of a block, or None if the block is not ours."""
    if match := re.fullmatch(r"orders (\S+): (.+)", what):
        study = Study(folder / match[1])
        return orders_table(study, [study.probe(name.strip()) for name in match[2].split(",")])
    if match := re.fullmatch(r"values (\S+): (.+?) by (.+?)( in percent)?", what):
        return values_table(Study(folder / match[1]), match[2], match[3], bool(match[4]))
    if match := re.fullmatch(r"figures (\S+): (.+)", what):
        return figures_table(Study(folder / match[1]),
                             [name.strip() for name in match[2].split(",")])
    if match := re.fullmatch(r"published (\S+) against (\S+)", what):
        return published_table(against_published(Study(folder / match[1]), folder / match[2]))
    if match := re.fullmatch(r"cheapest (\S+): (.+)", what):
        study = Study(folder / match[1])
        return markdown(*cheapest_rows(study, probe_with_error(study, match[2])))
    if match := re.fullmatch(r"failures (\S+)", what):
        return markdown(*failures_rows(Study(folder / match[1])))
    if what == "ratios":
        return markdown(*ratio_rows(folder))
    if match := re.fullmatch(r"automatic (\S+)", what):
        return markdown(automatic_tables.HEADER,
                        automatic_tables.automatic_rows(folder, folder / match[1]))
    if match := re.fullmatch(r"estimates (\S+)", what):
        return markdown(*estimate_rows(folder, folder / match[1]))
    return None


def refreshed(file, other_blocks=None):
    """The text of the README FILE with its tables made anew; OTHER_BLOCKS: text by name."""
    def replace(match):
        text = (other_blocks or {}).get(match[2]) or table(file.parent, match[2])
        return match[0] if text is None else match[1] + text + match[4]

    return BLOCK.sub(replace, file.read_text(encoding="utf-8"))


def main():
    parser = argparse.ArgumentParser(description="Tables of a study's README.md from its baseline.")
    parser.add_argument("files", nargs="+", type=Path, metavar="README.md")
    parser.add_argument("--check", action="store_true", help="change nothing")
    options = parser.parse_args()
    stale = []
    try:
        for file in options.files:
            text = refreshed(file)
            if text != file.read_text(encoding="utf-8"):
                stale.append(file)
                if not options.check:
                    file.write_text(text, encoding="utf-8")
    except (BadTable, OSError) as error:
        sys.exit(f"study_tables.py: error: {error}")
    for file in stale:
        print(f"{file}: " + ("tables are not those of the baseline" if options.check
                             else "tables rewritten"))
    sys.exit(1 if stale and options.check else 0)


if __name__ == "__main__":
    main()
