"""Panels of rqt on a graph of real ROS: a real Master and a real rospy node, which are looked at and operated."""

from __future__ import annotations

import pytest

from rosmini.ros.net.connecting import connect
from rosmini.viz.rqt import MessagePublisher, ServiceCaller
from rosmini.viz.rqt.graph import NodeGraph
from rosmini.viz.rqt.logger_level import LoggerLevel
from rosmini.viz.rqt.plot import Plot
from rosmini.viz.rqt.topics import TopicMonitor

from ..processes import start, wait_until
from .conftest import SYSTEM_PYTHON

pytestmark = pytest.mark.ros

NODE = """
import rospy
from std_msgs.msg import Float64
from sensor_msgs.srv import SetCameraInfo, SetCameraInfoResponse
rospy.init_node("real")
publisher = rospy.Publisher("/doubled", Float64, queue_size=10, latch=True)
rospy.Subscriber("/number", Float64, lambda message: publisher.publish(2 * message.data))
answer = lambda request: SetCameraInfoResponse(True, "%d pixels" % request.camera_info.width)
rospy.Service("/camera", SetCameraInfo, answer)
publisher.publish(-1.0)
rospy.spin()
"""


@pytest.fixture
def graph(master):
    """A graph of ours that is part of the real one, with the real node ready."""
    with start([SYSTEM_PYTHON, "-c", NODE], env=master) as process, connect(master) as graph:
        caller = ServiceCaller(graph, name="waiting")
        wait_until(lambda: {"/camera", "/real/set_logger_level"} <= set(caller.names()), "the real node", process)
        caller.close()
        yield graph


def until(graph, holds):
    """Let the graph go on until something is so."""

    def go_on():
        graph.run(0.05)
        return holds()

    wait_until(go_on, "the graph")


def test_services_and_loggers_of_a_real_node(graph):
    caller = ServiceCaller(graph, "/camera")
    caller.set("request/camera_info/width", "2 * 320")
    caller.set("call")
    assert "'640 pixels'" in caller.text
    levels = LoggerLevel(graph, "/real")
    levels.set("level/rosout", "Debug")
    assert levels.loggers["rosout"] == "Debug"


def test_what_is_published_comes_back_and_is_seen(graph):
    publisher = MessagePublisher(graph)
    plot, topics, drawing = Plot(graph, "/doubled/data"), TopicMonitor(graph, "/doubled"), NodeGraph(graph)
    row = publisher.add("/number", rate=20)
    assert row.type == "std_msgs/Float64"
    row.fill("data", "21")
    row.enable()
    until(graph, lambda: "last 42.00" in plot.text)
    until(graph, lambda: "42" in topics.text)
    drawing.change(hide=(), mode="nodes_topics_all", highlight="/real")
    drawing.refresh()
    assert "/rqt_publisher -> /number [std_msgs/Float64] -> /real" in drawing.text
    assert "/doubled" in drawing.text.rpartition("highlighted: /real")[2]
