"""Panels that only show."""

import numpy as np
import pytest

from rosmini.msgs.geometry_msgs.msg import TransformStamped
from rosmini.msgs.sensor_msgs.msg import Image
from rosmini.msgs.tf2_msgs.msg import TFMessage
from rosmini.viz.rqt.definitions import ActionTypes, MessageTypes, ServiceTypes
from rosmini.viz.rqt.image_view import ImageView
from rosmini.viz.rqt.tf_tree import TfTree
from rosmini.viz.view import ViewError


@pytest.mark.parametrize(
    ("panel", "kind", "line"),
    [
        (MessageTypes, "std_msgs/Header", "frame_id"),
        (ServiceTypes, "std_srvs/SetBool", "request/data"),
        (ActionTypes, "actionlib_tutorials/Fibonacci", "goal/order"),
    ],
)
def test_a_type_that_is_written_is_shown(graph, panel, kind, line):
    browser = panel(graph)
    assert browser.kind in browser.text
    browser.set("type", kind)
    assert line in browser.text
    with pytest.raises(ViewError):
        browser.set("type", "no_pkg/Nothing")
    assert browser.kind == kind


def test_frames_appear(graph):
    tree = TfTree(graph)
    publisher = graph.node("source").publisher("/tf", TFMessage)
    graph.run(0.1)
    one = TransformStamped(child_frame_id="base")
    one.header.frame_id, one.header.stamp = "odom", graph.now()
    one.transform.rotation.w = 1.0
    publisher.publish(TFMessage([one]))
    graph.run(1.1)
    assert "odom -> base" in tree.text
    tree.set("refresh")


def test_the_newest_image_is_shown(graph):
    publisher = graph.node("camera").publisher("/image", Image)
    view = ImageView(graph, "/image")
    assert "no image has come yet" in view.text
    graph.run(0.1)
    pixels = np.zeros((2, 3, 3), np.uint8).tobytes()
    publisher.publish(Image(height=2, width=3, encoding="rgb8", step=9, data=pixels))
    graph.run(0.1)
    assert "3 x 2" in view.text
    assert '<img src="data:image/png;base64,' in view.markup(live=True)
    with pytest.raises(ViewError, match="no images come on '/x'; there are /image"):
        view.choose("/x")
