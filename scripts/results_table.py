"""The table of a study: the rows of results.csv, and what their columns mean."""

import csv
import math
import re
from collections import namedtuple

FIRST_COST, LAST_COST, AFTER_PROBES = "cells", "peak memory MB", "volume ratio"
NEEDED = [FIRST_COST, "unknowns", "seconds total", LAST_COST, AFTER_PROBES, "status", "role"]
POISSON = "Scene/Poisson ratio"
# Parameters that change the discretisation, not the problem.
RESOLUTION = ["Scene/Mesh size", "Scene/Cells"]
UNITS = {"Mesh size": "m", "Young's modulus": "Pa", "Density": "kg/m³", "Poisson ratio": "",
         "Pressure": "Pa", "Traction": "Pa", "Gravity": "m/s²", "Body force": "N/m³",
         "Prescribed displacement": "m", "Prescribed rotation": "°"}

Probe = namedtuple("Probe", "column name unit error uncertainty")


class BadTable(Exception):
    pass


def number(text):
    """The number in TEXT, or None if there is none."""
    try:
        value = float(text)
    except (TypeError, ValueError):
        return None
    return value if math.isfinite(value) else None


class Study:
    """The rows of results.csv, and what their columns mean.

    runs, reference   rows, dictionaries of text by column
    probes            the measured figures
    varied            parameters that take more than one value in the runs
    methods           names of the methods, in order of appearance
    """

    def __init__(self, file):
        try:
            with open(file, newline="", encoding="utf-8") as stream:
                reader = csv.DictReader(stream, strict=True)
                self.columns = list(reader.fieldnames or [])
                rows = list(reader)
        except (OSError, UnicodeDecodeError, csv.Error) as error:
            raise BadTable(f"{file}: cannot be read: {getattr(error, 'strerror', error) or error}")
        missing = [name for name in NEEDED if name not in self.columns]
        if missing:
            raise BadTable(f"{file}: no column named {', '.join(map(repr, missing))}; "
                           "this is not a results.csv of isochor")
        if not rows:
            raise BadTable(f"{file}: holds no run")
        for line, row in enumerate(rows, 2):
            if None in row or None in row.values():
                raise BadTable(f"{file}: row {line} has not as many fields as the header")
        self.parameters = self.columns[:self.columns.index(FIRST_COST)]
        self.probes = self.find_probes()
        self.reference = [row for row in rows if row["role"] == "reference"]
        self.runs = [row for row in rows if row["role"] != "reference"]
        self.varied = [name for name in self.parameters
                       if len({row[name] for row in self.runs}) > 1]
        self.methods = list(dict.fromkeys(map(self.method, self.runs)))

    def find_probes(self):
        probes = []
        begin, end = self.columns.index(LAST_COST) + 1, self.columns.index(AFTER_PROBES)
        for column in self.columns[begin:end]:
            if re.search(r" (error|reference uncertainty)$", column):
                continue
            name, unit = re.fullmatch(r"(.*?)(?: \[(.*)\])?", column).groups()
            error, uncertainty = (
                next((c for c in (f"{column} {what}", f"{name} {what}") if c in self.columns), None)
                for what in ("error", "reference uncertainty"))
            probes.append(Probe(column, name, unit or "", error, uncertainty))
        return probes

    def method(self, row):
        """What the legend calls a run's method: all varied settings of the method."""
        names = [n for n in self.parameters if n.startswith("Method/")]
        several = [n for n in names if len({r[n] for r in self.runs}) > 1] or names[:1]
        return ", ".join(row[n] for n in several) or "run"

    def label(self, row):
        """What a picture calls a run: all that varies, the method first."""
        return ", ".join(row[n] if n.startswith("Method/") else setting(row, n)
                         for n in sorted(self.varied))

    def find(self, wanted):
        """The one run with the settings "Element = P1; Poisson ratio = 0.4999"."""
        rows = self.runs
        for assignment in filter(None, map(str.strip, wanted.split(";"))):
            key, _, value = map(str.strip, assignment.partition("="))
            names = [n for n in self.parameters if key in (n, short(n))]
            if len(names) != 1:
                raise BadTable(f"'{assignment}': the study varies {', '.join(self.parameters)}")
            rows = [row for row in rows if row[names[0]] == value]
        if len(rows) != 1:
            raise BadTable(f"'{wanted}' are the settings of {len(rows)} runs, not of one")
        return rows[0]

    def probe(self, name):
        """The probe NAME (without its unit)."""
        found = [probe for probe in self.probes if probe.name == name]
        if not found:
            raise BadTable(f"no probe is named '{name}'; there are "
                           f"{', '.join(probe.name for probe in self.probes) or 'none'}")
        return found[0]

    def resolution(self):
        """The one varied parameter that refines the mesh."""
        names = [name for name in self.varied if name in RESOLUTION]
        if len(names) != 1:
            raise BadTable("orders need a study that varies Mesh size or Cells, one of them")
        return names[0]

    def orders(self, probe):
        """Convergence of PROBE: (settings, [(size as text, error, order)]) for each group of runs
        that differ in size only, coarse to fine; the order is that since the size before, None
        for the first or beside a failed run. The error is that against the study's reference, or,
        without one, the probe itself, as of an error norm."""
        parameter = self.resolution()
        others = [name for name in self.varied if name != parameter]
        found = []
        for settings, rows in groups(self.runs, lambda row: tuple(row[n] for n in others)).items():
            line, before = [], None
            for row in sorted(rows, key=lambda row: -size_of(row[parameter])):
                text = row[probe.error] if probe.error and row[probe.error] else row[probe.column]
                error = None if failed(row) else number(text)
                error = abs(error) if error else None
                here = (size_of(row[parameter]), error) if error else None
                order = (math.log(before[1] / error) / math.log(before[0] / here[0])
                         if before and here else None)
                line.append((row[parameter], error, order))
                before = here
            found.append((dict(zip(others, settings)), line))
        return found

    def numeric_parameters(self):
        """Varied settings of the scene that are numbers."""
        return [name for name in self.varied if not name.startswith("Method/")
                and all(number(row[name]) is not None for row in self.runs)]


def failed(row):
    return not row["status"].startswith(("stable", "unstable", "converged"))


def size_of(text):
    """A number in proportion to the cells' size: a Mesh size, or Cells such as "8, 8"."""
    return float(text) if "," not in text else 1 / float(text.split(",")[0])


def short(parameter):
    return parameter.split("/")[-1]


def slug(text):
    """TEXT as a part of a file's name."""
    return re.sub(r"[^a-z0-9]+", "_", text.lower()).strip("_")


def groups(rows, key):
    """The rows by key(row), in order of appearance."""
    found = {}
    for row in rows:
        found.setdefault(key(row), []).append(row)
    return found


def scene_baselines(folder):
    """(scene, file) of each baseline_SCENE.csv of FOLDER."""
    files = sorted(folder.glob("baseline_*.csv"))
    if not files:
        raise BadTable(f"{folder}: holds no baseline_SCENE.csv")
    return [(file.stem.removeprefix("baseline_"), file) for file in files]


def setting(row, parameter):
    name = "ν" if parameter == POISSON else short(parameter)
    return f"{name} = {row[parameter]}" + (f" {UNITS[short(parameter)]}".rstrip()
                                           if short(parameter) in UNITS else "")
