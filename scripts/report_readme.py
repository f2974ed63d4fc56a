"""A study's README.md as a part of a report: no link leads out of the page, images are in it."""

import html
import re

import markdown

from report_page import scroll_box

COMMENT = re.compile(r"<!--.*?-->\n?", re.DOTALL)
IMAGE = re.compile(r"!\[([^]]*)\]\(([^)\s]+)\)")
TITLE = re.compile(r"\A\s*# +(.*)\n")
LINK = re.compile(r"<a href=\"([^\"]*)\"[^>]*>(.*?)</a>", re.DOTALL)


def readme_title(text):
    match = TITLE.match(text)
    return match and match[1].strip()


def as_text(match):
    """A link as what it says and where it leads, for those who have the files or the net."""
    target, said = match.groups()
    plain = html.unescape(re.sub(r"<[^>]*>", "", said))
    if target.startswith("#") or html.unescape(target) == plain:
        return said
    return f"{said} (<code>{target}</code>)"


def in_order(text, first):
    """The headings of TEXT renumbered from FIRST on, none left out."""
    levels = sorted(set(re.findall(r"<h([1-6])>", text)))
    new = {level: min(first + i, 6) for i, level in enumerate(levels)}
    return re.sub(r"(</?h)([1-6])>", lambda match: f"{match[1]}{new[match[2]]}>", text)


def readme_html(text, image):
    """HTML of the Markdown TEXT without its title, below a heading of level 2; IMAGE(alt, source)
    gives the HTML of an image."""
    images = []

    def keep(match):
        images.append(match.groups())
        return f"\n\nimage-{len(images) - 1}-of-readme\n\n"

    text = IMAGE.sub(keep, COMMENT.sub("", TITLE.sub("", text)))
    converter = markdown.Markdown(extensions=["tables", "fenced_code", "sane_lists"])
    # HTML in it is shown, not obeyed.
    converter.preprocessors.deregister("html_block")
    converter.inlinePatterns.deregister("html")
    found = in_order(LINK.sub(as_text, converter.convert(text)), 3)
    found = re.sub(r"<table>.*?</table>", lambda match: scroll_box(match[0], "Table"), found,
                   flags=re.DOTALL)
    found = found.replace("<pre>", '<pre tabindex="0">').replace("<th>", '<th scope="col">')
    return re.sub(r"<p>image-(\d+)-of-readme</p>", lambda match: image(*images[int(match[1])]), found)
