"""The table of a study: the rows of results.csv, and what their columns mean."""

import csv
import math
import re
from collections import namedtuple

FIRST_COST, LAST_COST, AFTER_PROBES = "cells", "peak memory MB", "volume ratio"
NEEDED = [FIRST_COST, "unknowns", "seconds total", LAST_COST, AFTER_PROBES, "status", "role"]
POISSON = "Scene/Poisson ratio"
UNITS = {"Mesh size": "m", "Young's modulus": "Pa", "Density": "kg/m³", "Poisson ratio": ""}

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

    def numeric_parameters(self):
        """Varied settings of the scene that are numbers."""
        return [name for name in self.varied if not name.startswith("Method/")
                and all(number(row[name]) is not None for row in self.runs)]


def failed(row):
    return not row["status"].startswith("converged")


def short(parameter):
    return parameter.split("/")[-1]


def groups(rows, key):
    """The rows by key(row), in order of appearance."""
    found = {}
    for row in rows:
        found.setdefault(key(row), []).append(row)
    return found


def setting(row, parameter):
    name = "ν" if parameter == POISSON else short(parameter)
    return f"{name} = {row[parameter]}" + (f" {UNITS[short(parameter)]}".rstrip()
                                           if short(parameter) in UNITS else "")
