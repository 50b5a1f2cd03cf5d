"""The page of a live view (pad, simulation view or panel) as a Jupyter widget."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from typing import Any

import anywidget
import traitlets

from .page import module


class PageWidget(anywidget.AnyWidget):
    """The page of a pad, a view or a panel, as a Jupyter widget."""

    data = traitlets.Dict().tag(sync=True)

    sink: Callable[[dict[str, Any], list[bytes] | None], None] | None = None
    """Receives the messages to the page if a program serves it in place of Jupyter (`rosmini.viz.live.loopback`)."""

    def send(self, content: dict[str, Any], buffers: list[bytes] | None = None) -> None:
        """Send a message to the page."""
        if self.sink is None:
            super().send(content, buffers)
        else:
            self.sink(content, buffers)

    @property
    def script(self) -> str:
        """JavaScript module of the page."""
        return str(self._esm)

    @property
    def state(self) -> dict[str, Any]:
        """Initial data of the page."""
        return dict(self.data)

    def hear(self, content: dict[str, Any]) -> None:
        """Receive a message from the page, in any thread."""
        self._handle_custom_msg(content, [])


def new_widget(scripts: Sequence[str], driver: str, data: dict[str, Any]) -> PageWidget:
    """Return the widget whose page runs these scripts and calls `render` of the object that they set."""
    return PageWidget(_esm=module(scripts, driver), data=data)
