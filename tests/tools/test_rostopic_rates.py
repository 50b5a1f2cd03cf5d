"""`rostopic hz`, `delay` and `bw` measure what is there, in the words of the real ones."""

from __future__ import annotations

import re
import shlex
from collections.abc import Iterator
from typing import Any

import pytest

from rosmini import Graph
from rosmini.core.time import Duration
from rosmini.core.verbs import VerbError
from rosmini.msgs.geometry_msgs.msg import PoseStamped
from rosmini.msgs.std_msgs.msg import String
from rosmini.tools.rostopic import TOOL

from .transcripts import read


@pytest.fixture
def graph() -> Iterator[Graph]:
    with Graph() as made:
        made.log_class
        node = made.node("talker")
        chatter, poses = node.publisher("chatter", String), node.publisher("pose", PoseStamped)

        def pose(_event: Any) -> None:
            message = PoseStamped()
            message.header.stamp = node.now() - Duration.from_sec(0.05)
            poses.publish(message)

        node.timer(0.1, lambda _: chatter.publish("x" * 29))
        node.timer(0.2, pose)
        yield made


def run(graph: Graph, line: str) -> tuple[list[str], Any]:
    """What is printed, and the result."""
    said: list[str] = []
    result = TOOL.run(*shlex.split(line), graph=graph, say=said.append)
    return said, result


def form(text: str) -> str:
    """The text, with each number as N."""
    return re.sub(r"\d+(\.\d+)?", "N", text)


def test_the_rate_of_a_topic(graph: Graph) -> None:
    said, result = run(graph, "hz /chatter --duration 2")
    real = read("rostopic_hz")["rostopic hz /chatter"][0].splitlines()
    assert form("\n".join(said)) == form("\n".join(real[:5]))
    assert said[2] == "average rate: 10.000\n\tmin: 0.100s max: 0.100s std dev: 0.00000s window: 20"
    assert result.hz == pytest.approx(10.0)


def test_the_rates_of_two_topics(graph: Graph) -> None:
    said, result = run(graph, "hz -w 5 /chatter /pose --duration 2")
    real = read("rostopic_hz")["rostopic hz -w 5 /chatter /pose"][0].splitlines()
    assert said[:2] == real[:2]
    table = said[-1].splitlines()
    assert table[0].split() == real[2].split()
    assert table[2].split() == ["/chatter", "10.0", "0.1", "0.1", "0.0", "5"]
    assert table[3].split() == ["/pose", "5.0", "0.2", "0.2", "0.0", "5"]
    assert set(table[1]) == {"="}
    assert len(table[1]) == len(table[0]) == len(table[2])
    assert {topic: found.window for topic, found in result.topics.items()} == {"/chatter": 5, "/pose": 5}


def test_the_rate_of_some_messages(graph: Graph) -> None:
    _, result = run(graph, "hz /pose --filter 'm.header.seq % 2 == 0' --wall-time --duration 3")
    assert result.hz == pytest.approx(2.5)
    with pytest.raises(VerbError, match="did you mean"):
        run(graph, "hz /pose --filter 'm.headr' --duration 3")


def test_nothing_new(graph: Graph, capsys: pytest.CaptureFixture[str]) -> None:
    graph.node("silent").publisher("silence", String)
    said, result = run(graph, "hz /silence --duration 1")
    assert said == ["subscribed to [/silence]", "no new messages"]
    assert result.hz is None
    assert run(graph, "hz /nope --duration 0.5")[0] == []
    assert run(graph, "bw /nope --duration 0.5")[1].weight is None
    assert run(graph, "delay /nope --duration 0.5")[1].statistics is None
    real = read("rostopic_hz")["rostopic hz /nope"][0].splitlines()[0]
    assert capsys.readouterr().err.splitlines().count(real) == 3


def test_it_says_so_where_time_may_be_simulated(graph: Graph, capsys: pytest.CaptureFixture[str]) -> None:
    graph.ask_as("/test").ask("setParam", "/use_sim_time", True)
    run(graph, "hz /chatter --duration 0.1")
    assert "WARNING: may be using simulated time" in capsys.readouterr().err


def test_how_old_messages_are(graph: Graph) -> None:
    said, result = run(graph, "delay /pose --duration 2")
    real = read("rostopic_delay")["rostopic delay /pose"][0].splitlines()
    assert form("\n".join(said)) == form("\n".join(real[:5]))
    assert result.statistics.mean == pytest.approx(0.05)
    assert result.statistics.window == 10


def test_messages_without_a_header_have_no_age(graph: Graph, capsys: pytest.CaptureFixture[str]) -> None:
    said, result = run(graph, "delay /chatter --duration 0.35")
    assert said == ["subscribed to [/chatter]"]
    assert result.statistics is None
    assert "msg does not have header" in capsys.readouterr().err


def test_the_bandwidth_of_a_topic(graph: Graph) -> None:
    said, result = run(graph, "bw -w 10 /chatter --duration 2")
    real = read("rostopic_bw")["rostopic bw /chatter"][0].splitlines()
    assert form("\n".join(said)) == form("\n".join(real[:5]))
    assert result.weight.mean == 33.0
    assert result.weight.window == 10
