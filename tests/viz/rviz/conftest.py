"""A graph in simulated time with one node that says where frames are and publishes what a test wants shown."""

import math
from pathlib import Path

import pytest

from rosmini import Graph
from rosmini.core.tf import TransformBroadcaster
from rosmini.viz.rviz import Scene


class Stage:
    """`place` frames, `publish` messages, `show` a display: it returns the scene's only layer after an update."""

    def __init__(self, graph):
        self.graph = graph
        self.node = graph.node("robot")
        self._broadcaster = TransformBroadcaster(self.node)
        self._publishers = {}
        self._scenes = []

    def place(self, parent, child, at=(0.0, 0.0, 0.0), yaw=0.0):
        """Say where a frame is, now; scenes hear it when the graph runs on."""
        self._broadcaster.send(parent, child, at, (0.0, 0.0, math.sin(yaw / 2), math.cos(yaw / 2)))

    def publish(self, topic, message, frame=None, settle=0.01):
        """Publish a message, latched; with a frame it is stamped with the present time. Then the graph runs on."""
        if frame is not None:
            message.header.frame_id, message.header.stamp = frame, self.graph.now()
        if topic not in self._publishers:
            self._publishers[topic] = self.node.publisher(topic, type(message), latch=True)
        self._publishers[topic].publish(message)
        self.graph.run(settle)

    def scene(self, config=None, fixed_frame="map"):
        """A scene, closed at the end of the test."""
        made = Scene(self.graph, config, fixed_frame=fixed_frame)
        self._scenes.append(made)
        self.graph.run(0.01)  # connections take a moment
        return made

    def display(self, kind, topic="", **properties):
        """A scene with one display of a topic, and that display; `more` are properties whose names are no words."""
        more = properties.pop("more", {})
        scene = self.scene()
        named = {"Topic": topic} if topic else {}
        made = scene.add(kind, {**named, **properties, **more})
        self.graph.run(0.01)
        return scene, made

    def close(self):
        for scene in self._scenes:
            scene.close()


@pytest.fixture
def stage():
    with Graph() as graph:
        made = Stage(graph)
        yield made
        made.close()


@pytest.fixture
def statuses():
    """How a display is doing, as {name: (level, text)}."""
    return lambda display: {each.name: (str(each.level), each.text) for each in display.statuses}


@pytest.fixture
def data():
    return Path(__file__).parent / "data"
