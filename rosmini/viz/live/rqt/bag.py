"""`rqt_bag` in a window: what is in a bag, over time (http://wiki.ros.org/rqt_bag)."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

from rosmini.viz.rqt.bag import rqt_bag
from rosmini.viz.view import ViewError

from .browsers import drawn
from .panel import Panel, bar
from .parts import Control, Words

if TYPE_CHECKING:
    from collections.abc import Sequence

    from rosmini.core.graph import Graph

    from .parts import Drawing, Part


class BagTimeline(Panel):
    """When the messages of a bag were recorded: a row for each topic.

    Args:
        graph: the graph.
        path: the bag that is shown first.
        name: of the panel's node.

    Raises:
        ViewError: the file cannot be opened, or holds no message.
        ROSBagException: it is no bag.

    """

    tool, heading, plugin = "rqt_bag", "Bag", "rqt_bag/Bag"

    def __init__(self, graph: Graph, path: str = "", *, name: str | None = None) -> None:
        super().__init__(graph, name=name)
        self.path = ""
        self._drawn: Drawing | None = None
        if path:
            self.load(path)

    def load(self, path: str) -> None:
        """Show another bag. Raises ``ViewError``, ``ROSBagException``."""
        try:
            self._drawn = drawn(rqt_bag(path))
        except OSError as error:
            raise ViewError(f"{path} cannot be opened: {error.strerror}") from error
        self.path = path

    def parts(self) -> Sequence[Part]:
        """The file, and its rows."""
        shown = (
            Words("name a file: it is read when you have typed it") if self._drawn is None else self._drawn
        )
        return [bar(Control("file", "File", "text", self.path)), shown]

    def _operate(self, _key: Sequence[str], value: Any) -> None:
        self.load(value)

    def settings(self) -> dict[str, Any]:
        """The file."""
        return {"path": self.path}

    def restore(self, settings: dict[str, Any]) -> None:
        """Show the file that was kept."""
        if settings.get("path"):
            self.load(str(settings["path"]))
