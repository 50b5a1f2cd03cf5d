"""Namespaces, topics and frames of the plugins of gazebo_ros."""

from __future__ import annotations

from rosmini.core.graph import Node
from rosmini.core.markup import Element
from rosmini.core.names import check_name
from rosmini.sim.devices.namespaces import prefixed, within
from rosmini.sim.gazebo.model import Model


class RosNames:
    """Names of the topics and frames of a model's plugin.

    Topics are in the namespace that the model was spawned with, or else in the plugin's `<robotNamespace>`. Frames
    begin with the parameter `tf_prefix`, searched from that namespace upwards, or else with the namespace itself
    (http://wiki.ros.org/geometry/CoordinateFrameConventions).
    """

    def __init__(self, model: Model, sdf: Element, *, default: str = "") -> None:
        self.namespace = (model.namespace or sdf.word("robotNamespace", default)).strip().strip("/")
        self.prefix = tf_prefix(model.world.node, self.namespace)

    def topic(self, name: str) -> str:
        """Return the full name of a topic or service; a leading slash means it is one. Raises `IllegalName`."""
        return check_name(within(f"/{self.namespace}", name.strip()), "topic")

    def frame(self, name: str) -> str:
        """Return the full name of a frame; one that begins with a slash gets no prefix."""
        return prefixed(self.prefix, name.strip())


def tf_prefix(node: Node, namespace: str) -> str:
    """Return the prefix of frames in a namespace."""
    found = node.graph.ask_as(f"/{namespace}").find("searchParam", "tf_prefix")
    value = None if found is None else node.get_param(found, None)
    if isinstance(value, str) and value.strip("/"):
        return value.strip("/")
    return namespace
