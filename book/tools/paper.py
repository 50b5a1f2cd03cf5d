"""The pages of the built book as paper and e-readers show them: no scripts, folds open, solutions at the end.

Both `book.tools.pdf` and `book.tools.epub` begin with `read_sheets`, so the two show the same text.
"""

from __future__ import annotations

import posixpath
import re
from dataclasses import dataclass, field
from html import escape
from typing import TYPE_CHECKING

import yaml
from bs4 import BeautifulSoup, Tag

if TYPE_CHECKING:
    from collections.abc import Iterator
    from pathlib import Path

ARTICLE = re.compile(r'<article class="bd-article">(.*?)</article>', re.DOTALL)
SCRIPT = re.compile(r"<script\b.*?</script>", re.DOTALL)
SVG_EDGE = re.compile(r"<svg\b|</svg>")
ID_IN_SVG = re.compile(r'(\sid="|\saria-labelledby="|url\(#|href="#)')
UNUSED = (
    ".rosmini-moving, .headerlink, .toctree-wrapper, .larger, #pause-films, label[for=pause-films], input[type=range]"
)
LONG_CODE = 45
"""Code and output of more lines may break between two pages: it would leave too much of a page empty."""
LONG_TABLE = 15
SOLUTIONS = "Solutions"
TITLE = "rosmini: learn ROS by driving a robot"


@dataclass
class Sheet:
    """A chapter, or the solutions to its exercises."""

    key: str
    """The beginning of each of its ids; also the id of the whole."""
    part: str
    title: str
    body: str
    sections: list[tuple[str, str]] = field(default_factory=list)
    """The id and the title of each section."""


@dataclass(frozen=True)
class Paper:
    """A book to be printed or packed."""

    sheets: list[Sheet]
    styles: str
    """The rules of the style elements that were in the pages."""

    def parts(self) -> Iterator[tuple[str, list[Sheet]]]:
        """Yield the parts in order, each with its sheets."""
        for part in dict.fromkeys(sheet.part for sheet in self.sheets):
            yield part, [sheet for sheet in self.sheets if sheet.part == part]


def listed_pages(checkout: Path) -> dict[str, str]:
    """Return the pages of `book/_toc.yml` in order, each with the caption of its part."""
    toc = yaml.safe_load((checkout / "book" / "_toc.yml").read_text(encoding="utf-8"))
    pages = {toc["root"]: ""}
    number = 0
    for part in toc.get("parts", ()):
        number += bool(part.get("numbered"))
        caption = f"{number}. {part['caption']}" if part.get("numbered") else part["caption"]
        pages |= {chapter["file"]: caption for chapter in part["chapters"]}
    return pages


def read_sheets(site: Path, pages: dict[str, str]) -> Paper:
    """Read the built pages (a page's name: the caption of its part), followed by the solutions of their exercises."""
    keys = {name: f"c{number}" for number, name in enumerate(pages)}
    chapters: list[Sheet] = []
    answers: list[Sheet] = []
    styles: dict[str, None] = {}
    for name, part in pages.items():
        html = SCRIPT.sub("", (site / f"{name}.html").read_text(encoding="utf-8"))
        article = ARTICLE.search(html)
        body, drawings = _cut_drawings(article[1] if article else "")
        soup = BeautifulSoup(body, "html.parser")
        for style in soup.find_all("style"):
            styles[style.extract().get_text()] = None
        _make_still(soup, name)
        _prefix(soup, name, keys)
        key = keys[name]
        solved = _move_solutions(soup, key)
        _open_folds(soup)
        _let_break(soup)
        sheet = Sheet(key, part, _heading(soup.h1), "", _sections(soup))
        sheet.body = _paste_drawings(soup.decode(), drawings, key)
        chapters.append(sheet)
        if solved:
            title = f"Solutions to {sheet.title}"
            text = f"<h1>{escape(title)}</h1>" + _paste_drawings("".join(solved), drawings, key)
            answers.append(Sheet(f"s{key[1:]}", SOLUTIONS, title, text))
    return Paper([*chapters, *answers], "\n".join(styles))


def _cut_drawings(html: str) -> tuple[str, list[str]]:
    """Replace each SVG by a placeholder: HTML's parser would write its names in small letters."""
    drawings: list[str] = []
    rest: list[str] = []
    depth = start = end = 0
    for edge in SVG_EDGE.finditer(html):
        depth += 1 if edge[0] == "<svg" else -1
        if depth == 1 and edge[0] == "<svg":
            start = edge.start()
            rest.append(html[end:start])
        elif depth == 0:
            end = edge.end()
            rest.append(f"<svg data-drawing={len(drawings)}></svg>")
            drawings.append(html[start:end])
    return "".join([*rest, html[end:]]), drawings


def _paste_drawings(html: str, drawings: list[str], key: str) -> str:
    def drawing(found: re.Match[str]) -> str:
        return ID_IN_SVG.sub(rf"\g<1>{key}-", drawings[int(found[1])])

    return re.sub(r'<svg data-drawing="(\d+)"></svg>', drawing, html)


def _make_still(soup: BeautifulSoup, name: str) -> None:
    """Leave the still picture of each moving one, with a line that says where it moves; turn forms into text."""
    for moving in soup.select(".rosmini-moving"):
        note = soup.new_tag("p", attrs={"class": "moves"})
        note.string = f"This is a still. It moves in the HTML book: {name}.html"
        moving.insert_after(note)
    for unused in soup.select(UNUSED):
        unused.decompose()
    for form in soup.select("input, select, button, label, fieldset"):
        chosen = form.select("option[selected]") or form.select("option")[:1] if form.name == "select" else []
        value = chosen[0].get_text() if chosen else str(form.get("value", ""))
        if form.get("type") in {"checkbox", "radio"}:
            value = "\u2611 " if form.has_attr("checked") else "\u2610 "
        if form.name in {"input", "select"}:
            form.string = value
        form.attrs = {"class": f"form-{form.name}"}
        form.name = "div" if form.name == "fieldset" else "span"


def _prefix(soup: BeautifulSoup, name: str, keys: dict[str, str]) -> None:
    """Make each id unique in the book, and let links lead to pages and sections of the book."""
    key = keys[name]
    for tag in soup.select("[id]"):
        tag["id"] = f"{key}-{tag['id']}"
    for link in soup.select("a[href]"):
        address, _, place = str(link["href"]).partition("#")
        if re.match(r"[a-z]+:", address):
            continue
        page = posixpath.normpath(posixpath.join(posixpath.dirname(name), address)).removesuffix(".html")
        target = keys.get(page) if address else key
        if target is None:
            del link["href"]
        else:
            link["href"] = f"#{target}-{place}" if place else f"#{target}"
    for image in soup.select("img[src]"):
        if not str(image["src"]).startswith("data:"):
            image["src"] = posixpath.normpath(posixpath.join(posixpath.dirname(name), str(image["src"])))


def _move_solutions(soup: BeautifulSoup, key: str) -> list[str]:
    """Take the solutions out, leaving links; return each below the heading of its exercise."""
    solved = []
    found = [
        fold for fold in soup.find_all("details") if fold.summary and fold.summary.get_text(strip=True) == "Solution"
    ]
    for number, fold in enumerate(found, start=1):
        label = f"{key}-solution-{number}"
        heading = fold.find_previous(["h2", "h3", "h4"])
        section = heading.parent if heading else None
        back = str(section.get("id", "")) if section else ""
        link = f'<p class="to-solution"><a href="#{label}">Solution</a></p>'
        fold.replace_with(BeautifulSoup(link, "html.parser"))
        if fold.summary:
            fold.summary.decompose()
        title = f'<h2 id="{label}"><a href="#{back or key}">{escape(_heading(heading))}</a></h2>'
        _open_folds(fold)
        _let_break(fold)
        solved.append(title + fold.decode_contents())
    return solved


def _open_folds(soup: Tag) -> None:
    """Show what folds contain, below their summaries; a fold of code has no summary of its own."""
    for fold in soup.find_all("details"):
        summary = fold.summary
        if summary and summary.select(".admonition-title"):
            summary.decompose()
            fold.unwrap()
            continue
        if summary:
            summary.name = "p"
            summary["class"] = "fold-title"
        fold.name = "div"
        fold.attrs = {"class": "fold"}


def _let_break(soup: Tag) -> None:
    """Let long code and long tables break between pages; the style sheet keeps the others whole."""
    for block in soup.find_all(["pre", "table"]):
        if block.get_text().count("\n") > LONG_CODE if block.name == "pre" else len(block.find_all("tr")) > LONG_TABLE:
            block["style"] = "break-inside: auto"


def _heading(tag: Tag | None) -> str:
    """Return the words of a heading; a chapter's number has no full stop after it."""
    return re.sub(r"^(\d+\.\d+)\.", r"\1", " ".join(tag.get_text().split())) if tag else ""


def _sections(soup: BeautifulSoup) -> list[tuple[str, str]]:
    return [(str(h2.parent["id"]), _heading(h2)) for h2 in soup.find_all("h2") if h2.parent and h2.parent.get("id")]


def contents(paper: Paper) -> Iterator[tuple[int, str, str]]:
    """Yield the entries of the contents: level (0 for a part), id of the target and title."""
    for part, sheets in paper.parts():
        if part:
            yield 0, sheets[0].key, part
        for sheet in sheets:
            yield 1, sheet.key, sheet.title
            yield from ((2, label, title) for label, title in sheet.sections)
