"""The Master alone; tests/interop/test_master_replies.py compares each answer with a real rosmaster."""

import pytest
from hypothesis import given
from hypothesis import strategies as st

from rosmini.core.graph.master import Master

ONE, TWO, THREE = "http://h:1/", "http://h:2/", "http://h:3/"


class Heard(list):
    """A notifier that writes down what it is told."""

    def publisher_update(self, caller_api, topic, uris) -> None:
        self.append(("publisherUpdate", caller_api, topic, uris))

    def param_update(self, caller_api, key, value) -> None:
        self.append(("paramUpdate", caller_api, key, value))

    def shutdown(self, caller_api, reason) -> None:
        self.append(("shutdown", caller_api, reason))

    def registrations_changed(self) -> None:
        pass


@pytest.fixture
def heard() -> Heard:
    return Heard()


@pytest.fixture
def master(heard: Heard) -> Master:
    return Master("http://h:11311/", heard)


def test_a_publisher_and_a_subscriber_find_each_other(master: Master, heard: Heard) -> None:
    answer = master.registerSubscriber("/listener", "/chatter", "std_msgs/String", TWO)
    assert answer == [1, "Subscribed to [/chatter]", []]
    answer = master.registerPublisher("/talker", "/chatter", "std_msgs/String", ONE)
    assert answer == [1, "Registered [/talker] as publisher of [/chatter]", [TWO]]
    assert heard == [("publisherUpdate", TWO, "/chatter", [ONE])]
    assert master.unregisterPublisher("/talker", "/chatter", ONE)[2] == 1
    assert heard[1:] == [("publisherUpdate", TWO, "/chatter", [])]
    assert master.lookupNode("/x", "/talker")[0] == -1
    assert master.lookupNode("/x", "/listener") == [1, "node api", TWO]


def test_a_second_node_of_the_same_name_ends_the_first(master: Master, heard: Heard) -> None:
    master.registerPublisher("/talker", "/chatter", "std_msgs/String", ONE)
    master.registerService("/talker", "/s", "rosrpc://h:5", ONE)
    master.registerSubscriber("/talker", "/cmd", "std_msgs/String", TWO)
    assert heard == [("shutdown", ONE, "[/talker] Reason: new node registered with same name")]
    assert master.getSystemState("/x")[2] == [[], [["/cmd", ["/talker"]]], []]
    assert master.lookupService("/x", "/s") == [-1, "no provider", ""]
    assert master.unregisterPublisher("/talker", "/chatter", ONE)[2] == 0


def test_any_type_never_hides_a_known_one(master: Master) -> None:
    master.registerPublisher("/a", "/t", "*", ONE)
    assert master.getTopicTypes("/x")[2] == [["/t", "*"]]
    master.registerPublisher("/b", "/t", "std_msgs/String", TWO)
    master.registerPublisher("/a", "/t", "*", ONE)
    assert master.getPublishedTopics("/x", "")[2] == [["/t", "std_msgs/String"]]


def test_listings_keep_the_order_of_registration(master: Master) -> None:
    for topic in ("/z", "/a", "/m"):
        master.registerPublisher("/n2", topic, "std_msgs/String", TWO)
        master.registerPublisher("/n1", topic, "std_msgs/String", ONE)
    assert master.getSystemState("/x")[2][0] == [[topic, ["/n2", "/n1"]] for topic in ("/z", "/a", "/m")]


def test_answers_cannot_reach_into_the_master(master: Master) -> None:
    master.setParam("/a", "/p", {"x": [1]})
    master.getParam("/a", "/p")[2]["x"].append(2)
    master.registerPublisher("/a", "/p", "bad type", ONE)[2].append("junk")
    assert master.getParam("/a", "/p")[2] == {"x": [1]}
    assert master.registerPublisher("/a", "/p", "bad type", ONE)[2] == []


def test_a_parameter_that_ros_cannot_hold_is_refused(master: Master) -> None:
    code, status, value = master.setParam("/a", "/p", {"q": 2**40})
    assert (code, value) == (-1, 0)
    assert "/p/q: 1099511627776 does not fit into 32 bits" in status
    assert master.setParam("/a", "/p", None) == [-1, "ERROR: parameter [value] must be specified", 0]
    assert master.hasParam("/a", "/p") == [1, "/p", False]


def test_the_setter_gets_no_echo(master: Master, heard: Heard) -> None:
    master.subscribeParam("/a", ONE, "/p")
    master.subscribeParam("/b", TWO, "/p")
    master.setParam("/a", "/p", 1)
    assert heard == [("paramUpdate", TWO, "/p/", 1)]
    del heard[:]
    master.deleteParam("/a", "/p")
    assert heard == [("paramUpdate", ONE, "/p/", {}), ("paramUpdate", TWO, "/p/", {})]


def test_shutdown_is_for_whoever_serves_the_master(master: Master) -> None:
    assert master.shutdown_reason is None
    assert master.shutdown("/a", "done") == [1, "shutdown", 0]
    assert master.shutdown_reason == "external shutdown request from [/a]: done"


METHODS = [
    "registerPublisher", "unregisterPublisher", "registerSubscriber", "unregisterSubscriber", "registerService",
    "unregisterService",
    "lookupService", "lookupNode", "getPublishedTopics", "getTopicTypes", "getSystemState", "getUri", "getPid",
    "shutdown", "setParam",
    "getParam", "hasParam", "deleteParam", "searchParam", "getParamNames", "subscribeParam", "unsubscribeParam",
]  # fmt: skip
anything = (
    st.none() | st.booleans() | st.integers() | st.floats() | st.text(max_size=4) | st.lists(st.integers(), max_size=2)
)
likely = st.sampled_from(
    ["/a", "/", "~", "~p", "a/b", ONE, "rosrpc://h:1", "*", "std_msgs/String", {}, {"a": {"b": 1}}]
)


@given(st.lists(st.tuples(st.sampled_from(METHODS), st.lists(likely | anything, max_size=5)), max_size=8))
def test_no_call_raises(calls) -> None:
    master = Master("http://h:11311/", Heard())
    for method, arguments in calls:
        code, status, value = getattr(master, method)(*arguments)
        assert code in (-1, 0, 1)
        assert isinstance(status, str)
        assert value is not None
