"""Panels that only show: the fields of types, the tree of frames, images."""

from __future__ import annotations

from abc import abstractmethod
from typing import TYPE_CHECKING, Any, ClassVar

from rosmini.core.tf import TransformListener
from rosmini.msgs import message_class
from rosmini.ros.introspection.topics import types
from rosmini.viz.image_pictures import image_picture
from rosmini.viz.rqt.definitions import rqt_action, rqt_msg, rqt_srv
from rosmini.viz.svg import element
from rosmini.viz.tf_trees import tf_tree
from rosmini.viz.view import PNG_MIME, Picture, ViewError

from .panel import Panel, bar
from .parts import Control, Drawing, Row, Rows, Words

if TYPE_CHECKING:
    from collections.abc import Sequence

    from rosmini.core.graph import Graph
    from rosmini.viz.rqt.table import Table

    from .parts import Part

REDRAW_S = 1.0
"""How often a picture is drawn again [s]."""


class _TypeBrowser(Panel):
    """The fields of a type."""

    example: ClassVar[str]

    def __init__(self, graph: Graph, kind: str = "", *, name: str | None = None) -> None:
        super().__init__(graph, name=name)
        self.choose(kind or self.example)

    @abstractmethod
    def _draw(self, kind: str) -> Table:
        """The fields of a type."""

    def choose(self, kind: str) -> None:
        """Show another type. Raises ``ViewError`` if no package here defines it."""
        self._table = self._draw(kind)
        self.kind = kind

    def parts(self) -> Sequence[Part]:
        """The type, and its fields."""
        rows = tuple(
            Row((tree.strip(), kind, path), (len(tree) - len(tree.lstrip())) // 2)
            for tree, kind, path in self._table.rows
        )
        return [
            bar(Control("type", "Type", "text", self.kind)),
            Rows(self._table.columns, rows, f"Fields of {self.kind}"),
        ]

    def _operate(self, _key: Sequence[str], value: Any) -> None:
        self.choose(value)

    def settings(self) -> dict[str, Any]:
        """The type."""
        return {"type": self.kind}

    def restore(self, settings: dict[str, Any]) -> None:
        """Show the type that was kept."""
        self.choose(str(settings.get("type", self.kind)))


class MessageTypes(_TypeBrowser):
    """The fields of a message type (http://wiki.ros.org/rqt_msg)."""

    tool, heading, plugin = "rqt_msg", "Message Type Browser", "rqt_msg/Messages"
    example = "geometry_msgs/Twist"

    def _draw(self, kind: str) -> Table:
        return rqt_msg(kind)


class ServiceTypes(_TypeBrowser):
    """The fields of a service type (http://wiki.ros.org/rqt_srv)."""

    tool, heading, plugin = "rqt_srv", "Service Type Browser", "rqt_srv/Services"
    example = "nav_msgs/GetPlan"

    def _draw(self, kind: str) -> Table:
        return rqt_srv(kind)


class ActionTypes(_TypeBrowser):
    """The fields of an action type (http://wiki.ros.org/rqt_action)."""

    tool, heading, plugin = "rqt_action", "Action Type Browser", "rqt_action/ActionPlugin"
    example = "move_base_msgs/MoveBase"

    def _draw(self, kind: str) -> Table:
        return rqt_action(kind)


class TfTree(Panel):
    """The tree of frames, as it is now (http://wiki.ros.org/rqt_tf_tree)."""

    tool, heading, plugin = "rqt_tf_tree", "TF Tree", "rqt_tf_tree/RosTfTree"

    def __init__(self, graph: Graph, *, name: str | None = None) -> None:
        super().__init__(graph, name=name)
        self._listener = TransformListener(self.node)
        self._drawn: tuple[float, Picture] | None = None

    def parts(self) -> Sequence[Part]:
        """The tree, drawn again every second."""
        now = self.graph.now().to_sec()
        if self._drawn is None or abs(now - self._drawn[0]) >= REDRAW_S:
            self._drawn = (now, tf_tree(self._listener))
        return [bar(Control("refresh", "Refresh", "button")), drawn(self._drawn[1])]

    def _operate(self, _key: Sequence[str], _value: Any) -> None:
        self._drawn = None


class ImageView(Panel):
    """The newest image on a topic (http://wiki.ros.org/rqt_image_view).

    Args:
        graph: the graph.
        topic: the one that is chosen first.
        name: of the panel's node.

    Raises:
        ViewError: no images are published there.

    """

    tool, heading, plugin = "rqt_image_view", "Image View", "rqt_image_view/ImageView"

    def __init__(self, graph: Graph, topic: str = "", *, name: str | None = None) -> None:
        super().__init__(graph, name=name)
        self.topic = ""
        self._image: Any = None
        self._subscriber: Any = None
        self._drawn: tuple[float, Drawing] | None = None
        if topic:
            self.choose(topic)

    def names(self) -> list[str]:
        """Return the topics of images, sorted."""
        return sorted(name for name, kind in types(self.graph) if kind == "sensor_msgs/Image")

    def choose(self, topic: str) -> None:
        """Show another topic. Raises ``ViewError``."""
        if topic not in self.names():
            known = ", ".join(self.names()) or "no topics of images"
            raise ViewError(f"no images come on {topic!r:.80}; there are {known}")
        if self._subscriber is not None:
            self._subscriber.unregister()
        self.topic, self._image, self._drawn = topic, None, None
        self._subscriber = self.node.subscriber(topic, message_class("sensor_msgs/Image"), self._take)

    def _take(self, image: Any) -> None:
        self._image = image

    def parts(self) -> Sequence[Part]:
        """The topic, and the image."""
        choices = tuple(dict.fromkeys((self.topic, *self.names())))
        head = bar(Control("topic", "Topic", "choice", self.topic, choices))
        if self._image is None:
            return [head, Words("no image has come yet")]
        now = self.graph.now().to_sec()
        if self._drawn is None or abs(now - self._drawn[0]) >= REDRAW_S:
            self._drawn = (now, drawn(image_picture(self._image, title=self.topic)))
        return [head, self._drawn[1]]

    def _operate(self, _key: Sequence[str], value: Any) -> None:
        self.choose(value)

    def settings(self) -> dict[str, Any]:
        """The topic."""
        return {"topic": self.topic}

    def restore(self, settings: dict[str, Any]) -> None:
        """Show the topic that was kept."""
        if settings.get("topic"):
            self.choose(str(settings["topic"]))


def drawn(picture: Picture) -> Drawing:
    """Return a picture as a part of a panel."""
    if picture.svg is not None:
        return Drawing(picture.svg, picture.text)
    data, _ = picture._repr_mimebundle_()
    image = element("img", src=f"data:{PNG_MIME};base64,{''.join(data[PNG_MIME].split())}", alt=picture.alt)
    return Drawing(image, picture.text)
