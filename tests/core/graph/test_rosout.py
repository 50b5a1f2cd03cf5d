"""Log messages: to the console, to /rosout, and from there to /rosout_agg."""

from __future__ import annotations

import inspect
import weakref
from pathlib import Path
from typing import TYPE_CHECKING, Any

import pytest

from rosmini.core.errors import ServiceException
from rosmini.core.graph.rosout import LEVELS
from rosmini.msgs.roscpp.srv import SetLoggerLevel
from rosmini.ros.scripts import run_source

from .conftest import settle, until

if TYPE_CHECKING:
    from rosmini.core.graph import Graph

METHODS = {"DEBUG": "logdebug", "INFO": "loginfo", "WARN": "logwarn", "ERROR": "logerr", "FATAL": "logfatal"}


def test_levels_are_those_of_the_message(graph: Graph) -> None:
    cls = graph.log_class
    assert {name: getattr(cls, name) for name in LEVELS} == LEVELS


def test_a_log_message_says_where_the_users_code_stands(graph: Graph) -> None:
    heard: list[Any] = []
    graph.node("watcher").subscriber("/rosout", graph.log_class, heard.append)
    node = graph.node("node")
    node.publisher("chatter", graph.log_class)
    settle(graph)
    heard.clear()
    line = inspect.currentframe().f_lineno + 1  # type: ignore[union-attr]
    node.logwarn("look out")
    until(graph, lambda: [message for message in heard if message.name == "/node"])
    message = next(message for message in heard if message.name == "/node")
    assert (message.level, message.msg, message.name) == (4, "look out", "/node")
    assert Path(message.file).name == "test_rosout.py"
    assert message.function == "test_a_log_message_says_where_the_users_code_stands"
    assert message.line == line
    assert message.topics == ["/rosout", "/chatter"]
    assert message.header.stamp.to_sec() >= 1000
    assert message.header.seq >= 1


def test_what_a_caller_has_deleted_is_not_kept_by_what_it_logged(graph: Graph) -> None:
    class Thing:
        """Something large."""

    node, thing = graph.node("talker"), Thing()
    gone = weakref.ref(thing)
    node.logwarn("a word")
    del thing
    assert gone() is None


def test_everything_arrives_on_rosout_agg(graph: Graph) -> None:
    heard: list[Any] = []
    graph.node("watcher").subscriber("/rosout_agg", graph.log_class, heard.append)
    nodes = [graph.node(name) for name in ("one", "two")]
    settle(graph)
    heard.clear()  # a node whose Master does not answer at once says so
    for node in nodes:
        node.loginfo(f"I am {node.name}")
    until(graph, lambda: len(heard) >= 2)
    assert sorted((message.name, message.msg) for message in heard) == [("/one", "I am /one"), ("/two", "I am /two")]


@pytest.mark.parametrize("level", LEVELS)
def test_the_console_shows_level_time_and_text_on_rospys_streams(
    simulated: Graph, capsys: pytest.CaptureFixture[str], level: str
) -> None:
    node = simulated.node("node")
    node.logger.set_level("rosout", "debug")
    simulated.run(0.25)
    getattr(node, METHODS[level])("text")
    said = capsys.readouterr()
    stream, other = (said.out, said.err) if level in ("DEBUG", "INFO") else (said.err, said.out)
    assert stream == f"[{level}] [1000.250000]: text\n"
    assert other == ""


def test_an_unknown_level_is_refused(graph: Graph, capsys: pytest.CaptureFixture[str]) -> None:
    change = graph.node("client").service_client("/client/set_logger_level", SetLoggerLevel)
    with pytest.raises(ServiceException, match="no level 'loud': use one of DEBUG, INFO, WARN, ERROR, FATAL"):
        change(logger="rosout", level="loud")
    capsys.readouterr()


def test_what_is_logged_need_not_be_text(graph: Graph, capsys: pytest.CaptureFixture[str]) -> None:
    graph.node("node").loginfo({"a": 1})
    assert "{'a': 1}" in capsys.readouterr().out


def test_last_words_before_the_end_of_a_graph_are_no_error(capfd: pytest.CaptureFixture[str]) -> None:
    text = "import rospy\nrospy.init_node('talker')\nrospy.sleep(1)\nrospy.loginfo('goodbye')"
    run_source(text)
    shown = capfd.readouterr()
    assert "goodbye" in shown.out
    assert shown.err == ""


def test_the_collector_of_the_log_does_not_publish_on_what_it_collects(graph: Graph) -> None:
    published, subscribed, _ = graph.ask_as("/check").find("getSystemState")
    assert published == [["/rosout_agg", ["/rosout"]]]  # ROS's node has no log of its own on /rosout
    assert subscribed == [["/rosout", ["/rosout"]]]
    graph.nodes["/rosout"].logwarn("a word of its own")  # to the console, and it does not fail
