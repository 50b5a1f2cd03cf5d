"""Pictures that move: a still picture, data, and a script that takes the still picture's place.

The script is a file of `rosmini/viz/static/` that defines a function `mount(host, data, options)`:

- `host` is an empty element of the page, as wide as the text and at least `height` pixels high;
- `data` is the JSON that Python gave (bytes are base64 in it);
- `options` has `title`, `alt`, `height`, `book` (whether the page is one of the book), `asset(name)`, a promise of the
  address of another file, `still`, the still picture's element, and `show(moving)`, which shows `host` or `still`.

What it returns is awaited. If it fails or returns `false`, the still picture comes back. Without scripts (GitHub, a
notebook that is not trusted, a page without its `_static` folder) the still picture is what one sees, and it is
printed.

In the book form the scripts are files of the book, loaded once for each page, from file:// too. In the live form
they are in the HTML, large ones compressed. The data never are: another zlib gives other bytes, and nbval compares
the book form to the byte.
"""

from __future__ import annotations

import base64
import gzip
import hashlib
import json
import re
from collections.abc import Mapping, Sequence
from functools import cache
from importlib.util import find_spec
from pathlib import Path
from typing import Any

from rosmini.core.errors import nearest
from rosmini.viz.book_form import book_form
from rosmini.viz.svg import element, escape
from rosmini.viz.view import ViewError

STATIC = Path(__file__).parent / "static"
MESHCAT = "meshcat.min.js"
"""The viewer of meshcat: a file of its wheel, copied into the book when it is built and never committed."""

LIVE = "const book = false"
"""What the live form holds and the book form does not."""

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
    """The HTML of a picture that moves: the same input gives the same bytes.

    Args:
        script_names: scripts of `rosmini/viz/static/`, run in this order before the call.
        call: the function that shows the data, seen from the global object: `"rosminiReplay.mount"`.
        data: what it shows, as JSON; bytes become base64.
        title: the name of the thing, in a few words; `options.title` of the call.
        alt: what it shows, in a sentence or two; `options.alt` of the call.
        height: the least height of the place that the script is given [CSS px].
        fallback_html: the still picture, with a text of its own.
        caption: words under the picture.
        assets: further files that the script may ask for with `options.asset(name)`.
        book: the book's form or the live form; by default as `book_form()` says.

    Raises:
        ViewError: there is no such script, the call is not a name, or the title, alt text or still picture is empty.

    """
    for what, given in (("a title", title), ("alt text", alt), ("a still picture", fallback_html)):
        if not given.strip():
            raise ViewError(f"a picture that moves needs {what}")
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
    """Where a script is that pages may load.

    Raises:
        ViewError: there is none of that name, or meshcat is not installed.

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
    """JSON that ends no script element."""
    text = json.dumps(data, separators=(",", ":"), ensure_ascii=False, allow_nan=False, default=_base64)
    return text.replace("<", "\\u003c").replace("\u2028", "\\u2028").replace("\u2029", "\\u2029")


def _base64(value: object) -> str:
    if isinstance(value, bytes | bytearray | memoryview):
        return base64.b64encode(value).decode()
    raise TypeError(
        f"a {type(value).__name__} in the data of a picture: give numbers, text, lists, dicts or bytes"
    )


def _book(script_names: Sequence[str], assets: Sequence[str]) -> str:
    """How a page of the book gets its scripts: each once, in order."""
    del assets  # all of them are files beside the scripts
    return _FROM_BOOK % json.dumps(list(script_names))


def _live(script_names: Sequence[str], assets: Sequence[str]) -> str:
    """How an output that stands alone gets its scripts: it brings them."""
    scripts = "".join(
        f"(() => {{{asset_path(name).read_text(encoding='utf-8')}\n}})();" for name in script_names
    )
    if "</script" in scripts.lower():
        raise ViewError(f"one of the scripts {', '.join(script_names)} holds the end of a script element")
    return _ALONE % {"scripts": scripts, "unpacking": unpacking(assets)}


def unpacking(assets: Sequence[str]) -> str:
    """A script with files in it that defines `asset(name)`, a promise of a file's address."""
    return _UNPACKING % json.dumps({name: _packed(name) for name in assets})


@cache
def _packed(name: str) -> str:
    return base64.b64encode(gzip.compress(asset_path(name).read_bytes(), mtime=0)).decode()


_PRINT = (
    "@media print{.rosmini-still[hidden]{display:block!important}.rosmini-moving{display:none!important}}"
)

# `find` takes the first picture of that mark that has no script yet: two equal ones on one page both work.
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
