"""Moving pictures: a still picture, data, and a script that replaces the still picture.

The script is a file of `rosmini/viz/static/` that defines a function `mount(host, data, options)`:

- `host` is an empty element of the page, as wide as the text and at least `height` pixels high;
- `data` is the JSON from Python (bytes as base64);
- `options` has `title`, `alt`, `height`, `book` (true on a page of the book), `asset(name)`, a promise of the URL
  of another file, `still`, the element of the still picture, and `show(moving)`, which shows `host` or `still`.

The value that it returns is awaited. If it fails or returns `false`, the still picture is shown again. Where scripts
do not run (GitHub, an untrusted notebook, a page without its `_static` folder), readers see the still picture, and
it is printed.

In the book form the scripts are files of the book, loaded once per page, also from file:// URLs. In the live form
they are part of the HTML, large ones compressed. The data are never compressed: another version of zlib produces
other bytes, and nbval compares the book form byte by byte.
"""

from __future__ import annotations

import base64
import gzip
import hashlib
import json
import os
import re
from abc import abstractmethod
from collections.abc import Mapping, Sequence
from functools import cache
from importlib.util import find_spec
from pathlib import Path
from typing import Any, ClassVar

from rosmini.core.errors import nearest
from rosmini.viz.svg import element, escape
from rosmini.viz.view import SVG_MIME, View, ViewError

STATIC = Path(__file__).parent / "static"
MESHCAT = "meshcat.min.js"
"""The meshcat viewer: a file of meshcat's wheel, copied into the book at build time and never committed."""

LIVE = "const book = false"
"""Text that occurs in the live form and not in the book form."""

_CALL = re.compile(r"[A-Za-z_]\w*(\.[A-Za-z_]\w*)*")


def embed(
    script_names: Sequence[str],
    call: str,
    data: Mapping[str, Any],
    *,
    title: str,
    alt: str,
    height: int,
    fallback_html: str,
    caption: str | None = None,
    assets: Sequence[str] = (),
    book: bool | None = None,
) -> str:
    """Return the HTML of a moving picture; the same input gives the same bytes.

    Args:
        script_names: scripts of `rosmini/viz/static/`, run in this order before the call.
        call: the JavaScript function that shows the data, as seen from the global object: `"rosminiReplay.mount"`.
        data: the data to show, as JSON; bytes become base64.
        title: a name of a few words; `options.title` of the call.
        alt: a description in one or two sentences; `options.alt` of the call.
        height: the minimum height of the element that the script fills [CSS px].
        fallback_html: the still picture, including its own text.
        caption: the caption below the picture.
        assets: further files that the script may ask for with `options.asset(name)`.
        book: True for the book form, False for the live form; by default `book_form()`.

    Raises:
        ViewError: a script does not exist, the call is not a name, or the title, alt text or still picture is empty.

    """
    for what, given in (("a title", title), ("alt text", alt), ("a still picture", fallback_html)):
        if not given.strip():
            raise ViewError(f"a moving picture needs {what}")
    if not _CALL.fullmatch(call):
        raise ViewError(f"{call!r} is not the name of a function: give one such as 'rosminiReplay.mount'")
    for name in (*script_names, *assets):
        asset_path(name)
    text = _script_json(data)
    options = {"title": title, "alt": alt, "height": height}
    mark = hashlib.sha256(f"{call}{options}{text}".encode()).hexdigest()[:12]
    form = _book if (book_form() if book is None else book) else _live
    script = _MOUNT % {"mark": mark, "call": call, "options": _script_json(options)}
    body = (
        element("div", fallback_html, class_="rosmini-still")
        + f'<div class="rosmini-moving" style="min-height:{height}px" hidden></div>'
        + f'<script type="application/json">{text}</script>'
        + (element("figcaption", escape(caption)) if caption else "")
        + f"<script>(() => {{{form(script_names, assets)}{script}}})();</script>"
    )
    return element(
        "figure",
        f"<style>{_PRINT}</style>{body}",
        class_="rosmini-figure",
        role="group",
        aria_label=title,
        data_rosmini=mark,
        style="margin:0.5em 0;overflow-x:auto",
    )


def asset_path(name: str) -> Path:
    """Return the path of a script that pages may load.

    Raises:
        ViewError: no script has this name, or meshcat is not installed.

    """
    if name == MESHCAT:
        found = find_spec("meshcat")
        if found is None or found.origin is None:
            raise ViewError("3D pictures need meshcat, which is not installed here: `pip install meshcat`")
        return Path(found.origin).parent / "viewer" / "dist" / "main.min.js"
    path = STATIC / name
    if "/" in name or not path.is_file():
        names = [MESHCAT, *(file.name for file in STATIC.iterdir())]
        raise ViewError(f"no script {name!r} in rosmini/viz/static. {nearest(name, names) or ''}".rstrip())
    return path


def _script_json(data: Mapping[str, Any]) -> str:
    """Return JSON that cannot end a script element."""
    text = json.dumps(data, separators=(",", ":"), ensure_ascii=False, allow_nan=False, default=_base64)
    return text.replace("<", "\\u003c").replace("\u2028", "\\u2028").replace("\u2029", "\\u2029")


def _base64(value: object) -> str:
    if isinstance(value, bytes | bytearray | memoryview):
        return base64.b64encode(value).decode()
    raise TypeError(f"a {type(value).__name__} in the data of a picture: give numbers, text, lists, dicts or bytes")


def _book(script_names: Sequence[str], assets: Sequence[str]) -> str:
    """Return the code that loads the scripts on a page of the book: each once, in order."""
    del assets  # assets are files beside the scripts, so the page can load them itself
    return _FROM_BOOK % json.dumps(list(script_names))


def _live(script_names: Sequence[str], assets: Sequence[str]) -> str:
    """Return the scripts themselves, for an output that must work alone."""
    scripts = "".join(f"(() => {{{asset_path(name).read_text(encoding='utf-8')}\n}})();" for name in script_names)
    if "</script" in scripts.lower():
        raise ViewError(f"one of the scripts {', '.join(script_names)} contains the end of a script element")
    return _ALONE % {"scripts": scripts, "unpacking": unpacking(assets)}


def unpacking(assets: Sequence[str]) -> str:
    """Return a script that contains the given files and defines `asset(name)`, a promise of a file's URL."""
    return _UNPACKING % json.dumps({name: _packed(name) for name in assets})


@cache
def _packed(name: str) -> str:
    return base64.b64encode(gzip.compress(asset_path(name).read_bytes(), mtime=0)).decode()


_PRINT = "@media print{.rosmini-still[hidden]{display:block!important}.rosmini-moving{display:none!important}}"

# `find` takes the first picture with this mark that has no script yet, so that two equal ones on a page both work.
_FROM_BOOK = """
const root = document.documentElement.dataset.content_root;
if (root === undefined) return;
const book = true, loaded = globalThis.rosminiLoaded ??= {};
const asset = async (name) => new URL(`${root}_static/${name}`, document.baseURI).href;
const load = (name) => loaded[name] ??= asset(name).then((address) => new Promise((resolve, reject) => {
  const script = document.createElement("script");
  script.onload = resolve;
  script.onerror = () => reject(new Error(`${address} was not loaded`));
  script.src = address;
  document.head.append(script);
}));
const ready = %s.reduce((before, name) => before.then(() => load(name)), Promise.resolve());
"""
_UNPACKING = """
const packed = %s;
const unpack = async (name) => {
  const bytes = Uint8Array.from(atob(packed[name]), (character) => character.charCodeAt(0));
  const stream = new Blob([bytes]).stream().pipeThrough(new DecompressionStream("gzip"));
  const text = await new Response(stream).arrayBuffer();
  return URL.createObjectURL(new Blob([text], {type: "text/javascript"}));
};
const addresses = globalThis.rosminiAddresses ??= {};
const asset = (name) => addresses[name] ??= unpack(name);
"""
_ALONE = """
%(scripts)s
const book = false;
%(unpacking)s
const ready = Promise.resolve();
"""
_MOUNT = """
const figure = document.querySelector('figure[data-rosmini="%(mark)s"]:not([data-mounted])');
if (!figure) return;
figure.dataset.mounted = "";
const [still, host] = [".rosmini-still", ".rosmini-moving"].map((name) => figure.querySelector(name));
const data = JSON.parse(figure.querySelector('script[type="application/json"]').textContent);
const show = (moving) => { still.hidden = moving; host.hidden = !moving; };
ready.then(() => {
  show(true);
  return globalThis.%(call)s(host, data, {...%(options)s, book, asset, still, show});
}).then((shown) => shown === false && show(false), (error) => { show(false); console.error(error); });
"""


# -- views that move ---------------------------------------------------------------------------------------------------


class MovingView(View):
    """A view with a still picture, data, and scripts of `rosmini/viz/static/` that show the data."""

    scripts: Sequence[str] = ()
    """Scripts that run in this order before the call."""
    assets: ClassVar[tuple[str, ...]] = ()
    """Further files that the scripts may ask for."""
    call: ClassVar[str]
    """The JavaScript function that shows the data, as seen from the global object."""
    usual_name: ClassVar[str] = ""
    """The name used without a title."""
    title: str | None = None
    """A caption, and the first words of the text form."""

    @property
    def name(self) -> str:
        """The name, in a few words."""
        return self.title or self.usual_name

    @property
    @abstractmethod
    def svg(self) -> str:
        """The still picture."""

    @property
    @abstractmethod
    def data(self) -> Mapping[str, Any]:
        """The data for the scripts, as JSON; bytes become base64."""

    @property
    @abstractmethod
    def height(self) -> int:
        """The minimum height of the moving picture, with its controls [CSS px]."""

    @property
    def fallback(self) -> str:
        """The HTML that a page shows without scripts and in print."""
        return self.svg

    def _images(self) -> dict[str, bytes]:
        return {} if page_form() else {SVG_MIME: self.svg.encode()}

    @property
    def html(self) -> str:
        """The moving picture: for the book or self-contained, according to `rosmini.viz.embed.book_form`."""
        return self._html(None)

    @property
    def page(self) -> str:
        """The moving picture with everything that it needs, for a separate file."""
        return self._html(book=False)

    def _html(self, book: bool | None) -> str:
        still = element("p", escape(self.alt)) if page_form() else self.fallback
        return embed(
            self.scripts, self.call, self.data, title=self.name, alt=self.alt, height=self.height,
            fallback_html=still, caption=self.title, assets=self.assets, book=book,
        )  # fmt: skip


# -- the book's form or the live form ----------------------------------------------------------------------------------

VARIABLE = "ROSMINI_DISPLAY"
BOOK = "book"
PAGE = "page"


def book_form() -> bool:
    """True if outputs are made for the book: the environment has `ROSMINI_DISPLAY=book` (or `page`).

    `python -m book.tools.notebooks execute` and the tests set it for the kernels that they start, so that committed
    outputs hold small HTML that refers to the book's scripts. Elsewhere a view's HTML contains its scripts.
    """
    return os.environ.get(VARIABLE) == BOOK or page_form()


def page_form() -> bool:
    """True on a page of the book that runs its own cells: `ROSMINI_DISPLAY=page`, set by `rosmini.notebook.page`.

    Its outputs have the form of the book, but live views are connected to their graph, and moving pictures have no
    still picture, which matplotlib would have to draw.
    """
    return os.environ.get(VARIABLE) == PAGE
