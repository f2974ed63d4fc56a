#!/usr/bin/python3
"""The table of this study's baselines beside the paper's table 1 (paper.csv); writes it into README.md.

  make_table.py [--check]    exit code 1 if README.md has another one
"""

import argparse
import csv
import sys
from pathlib import Path

HERE = Path(__file__).resolve().parent
sys.path.insert(0, str(HERE.parents[1] / "scripts"))

from results_table import Study, failed, number  # noqa: E402
from study_tables import figure, markdown, refreshed  # noqa: E402

METHODS = ["standard", "mixed"]
HEADER = ["experiment", "cells", *(f"{m} (s)" for m in METHODS), "ratio",
          *(f"{m} iterations" for m in METHODS), *(f"paper, {m} (s)" for m in METHODS),
          "paper, ratio"]


def line(entry):
    study = Study(HERE / f"baseline_{entry['file']}.csv")
    runs = [study.find(entry[method]) for method in METHODS]
    seconds = [number(run["seconds total"]) for run in runs]
    paper = [number(entry[f"paper {method} [s]"]) for method in METHODS]
    return [entry["experiment"], runs[0]["cells"],
            *("failed" if failed(run) else figure(s, 2) for run, s in zip(runs, seconds)),
            "-" if any(map(failed, runs)) else figure(seconds[1] / seconds[0], 2),
            *(run["newton iterations"] for run in runs),
            *(f"{s:g}" for s in paper), figure(paper[1] / paper[0], 2)]


def main():
    parser = argparse.ArgumentParser(description="The table of this study beside the paper's.")
    parser.add_argument("--check", action="store_true", help="change nothing")
    options = parser.parse_args()
    with open(HERE / "paper.csv", newline="", encoding="utf-8") as stream:
        lines = [line(entry) for entry in csv.DictReader(stream)]
    readme = HERE / "README.md"
    text = refreshed(readme, {"seconds": markdown(HEADER, lines)})
    if text == readme.read_text(encoding="utf-8"):
        return
    if options.check:
        sys.exit("README.md: another table than the baselines give")
    readme.write_text(text, encoding="utf-8")


if __name__ == "__main__":
    main()
