"""Where a study's table, parameters and charts are: in the folder that isochor wrote, or beside the
baseline of a study of convergence/."""

import re
from pathlib import Path

from results_table import Study

TITLE = re.compile(r"^subsection Study$(?:(?!^end$).)*?^ *set Title *= *([^#\n]*?) *(?:#.*)?$",
                   re.MULTILINE | re.DOTALL)
INCLUDE = re.compile(r"^ *include +(\S+).*$", re.MULTILINE)


def parameters_text(file, depth=9):
    """The text of a parameter file with what it includes in place; empty if there is none."""
    if not file.is_file() or not depth:
        return ""
    text = file.read_text(encoding="utf-8", errors="replace")
    return INCLUDE.sub(lambda match: parameters_text(file.parent / match[1], depth - 1), text)


class StudyFiles:
    """Of a folder with results.csv, or of a table such as baseline_tube.csv, whose study is tube.prm.

    table        the .csv
    parameters   the .prm, which may be missing
    folder       where charts go
    prefix       what their names begin with: a folder of baselines may have several studies
    """

    def __init__(self, place):
        place = Path(place)
        is_table = place.suffix == ".csv"
        self.table = place if is_table else place / "results.csv"
        self.folder = self.table.parent
        part = re.fullmatch(r"baseline(?:_(.*))?", place.stem) if is_table else None
        self.part = part[1] if part else None
        self.prefix = f"{self.part}_" if self.part else ""
        self.parameters = self.folder / (f"{self.part or 'study'}.prm" if part else "parameters.prm")

    def read(self):
        return Study(self.table)

    def title(self):
        """The one that the parameters give, or a name."""
        titles = TITLE.findall(parameters_text(self.parameters))  # the last one counts
        name = self.part or self.folder.absolute().name
        return titles[-1] if titles and titles[-1] else name.replace("_", " ").capitalize()

    def blamed(self, error):
        """The text of ERROR, with the table's name if it does not say it itself."""
        text = str(error)
        return text if text.startswith(str(self.table)) else f"{self.table}: {text}"
