"""Publishers and subscribers as scripts use them."""

from __future__ import annotations

import itertools
import warnings

import numpy as np
import pytest

from rosmini.core.actionlib import ActionException
from rosmini.msgs.rospy_tutorials.msg import Floats
from rosmini.msgs.std_msgs.msg import Int32, String
from rosmini.ros import rospy
from rosmini.ros.rospy.aliases.actionlib import SimpleActionClient
from rosmini.ros.rospy.numpy_msg import numpy_msg


def test_topics_made_before_init_node_start_with_it(programs):
    def main():
        heard = []
        publisher = rospy.Publisher("chatter", String, queue_size=1)
        rospy.Subscriber("chatter", String, lambda message: heard.append(message.data))
        gone = rospy.Publisher("gone", String, queue_size=1)
        gone.unregister()
        with pytest.raises(rospy.ROSException, match="init_node"):
            publisher.publish("too early")
        with pytest.raises(ValueError, match="before init_node"):
            rospy.Publisher("~private", String, queue_size=1)
        rospy.init_node("main")
        rospy.sleep(0.2)
        publisher.publish("x")
        rospy.sleep(0.2)
        return publisher.name, heard, [topic for topic, _ in rospy.get_published_topics()]

    name, heard, topics = programs(main, arguments=("chatter:=/news",))
    assert (name, heard) == ("/news", ["x"])
    assert "/news" in topics
    assert "/gone" not in topics


@pytest.mark.parametrize(
    ("queue_size", "expected"), [(None, [0, 1, 2, 3, 4]), (1, [0, 3, 6, 9, 12]), (2, [0, 2, 3, 8, 9, 14, 15])]
)
def test_a_slow_callback_works_through_batches(programs, queue_size, expected):
    """As measured with rospy: all messages that waited when a callback returned are delivered before newer ones."""

    def main():
        rospy.init_node("main")
        heard, numbers = [], itertools.count()

        def hear(message):
            heard.append(message.data)
            if len(heard) < 8:
                for _ in range(3):
                    publisher.publish(next(numbers))
            rospy.sleep(0.1)

        publisher = rospy.Publisher("t", Int32, queue_size=10)
        rospy.Subscriber("t", Int32, hear, queue_size=queue_size)
        rospy.sleep(0.2)
        publisher.publish(next(numbers))
        while len(heard) < 8:
            rospy.sleep(0.1)
        return heard

    assert programs(main)[: len(expected)] == expected


def test_of_a_lost_message_it_is_said_what_a_script_can_do(programs, capfd):
    def main():
        rospy.init_node("main")
        rospy.Publisher("t", String, queue_size=10).publish("lost")
        rospy.sleep(0.1)

    programs(main)
    said = "".join(capfd.readouterr())
    assert "wait while get_num_connections() is 0" in said
    assert "wait_for_subscribers" not in said


def test_numpy_msg_gives_arrays(programs):
    def main():
        rospy.init_node("main")
        got = []
        rospy.Subscriber("floats", numpy_msg(Floats), got.append)
        publisher = rospy.Publisher("floats", numpy_msg(Floats), queue_size=1)
        rospy.sleep(0.2)
        publisher.publish(np.array([1.0, 2.0], dtype=np.float32))
        rospy.sleep(0.2)
        waited = []
        rospy.Timer(rospy.Duration(0.2), lambda _: publisher.publish(Floats([3.0])), oneshot=True)
        waited.append(rospy.wait_for_message("floats", numpy_msg(Floats), timeout=1000))
        return got[0], waited[0]

    arrays, waited = programs(main)
    assert isinstance(arrays.data, np.ndarray)
    assert arrays.data.tolist() == [1.0, 2.0]
    assert isinstance(arrays, Floats)
    assert isinstance(arrays, numpy_msg(Floats))
    assert waited.data.dtype == np.float32


def test_a_name_with_two_slashes_is_warned_of(programs):
    def main():
        rospy.init_node("main")
        with warnings.catch_warnings(record=True) as caught:
            warnings.simplefilter("always")
            made = [rospy.Publisher("a//b", String, queue_size=1), rospy.Subscriber("a//b", String)]
        return [topic.resolved_name for topic in made], [(str(w.message), w.filename) for w in caught]

    names, told = programs(main)
    assert names == ["/a/b", "/a/b"]
    assert len(told) == 2
    assert all("'a//b' is not a legal ROS graph resource name" in text for text, _ in told)
    assert {filename for _, filename in told} == {__file__}


def test_what_a_callback_raises_is_logged_with_place_topic_and_message(programs, log):
    def bad(message):
        raise ValueError("deliberate " + message.data)

    def main():
        rospy.init_node("main")
        publisher = rospy.Publisher("t", String, queue_size=1, latch=True)
        rospy.Subscriber("t", String, bad)
        publisher.publish("failure")
        rospy.sleep(0.2)

    programs(main)
    written = log.read().err
    for part in ("[ERROR]", "deliberate failure", "/t", "test_topics.py", "in bad", 'data: "failure"'):
        assert part in written


def test_publishing_after_the_shutdown_is_said_once(programs, log):
    def main():
        rospy.init_node("main")
        publisher = rospy.Publisher("t", String, queue_size=1)
        rospy.signal_shutdown("enough")
        publisher.publish("x")
        publisher.publish("x")

    programs(main)
    assert log.read().err.count("/main was shut down (enough)") == 1


@pytest.mark.parametrize("text", ["std_msgs/String", "std_msgs.msg.String", "std_msgs.String"])
def test_a_type_given_as_text_says_what_to_write(sim_programs, text):
    def main():
        rospy.init_node("main")
        for make in (
            lambda: rospy.Publisher("t", text, queue_size=1),
            lambda: rospy.Subscriber("t", text),
            lambda: rospy.wait_for_message("t", text, 1),
        ):
            with pytest.raises(ValueError, match=r"write `from std_msgs.msg import String` and give String itself"):
                make()
        for make in (
            lambda: rospy.Service("s", "std_srvs/Empty", print),
            lambda: rospy.ServiceProxy("s", "std_srvs.srv.Empty"),
        ):
            with pytest.raises(ValueError, match=r"write `from std_srvs.srv import Empty`"):
                make()
        for name in ("Fibonacci", "FibonacciAction"):
            with pytest.raises(ActionException, match=r"write `from actionlib_tutorials.msg import FibonacciAction`"):
                SimpleActionClient("a", f"actionlib_tutorials/{name}")
        with pytest.raises(ValueError, match=r"did you mean LaserScan"):
            rospy.Subscriber("t", "sensor_msgs/LaserScam")

    sim_programs(main)
