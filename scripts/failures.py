"""How far a body can be loaded by each method at each Poisson ratio, from a study that varies one load
and the Poisson ratio: which runs failed, where and why."""

import re
from collections import namedtuple

from results_table import POISSON, RESOLUTION, UNITS, BadTable, number, short

NUMBER = r"[-+]?(?:\d+\.?\d*|\.\d+)(?:[eE][-+]?\d+)?"
TOKEN = re.compile(rf"{NUMBER}|\s+|\w+|.")

# What a reason begins with or holds (march/load_control.cc, march/limit_point.cc), in a word or
# two; the first that fits is the most telling.
CAUSES = [(r"limit point near load factor", "limit point"),
          (r"^singular tangent", "singular"),
          (r"^inverted cell", "inverted"),
          (r"^unstable \((\d+) negative pivots", "turns unstable, {}"),
          (r"", "no convergence")]

# word: why it is not stable, empty if it is. kind: "stable", "unstable" (an equilibrium, but one that
# the body would leave), "failed" or "refused". reached: the load, in the unit of Loads.amounts.
# least_j: of the last state; None if there is none.
Outcome = namedtuple("Outcome", "kind word amount reached seconds least_j")


def modes(count):
    return f"{count} mode" + ("" if int(count) == 1 else "s")


class Loads:
    """The values of the load that a study varies; of texts, the part that differs.

    parameter   "Scene/Pressure"
    amounts     number by text, smallest load first; from "inner: 4e3" 4000
    label       what an axis says, with its unit
    """

    def __init__(self, study):
        names = [name for name in study.varied
                 if not name.startswith("Method/") and name != POISSON]
        sizes = [name for name in names if name in RESOLUTION]
        if len(names) != 1 or sizes or POISSON not in study.varied:
            raise BadTable("a failure map needs a study that varies Poisson ratio and one load, and of "
                           f"the scene nothing else; this one varies {', '.join(study.varied)}")
        self.parameter = names[0]
        texts = list(dict.fromkeys(row[self.parameter] for row in study.runs))
        before, parts, after = split_common(texts)
        numbers = [re.search(NUMBER, part) for part in parts]
        if None in numbers:
            raise BadTable(f"{self.parameter}: {' and '.join(map(repr, texts[:2]))} do not differ in "
                           "a number")
        amounts = {text: float(match[0]) for text, match in zip(texts, numbers)}
        self.amounts = dict(sorted(amounts.items(), key=lambda item: abs(item[1])))
        name = short(self.parameter)
        place = re.sub(r"\*load\b", "", f"{before}…{after}").strip().removesuffix(": …")
        self.label = name + (f" ({place})" if place != "…" else "")
        self.label += f" [{UNITS[name]}]" if name in UNITS else ""


def split_common(texts):
    """What all TEXTS begin with, their parts in between, and what all end with; words and numbers are
    not cut."""
    tokens = [TOKEN.findall(text) for text in texts]
    shortest = min(map(len, tokens))

    def common(place):
        n = 0
        while n < shortest and len({line[place(n)] for line in tokens}) == 1:
            n += 1
        return n

    head = common(lambda n: n)
    tail = min(common(lambda n: -1 - n), shortest - head)
    parts = ["".join(line[head:len(line) - tail]) for line in tokens]
    end = len(tokens[0]) - tail
    return "".join(tokens[0][:head]), parts, "".join(tokens[0][end:])


def text_of(amount):
    """To three digits."""
    return f"{float(f'{amount:.3g}') + 0.:.10g}"  # no "-0"


def outcome(row, loads):
    """Of one run."""
    amount, status = loads.amounts[row[loads.parameter]], row["status"]
    reached = amount * (number(row["load factor"]) or 0.)
    figures = amount, reached, number(row["seconds total"]), number(row.get("min J"))
    if match := re.fullmatch(r"unstable \((\d+) modes?\)", status):
        return Outcome("unstable", f"unstable, {modes(match[1])}", *figures)
    if status in ("stable", "converged"):
        return Outcome("stable", "", *figures)
    if status != "not converged":
        return Outcome("refused" if status == "refused" else "failed", status, *figures)
    for pattern, word in CAUSES:
        if match := re.search(pattern, row["reason"]):
            word = word.format(*map(modes, match.groups()))
            return Outcome("failed", word, *figures)


def summary(outcomes):
    """How far the runs of one method at one Poisson ratio came, and why no further."""
    outcomes = sorted(outcomes, key=lambda found: abs(found.amount))
    trouble = next((found for found in outcomes if found.kind != "stable"), None)
    if trouble is None:
        return text_of(outcomes[-1].amount)
    if trouble.kind == "refused":
        return "refused"
    text = f"{text_of(trouble.reached)} {trouble.word}"
    borne = max((found.amount for found in outcomes[:outcomes.index(trouble)]), key=abs, default=0.)
    if abs(borne) > abs(trouble.reached):
        # Its steps were larger than those to the load before.
        text = f"{text_of(borne)}; {text} on the way to {text_of(trouble.amount)}"
    # Larger steps may jump over what stopped this run.
    farthest = max((found.reached for found in outcomes if found.kind == "failed"), key=abs,
                   default=0.)
    if abs(farthest) > 1.05 * max(abs(trouble.reached), abs(borne)):
        text += f"; {text_of(farthest)} in larger steps"
    beyond = [found for found in outcomes
              if found.kind == "stable" and abs(found.amount) > abs(trouble.amount)]
    return text + (f"; but stable at {text_of(beyond[-1].amount)}" if beyond else "")


def failures_rows(study):
    """The header and the rows of a table: a row per method, a column per Poisson ratio."""
    loads = Loads(study)
    ratios = sorted({row[POISSON] for row in study.runs}, key=float)
    rows = []
    for method in study.methods:
        line = [method]
        for ratio in ratios:
            found = [outcome(row, loads) for row in study.runs
                     if row[POISSON] == ratio and study.method(row) == method]
            line.append(summary(found) if found else "-")
        rows.append(line)
    return [loads.label, *(f"ν = {ratio}" for ratio in ratios)], rows
