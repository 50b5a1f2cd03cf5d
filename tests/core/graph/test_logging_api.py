"""Log functions of a node: gates, loggers and their levels, the console that gathers."""

from __future__ import annotations

from pathlib import Path
from typing import TYPE_CHECKING, Any

import pytest

import rosmini
from rosmini import Graph
from rosmini.msgs.roscpp.srv import GetLoggers, SetLoggerLevel

from .conftest import settle, until

if TYPE_CHECKING:
    from collections.abc import Callable


TRYING = "Will keep trying"
"""What a node says whose Master does not answer."""


def texts(capsys: pytest.CaptureFixture[str]) -> list[str]:
    said = capsys.readouterr()
    lines = [line.partition("]: ")[2] for line in (said.out + said.err).splitlines()]
    return [line for line in lines if TRYING not in line]


# -- gates -------------------------------------------------------------------------------------------------------


LOOPS: list[tuple[Callable[[Any, int], None], list[str]]] = [
    (lambda node, n: node.loginfo(n, throttle=0.5), ["0", "3", "6", "9"]),
    (lambda node, n: node.logwarn(n, once=True), ["0"]),
    (lambda node, n: node.logerr(n // 4, identical=True), ["0", "1", "2"]),
    (lambda node, n: node.logfatal(n // 5, identical=True, throttle=0.5), ["0", "0", "1", "1", "1"]),
    (lambda node, n: node.loginfo(n // 5, identical=True, throttle=100), ["0", "1"]),
    (lambda node, n: node.loginfo("same", throttle=100), ["same"]),
]


@pytest.mark.parametrize(("log", "expected"), LOOPS)
def test_a_loop_of_ten_turns_at_5_hz(
    simulated: Graph, capsys: pytest.CaptureFixture[str], log: Callable[[Any, int], None], expected: list[str]
) -> None:
    node = simulated.node("node")
    for number in range(10):
        log(node, number)
        simulated.run(0.2)
    assert texts(capsys) == expected


def test_each_place_and_each_node_counts_alone(simulated: Graph, capsys: pytest.CaptureFixture[str]) -> None:
    one, two = simulated.node("one"), simulated.node("two")
    for _ in range(2):
        for node in (one, two):
            node.loginfo(node.name, once=True)
        one.loginfo("here", once=True)
    assert texts(capsys) == ["/one", "/two", "here"]


# -- loggers -----------------------------------------------------------------------------------------------------


def test_levels_are_set_at_run_time(graph: Graph, capsys: pytest.CaptureFixture[str]) -> None:
    node, client = graph.node("node"), graph.node("client")
    change = client.service_client("/node/set_logger_level", SetLoggerLevel)
    loggers = client.service_client("/node/get_loggers", GetLoggers)
    node.logdebug("unseen", logger="camera")
    change(logger="rosout.camera", level="debug")
    node.logdebug("seen 1", logger="camera")
    node.logdebug("seen 2", logger="camera.driver")
    node.logdebug("unseen")
    change(logger="rosout", level="Error")
    node.logwarn("unseen", logger="other")
    node.logdebug("seen 3", logger="camera")
    change(logger="rosout.camera", level="FATAL")
    node.logerr("unseen", logger="camera.driver")
    assert texts(capsys) == ["seen 1", "seen 2", "seen 3"]
    found = {logger.name: logger.level for logger in loggers().loggers}
    assert found == {
        "rosout": "ERROR", "rospy": "INFO", "rospy.client": "INFO", "rospy.core": "INFO", "rospy.init": "INFO",
        "rospy.internal": "INFO", "rosout.camera": "FATAL", "rosout.camera.driver": "FATAL", "rosout.other": "ERROR",
    }  # fmt: skip


def test_what_the_library_tells_of_itself_goes_to_the_file_only(
    simulated: Graph, capsys: pytest.CaptureFixture[str]
) -> None:
    node, console = simulated.node("node"), simulated.console()
    simulated.run(0.1)
    node.logger.log(8, "unseen", logger="rospy.internal")
    simulated.run(0.1)
    assert texts(capsys) == []
    assert console.messages == []


# -- the console -------------------------------------------------------------------------------------------------


def test_the_console_gathers_what_all_nodes_log(graph: Graph) -> None:
    nodes = [graph.node(name) for name in ("one", "two")]
    console = graph.console(limit=3)
    settle(graph)
    for number in range(2):
        for node in nodes:
            node.logwarn(f"{node.name} {number}")
    until(graph, lambda: console.total == 4)
    assert len(console.messages) == 3
    assert {message.msg for message in console.messages} < {"/one 0", "/two 0", "/one 1", "/two 1"}

    console.clear()
    assert (console.messages, console.total) == ([], 0)
    console.close()
    nodes[0].loginfo("unheard")
    graph.run(0.05)
    assert console.messages == []


def test_the_last_message_is_for_listeners_that_come_later(simulated: Graph) -> None:
    node = simulated.node("node")
    node.loginfo("lost")
    node.loginfo("kept")
    simulated.run(0.1)
    heard: list[Any] = []
    simulated.node("late").subscriber("/rosout", simulated.log_class, heard.append)
    simulated.run(0.1)
    assert [message.msg for message in heard] == ["kept"]


def test_each_place_of_a_built_in_node_is_throttled_by_itself(capsys):
    """The first of two different warnings of map_server once kept the second one quiet."""
    node = Graph().node("server")
    text = "for _ in range(3):\n    node.logwarn('one', throttle=5.0)\n    node.logwarn('two', throttle=5.0)\n"
    file = Path(rosmini.__file__).parent / "navigation" / "made_up.py"
    exec(compile(text, str(file), "exec"), {"node": node})
    assert [line.rpartition(" ")[2] for line in texts(capsys)] == ["one", "two"]
