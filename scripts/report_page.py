"""The pieces of a report: one HTML page that needs no other file."""

import base64
import html
import re
from pathlib import Path

from compare_results import RELATIVE
from results_table import failed, number, short
from study_tables import figure as digits

STYLE = Path(__file__).resolve().parent / "report.css"
FIRST = ["status"]       # columns that come right behind the settings
LAST = ["reason"]
HIDDEN = ["role", "folder"]
ID = re.compile(r"\bid=\"([^\"]+)\"")


def escape(text):
    return html.escape(str(text))


def page(title, sections):
    """SECTIONS: (id, heading, HTML)."""
    contents = "".join(f'<li><a href="#{name}">{escape(heading)}</a></li>\n'
                       for name, heading, _ in sections)
    body = "".join(f'<section id="{name}">\n<h2>{escape(heading)}</h2>\n{text}</section>\n'
                   for name, heading, text in sections)
    return ("<!DOCTYPE html>\n<html lang=\"en\">\n<head>\n<meta charset=\"utf-8\">\n"
            "<meta name=\"viewport\" content=\"width=device-width, initial-scale=1\">\n"
            f"<title>{escape(title)}</title>\n"
            # An icon of its own: a browser looks for one on the server otherwise.
            "<link rel=\"icon\" href=\"data:,\">\n"
            f"<style>\n{STYLE.read_text(encoding='utf-8')}</style>\n</head>\n<body>\n<main>\n"
            f"<h1>{escape(title)}</h1>\n<nav aria-label=\"Contents\">\n<ul>\n{contents}</ul>\n</nav>\n"
            f"{body}</main>\n</body>\n</html>\n")


def scroll_box(content, label):
    """In which CONTENT may be wider than the screen; reached by the keyboard."""
    return (f'<div class="scroll" tabindex="0" role="region" aria-label="{escape(label)}">\n'
            f"{content}\n</div>\n")


def figure(content, caption):
    return (f"<figure>\n{scroll_box(content, caption)}<figcaption>{escape(caption)}</figcaption>\n"
            "</figure>\n")


def inline_svg(file, name, label):
    """The chart in the SVG FILE; its ids get the prefix NAME, as those of several charts on one page
    must differ."""
    text = file.read_text(encoding="utf-8")
    text = text[text.index("<svg"):]
    text = re.sub(r"<metadata>.*?</metadata>|<!--.*?-->", "", text, flags=re.DOTALL)
    for identity in set(ID.findall(text)):
        text = re.sub(rf"(\bid=\"|href=\"#|url\(#){re.escape(identity)}(?=[\")])",
                      rf"\g<1>{name}-{identity}", text)
    head, rest = text.split(">", 1)
    head = re.sub(r"\s(width|height|version|xmlns(:\w+)?)=\"[^\"]*\"", "", head)
    return f'{head} role="img" aria-label="{escape(label)}">{rest.strip()}'


def inline_image(file, label):
    data = base64.b64encode(file.read_bytes()).decode()
    return f'<img alt="{escape(label)}" src="data:image/png;base64,{data}">'


def cell(column, text):
    """HTML of a figure, to the digits that a reader wants."""
    value = number(text)
    if value is None:
        return f"<td>{escape(text)}</td>"
    if RELATIVE.search(column):
        text = f"{100 * value:.3g} %"
    elif not re.fullmatch(r"-?\d+", text):
        text = digits(value, 5)
    return f'<td class="number">{text}</td>'


def runs_table(study):
    """All runs, and all columns in which there is something."""
    rows = study.runs + study.reference
    filled = [name for name in study.columns if any(row[name] for row in rows)]
    figures = [name for name in filled if name not in study.parameters + FIRST + LAST + HIDDEN]
    columns = [*FIRST, *figures, *(name for name in LAST if name in filled)]
    head = "".join(f'<th scope="col">{escape(short(name))}</th>' for name in study.parameters)
    for name in columns:
        marks = ' class="number"' if any(number(row[name]) is not None for row in rows) else ""
        head += f'<th scope="col"{marks}>{escape(name)}</th>'
    body = ""
    for row in rows:
        marks = ' class="failed"' if failed(row) else ""
        status = row["status"] + (", reference" if row["role"] == "reference" else "")
        # Settings as they were written, 0.50 and all.
        body += f"<tr{marks}>" + "".join(f"<td>{escape(row[name])}</td>"
                                         for name in study.parameters)
        body += f"<td>{escape(status)}</td>"
        body += "".join(cell(name, row[name]) for name in columns[len(FIRST):]) + "</tr>\n"
    return scroll_box(f'<table class="runs">\n<thead><tr>{head}</tr></thead>\n<tbody>\n{body}'
                      "</tbody>\n</table>", "All runs")
