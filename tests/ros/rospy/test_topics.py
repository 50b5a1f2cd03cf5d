"""Publishers and subscribers as scripts use them."""

from __future__ import annotations

import itertools
import warnings

import numpy as np
import pytest

from rosmini.core.actionlib import ActionException
from rosmini.msgs.geometry_msgs.msg import PointStamped, Twist
from rosmini.msgs.rospy_tutorials.msg import Floats
from rosmini.msgs.sensor_msgs.msg import Image, LaserScan
from rosmini.msgs.std_msgs.msg import Header, Int32, String
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


def test_publish_takes_a_message_its_fields_or_keywords(programs):
    def main():
        rospy.init_node("main")
        heard = []
        publisher = rospy.Publisher("t", Twist, queue_size=10)
        rospy.Subscriber(
            "t", Twist, lambda message, extra: heard.append((message.linear.x, extra)), callback_args="extra"
        )
        rospy.sleep(0.2)
        message = Twist()
        message.linear.x = 1.0
        publisher.publish(message)
        message.linear.x = 2.0
        publisher.publish(message.linear, message.angular)
        publisher.publish(linear=message.linear)
        publisher.publish()
        rospy.sleep(0.2)
        for arguments, keywords, problem in (
            ((String("x"),), {}, "std_msgs/String"),
            ((1, 2, 3), {}, "3"),
            ((message,), {"linear": message.linear}, "not both"),
            ((), {"linaer": 1}, "linear"),
        ):
            with pytest.raises((TypeError, AttributeError), match=problem):
                publisher.publish(*arguments, **keywords)
        return heard

    assert programs(main) == [(1.0, "extra"), (2.0, "extra"), (2.0, "extra"), (0.0, "extra")]


def test_a_field_of_the_wrong_type_is_a_serialization_exception(programs):
    def main():
        rospy.init_node("main")
        publisher = rospy.Publisher("t", Int32, queue_size=1)
        with pytest.raises(rospy.ROSSerializationException, match="data"):
            publisher.publish("seven")

    programs(main)


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


def test_a_missing_queue_size_is_warned_of(programs):
    def main():
        rospy.init_node("main")
        with warnings.catch_warnings(record=True) as caught:
            warnings.simplefilter("always")
            rospy.Publisher("t", String)
            rospy.Publisher("u", String, queue_size=0)
        return [(one.category, "queue_size" in str(one.message), one.filename) for one in caught]

    assert programs(main) == [(SyntaxWarning, True, __file__)]


@pytest.mark.parametrize("make", [lambda *a: rospy.Publisher(*a, queue_size=1), rospy.Subscriber])
@pytest.mark.parametrize(
    ("arguments", "problem"),
    [
        (("", String), "non-empty string"),
        ((3, String), "non-empty string"),
        (("t", None), "not initialized"),
        (("t", String()), "is not a class"),
        (("t", int), "not a message data class"),
        (("bad name", String), "bad name"),
    ],
)
def test_bad_arguments_of_topics(sim_programs, make, arguments, problem):
    def main():
        rospy.init_node("main")
        make(*arguments)

    with pytest.raises(ValueError, match=problem):
        sim_programs(main)


@pytest.mark.parametrize("keywords", [{"queue_size": 0}, {"queue_size": "1"}, {"buff_size": 0}, {"buff_size": 1.5}])
def test_bad_sizes_of_subscribers(sim_programs, keywords):
    def main():
        rospy.init_node("main")
        rospy.Subscriber("t", String, print, **keywords)

    with pytest.raises(rospy.ROSException, match="size"):
        sim_programs(main)


def test_latched_messages_reach_late_subscribers_and_second_ones(programs):
    def talker():
        rospy.init_node("talker")
        rospy.Publisher("t", String, queue_size=1, latch=True).publish("kept")
        rospy.spin()

    def main():
        rospy.init_node("main")
        rospy.sleep(0.3)
        heard = []
        first = rospy.Subscriber(
            "t", String, lambda message: heard.append(("first", message._connection_header["latching"]))
        )
        rospy.sleep(0.3)
        rospy.Subscriber("t", String, lambda message: heard.append(("second", message.data)))
        rospy.sleep(0.3)
        assert first.get_num_connections() == 1
        first.unregister()
        first.unregister()
        assert first.get_num_connections() == 0
        return heard

    assert programs(talker, main) == [("first", "1"), ("second", "kept")]


def test_of_a_lost_message_it_is_said_what_a_script_can_do(programs, capfd):
    def main():
        rospy.init_node("main")
        rospy.Publisher("t", String, queue_size=10).publish("lost")
        rospy.sleep(0.1)

    programs(main)
    said = "".join(capfd.readouterr())
    assert "wait while get_num_connections() is 0" in said
    assert "wait_for_subscribers" not in said


def test_connections_are_counted_and_listeners_hear_of_them(programs):
    events = []

    class Listener(rospy.SubscribeListener):
        def peer_subscribe(self, topic_name, topic_publish, peer_publish):
            events.append(("came", topic_name))
            peer_publish("to you")
            topic_publish(String("to all"))

        def peer_unsubscribe(self, topic_name, num_peers):
            events.append(("went", topic_name, num_peers))

    def heard(name):
        return [event for event in events if event[0] == name]

    def until(condition):
        while not condition():
            rospy.sleep(0.05)

    counts = []

    def hears(name, comes, goes):
        def listener():
            rospy.init_node(name)
            until(comes)
            subscriber = rospy.Subscriber("t", String, lambda message: events.append((name, message.data)))
            until(goes)
            subscriber.unregister()
            rospy.spin()

        return listener

    def main():
        rospy.init_node("main")
        publisher = rospy.Publisher("t", String, subscriber_listener=Listener(), queue_size=10)
        until(lambda: len(heard("a") + heard("b")) == 5)
        counts.append(publisher.get_num_connections())
        until(lambda: len(heard("went")) == 2)
        counts.append(publisher.get_num_connections())
        publisher.unregister()
        with pytest.raises(rospy.ROSException, match="unregister"):
            publisher.publish("x")
        return counts

    first = hears("a", lambda: True, lambda: counts)
    second = hears("b", lambda: len(heard("a")) == 2, lambda: heard("went"))
    assert programs(first, second, main) == [2, 0]
    assert heard("a") == [("a", "to you"), ("a", "to all"), ("a", "to all")]
    assert heard("b") == [("b", "to you"), ("b", "to all")]
    assert heard("went") == [("went", "/t", 1), ("went", "/t", 0)]


def test_receipt_types_are_those_of_rospy(programs):
    def main():
        rospy.init_node("main")
        got = []
        rospy.Subscriber("scan", LaserScan, got.append)
        rospy.Subscriber("image", Image, got.append)
        scan = rospy.Publisher("scan", LaserScan, queue_size=1, latch=True)
        image = rospy.Publisher("image", Image, queue_size=1, latch=True)
        scan.publish(LaserScan(ranges=[1.0, 2.0]))
        rospy.sleep(0.2)
        image.publish(Image(data=b"\x01\x02"))
        rospy.sleep(0.2)
        return [(type(got[0].ranges), got[0].ranges + got[0].ranges), (type(got[1].data), got[1].data[0])]

    assert programs(main) == [(tuple, (1.0, 2.0, 1.0, 2.0)), (bytes, 1)]


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


def test_numpy_msg_deserializes_arrays():
    data = Floats._encode(Floats([1.0, 2.0]))
    arrays = numpy_msg(Floats)()
    assert arrays.deserialize(data) is arrays
    assert isinstance(arrays.data, np.ndarray)
    assert (arrays.data.dtype, arrays.data.tolist(), arrays.data.flags.writeable) == (np.float32, [1.0, 2.0], False)
    assert Floats().deserialize(data).data == (1.0, 2.0)


def test_any_msg_takes_everything(programs):
    def main():
        rospy.init_node("main")
        got = []
        rospy.Publisher("t", String, queue_size=1, latch=True).publish("hello")
        rospy.Subscriber("t", rospy.AnyMsg, got.append)
        rospy.sleep(0.2)
        with pytest.raises(ValueError, match="AnyMsg"):
            rospy.Publisher("u", rospy.AnyMsg, queue_size=1)
        return got[0]

    message = programs(main)
    assert message._buff == b"\x05\x00\x00\x00hello"
    assert message._connection_header["type"] == "std_msgs/String"
    assert String().deserialize(message._buff).data == "hello"
    assert not message._has_header


@pytest.mark.parametrize("first", [String, rospy.AnyMsg])
def test_any_msg_beside_a_typed_subscriber_is_the_first_ones(programs, first):
    """rospy has one connection for both, with the class of whoever came first."""

    def main():
        rospy.init_node("main")
        got = []
        for data_class in (first, rospy.AnyMsg, String):
            rospy.Subscriber("t", data_class, got.append)
        publisher = rospy.Publisher("t", String, queue_size=1)
        rospy.sleep(0.2)
        publisher.publish("hello")
        rospy.sleep(0.2)
        return got

    got = programs(main)
    assert [type(message) for message in got] == [first] * 3
    assert got[0] is got[1] is got[2]


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


def test_headers_are_stamped_with_a_sequence(programs):
    def main():
        rospy.init_node("main")
        got = []
        publisher = rospy.Publisher("t", PointStamped, queue_size=10)
        rospy.Subscriber("t", PointStamped, got.append)
        rospy.sleep(0.2)
        for stamp in (rospy.Time(3), rospy.Time.now()):
            publisher.publish(PointStamped(header=Header(stamp=stamp)))
        rospy.sleep(0.2)
        return [message.header for message in got], rospy.Header

    headers, cls = programs(main)
    assert [header.seq for header in headers] == [1, 2]
    assert headers[0].stamp.secs == 3
    assert cls is Header


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


def test_wait_for_message(programs):
    def talker():
        rospy.init_node("talker")
        publisher = rospy.Publisher("t", String, queue_size=1)
        for count in range(20):
            rospy.sleep(0.1)
            publisher.publish(str(count))

    def main():
        rospy.init_node("main")
        message = rospy.wait_for_message("t", String, timeout=rospy.Duration(1000))
        with pytest.raises(rospy.ROSException, match=r"timeout exceeded.*/nothing.*nobody publishes"):
            rospy.wait_for_message("nothing", String, timeout=0.2)
        return message

    assert isinstance(programs(talker, main), String)


def test_publishing_after_the_shutdown_is_said_once(programs, log):
    def main():
        rospy.init_node("main")
        publisher = rospy.Publisher("t", String, queue_size=1)
        rospy.signal_shutdown("enough")
        publisher.publish("x")
        publisher.publish("x")

    programs(main)
    assert log.read().err.count("after node /main was shut down (enough)") == 1


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
