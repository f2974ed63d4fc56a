#!/usr/bin/env python3
"""Runs one test and compares what came out with what was expected.

  runner.py program PROGRAM STEM.output FOLDER   standard output of a test program
  runner.py prm     ISOCHOR STEM.output FOLDER   digest of results.csv of a parameter file
  runner.py bad     ISOCHOR STEM.output FOLDER   exit code and message of a refused run

The test runs in FOLDER, which is emptied first; "STEM.mpirun=N.output" runs on N ranks, others on
as many as --ranks says.

prm, bad: STEM.args, if there is one, holds arguments of isochor as a shell would split them;
  {here} is the folder of the test, {run} FOLDER. Without STEM.prm the arguments are all there
  is. Unless the arguments name an --output, the run writes to {run}/out.

prm: comment lines of the expected output say where its figures come from, and may set
    # exit: 2                        the exit code, 0 unless told
    # tolerance: 1e-3                numdiff's relative tolerance, 1e-6 unless told
    # columns: tip y [m] | status    the columns of the digest, in this order
  Without columns: all but times, memory and the counts of linear algebra, which machines and
  numbers of ranks may change.

bad: the first line is "exit CODE", the rest the message on standard error. The names of the
  two folders do not count.
"""

import argparse
import csv
import os
import re
import shlex
import shutil
import subprocess
import sys
from pathlib import Path

SEPARATORS = r" \t\n=,:;<>[](){}^"
UNSTABLE_COLUMN = re.compile(r"seconds|memory|factorisations|krylov|reason")


class Failure(Exception):
    pass


def run(command, folder, n_ranks, options):
    """The finished process; outputs are kept in FOLDER too."""
    environment = dict(os.environ, OMP_NUM_THREADS="1", OPENBLAS_NUM_THREADS="1",
                       DEAL_II_NUM_THREADS="1", LC_ALL="C")
    if n_ranks > 1:
        root = ["--allow-run-as-root"] if os.geteuid() == 0 else []
        command = [options.mpirun, "-q", *root, "--oversubscribe", "--bind-to", "none",
                   "-np", str(n_ranks), *command]
    with open(folder / "stdout", "w") as out, open(folder / "stderr", "w") as err:
        code = subprocess.run(command, cwd=folder, env=environment, stdin=subprocess.DEVNULL,
                              stdout=out, stderr=err).returncode
    return code, (folder / "stdout").read_text(), (folder / "stderr").read_text()


def fail_with_streams(reason, out, err):
    raise Failure(f"{reason}\n--- standard output\n{out}\n--- standard error\n{err}")


def expected_exit(found, wanted, out, err):
    if found != wanted:
        fail_with_streams(f"exit code {found}, expected {wanted}", out, err)


def compare(found, expected, tolerance, options):
    """By numdiff: a figure passes if its absolute or its relative error is small."""
    result = subprocess.run([options.numdiff, "-a", "1e-9", "-r", tolerance, "-s", SEPARATORS,
                             expected, found], capture_output=True, text=True)
    if result.returncode != 0:
        raise Failure(f"< {expected}\n> {found}\n{result.stdout}{result.stderr}"
                      f"--- found\n{found.read_text()}")


def strip_comments(expected, folder):
    stripped = folder / "expected"
    lines = expected.read_text().splitlines(keepends=True)
    stripped.write_text("".join(line for line in lines if not line.startswith("#")))
    return stripped


def settings(expected):
    pattern = re.compile(r"# (exit|tolerance|columns): (.*)")
    matches = map(pattern.fullmatch, expected.read_text().splitlines())
    return {match[1]: match[2].strip() for match in matches if match}


def digest(file, columns):
    with open(file, newline="") as stream:
        rows = list(csv.DictReader(stream))
    text = ""
    for number, row in enumerate(rows, 1):
        names = columns or [name for name in row if not UNSTABLE_COLUMN.search(name)]
        missing = [name for name in names if name not in row]
        if missing:
            raise Failure(f"{file} has no column {missing}; it has {list(row)}")
        text += f"row {number}\n" + "".join(f"  {name} = {row[name]}\n" for name in names)
    return text


def isochor_command(program, stem, folder):
    parameters, arguments = Path(f"{stem}.prm"), Path(f"{stem}.args")
    command = [program] + ([str(parameters)] if parameters.exists() else [])
    if arguments.exists():
        command += [word.format(here=stem.parent, run=folder)
                    for word in shlex.split(arguments.read_text(), comments=True)]
    if not any(word.startswith("--output") for word in command):
        command += ["--output", str(folder / "out")]
    return command


def test_program(options, stem, expected, folder, n_ranks):
    code, out, err = run([options.program], folder, n_ranks, options)
    expected_exit(code, 0, out, err)
    if not expected.exists():
        fail_with_streams(f"{expected} is missing", out, err)
    compare(folder / "stdout", expected, "1e-6", options)


def test_prm(options, stem, expected, folder, n_ranks):
    code, out, err = run(isochor_command(options.program, stem, folder), folder, n_ranks, options)
    told = settings(expected) if expected.exists() else {}
    expected_exit(code, int(told.get("exit", 0)), out, err)
    columns = [name.strip() for name in told.get("columns", "").split("|") if name.strip()]
    found = folder / "digest"
    found.write_text(digest(folder / "out" / "results.csv", columns))
    if not expected.exists():
        raise Failure(f"{expected} is missing; the digest is\n{found.read_text()}")
    compare(found, strip_comments(expected, folder), told.get("tolerance", "1e-6"), options)


def test_bad(options, stem, expected, folder, n_ranks):
    code, out, err = run(isochor_command(options.program, stem, folder), folder, n_ranks, options)
    for place in (folder, stem.parent):
        err = err.replace(f"{place}/", "").replace(str(place), ".")
    if n_ranks > 1:  # mpirun's own words about the exit code, framed by dashes
        err = re.sub(r"^-{20,}\n.*?^-{20,}\n", "", err, flags=re.DOTALL | re.MULTILINE)
    lines = [line.rstrip() for line in f"exit {code}\n{err}".splitlines() if line.strip()]
    wanted = [line.rstrip() for line in expected.read_text().splitlines() if line.strip()]
    if lines != wanted:
        raise Failure("\n".join(["--- expected", *wanted, "--- found", *lines]))


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--numdiff", default="numdiff")
    parser.add_argument("--mpirun", default="mpirun")
    parser.add_argument("--ranks", type=int, default=1)
    parser.add_argument("kind", choices=["program", "prm", "bad"])
    parser.add_argument("program")
    parser.add_argument("expected", type=Path)
    parser.add_argument("folder", type=Path)
    options = parser.parse_args()

    expected = options.expected.absolute()
    match = re.fullmatch(r"(.*?)(?:\.mpirun=(\d+))?\.output", str(expected))
    if not match:
        parser.error(f"{expected} does not end in .output")
    folder = options.folder.absolute()
    shutil.rmtree(folder, ignore_errors=True)
    folder.mkdir(parents=True)
    test = {"program": test_program, "prm": test_prm, "bad": test_bad}[options.kind]
    try:
        test(options, Path(match[1]), expected, folder, int(match[2] or options.ranks))
    except Failure as failure:
        sys.exit(f"FAILED\n{failure}")


if __name__ == "__main__":
    main()
