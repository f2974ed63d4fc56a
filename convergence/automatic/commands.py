#!/usr/bin/env python3
"""What Element = auto costs who waits for it: whole commands, from start to end, beside those of the
cheapest fixed method that hindsight knows. One thread, each command alone.

  commands.py               run all, write the table of README.md and commands.csv
  commands.py --only tube   some scenes; print the table, write nothing

The seconds of a run that results.csv tells are those of its own work; a command also loads its libraries
and reads its file, which is what a run of a few hundred unknowns takes most of its time for.
"""

import sys
import time
from pathlib import Path
from typing import NamedTuple

HERE = Path(__file__).resolve().parent
FIXED = HERE.parent / "work_precision"
sys.path.insert(0, str(HERE.parents[1] / "scripts"))

from automatic_tables import ACCURACY, baselines, best_in_hindsight, fixed_words  # noqa: E402
from benchmark_runs import (Failed, checked, interleaved, markdown, options_of, publish,  # noqa: E402
                            record, run)
from results_table import BadTable, number  # noqa: E402
from study_tables import figure  # noqa: E402

METHODS = ("auto", "fixed")
NO_REFERENCE = {"Study/Reference": "", "Study/Reference check": ""}


class Case(NamedTuple):
    scene: str
    accuracy: str
    words: str # of the fixed method
    settings: tuple

    def __str__(self):
        return f"{self.scene} {self.accuracy}"


def all_cases():
    """Each request of the study that a fixed method meets."""
    cases = []
    for scene, automatic, fixed in baselines(HERE, FIXED):
        for row, best in best_in_hindsight(automatic, fixed):
            if best is not None:
                cases.append(Case(scene, row[ACCURACY], fixed_words(fixed, best),
                                  tuple((name, best[name]) for name in fixed.varied)))
    return cases


def measured(options, case, method):
    folder, settings = ((HERE, {ACCURACY: case.accuracy}) if method == "auto"
                        else (FIXED, dict(case.settings)))
    begin = time.perf_counter()
    row = run(options.isochor, folder / f"{case.scene}.prm", {**settings, **NO_REFERENCE})
    return {"seconds": time.perf_counter() - begin, "run": number(row["seconds total"]),
            "choice": row["auto choice"] if method == "auto" else case.words}


def rows_of(cases, found):
    rows = []
    for case in cases:
        auto, fixed = (found[case, method] for method in METHODS)
        rows.append({"scene": case.scene, "wanted": case.accuracy, "chosen": auto["choice"],
                     "auto run seconds": auto["run"], "auto command seconds": auto["seconds"],
                     "fixed": fixed["choice"], "fixed run seconds": fixed["run"],
                     "fixed command seconds": fixed["seconds"],
                     "run ratio": auto["run"] / fixed["run"],
                     "command ratio": auto["seconds"] / fixed["seconds"]})
    return rows


def table(rows):
    header = ["scene", "wanted", "auto: runs", "command", "cheapest fixed", "run", "command",
              "ratio of runs", "of commands"]
    return markdown(header,
                    [[row["scene"].replace("_", " "), row["wanted"],
                      figure(row["auto run seconds"], 2), figure(row["auto command seconds"], 2),
                      row["fixed"], figure(row["fixed run seconds"], 2),
                      figure(row["fixed command seconds"], 2), f"{row['run ratio']:.1f}",
                      f"{row['command ratio']:.1f}"] for row in rows])


def main():
    options = checked(options_of(__doc__.split("\n", maxsplit=1)[0]).parse_args())
    cases = [case for case in all_cases() if options.only in str(case)]
    found = interleaved(options.repeat, cases, lambda case: METHODS,
                        lambda case, method: measured(options, case, method))
    rows = rows_of(cases, found)
    publish(HERE, rows, {"commands": table(rows) + "\n" + record(options.isochor, options.repeat)},
            options.show, "commands.csv")


if __name__ == "__main__":
    try:
        main()
    except (Failed, BadTable, OSError) as error:
        sys.exit(f"commands.py: error: {error}")
