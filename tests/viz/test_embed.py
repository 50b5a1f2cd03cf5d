"""Pictures that move: their HTML in the book and alone, and what is refused."""

import base64
import gzip
import json
import re

import pytest

from book.tools.pages import page_problems
from rosmini.viz import ViewError
from rosmini.viz import embed as module
from rosmini.viz.embed import MESHCAT, MovingView, asset_path, book_form, embed

SCRIPT = "globalThis.test = {mount() {}};"
GIVEN = {"title": "A run", "alt": "A robot <runs>.", "height": 300, "fallback_html": "<p>still</p>"}


@pytest.fixture(autouse=True)
def static(tmp_path, monkeypatch):
    (tmp_path / "test.js").write_text(SCRIPT, encoding="utf-8")
    (tmp_path / "closing.js").write_text("'</script>'", encoding="utf-8")
    monkeypatch.setattr(module, "STATIC", tmp_path)


def json_of(html):
    return json.loads(re.search(r'<script type="application/json">(.*?)</script>', html, re.DOTALL)[1])


@pytest.mark.parametrize(("value", "expected"), [("book", True), ("live", False), (None, False)])
def test_the_environment_says_which_form(monkeypatch, value, expected):
    if value is None:
        monkeypatch.delenv("ROSMINI_DISPLAY", raising=False)
    else:
        monkeypatch.setenv("ROSMINI_DISPLAY", value)
    assert book_form() is expected
    html = embed(["test.js"], "test.mount", {}, **GIVEN)
    assert html == embed(["test.js"], "test.mount", {}, book=expected, **GIVEN)
    assert (SCRIPT in html) is not expected


def test_the_book_form_names_the_scripts_and_the_live_form_carries_them():
    book = embed(["test.js"], "test.mount", {"a": 1}, assets=[MESHCAT], book=True, **GIVEN)
    live = embed(["test.js"], "test.mount", {"a": 1}, assets=[MESHCAT], book=False, **GIVEN)
    assert '["test.js"]' in book
    assert SCRIPT not in book
    assert len(book) < 2500
    assert SCRIPT in live
    packed = json.loads(re.search(r"packed = (\{.*?\});", live)[1])
    assert gzip.decompress(base64.b64decode(packed[MESHCAT])) == asset_path(MESHCAT).read_bytes()
    assert page_problems(book) == []
    assert [problem for problem in page_problems(live) if "live form" not in problem] == []
    for html in (book, live):
        assert '<div class="rosmini-still"><p>still</p></div>' in html
        assert 'aria-label="A run"' in html


def test_data_come_back_whatever_is_in_them():
    data = {"text": "</script><!-- \u2028 é", "bytes": b"\x00\xff", "list": [1.5, None]}
    html = embed(["test.js"], "test.mount", data, book=True, **GIVEN)
    assert json_of(html) == data | {"bytes": base64.b64encode(b"\x00\xff").decode()}
    assert html.count("</script>") == 2


@pytest.mark.parametrize(
    ("change", "message"),
    [
        ({"script_names": ["tset.js"]}, "no script 'tset.js'.*test.js"),
        ({"script_names": ["../embed.py"]}, "no script"),
        ({"script_names": ["closing.js"], "book": False}, "closing.js contains the end of a script element"),
        ({"assets": ["other.js"]}, "no script 'other.js'"),
        ({"call": "alert(1)"}, "not the name of a function"),
        ({"alt": " "}, "needs alt text"),
        ({"title": ""}, "needs a title"),
        ({"fallback_html": ""}, "needs a still picture"),
    ],
)
def test_what_is_refused(change, message):
    given = {"script_names": ["test.js"], "call": "test.mount", "data": {}} | GIVEN | change
    with pytest.raises(ViewError, match=message):
        embed(**given)


class Clock(MovingView):
    scripts = ("test.js",)
    call = "rosminiClock.mount"
    usual_name = "a clock"
    text, alt, svg = "noon", "A clock at noon.", "<svg><title>noon</title></svg>"
    height = 200

    @property
    def data(self):
        return {"hands": b"\x00\x01"}


def test_a_page_has_the_still_picture_the_data_and_the_scripts(monkeypatch):
    monkeypatch.setenv("ROSMINI_DISPLAY", "book")
    view = Clock()
    assert view._repr_mimebundle_()[0].keys() == {"text/plain", "image/svg+xml", "text/html"}
    data = re.search(r'type="application/json">(.*?)<', view.html)
    assert data is not None and json.loads(data[1]) == {"hands": "AAE="}
    assert view.svg in view.html and "rosminiClock.mount" in view.html and "figcaption" not in view.html
    assert SCRIPT in view.page and SCRIPT not in view.html, "the page for a file of its own brings its script"


def test_a_title_is_its_name_and_its_caption():
    view = Clock()
    assert view.name == "a clock"
    view.title = "Figure 1: Noon"
    assert view.name == view.title and "<figcaption>Figure 1: Noon</figcaption>" in view.html
