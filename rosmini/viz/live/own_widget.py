"""The page of a live view on a page of the book whose cells run in the browser (*Run in this page*)."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from itertools import count
from typing import Any, ClassVar

from rosmini.viz.embed import embed

from .loopback import packed

_ids = count(1)


class OwnWidget:
    """Takes the place of a Jupyter widget: `mount` of `book/static/run.js` calls `render` of the driver."""

    opened: ClassVar[dict[int, OwnWidget]] = {}
    """All widgets, by the number that their messages name."""
    post: ClassVar[Callable[..., object]]
    """Posts a message to the page."""

    comm = sink = None

    def __init__(self, html: str, number: int) -> None:
        self._html = html
        self._number = number
        self._receive: Callable[..., object] = print
        self.opened[number] = self

    def on_msg(self, receive: Callable[..., object]) -> None:
        """Call `receive(widget, content, buffers)` for each message from the page."""
        self._receive = receive

    def hear(self, content: dict[str, Any]) -> None:
        """Receive a message from the page."""
        self._receive(self, content, [])

    def send(self, content: dict[str, Any], buffers: list[bytes] | None = None) -> None:
        """Send a message to the page."""
        OwnWidget.post(kind="tell", id=self._number, content=content, buffers=[packed(each) for each in buffers or ()])

    def _repr_mimebundle_(self) -> tuple[dict[str, str], dict[str, Any]]:
        """Return the HTML that opens the page."""
        return {"text/html": self._html}, {}


def new_widget(scripts: Sequence[str], driver: str, data: dict[str, Any]) -> OwnWidget:
    """Return the widget whose page runs these scripts and calls `render` of the object that they set."""
    number = next(_ids)
    plain = {key: packed(value) if isinstance(value, bytes) else value for key, value in data.items()}
    title = str(data.get("title", "Panel"))
    html = embed(
        scripts, "rosminiPage.mount", {"id": number, "driver": driver, "data": plain},
        title=title, alt=title, height=1, fallback_html=title,
    )  # fmt: skip
    return OwnWidget(html, number)
