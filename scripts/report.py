#!/usr/bin/python3
"""A report of a study: one HTML file that opens on any screen and without a network.

  report.py NAME_OR_FOLDER -o FILE.html [--picture "Element = P1; Poisson ratio = 0.3"]...

NAME is a study of convergence/, FOLDER such a folder or one that isochor has written. The report holds
the study's README.md, all runs, the charts, pictures of the deformed body, the parameters and the
versions. Pictures are of the runs with the given settings, "PART: SETTINGS" in a study of several
parts: the VTU files of FOLDER, or, for a study of convergence/, of the runs made again. Without
--picture, a FOLDER with VTU files shows the methods of its last problem.
"""

import argparse
import datetime
import os
import shutil
import subprocess
import sys
import tempfile
from pathlib import Path

from cost_and_accuracy import probe_with_error
from failures import Loads
from report_page import escape, figure, inline_image, inline_svg, page, runs_table
from report_readme import readme_html, readme_title
from rerun_study import Failed, parts_of, processor
from results_table import BadTable, failed
from study_files import StudyFiles, parameters_text

SCRIPTS = Path(__file__).resolve().parent
ROOT = SCRIPTS.parent
MOST_BODIES = 4  # side by side, if none were asked for


class Part:
    """A table of the study, and what belongs to it.

    name     of the part, "" if there is no other one
    charts   {name without ending: SVG file}
    """

    def __init__(self, files, several):
        self.files, self.study = files, files.read()
        self.name = (files.part or "study") if several else ""
        self.title = files.title()
        self.charts = {}

    def heading(self):
        """HTML above what belongs to this part, if there are others."""
        return f"<h3>{escape(self.title)}</h3>\n" if self.name else ""


def find_parts(place):
    if (place / "results.csv").is_file():
        tables = [place]
    elif place.is_dir() and any(place.glob("*.prm")):
        tables = [part.baseline for part in parts_of(place) if part.baseline.is_file()]
    else:
        tables = []
    if not tables:
        known = sorted({file.parent.name for file in place.parent.glob("*/*.prm")})
        raise Failed(f"{place}: neither results.csv nor a parameter file with its baseline"
                     + (f"; studies there are {', '.join(known)}" if known else ""))
    return [Part(StudyFiles(table), len(tables) > 1) for table in tables]


def run_script(name, *arguments):
    # As a program: its first line names the Python that has what it needs.
    result = subprocess.run([SCRIPTS / name, *arguments], capture_output=True, text=True)
    if result.returncode != 0:
        raise Failed(result.stderr.strip())


def draw_charts(part, scratch):
    """All charts that there are for such a study, in a folder below SCRATCH."""
    folder = scratch / f"charts_{part.name}"
    folder.mkdir()
    shutil.copyfile(part.files.table, folder / "results.csv")

    def draw(script, needed=None):
        try:
            if needed:
                needed()
        except BadTable:
            return
        run_script(script, folder, "--title", part.title)

    draw("failure_map.py", lambda: Loads(part.study))
    draw("work_precision.py", lambda: probe_with_error(part.study))
    draw("chart.py")
    part.charts = {file.stem: file for file in sorted(folder.glob("*.svg"))}


def chart_caption(name):
    words = name.replace("_", " ").replace("poisson", "Poisson")
    return words[0].upper() + words[1:]


def charts_html(part, left_out):
    """The charts of a part but those that the README shows."""
    text = ""
    for name, file in part.charts.items():
        if part.files.prefix + name not in left_out:
            caption = chart_caption(name) + (f", {part.title}" if part.name else "")
            text += figure(inline_svg(file, f"{part.name}-{name}", caption), caption)
    return part.heading() + text if text else ""


def readme_section(readme, parts):
    """HTML of the README, and the names of the charts that it shows."""
    shown = set()

    def image(alt, source):
        name = Path(source).stem
        for part in parts:
            found = part.charts.get(name.removeprefix(part.files.prefix))
            if found and name.startswith(part.files.prefix):
                if name in shown:
                    return f"<p>{escape(alt)}: shown above.</p>"
                shown.add(name)
                return figure(inline_svg(found, f"readme-{name}", alt), alt)
        file = readme.parent / source
        if file.suffix == ".png" and file.is_file():
            return figure(inline_image(file, alt), alt)
        return f"<p>{escape(alt)} (<code>{escape(source)}</code>)</p>"

    return readme_html(readme.read_text(encoding="utf-8"), image), shown


def run_again(part, row, program, folder):
    """The run of ROW with its final state written; the folder of its results."""
    command = [program, part.files.parameters, "--output", folder, "--overwrite",
               "--set", "Output/VTU=final", "--set", "Study/Reference=",
               "--set", "Study/Reference check="]
    for name in part.study.parameters:
        command += ["--set", f"{name}={row[name]}"]
    result = subprocess.run(command, stdin=subprocess.DEVNULL, capture_output=True, text=True,
                            env=dict(os.environ, OMP_NUM_THREADS="1"))
    if result.returncode not in (0, 2):
        raise Failed(f"{part.files.parameters}: exit code {result.returncode}: "
                     f"{result.stderr.strip()}")
    return folder


def state_of(part, row, options, scratch):
    """The .pvd file of a run."""
    if part.files.table.name == "results.csv":
        file = part.files.folder / (row.get("folder") or "") / "solution.pvd"
        if not file.is_file():
            raise Failed(f"{file}: missing, no picture of {part.study.label(row)}; the study needs "
                         "Output/VTU = final")
        return file
    if not options.isochor.is_file():
        raise Failed(f"{options.isochor}: no such program, which pictures need; name it by --isochor")
    folder = scratch / f"run_{part.name}_{part.study.runs.index(row)}"
    return run_again(part, row, options.isochor.resolve(), folder) / "solution.pvd"


def wanted_rows(parts, wanted):
    """Pairs of part and runs for the settings WANTED; if empty, those whose states are on disk."""
    rows = [(part, []) for part in parts]
    for text in wanted:
        name, colon, settings = text.partition(":")
        chosen = [entry for entry in rows if colon and entry[0].name == name.strip()]
        if not chosen and len(parts) > 1:
            raise BadTable(f"--picture '{text}': begin with the part, PART: SETTINGS; there are "
                           f"{', '.join(part.name for part in parts)}")
        part, found = chosen[0] if chosen else rows[0]
        found.append(part.study.find(settings if chosen else text))
    if not wanted:
        for part, found in rows:
            found += rows_on_disk(part)
    return [(part, found) for part, found in rows if found]


def rows_on_disk(part):
    """A run of each method on the last problem of the study."""
    def has_state(row):
        return (part.files.folder / (row.get("folder") or "") / "solution.pvd").is_file()

    if part.files.table.name != "results.csv":
        return []
    rows = [row for row in part.study.runs if not failed(row) and has_state(row)]
    scene = [name for name in part.study.varied if not name.startswith("Method/")]
    return [row for row in rows if all(row[n] == rows[-1][n] for n in scene)][:MOST_BODIES]


def pictures_html(part, rows, options, scratch):
    states = [state_of(part, row, options, scratch) for row in rows]
    labels = [part.study.label(row) or "the run" for row in rows]
    file = scratch / f"picture_{part.name}.png"
    run_script("picture.py", "-o", file, *(f"--label={label}" for label in labels), *states)
    caption = f"Deformed and, in grey, at rest, coloured by von Mises stress: {'; '.join(labels)}"
    return part.heading() + figure(inline_image(file, caption), caption)


def parameters_html(part):
    text = parameters_text(part.files.parameters)
    heading = f"<h3>{escape(part.files.parameters.name)}</h3>\n" if part.name else ""
    return (heading + f'<pre tabindex="0">{escape(text.strip())}</pre>\n' if text else
            f"<p>{escape(part.files.parameters.name)} is missing.</p>\n")


def commit():
    """Of this program's sources, or None outside a repository."""
    result = subprocess.run(["git", "-C", ROOT, "describe", "--always", "--dirty=, changed",
                             "--abbrev=12", "--exclude=*"], capture_output=True, text=True)
    return result.stdout.strip() if result.returncode == 0 else None


def versions_html(parts, options):
    lines = [f"Report made on {datetime.date.today()} on {processor()}."]
    if found := commit():
        lines.append(f"Commit of the sources: {found}.")
    results = [part.files.table for part in parts if part.files.table.name == "results.csv"]
    lines += [f"Results written on {datetime.date.fromtimestamp(file.stat().st_mtime)}."
              for file in results]
    text = "".join(f"<p>{escape(line)}</p>\n" for line in lines)
    if not options.isochor.is_file():
        return text + f"<p>No program {escape(options.isochor.name)} is there to tell its version.</p>\n"
    told = subprocess.run([options.isochor, "--version"], capture_output=True, text=True).stdout
    return text + f'<p>The program now:</p>\n<pre tabindex="0">{escape(told.strip())}</pre>\n'


def report(place, options, scratch):
    """The page."""
    parts = find_parts(place)
    # First what can be wrong.
    pictures = [pictures_html(part, rows, options, scratch)
                for part, rows in wanted_rows(parts, options.picture)]
    for part in parts:
        draw_charts(part, scratch)
    readme, study, shown = place / "README.md", "", set()
    title = parts[0].title if not parts[0].name else place.absolute().name.replace("_", " ")
    if readme.is_file():
        title = readme_title(readme.read_text(encoding="utf-8")) or title
        study, shown = readme_section(readme, parts)
    sections = {"Study": study, "Pictures": "".join(pictures),
                "Charts": "".join(charts_html(part, shown) for part in parts),
                "Runs": "".join(part.heading() + runs_table(part.study) for part in parts),
                "Parameters": "".join(map(parameters_html, parts)),
                "Versions": versions_html(parts, options)}
    return page(options.title or title,
                [(name.lower(), name, text) for name, text in sections.items() if text])


def main():
    parser = argparse.ArgumentParser(description="A report of a study, one HTML file.")
    parser.add_argument("place", metavar="NAME_OR_FOLDER",
                        help="a study of convergence/, or a folder with results")
    parser.add_argument("-o", "--output", required=True, type=Path, help="the .html to write")
    parser.add_argument("--picture", action="append", default=[], metavar="SETTINGS",
                        help="of the run with [PART:] Key = value; ...; may be repeated")
    parser.add_argument("--title", help="default: that of README.md or of the study")
    parser.add_argument("--isochor", type=Path, default=ROOT / "build" / "release" / "isochor",
                        help="the program, for pictures and its version "
                             "(default: build/release/isochor)")
    options = parser.parse_args()
    place = Path(options.place)
    if not place.is_dir() and len(place.parts) == 1:
        place = ROOT / "convergence" / place
    try:
        with tempfile.TemporaryDirectory() as scratch:
            text = report(place, options, Path(scratch))
        options.output.write_text(text, encoding="utf-8")
    except (BadTable, Failed, OSError) as error:
        sys.exit(f"report.py: error: {error}")
    print(options.output)


if __name__ == "__main__":
    main()
