"""A listener fills a buffer, and empties it when time jumps back."""

from __future__ import annotations

import pytest

from rosmini.core.graph import Graph
from rosmini.core.tf import Buffer, TransformListener
from rosmini.core.tf.messages import to_stamped
from rosmini.core.tf.rigid import from_yaw
from rosmini.core.time import Time
from rosmini.msgs import message_class


@pytest.fixture
def graph():
    with Graph() as graph:
        graph.master.setParam("/test", "/use_sim_time", True)
        yield graph


def test_a_jump_back_in_time_empties_the_buffer_but_for_static_frames(graph, capsys):
    clock = graph.node("clock").publisher("/clock", message_class("rosgraph_msgs/Clock"))
    sender = graph.node("sender")
    kind = message_class("tf2_msgs/TFMessage")
    moving = sender.publisher("/tf", kind)
    fixed = sender.publisher("/tf_static", kind, latch=True)
    looker = graph.node("looker")
    listener = TransformListener(looker, Buffer(looker))
    buffer = listener.buffer
    graph.run(0.1)

    def at(seconds, child):
        clock.publish(Time(seconds))
        graph.run(0.1)
        moving.publish([to_stamped("map", child, from_yaw(1, 2, 0), seconds * 10**9)])
        graph.run(0.1)

    fixed.publish([to_stamped("base", "laser", from_yaw(0, 0, 0), 0)])
    at(100, "base")
    assert listener.last_update_ns == 100 * 10**9
    assert buffer.tree.edges["base"].newest.authority == "/sender"
    at(101, "base")
    assert set(buffer.tree) == {"map", "base", "laser"}
    at(5, "arm")
    assert set(buffer.tree.edges) == {"laser", "arm"}
    assert "jump back in time" in capsys.readouterr().err
    at(6, "base")  # what is sent after the jump is older than what was forgotten, and is taken
    assert buffer.tree.lookup("map", "laser").stamp_ns == 6 * 10**9
    listener.unregister()
    at(7, "gripper")
    assert "gripper" not in buffer.tree
