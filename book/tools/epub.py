"""The book as an EPUB 3 file: one XHTML file for each chapter, drawings inline, no scripts.

Sphinx has a builder for EPUB. It is not used: it would read the book a second time, write the raw HTML of notebooks as
it is, which is not XML, and pack the theme's scripts.
"""

from __future__ import annotations

import base64
import hashlib
import re
import uuid
import zipfile
from datetime import UTC, datetime
from html import escape
from pathlib import PurePosixPath
from typing import TYPE_CHECKING

from pygments.formatters import HtmlFormatter

from .cover import ALT, draw_cover
from .paper import TITLE, contents

if TYPE_CHECKING:
    from pathlib import Path

    from .paper import Paper

TYPES = {".png": "image/png", ".jpg": "image/jpeg", ".gif": "image/gif", ".svg": "image/svg+xml"}
VARIABLE = re.compile(r"var\((--[\w-]+)(?:,\s*((?:[^()]|\([^()]*\))*))?\)")
SOURCE = re.compile(r'(<img\b[^>]*?\ssrc=")([^"]+)')
ID = re.compile(r'\sid="([^"]+)"')
CONTAINER = """<?xml version="1.0" encoding="UTF-8"?>
<container version="1.0" xmlns="urn:oasis:names:tc:opendocument:xmlns:container"><rootfiles>
<rootfile full-path="EPUB/package.opf" media-type="application/oebps-package+xml"/></rootfiles></container>
"""
PACKAGE = """<?xml version="1.0" encoding="UTF-8"?>
<package xmlns="http://www.idpf.org/2007/opf" version="3.0" unique-identifier="id" xml:lang="en-GB">
<metadata xmlns:dc="http://purl.org/dc/elements/1.1/"><dc:identifier id="id">urn:uuid:%(id)s</dc:identifier>
<dc:title>%(title)s</dc:title><dc:language>en-GB</dc:language><dc:creator>The rosmini developers</dc:creator>
<meta property="dcterms:modified">%(time)s</meta><meta name="cover" content="f-cover-png"/></metadata>
<manifest>%(manifest)s</manifest><spine>%(spine)s</spine></package>
"""
COVER = f'<section id="cover" epub:type="cover"><img src="cover.png" alt="{ALT}"/></section>'
PAGE = """<?xml version="1.0" encoding="UTF-8"?>
<!DOCTYPE html>
<html xmlns="http://www.w3.org/1999/xhtml" xmlns:epub="http://www.idpf.org/2007/ops" lang="en-GB" xml:lang="en-GB">
<head><title>%(title)s</title><link rel="stylesheet" href="book.css"/></head>
<body>%(body)s</body></html>
"""


def make_epub(site: Path, paper: Paper, output: Path) -> Path:
    """Pack the sheets into the file `output`; `site` is the folder of the built book, which has the pictures."""
    files = {
        "cover.png": draw_cover(site / "_static", "png"),
        "cover.xhtml": (PAGE % {"title": TITLE, "body": COVER}).encode(),
    }

    def picture(found: re.Match[str]) -> str:
        start, _, data = found[2].partition(";base64,")
        content = base64.b64decode(data) if data else (site / found[2]).read_bytes()
        suffix = f".{start.partition('/')[2].partition('+')[0]}" if data else PurePosixPath(found[2]).suffix
        name = f"{hashlib.sha256(content).hexdigest()[:16]}{suffix.replace('jpeg', 'jpg')}"
        files[name] = content
        return f"{found[1]}{name}"

    home = {name: sheet.key for sheet in paper.sheets for name in (sheet.key, *ID.findall(sheet.body))}
    for sheet in paper.sheets:
        body = resolve_variables(SOURCE.sub(picture, sheet.body))
        body = re.sub(r' (paint-order)="(\w+)"', r' style="\1:\2"', body)  # no attribute in EPUB's SVG
        body = re.sub(r'(?<=\shref=")#([^"]+)', lambda found: f"{home[found[1]]}.xhtml#{found[1]}", body)
        text = f'<section id="{sheet.key}">{body}</section>'
        files[f"{sheet.key}.xhtml"] = (PAGE % {"title": escape(sheet.title), "body": text}).encode()
    files["nav.xhtml"] = (PAGE % {"title": "Contents", "body": _navigation(paper, home)}).encode()
    code = HtmlFormatter(style="a11y-high-contrast-light").get_style_defs(".highlight")
    rules = (site / "_static" / "paper.css").read_text(encoding="utf-8")
    files["book.css"] = "\n".join([code, resolve_variables(paper.styles), rules]).encode()
    _pack(files, ["cover", "nav", *(sheet.key for sheet in paper.sheets)], output)
    return output


def resolve_variables(text: str) -> str:
    """Replace CSS variables by their values in the light theme: not every e-reader knows them."""

    def value(found: re.Match[str]) -> str:
        given = re.search(rf"{found[1]}:\s*([^;\"}}]+)", text)
        return found[2] or (given[1] if given else "inherit")

    while VARIABLE.search(text):
        text = VARIABLE.sub(value, text)
    return text


def _navigation(paper: Paper, home: dict[str, str]) -> str:
    """Return the contents as nested lists."""

    def listed(entries: list[tuple[int, str, str]]) -> str:
        top = min(level for level, _, _ in entries)
        items = []
        while entries:
            (_, key, title), *entries = entries
            below = []
            while entries and entries[0][0] > top:
                below.append(entries.pop(0))
            link = f'<a href="{home[key]}.xhtml#{key}">{escape(title)}</a>'
            items.append(f"<li>{link}{listed(below) if below else ''}</li>")
        return f"<ol>{''.join(items)}</ol>"

    entries = list(contents(paper))
    cover = [(0, key, title) for level, key, title in entries[:1]] + entries[1:]
    return f'<nav epub:type="toc" id="toc"><h1>Contents</h1>{listed(cover)}</nav>'


def _pack(files: dict[str, bytes], spine: list[str], output: Path) -> None:
    items = []
    for name, content in files.items():
        stem, _, suffix = name.rpartition(".")
        kind = TYPES.get(f".{suffix}") or {"css": "text/css", "xhtml": "application/xhtml+xml"}[suffix]
        marks = {"nav": stem == "nav", "svg": b"<svg" in content, "mathml": b"<math" in content}
        used = [mark for mark, is_set in marks.items() if is_set and suffix == "xhtml"]
        properties = "cover-image" if name == "cover.png" else " ".join(used)
        properties = f' properties="{properties}"' if properties else ""
        items.append(f'<item id="f-{stem}-{suffix}" href="{name}" media-type="{kind}"{properties}/>')
    digest = hashlib.sha256(b"".join(files.values())).hexdigest()
    package = PACKAGE % {
        "id": uuid.uuid5(uuid.NAMESPACE_OID, digest),
        "title": TITLE,
        "time": datetime.now(UTC).strftime("%Y-%m-%dT%H:%M:%SZ"),
        "manifest": "".join(items),
        "spine": "".join(f'<itemref idref="f-{name}-xhtml"/>' for name in spine),
    }
    with zipfile.ZipFile(output, "w", zipfile.ZIP_DEFLATED) as archive:
        archive.writestr("mimetype", "application/epub+zip", zipfile.ZIP_STORED)  # first, and as it is
        archive.writestr("META-INF/container.xml", CONTAINER)
        archive.writestr("EPUB/package.opf", package)
        for name, content in files.items():
            archive.writestr(f"EPUB/{name}", content)
