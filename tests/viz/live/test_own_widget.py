"""Live views and moving pictures on a page of the book that runs its own cells."""

import json

from rosmini.viz.embed import MovingView, book_form
from rosmini.viz.live.live_view import LiveView
from rosmini.viz.live.own_widget import OwnWidget, new_widget


class Film(MovingView):
    """A moving picture whose still picture nothing can draw."""

    call, scripts, usual_name = "rosminiReplay.mount", ("rosmini-replay.js",), "A film"
    text = alt = "A robot drives."
    height, data = 100, {"poses": [1, 2]}

    @property
    def svg(self):
        raise AssertionError("drawn")


class Dial(LiveView):
    """A view with a page."""

    text = alt = "A dial."

    def _images(self):
        return {}

    def _new_link(self):
        self.widget = new_widget(("rosmini-rqt.js",), "rosminiRqt", {"title": "Dial", "ranges": b"\x00\x01"})
        return self


def test_a_moving_picture_needs_no_still_one(monkeypatch):
    monkeypatch.setenv("ROSMINI_DISPLAY", "page")
    assert book_form()
    data, _ = Film()._repr_mimebundle_()
    assert data.keys() == {"text/plain", "text/html"}
    assert '<div class="rosmini-still"><p>A robot drives.</p></div>' in data["text/html"]


def test_a_view_talks_to_its_page(monkeypatch):
    monkeypatch.setenv("ROSMINI_DISPLAY", "page")
    dial, posted, heard = Dial(), [], []
    data, _ = dial._repr_mimebundle_()
    given = json.loads(data["text/html"].partition('<script type="application/json">')[2].partition("</script>")[0])
    assert "rosminiPage.mount(" in data["text/html"]
    assert given["driver"] == "rosminiRqt"
    assert given["data"] == {"title": "Dial", "ranges": {"base64": "AAE="}}
    monkeypatch.setattr(OwnWidget, "post", lambda **message: posted.append(message), raising=False)
    dial.widget.on_msg(lambda _widget, content, _buffers: heard.append(content))
    OwnWidget.opened[given["id"]].hear({"type": "hello"})
    dial.widget.send({"type": "frame"}, [b"\x02"])
    assert heard == [{"type": "hello"}]
    assert posted == [
        {"kind": "tell", "id": given["id"], "content": {"type": "frame"}, "buffers": [{"base64": "Ag=="}]}
    ]
