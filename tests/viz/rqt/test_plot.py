"""rqt_plot: what stands in messages, over time."""

import pytest

from rosmini import Graph
from rosmini.core.time import Time
from rosmini.msgs.geometry_msgs.msg import Twist
from rosmini.msgs.sensor_msgs.msg import LaserScan
from rosmini.ros.bag import Bag
from rosmini.viz import ViewError
from rosmini.viz.rqt.plot import expanded, rqt_plot


@pytest.fixture
def graph():
    """A graph with a node that counts in `linear.x` and counts down in `angular.z`, ten times a second."""
    with Graph() as made:
        node = made.node("counter")
        publisher = node.publisher("cmd_vel", Twist)
        count = 0

        def tick(_):
            nonlocal count
            message = Twist()
            message.linear.x, message.angular.z = float(count), -0.5 * count
            publisher.publish(message)
            count += 1

        node.timer(0.1, tick)
        yield made


def test_two_fields_over_the_time_that_passes(graph):
    before = graph.now().to_sec()
    view = rqt_plot(graph, "/cmd_vel/linear/x", "cmd_vel/angular/z", duration=2.0)
    assert graph.now().to_sec() - before == pytest.approx(2.0)
    assert view.text.splitlines() == [
        "rqt_plot: value over time [s]",
        "/cmd_vel/linear/x: 19 points, from 0.00 to 18.00, last 18.00",
        "cmd_vel/angular/z: 19 points, from -9.00 to 0.00, last -9.00",
    ]
    assert not [name for name in graph.nodes if "rqt" in name]


def test_colons_stand_for_fields_beside_one_another():
    assert expanded("/a/b/x:y:z") == ["/a/b/x", "/a/b/y", "/a/b/z"]
    assert expanded("/scan/ranges[0]") == ["/scan/ranges[0]"]
    assert expanded("/a/ranges[0:2]") == ["/a/ranges[0:2]"]


@pytest.mark.parametrize(
    ("field", "text"),
    [
        ("/cmd_val/linear/x", "nothing to hear at /cmd_val/linear/x; did you mean /cmd_vel"),
        ("/cmd_vel/liner/x", "did you mean linear?"),
        ("/cmd_vel/linear", "it is a Vector3 and no number"),
        ("/cmd_vel/linear/x[0]", "not subscriptable|no"),
        ("/cmd_vel/linear[", "missing closing"),
    ],
)
def test_a_field_that_is_none_is_named_with_what_was_meant(graph, field, text):
    graph.run(0.1)
    with pytest.raises(ViewError, match=text):
        rqt_plot(graph, field, duration=0.5)


@pytest.mark.parametrize("duration", [0, -1, float("inf"), float("nan")])
def test_a_duration_is_positive(graph, duration):
    with pytest.raises(ViewError, match="positive number of seconds"):
        rqt_plot(graph, "/cmd_vel/linear/x", duration=duration)


def test_a_topic_on_which_nothing_comes_and_no_field_at_all(graph):
    graph.node("mute").publisher("scan", LaserScan)
    with pytest.raises(ViewError, match="no message came for /scan/angle_min; listen longer"):
        rqt_plot(graph, "/scan/angle_min", duration=0.5)
    with pytest.raises(ViewError, match="name a field"):
        rqt_plot(graph)


def test_a_bag_is_read_from_end_to_end(tmp_path):
    with Bag(tmp_path / "run.bag", "w") as bag:
        for number in range(5):
            scan = LaserScan(ranges=[float(number), 2.0])
            bag.write("/robot/scan", scan, Time(10 + number))
    with Bag(tmp_path / "run.bag") as bag:
        assert rqt_plot(bag, "/robot/scan/ranges[0]").text.splitlines()[1] == (
            "/robot/scan/ranges[0]: 5 points, from 0.00 to 4.00, last 4.00"
        )
        with pytest.raises(ViewError, match="no topic of /scan/ranges"):
            rqt_plot(bag, "/scan/ranges[0]")
        with pytest.raises(ViewError, match="out of bounds"):
            rqt_plot(bag, "/robot/scan/ranges[7]")
