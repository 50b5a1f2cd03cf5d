"""What pictures that move have in common: a name, a still picture, data and scripts make their HTML."""

from __future__ import annotations

import json
import re

from rosmini.viz.moving_view import MovingView


class Clock(MovingView):
    scripts = ("rosmini-canvas.js",)
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
    assert len(view.page) > len(view.html), "the page for a file of its own brings its script"


def test_a_title_is_its_name_and_its_caption():
    view = Clock()
    assert view.name == "a clock"
    view.title = "Figure 1: Noon"
    assert view.name == view.title and "<figcaption>Figure 1: Noon</figcaption>" in view.html
