#!/usr/bin/env python3
"""Re-runs a study of convergence/ and compares it with its baseline.

  rerun_study.py NAME... | all [--isochor PATH] [--output FOLDER] [--update] [--jobs N]

convergence/NAME holds README.md and one or more parts: study.prm with baseline.csv, and any other
STEM.prm with baseline_STEM.csv. If there are published values, expected.csv or expected_STEM.csv,
they are compared, too (compare_results.py says how). Every part runs on one rank and one thread, N of
them at a time; seconds are best measured with one.

Exit code 0 if nothing deviates, else 1, with a table of what does. --update makes what was found the
baseline instead: the tables, the date, the machine and the charts that the README shows, too;
published values are not changed by anything.
"""

import argparse
import datetime
import os
import re
import shutil
import subprocess
import sys
import tempfile
from concurrent.futures import ThreadPoolExecutor
from pathlib import Path

from compare_results import against_published, compare
from results_table import BadTable, Study, short, slug
from study_tables import BLOCK, refreshed

ROOT = Path(__file__).resolve().parents[1]
SCRIPTS = Path(__file__).resolve().parent


class Failed(Exception):
    pass


class Part:
    """One parameter file of a study, and what belongs to it."""

    def __init__(self, file):
        self.file, self.folder = file, file.parent
        tail = "" if file.stem == "study" else f"_{file.stem}"
        self.name = file.parent.name + ("" if file.stem == "study" else f"/{file.stem}")
        self.baseline = self.folder / f"baseline{tail}.csv"
        self.expected = self.folder / f"expected{tail}.csv"
        self.chart_prefix = "" if file.stem == "study" else f"{file.stem}_"


def parts_of(folder):
    files = sorted(folder.glob("*.prm"), key=lambda file: (file.stem != "study", file.stem))
    if not files:
        raise Failed(f"{folder}: holds no parameter file")
    return [Part(file) for file in files]


def run(part, isochor, output):
    """The results of the part, in OUTPUT."""
    environment = dict(os.environ, OMP_NUM_THREADS="1", OPENBLAS_NUM_THREADS="1",
                       DEAL_II_NUM_THREADS="1", LC_ALL="C")
    result = subprocess.run([isochor, part.file, "--output", output, "--overwrite"],
                            env=environment, stdin=subprocess.DEVNULL, capture_output=True,
                            text=True)
    # 2: some runs did not converge; whether they should is the baseline's to say.
    if result.returncode not in (0, 2):
        raise Failed(f"{part.file}: exit code {result.returncode}\n{result.stderr}")
    return Study(output / "results.csv")


def print_table(header, rows):
    lines = [header, *rows]
    widths = [max(len(str(line[k])) for line in lines) for k in range(len(header))]
    for line in lines:
        print("  " + "  ".join(str(text).ljust(width) for text, width in zip(line, widths)).rstrip())


def check_published(part, study):
    """Prints the table; the number of entries out of tolerance."""
    if not part.expected.is_file():
        return 0
    entries = against_published(study, part.expected)
    bad = [e for e in entries if e.deviation is not None and not abs(e.deviation) <= e.tolerance]
    print(f"{part.name}: against the published values of {part.expected.name}")
    print_table(["run", "figure", "published", "found", "deviation", ""],
                [[", ".join(f"{short(n)} {v}" for n, v in e.settings.items()), e.column,
                  f"{e.expected:.10g}", "-" if e.found is None else f"{e.found:.6g}",
                  "not run" if e.found is None else f"{100 * e.deviation:+.3f} %",
                  "DEVIATES" if e in bad else ""] for e in entries])
    return len(bad)


def check_baseline(part, study):
    if not part.baseline.is_file():
        raise Failed(f"{part.baseline}: missing; --update writes it")
    baseline = Study(part.baseline)
    deviations = compare(study, baseline)
    runs = len(baseline.runs) + len(baseline.reference)
    print(f"{part.name}: {runs} runs, {len(deviations)} deviations from {part.baseline.name}")
    if deviations:
        print_table(["run", "figure", "baseline", "found"], deviations)
    return len(deviations)


def seconds(study):
    return sum(float(row["seconds total"] or 0) for row in study.runs + study.reference)


def processor():
    with open("/proc/cpuinfo", encoding="utf-8") as stream:
        match = re.search(r"^model name\s*: (.*)$", stream.read(), re.MULTILINE)
    return " ".join(match[1].split()) if match else "unknown processor"


def version(isochor):
    """Isochor's, and the kernels of OpenBLAS, on which seconds depend by a factor of two."""
    text = subprocess.run([isochor, "--version"], capture_output=True, text=True).stdout
    kernels = blas_kernels(text)
    return (text.splitlines()[0] if text else "") + (f", BLAS kernels {kernels}" if kernels else "")


def blas_kernels(version_text):
    match = re.search(r"\(OpenBLAS [^)]* (\w+) MAX_THREADS", version_text)
    return match and match[1]


def update(folder, results, isochor):
    """RESULTS: (part, study, output folder)."""
    readme = folder / "README.md"
    for part, _, output in results:
        shutil.copyfile(output / "results.csv", part.baseline)
    total = sum(seconds(study) for _, study, _ in results)
    record = (f"{datetime.date.today()}, one thread of {processor()}, {version(isochor)}: "
              f"{sum(len(s.runs) + len(s.reference) for _, s, _ in results)} runs in "
              f"{total:.0f} s.\n")
    if readme.is_file():
        readme.write_text(refreshed(readme, {"baseline": record}), encoding="utf-8")
    draw(folder, results)


def command_for(picture, study, output):
    """The program that draws the chart PICTURE (a name without prefix and ending) of STUDY in the
    folder OUTPUT, with arguments; None if no chart is called so."""
    if picture.endswith("_against_iterations"):
        return ["iteration_chart.py", output]
    if "_against_" in picture:
        return ["chart.py", output]
    if picture == "failure_map":
        return ["failure_map.py", output]
    if picture == "work_precision":
        return ["work_precision.py", output]
    probes = {f"{slug(probe.name)}_work_precision": probe.name for probe in study.probes}
    if picture in probes:
        return ["work_precision.py", output, "--probe", probes[picture]]
    return None


def draw(folder, results):
    """The charts that the README shows; their names tell which."""
    readme = folder / "README.md"
    wanted = (re.findall(r"!\[[^]]*\]\(([^)/]+)\.png\)", readme.read_text(encoding="utf-8"))
              if readme.is_file() else [])
    for part, study, output in results:
        pictures = [name.removeprefix(part.chart_prefix) for name in wanted
                    if name.startswith(part.chart_prefix)]
        commands = [command for picture in pictures
                    if (command := command_for(picture, study, output))]
        for command in dict.fromkeys(map(tuple, commands)):
            # As a program: its first line names the Python that has matplotlib.
            result = subprocess.run([SCRIPTS / command[0], *command[1:]], capture_output=True,
                                    text=True)
            if result.returncode != 0:
                raise Failed(f"{command[0]}: {result.stderr}")
        for picture in pictures:
            if (chart := output / f"{picture}.png").is_file():
                shutil.copyfile(chart, folder / f"{part.chart_prefix}{picture}.png")


def start(pool, folder, options, scratch):
    """The parts of a study: (part, its results to come, output folder)."""
    started = []
    for part in parts_of(folder):
        output = scratch / folder.name / part.file.stem
        output.mkdir(parents=True, exist_ok=True)
        started.append((part, pool.submit(run, part, options.isochor, output), output))
    return started


def evaluate(folder, started, options):
    """The number of deviations."""
    results = []
    for part, to_come, output in started:
        study = to_come.result()
        results.append((part, study, output))
        print(f"{part.name}: {seconds(study):.1f} s", flush=True)
    bad = sum(check_published(part, study) for part, study, _ in results)
    if options.update:
        update(folder, results, options.isochor)
        print(f"{folder.name}: baseline updated")
        return bad
    bad += sum(check_baseline(part, study) for part, study, _ in results)
    readme = folder / "README.md"
    if readme.is_file() and BLOCK.search(text := readme.read_text(encoding="utf-8")):
        if refreshed(readme) != text:
            print(f"{folder.name}: the tables of README.md are not those of the baseline; "
                  "scripts/study_tables.py rewrites them")
            bad += 1
    return bad


def find_studies(names, place):
    known = sorted(file.parent.name for file in place.glob("*/*.prm"))
    known = list(dict.fromkeys(known))
    if names == ["all"]:
        return [place / name for name in known]
    for name in names:
        if name not in known:
            raise Failed(f"no study is named '{name}'; there are {', '.join(known)}, or all")
    return [place / name for name in names]


def main():
    parser = argparse.ArgumentParser(
        description="Re-run studies of convergence/ and compare them with their baselines.")
    parser.add_argument("names", nargs="+", metavar="NAME", help="of a folder, or all")
    parser.add_argument("--isochor", type=Path, default=ROOT / "build" / "release" / "isochor",
                        help="the program, a Release build (default: build/release/isochor)")
    parser.add_argument("--output", type=Path, help="keep the results there")
    parser.add_argument("--update", action="store_true", help="make the results the baseline")
    parser.add_argument("--jobs", type=int, choices=range(1, 65), default=1, metavar="N",
                        help="parts that run at a time (default: 1)")
    parser.add_argument("--studies", type=Path, default=ROOT / "convergence",
                        help="folder of the studies (default: convergence)")
    options = parser.parse_args()
    try:
        if not options.isochor.is_file():
            raise Failed(f"{options.isochor}: no such program; build it or name it by --isochor")
        options.isochor = options.isochor.resolve()
        folders = find_studies(options.names, options.studies.resolve())
        with tempfile.TemporaryDirectory() as scratch:
            place = options.output.resolve() if options.output else Path(scratch)
            with ThreadPoolExecutor(options.jobs) as pool:
                try:
                    started = [start(pool, folder, options, place) for folder in folders]
                    bad = sum(evaluate(folder, parts, options)
                              for folder, parts in zip(folders, started))
                finally:  # after an error no other part begins
                    pool.shutdown(wait=False, cancel_futures=True)
    except (Failed, BadTable, OSError) as error:
        sys.exit(f"rerun_study.py: error: {error}")
    print("nothing deviates" if not bad else f"{bad} deviations")
    sys.exit(1 if bad else 0)


if __name__ == "__main__":
    main()
