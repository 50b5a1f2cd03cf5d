"""One PDF of the book: its pages in one document, printed by Chromium or Chrome.

Chromium prints MathML and the pictures as the HTML book shows them, numbers the pages, writes chapters' titles above
them and makes the outline. It cannot print the number of the page that a link leads to, so the document is printed
again with the numbers read from the first PDF.
"""

from __future__ import annotations

import base64
import os
import re
import subprocess
import sys
import tempfile
from html import escape
from pathlib import Path
from typing import TYPE_CHECKING

from pygments.formatters import HtmlFormatter

from .build import BookError, find_chromium
from .cover import ALT, draw_cover
from .paper import SOLUTIONS, TITLE, contents

if TYPE_CHECKING:
    from .paper import Paper, Sheet

MOST_PRINTS = 4
NUMBER = re.compile(r'(?<=<b data-page=")([^"]+)">[^<]*')


def make_pdf(site: Path, paper: Paper, output: Path, *, size: str = "a4") -> Path:
    """Print the sheets to the file `output`; `site` is the folder of the built book, which has the pictures.

    Raises `BookError` if there is no Chromium or it prints nothing.
    """
    chromium = find_chromium()
    html = document(site, paper, size)
    numbers: dict[str, int] = {}
    with tempfile.TemporaryDirectory() as folder:
        source = Path(folder, "book.html")
        for _ in range(MOST_PRINTS):
            source.write_text(fill_numbers(html, numbers), encoding="utf-8", newline="\n")
            _print(chromium, source, output)
            before, numbers = numbers, page_numbers(output.read_bytes())
            if numbers == before:
                break
    return output


def fill_numbers(html: str, numbers: dict[str, int]) -> str:
    """Write the numbers of pages into the contents and behind the links to solutions; 000 where none is known."""
    return NUMBER.sub(lambda found: f'{found[1]}">{numbers.get(found[1], "000")}', html)


def document(site: Path, paper: Paper, size: str) -> str:
    """Return the book as one HTML document for paper of a `size` that CSS knows, with 000 for each page's number."""
    code = HtmlFormatter(style="a11y-high-contrast-light").get_style_defs(".highlight")
    lines = [_line(*entry) for entry in contents(paper)]
    parts = [_part(name, sheets) for name, sheets in paper.parts()]
    running = [_running(sheet.key, sheet.title) for sheet in paper.sheets if sheet.part != SOLUTIONS]
    cover = base64.b64encode(draw_cover(site / "_static", "svg")).decode()
    style = "\n".join([code, paper.styles, f"@page {{ size: {size}; }}", *running, _running("solutions", SOLUTIONS)])
    return (
        '<!DOCTYPE html><html lang="en"><head><meta charset="utf-8"><title>'
        f"{TITLE}</title>"
        f'<base href="{site.resolve().as_uri()}/"><link rel="stylesheet" href="_static/rosmini.css">'
        '<link rel="stylesheet" href="_static/paper.css">'
        f'<link rel="stylesheet" href="_static/pdf.css"><style>{style}</style></head><body>'
        f'<section id="title"><img alt="{ALT}" src="data:image/svg+xml;base64,{cover}"></section>'
        f'<section id="contents"><h1>Contents</h1>{"".join(lines)}</section>{"".join(parts)}</body></html>'
    )


def page_numbers(pdf: bytes) -> dict[str, int]:
    """Return the page (from 1) of each target of a link in a PDF that Chromium printed."""
    pages = sorted(int(number) for number in re.findall(rb"(?m)^(\d+) 0 obj\n<</Type /Page\n", pdf))
    place = {number: index for index, number in enumerate(pages, start=1)}
    targets = re.findall(rb"/([\w.-]+) \[(\d+) 0 R /XYZ", pdf)
    return {name.decode(): place[int(number)] for name, number in targets}


def _line(level: int, key: str, title: str) -> str:
    number = f'<i></i><b data-page="{key}">000</b>' if level else ""
    return f'<div class="level-{level}"><a href="#{key}">{escape(title)}</a>{number}</div>'


def _part(name: str, sheets: list[Sheet]) -> str:
    """Return the chapters of a part, with headings a level deeper: the part's name is the first."""
    parts = []
    for place, sheet in enumerate(sheets):
        body = re.sub(r"(</?h)([1-5])", lambda found: f"{found[1]}{int(found[2]) + (name != '')}", sheet.body)
        body = re.sub(
            r'(class="to-solution"><a href="#([^"]+)">Solution</a>)', r'\1, page <b data-page="\2">000</b>', body
        )
        title = f'<h1 class="part">{escape(name)}</h1>' if name and not place else ""
        parts.append(f'<section class="chapter" id="{sheet.key}">{title}{body}</section>')
    text = "".join(parts)
    return f'<section id="solutions" class="solutions">{text}</section>' if name == SOLUTIONS else text


def _running(key: str, title: str) -> str:
    """Return the rules that write a title at the top of the pages of an element."""
    words = title.replace("\\", r"\\").replace('"', r"\"").replace("<", r"\3c ")
    return f'@page {key} {{ @top-left {{ content: "{words}"; font: 9pt sans-serif; }} }} #{key} {{ page: {key}; }}'


def _print(chromium: str, source: Path, output: Path) -> None:
    output.unlink(missing_ok=True)
    with tempfile.TemporaryDirectory() as profile:
        command = [
            chromium, "--headless", "--disable-gpu", "--no-first-run", "--disable-background-networking",
            "--disable-component-update", "--disable-sync", f"--user-data-dir={profile}", "--no-pdf-header-footer",
            "--generate-pdf-document-outline", f"--print-to-pdf={output}", source.as_uri(),
        ]  # fmt: skip
        if sys.platform == "linux" and os.geteuid() == 0:
            command.insert(1, "--no-sandbox")  # root has no sandbox there
        done = subprocess.run(command, check=False, capture_output=True, encoding="utf-8", errors="replace")
    if not output.is_file():
        raise BookError(f"{chromium} printed no PDF (status {done.returncode}): {done.stderr[-1000:].strip()}")
