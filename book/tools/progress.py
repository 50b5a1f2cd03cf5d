"""The directive `progress-list`: the pages of the book and their exercises, each with a box for the reader to tick.

`book/static/progress.js` keeps the ticks in the reader's browser, and ticks a page when its end was reached.
"""

from __future__ import annotations

import re
from html import escape
from pathlib import Path
from typing import TYPE_CHECKING

from docutils import nodes
from sphinx import addnodes
from sphinx.util.docutils import SphinxDirective

from book.tools import notebooks, solutions

if TYPE_CHECKING:
    from collections.abc import Iterator

    from sphinx.application import Sphinx

ABOUT = "About the book"
"""The part for reference, which is not listed."""
HEADING = re.compile(r"^### (Exercise \d+: .+)$", re.MULTILINE)


class progress_list(nodes.General, nodes.Element):  # noqa: N801  (docutils names nodes like this)
    """Where the list will be when all pages are read."""


class ProgressList(SphinxDirective):
    """The list of all pages with their exercises."""

    def run(self) -> list[nodes.Node]:
        """Return the place for it."""
        return [progress_list()]


def exercises(path: Path) -> dict[str, str]:
    """The headings of a notebook's exercises, by the name that `check` knows; none if the page is no notebook."""
    if not path.name.endswith(".ipynb"):
        return {}
    notebook = notebooks.read(path)
    texts = (cell.source for cell in notebook.cells if cell.cell_type == "markdown")
    headings = [heading for text in texts for heading in HEADING.findall(text)]
    return dict(zip(solutions.checks(notebook), headings, strict=True))


def fill(app: Sphinx, document: nodes.document, docname: str) -> None:
    """Put the list into the place of the directive."""
    for place in list(document.findall(progress_list)):
        place.replace_self(nodes.raw("", "\n".join(listed(app, docname)), format="html"))


def listed(app: Sphinx, docname: str) -> Iterator[str]:
    """The lines of the list as HTML, a heading and a list for each part."""
    for part in app.env.get_doctree(app.config.root_doc).findall(addnodes.toctree):
        if part.get("caption") == ABOUT:
            continue
        yield f'<h2>{escape(part["caption"])}</h2>\n<ul class="progress-list">'
        for _, page in part["entries"]:
            title, address = escape(app.env.titles[page].astext()), app.builder.get_relative_uri(docname, page)
            yield f'<li>{box("pages", page, f"Read: {title}")} <a href="{address}">{title}</a>'
            if found := exercises(Path(app.env.doc2path(page))):
                yield "<ul>"
                for name, heading in found.items():
                    text = escape(heading.replace("`", ""))
                    yield f"<li><label>{box('exercises', name)} {text}</label></li>"
                yield "</ul>"
            yield "</li>"
        yield "</ul>"


def box(kind: str, name: str, label: str = "") -> str:
    """A box to tick for a page or an exercise."""
    said = f' aria-label="{label}"' if label else ""
    return f'<input type="checkbox" data-{kind}="{escape(name)}"{said} />'


def setup(app: Sphinx) -> None:
    """Register it with Sphinx."""
    app.add_node(progress_list)
    app.add_directive("progress-list", ProgressList)
    app.connect("doctree-resolved", fill)
