"""What the benchmarks of convergence/ share: runs of isochor, medians, the tables of a README.md."""

import argparse
import contextlib
import csv
import datetime
import os
import signal
import statistics
import subprocess
import tempfile
from pathlib import Path

from rerun_study import Failed, blas_kernels, processor, version
from results_table import number
from study_tables import figure, markdown, refreshed

ROOT = Path(__file__).resolve().parents[1]
ENVIRONMENT = dict(os.environ, OMP_NUM_THREADS="1", OPENBLAS_NUM_THREADS="1",
                   DEAL_II_NUM_THREADS="1", LC_ALL="C")
GRACE = 60  # seconds for the last Newton iteration and the results of a run that was asked to end


def options_of(description):
    """The command line that all benchmarks have."""
    parser = argparse.ArgumentParser(description=description)
    parser.add_argument("--isochor", type=Path, default=ROOT / "build" / "release" / "isochor",
                        help="the program, a Release build (default: build/release/isochor)")
    parser.add_argument("--repeat", type=int, default=3, metavar="N",
                        help="times that all is run, in turn; the median counts (default: 3)")
    parser.add_argument("--only", default="", metavar="TEXT",
                        help="only cases with TEXT in their names; nothing is written")
    parser.add_argument("--show", action="store_true", help="print the tables and write nothing")
    return parser


def checked(options):
    if not options.isochor.is_file():
        raise Failed(f"{options.isochor}: no such program; build it or name it by --isochor")
    options.isochor = options.isochor.resolve()
    # Other codes are to have the kernels that Isochor asks for.
    text = subprocess.run([options.isochor, "--version"], capture_output=True, text=True).stdout
    if kernels := blas_kernels(text):
        ENVIRONMENT.setdefault("OPENBLAS_CORETYPE", kernels)
    options.show = options.show or bool(options.only)
    return options


def run(program, scene, settings, ranks=1, limit=None, output=None):
    """The row of results.csv, text by column, of one run of the file SCENE with SETTINGS (values by
    "Section/Key"). One that takes more than LIMIT seconds is asked to end where it is, as by Ctrl-C;
    the row is None if it does not. The results stay in the folder OUTPUT, if one is given."""
    with contextlib.nullcontext(output) if output else tempfile.TemporaryDirectory() as folder:
        command = [program, scene, "--output", folder, "--overwrite"]
        for key, value in {"Output/VTU": "none", **settings}.items():
            command += ["--set", f"{key}={value}"]
        if ranks > 1:
            root = ["--allow-run-as-root"] if os.geteuid() == 0 else [] # Open MPI's option
            command = ["mpirun", "-q", *root, "-np", str(ranks), *command]
        process = subprocess.Popen(command, env=ENVIRONMENT, stdin=subprocess.DEVNULL,
                                   stdout=subprocess.DEVNULL, stderr=subprocess.PIPE, text=True)
        try:
            _, errors = process.communicate(timeout=limit)
        except subprocess.TimeoutExpired:
            process.send_signal(signal.SIGINT)
            try:
                _, errors = process.communicate(timeout=GRACE)
            except subprocess.TimeoutExpired:
                process.kill()
                process.communicate()
                return None
        # 2: it did not converge, or was asked to end.
        if process.returncode not in (0, 2):
            raise Failed(f"{scene} with {settings}: exit code {process.returncode}\n{errors}")
        with open(Path(folder) / "results.csv", newline="", encoding="utf-8") as stream:
            return list(csv.DictReader(stream))[-1]


def interleaved(repeat, cases, methods, measure):
    """Figures by (case, method): the medians of REPEAT calls of measure(case, method), each a
    dictionary of numbers and words, or None: not measured. All is run once before anything is run
    again, so that a machine that slows down slows down all alike."""
    runs = {}
    for turn in range(repeat):
        for case in cases:
            for method in methods(case):
                figures = measure(case, method)
                if figures is not None:
                    runs.setdefault((case, method), []).append(figures)
                    print(f"{turn + 1}/{repeat}  {case}  {method}  "
                          f"{figure(number(figures['seconds']), 3)} s", flush=True)
    return {key: medians(found) for key, found in runs.items()}


def medians(runs):
    """Of each number, whole if it is a count; words are those of the first run."""
    def median(name):
        values = [run.get(name) for run in runs]
        if all(isinstance(value, int) for value in values):
            return statistics.median_low(values)
        if all(isinstance(value, (int, float)) for value in values):
            return statistics.median(values)
        return values[0]

    return {name: median(name) for name in runs[0]}


def numbers(row):
    """The row with its numbers as numbers, and "seconds": all of them but those for the mesh."""
    values = {name: text if number(text) is None else
              int(text) if text.isdigit() else float(text) for name, text in row.items()}
    values["seconds"] = round(values["seconds total"] - values["seconds mesh"], 9)
    return values


def record(program, repeat, more=""):
    """Date, machine, versions."""
    return (f"{datetime.date.today()}, {processor()}, {version(program)}{more}; "
            f"{'one run each' if repeat == 1 else f'medians of {repeat} runs'}.\n")


def write_rows(file, rows):
    """ROWS: dictionaries, the first has all columns."""
    with open(file, "w", newline="", encoding="utf-8") as stream:
        table = csv.DictWriter(stream, list(rows[0]), restval="", extrasaction="ignore",
                               lineterminator="\n")
        table.writeheader()
        table.writerows(rows)


def publish(folder, rows, tables, show, baseline="baseline.csv"):
    """Write ROWS to the baseline and TABLES, Markdown by name of a block, to README.md, or, if only
    to SHOW, print the tables. Nothing if there are no rows."""
    if not rows:
        return
    if show:
        for name, text in tables.items():
            print(f"\n{name}\n{text}")
        return
    write_rows(folder / baseline, rows)
    readme = folder / "README.md"
    readme.write_text(refreshed(readme, tables), encoding="utf-8")
    print(f"{folder.name}: README.md and {baseline} written")


__all__ = ["ENVIRONMENT", "Failed", "ROOT", "checked", "figure", "interleaved", "markdown",
           "numbers", "options_of", "publish", "record", "run"]
