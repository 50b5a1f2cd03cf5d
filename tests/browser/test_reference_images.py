"""Every kind of picture against its reference image: nbval compares SVG texts, which say nothing of how they look.

`ROSMINI_WRITE_REFERENCES=1 pytest -n0 tests/browser/test_reference_images.py` writes them again; look at what changed.

A reference has the cells of two screenshots, one below the other: shapes without words, where no font has a say and
hardly anything may differ, and all of it, with the words in the one font that comes with matplotlib.
"""

from __future__ import annotations

import base64
import os
from pathlib import Path

import matplotlib as mpl
import numpy as np
import pytest
from PIL import Image

from rosmini.viz import style
from rosmini.viz.embed import STATIC

from .kinds import KINDS
from .perception import cells, difference, why

pytestmark = pytest.mark.browser

REFERENCES = Path(__file__).parent / "references"
WRITE = os.environ.get("ROSMINI_WRITE_REFERENCES") == "1"
SHAPES, WORDS = 1.5, 18.0
"""How much a block of the two screenshots may differ, of 255."""

ALSO = ("world", "plot", "graph", "own_figure")
"""What is looked at in dark and on paper, too."""
CASES = [(kind, "light") for kind in KINDS] + [(kind, theme) for theme in ("dark", "print") for kind in ALSO]

FONT = base64.b64encode((Path(mpl.get_data_path()) / "fonts/ttf/DejaVuSans.ttf").read_bytes()).decode()
SHEET = (STATIC / "rosmini.css").read_text(encoding="utf-8") + (
    f"@font-face {{font-family: Reference; src: url(data:font/ttf;base64,{FONT})}}"
    "body, .rosmini-figure > svg {margin: 0 !important} * {font-family: Reference !important}"
    "html[data-theme=dark] {background: #14181e}"
    ".wordless :is(text, figcaption) {visibility: hidden}"
)

PARTS = "figure svg :is(path, line, rect, ellipse, circle, polygon, polyline, image):not(defs *)"
LABELS = "figure :is(svg text, figcaption)"

# Where only a part of a picture has changed, Chromium draws that part alone, and the edges of its curves a little
# otherwise than in a whole: so all of it goes away and comes back.
AFRESH = """async () => {
  const frame = () => new Promise(requestAnimationFrame);
  for (const display of ["none", ""]) {
    document.body.style.display = display;
    await frame();
    await frame();
  }
}"""


@pytest.fixture(scope="module")
def pictures():
    """Each kind's HTML, made once."""
    made = {}
    return lambda kind: made.setdefault(kind, KINDS[kind]().html)


class Shown:
    """A picture in a page."""

    def __init__(self, page, html: str, theme: str) -> None:
        self.page = page
        page.emulate_media(media="print" if theme == "print" else "screen")
        page.set_content(
            f'<!DOCTYPE html><html data-theme="{"dark" if theme == "dark" else "light"}">'
            f"<head><style>{SHEET}</style></head><body>{html}</body></html>"
        )
        page.evaluate("document.fonts.load('12px Reference').then(() => document.fonts.ready).then(() => true)")

    def shapes(self):
        """The cells of a screenshot without words."""
        self.page.evaluate("document.body.classList.add('wordless')")
        seen = self.words()
        self.page.evaluate("document.body.classList.remove('wordless')")
        return seen

    def words(self):
        """The cells of a screenshot."""
        self.page.evaluate(AFRESH)
        return cells(self.page.locator("figure").first.screenshot())

    def change(self, css: str):
        """Add rules; what is returned takes them away again."""
        sheet = self.page.evaluate_handle(
            """(css) => {
              const sheet = document.createElement("style");
              sheet.textContent = css;
              return document.head.appendChild(sheet);
            }""",
            css,
        )
        return lambda: sheet.evaluate("(sheet) => sheet.remove()")


@pytest.fixture(scope="module")
def show(tabs, pictures):
    with tabs.open({"width": 700, "height": 700}) as (page, _):
        yield lambda kind, theme="light": Shown(page, pictures(kind), theme)


def read(path: Path):
    with Image.open(path) as image:
        both = np.asarray(image.convert("RGB"), dtype=np.float64)
    return np.split(both, 2)


@pytest.mark.parametrize(("kind", "theme"), CASES, ids=lambda part: part)
def test_it_looks_as_it_did(show, kind, theme):
    path = REFERENCES / f"{kind}-{theme}.png"
    shown = show(kind, theme)
    seen = shown.shapes(), shown.words()
    if WRITE:
        REFERENCES.mkdir(exist_ok=True)
        Image.fromarray(np.rint(np.vstack(seen)).astype(np.uint8)).save(path, optimize=True)
    assert path.is_file(), f"no reference {path.name}; the docstring of this file says how one is made"
    shapes, words = read(path)
    assert why(seen[0], shapes, SHAPES) is None
    assert why(seen[1], words, WORDS) is None


each_kind = pytest.mark.parametrize("kind", KINDS)


def test_each_reference_is_of_a_picture():
    assert {path.stem for path in REFERENCES.iterdir()} == {f"{kind}-{theme}" for kind, theme in CASES}


@pytest.mark.nightly
@each_kind
def test_another_rasteriser_is_no_difference(show, kind):
    """Letters without hinting, at places between pixels."""
    shown = show(kind)
    shapes, words = shown.shapes(), shown.words()
    shown.change("text {text-rendering: geometricPrecision}")
    assert why(shown.shapes(), shapes, SHAPES) is None
    assert why(shown.words(), words, WORDS) is None


@pytest.mark.nightly
@each_kind
def test_a_word_a_shape_or_a_colour_that_goes_missing_is_seen(show, kind):
    shown = show(kind)
    before = {"shapes": shown.shapes(), "words": shown.words()}
    missed, count = [], 0
    for what, css, seen_in in mutations(shown.page):
        take_back = shown.change(css)
        after = {where: getattr(shown, where)() for where in seen_in}
        take_back()
        if sum(float(np.abs(each - before[where]).sum()) for where, each in after.items()) < LEAST:
            continue  # nobody sees it: it lies under something else, or has the colour of what is around
        count += 1
        limits = {"shapes": SHAPES, "words": WORDS}
        if not any(why(each, before[where], limits[where]) for where, each in after.items()):
            missed.append((what, [round(difference(each, before[where]).max(), 1) for where, each in after.items()]))
    assert missed == []
    assert count >= 4


LEAST = 20.0
"""The sum over all cells from which on a change is one: half a pixel from white to black is 24."""
MOST = 8
"""So many words and so many shapes of a picture are taken away, one at a time."""


def mutations(page):
    """What to take away, in words and in CSS, and where that is seen: words, shapes, and colours of the palette."""
    for what, selector, seen_in in (("word", LABELS, "words"), ("shape", PARTS, "shapes")):
        count = page.evaluate(
            """([selector, what]) => [...document.querySelectorAll(selector)].map((each, i) =>
               each.setAttribute(`data-${what}`, i)).length""",
            [selector, what],
        )
        for i in range(0, count, max(1, -(-count // MOST))):
            yield f"{what} {i}", f'[data-{what}="{i}"] {{visibility: hidden !important}}', (seen_in,)
    html = page.content().partition("<body>")[2]
    for name in style.LIGHT:
        other = style.LIGHT["vermilion" if name != "vermilion" else "blue"]
        if name != "page" and f"var(--rosmini-{name}," in html:
            yield f"colour {name}", f":root {{--rosmini-{name}: {other}}}", ("shapes", "words")


def test_on_paper_the_lines_of_a_plot_differ_without_their_colours(show):
    """In the greys of a printer each line is another one."""
    shown = show("plot", "print")
    colours = shown.page.evaluate(
        """(parts) => [...document.querySelectorAll(parts)].map((each) => getComputedStyle(each).stroke)""", PARTS
    )
    greys = sorted(
        0.299 * r + 0.587 * g + 0.114 * b
        for r, g, b in (map(int, colour[4:-1].split(", ")) for colour in set(colours) if colour.startswith("rgb("))
    )
    assert len(greys) >= 4  # three lines and the grid
    assert min(np.diff(greys)) > 20
