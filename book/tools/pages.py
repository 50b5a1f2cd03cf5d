"""What a built page may not contain: anything fetched from elsewhere, anything that a reader cannot perceive."""

from __future__ import annotations

import json
import re
from html.parser import HTMLParser
from typing import TYPE_CHECKING

from rosmini.viz.embed import LIVE, MESHCAT

if TYPE_CHECKING:
    from collections.abc import Iterator
    from pathlib import Path

# Where an element names something that the browser fetches by itself (a link in the text is followed by the reader).
FETCHED = {
    "script": ("src",),
    "link": ("href",),
    "img": ("src", "srcset"),
    "iframe": ("src",),
    "source": ("src", "srcset"),
    "video": ("src", "poster"),
    "audio": ("src",),
    "track": ("src",),
    "embed": ("src",),
    "object": ("data",),
    "image": ("href", "xlink:href"),
    "use": ("href", "xlink:href"),
}
# `rel` values of links that name a page and fetch nothing.
NAMING = {"canonical", "next", "prev", "author", "license", "alternate", "index", "search"}
ELSEWHERE = re.compile(r"^\s*(?:[a-z][a-z0-9+.-]*:)?//", re.IGNORECASE)
IN_STYLE = re.compile(r"(?:url\(|@import)\s*[\"']?\s*((?:https?:)?//[^\"')\s]+)", re.IGNORECASE)
VIEWER_CALL = "globalThis.rosminiMeshcat.mount("
"""What a page says once for each three-dimensional picture."""
MOST_VIEWERS = 6
"""Browsers draw only about eight WebGL pictures at a time: each one more takes the place of the oldest."""
IN_SCRIPT = re.compile(r"\b(?:import\s*\(?|from|fetch\(|importScripts\(|require\()\s*[\"'](https?://[^\"']+)")
# What other scripts have no use for, whatever the address.
ASKING = re.compile(r"\b(fetch\(|XMLHttpRequest|WebSocket|EventSource|sendBeacon|importScripts|import\(|connect\()")
ADDRESS = re.compile(r"(?:https?|wss?)://[^\s\"'`)]+")
ASKS = {
    "run-worker.js": ("https://cdn.jsdelivr.net/npm/pyodide@0.29.5/", "https://cdn.jsdelivr.net/pyodide/v0.29.5/full/")
}
"""The one script that asks for something, after the reader has pressed a button, and the two folders of Pyodide (its
own files, and its packages) that it asks."""
OWN = {"pictures.js", "progress.js", "run.js", "run-worker.js"}
"""The scripts of `book/static`."""
# The names of XML's vocabularies look like addresses; nothing is fetched from there.
NAMESPACES = {"http://www.w3.org/1999/xhtml", "http://www.w3.org/2000/svg"}
# Where meshcat's viewer looks for its server when somebody calls its `connect`, which our scripts may not.
UNUSED = {"ws://${location.host}"}
SHARED_SCRIPTS = re.compile(r"const ready = (\[[^\]]*\])\.reduce")


class Page(HTMLParser):
    """Reads one page and gathers what is wrong with it in `problems`."""

    def __init__(self) -> None:
        super().__init__()
        self.problems: list[str] = []
        self.within = ""
        self.pictures: list[dict[str, str]] = []
        self.viewers = 0
        self.ids: set[str] = set()

    def handle_starttag(self, tag: str, attrs: list[tuple[str, str | None]]) -> None:
        """Look at one element."""
        given = {name: value or "" for name, value in attrs}
        self.within = tag if tag in {"script", "style"} else self.within
        if given.get("id") in self.ids:
            self.problems.append(f"an id twice: {given['id']} ({tag})")
        self.ids.update(filter(None, [given.get("id")]))
        self._look_for_fetches(tag, given)
        said = given.get("alt", "").strip().replace(given.get("src", ""), "")  # docutils fills in the address
        if tag == "img" and not said and given.get("aria-hidden") != "true":
            self.problems.append(f"an image without a text: {given.get('src', '')[:80]}")
        if tag == "iframe" and not given.get("title", "").strip():
            self.problems.append(f"a frame without a title: {given.get('src', 'srcdoc')[:80]}")
        if tag == "svg":
            self.pictures.append(given)
        elif tag == "title" and self.pictures:
            self.pictures[-1]["title"] = "yes"
        self.problems += [f"a local address in {tag} {name}" for name, value in given.items() if "127.0.0.1" in value]

    def handle_endtag(self, tag: str) -> None:
        """Leave an element; a picture has to have a text by then."""
        if tag == self.within:
            self.within = ""
        if tag == "svg" and self.pictures:
            given = self.pictures.pop()
            named = given.get("aria-label", "").strip() or given.get("aria-labelledby") or given.get("title")
            if not self.pictures and not named and given.get("aria-hidden") != "true":
                self.problems.append(f"a drawing without a text: svg {given.get('class', '')}".rstrip())

    def handle_data(self, data: str) -> None:
        """Look at text, styles and scripts."""
        if "127.0.0.1" in data:
            self.problems.append(f"a local address in the text: {_around(data, '127.0.0.1')}")
        if self.within == "style":
            self.problems += [f"a style from elsewhere: {url}" for url in IN_STYLE.findall(data)]
        if self.within == "script":
            self.viewers += data.count(VIEWER_CALL)
            if LIVE in data:
                self.problems.append("a moving picture in its live form: store it with `notebooks execute`")
            self.problems += [f"a script from elsewhere: {url}" for url in IN_SCRIPT.findall(data)]

    def _look_for_fetches(self, tag: str, given: dict[str, str]) -> None:
        if tag == "link" and set(given.get("rel", "").split()) & NAMING:
            return
        for name in FETCHED.get(tag, ()):
            if ELSEWHERE.match(given.get(name, "")):
                self.problems.append(f"{tag} {name} from elsewhere: {given[name]}")
        self.problems += [f"a style from elsewhere: {url}" for url in IN_STYLE.findall(given.get("style", ""))]
        if given.get("srcdoc"):
            inner = Page()
            inner.feed(given["srcdoc"])
            self.problems += [f"in a frame: {problem}" for problem in inner.problems]


def script_problems(text: str, *, ours: bool = True, asks: tuple[str, ...] | None = None) -> list[str]:
    """What a script may not contain; one that is not `ours` may have code that never runs, and one may ask `asks`."""
    harmless = NAMESPACES if ours else NAMESPACES | UNUSED
    found = (address for address in ADDRESS.findall(text) if asks is None or not address.startswith(asks))
    problems = [f"names {address}" for address in found if address not in harmless]
    if "127.0.0.1" in text or "//localhost" in text:
        problems.append("names this machine")
    if ours and asks is None:
        problems += [f"uses {asking.rstrip('(')}" for asking in ASKING.findall(text)]
    return problems


def _missing_scripts(page: str, static: Path) -> Iterator[str]:
    """Scripts that a page's moving pictures load and that are not there."""
    names = {name for found in SHARED_SCRIPTS.findall(page) for name in json.loads(found)}
    if VIEWER_CALL in page:
        names.add(MESHCAT)
    yield from (f"loads {name}, which is not in _static" for name in sorted(names) if not (static / name).is_file())


def _around(text: str, found: str) -> str:
    at = text.index(found)
    return " ".join(text[max(0, at - 30) : at + 40].split())


def page_problems(html: str) -> list[str]:
    """What is wrong with one page of HTML, one line each."""
    page = Page()
    page.feed(html)
    page.close()
    if page.viewers > MOST_VIEWERS:
        page.problems.append(f"{page.viewers} three-dimensional pictures, over {MOST_VIEWERS}")
    return page.problems


def site_problems(site: Path) -> Iterator[str]:
    """What is wrong with the pages, style sheets and scripts below `site`, one line each, beginning with the file."""
    for path in sorted(site.rglob("*.html")):
        if "_static" not in path.relative_to(site).parts:
            text = path.read_text(encoding="utf-8")
            problems = [*page_problems(text), *_missing_scripts(text, site / "_static")]
            yield from (f"{path.relative_to(site).as_posix()}: {problem}" for problem in problems)
    for path in sorted((site / "_static").glob("*.js")):
        if path.name == MESHCAT or path.name in OWN or path.name.startswith("rosmini"):
            text = path.read_text(encoding="utf-8")
            problems = script_problems(text, ours=path.name != MESHCAT, asks=ASKS.get(path.name))
            yield from (f"{path.relative_to(site).as_posix()}: {problem}" for problem in problems)
    for path in sorted(site.rglob("*.css")):
        text = path.read_text(encoding="utf-8")
        yield from (f"{path.relative_to(site).as_posix()}: fetches {url}" for url in IN_STYLE.findall(text))
