"""`rqt_image_view`: the newest image on a topic (http://wiki.ros.org/rqt_image_view)."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from optparse import Values
from typing import Any

from rosmini.core.graph import Graph
from rosmini.core.verbs import Call, Span, VerbError, tool_node
from rosmini.msgs import message_class
from rosmini.ros.introspection.topics import types
from rosmini.viz.image_pictures import image_picture
from rosmini.viz.view import View, ViewError

from .panel import Panel, bar
from .parts import Control, Part, Words, drawn


class ImageView(Panel):
    """The newest image on a topic (http://wiki.ros.org/rqt_image_view).

    Args:
        graph: the graph.
        topic: topic shown at first.
        name: name of the panel's node.

    Raises:
        ViewError: no images are published there.

    """

    tool, heading, plugin = "rqt_image_view", "Image View", "rqt_image_view/ImageView"
    group, summary = "Visualization", "the next image on a topic"
    usage, takes, example, listen_s = "TOPIC", "topic", "/camera/rgb/image_raw", 5.0

    def __init__(self, graph: Graph, topic: str = "", *, name: str | None = None) -> None:
        super().__init__(graph, name=name)
        self.topic = ""
        self._image: Any = None
        self._subscriber: Any = None
        if topic:
            self.choose(topic)

    @classmethod
    def still(cls, given: Values, call: Call) -> View:
        """Wait for an image, and return it. Raises ``VerbError`` if none comes."""
        (topic,), _ = cls.arguments(given)
        images: list[Any] = []
        with tool_node(call.graph, cls.tool) as node:

            def begin(wake: Callable[[], None]) -> None:
                def take(image: Any) -> None:
                    images.append(image)
                    wake()

                node.subscriber(topic, message_class("sensor_msgs/Image"), take)

            Span.of(call.graph, round(given.duration * 1e9)).wait(node, f"an image on {topic}", begin)
        if not images:
            raise VerbError(f"no image came on {topic} in {given.duration:g} s; see `rosmini rostopic info {topic}`")
        return image_picture(images[0], title=given.title or topic)

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
        return [head, self._redrawn(lambda: drawn(image_picture(self._image, title=self.topic)))]

    def _operate(self, _key: Sequence[str], value: Any) -> None:
        self.choose(value)

    def settings(self) -> dict[str, Any]:
        """Return the topic."""
        return {"topic": self.topic}

    def restore(self, settings: dict[str, Any]) -> None:
        """Show the topic of a perspective."""
        if settings.get("topic"):
            self.choose(str(settings["topic"]))
