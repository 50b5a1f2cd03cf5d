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
