"""`rostopic pub` says what the real one does, and its messages arrive."""

from __future__ import annotations

import shlex
from collections.abc import Iterator
from typing import Any

import pytest

import rosmini.tools.main as cli
from rosmini import Graph
from rosmini.core.verbs import VerbError
from rosmini.msgs import message_class
from rosmini.tools.rostopic import TOOL

from .transcripts import read

REAL = read("rostopic_pub")


@pytest.fixture
def graph() -> Iterator[Graph]:
    with Graph() as made:
        yield made


def pub(graph: Graph, line: str) -> tuple[str, int, Any]:
    """What is printed on both streams, the exit status, and the result."""
    said: list[str] = []
    try:
        result = TOOL.run("pub", *shlex.split(line), graph=graph, say=said.append)
    except VerbError as error:
        return f"{error}\n", error.status, None
    return "".join(f"{text}\n" for text in said), result.status, result


def ear(graph: Graph, topic: str, kind: str) -> list[Any]:
    heard: list[Any] = []
    graph.node("ear").subscriber(topic, message_class(kind), lambda message: heard.append((graph.now(), message)))
    return heard


@pytest.mark.parametrize("value", ["'hello'", "'data: hello'"])
def test_one_message_stays_for_three_seconds(graph: Graph, value: str) -> None:
    heard = ear(graph, "/t1", "std_msgs/String")
    start = graph.now().to_sec()
    text, status, result = pub(graph, f"-1 /t1 std_msgs/String {value}")
    assert (text, status) == REAL[f"rostopic pub -1 /t1 std_msgs/String {value}"]
    assert graph.now().to_sec() == pytest.approx(start + 3.0)
    assert [message.data for _, message in heard] == ["hello"]
    assert (result.count, result.message.data) == (1, "hello")
    assert set(graph.nodes) == {"/rosout", "/ear"}


def test_messages_at_a_rate(graph: Graph) -> None:
    heard = ear(graph, "/cmd", "geometry_msgs/Twist")
    text, _, result = pub(graph, "-r 5 --duration 1 /cmd geometry_msgs/Twist '[0.1, 0, 0]' '[0, 0, 0.5]'")
    assert text == ""
    assert result.count == 6
    assert [message.angular.z for _, message in heard] == [0.5] * len(heard)
    times = [when.to_sec() for when, _ in heard]
    assert times[-1] - times[-2] == pytest.approx(0.2)


def test_a_message_without_a_rate_is_latched(graph: Graph) -> None:
    line = "/cmd2 geometry_msgs/Twist '{linear: {x: 0.1}, angular: {z: 0.5}}'"
    text, _, _ = pub(graph, line)
    assert text == REAL[f"rostopic pub {line}"][0]
    text, _, _ = pub(graph, f"-v {line}")
    assert text.startswith("publishing and latching [linear: \n  x: 0.1\n")


def test_auto_and_now_are_times(graph: Graph) -> None:
    start = graph.now()
    _, _, result = pub(graph, "-1 /p geometry_msgs/PoseStamped '{header: auto, pose: {position: {x: 1}}}'")
    assert result.message.header.stamp == start
    _, _, result = pub(graph, "-1 /h std_msgs/Header '{stamp: now, frame_id: map}'")
    assert result.message.stamp > start
    heard = ear(graph, "/q", "geometry_msgs/PoseStamped")
    pub(graph, "-r 2 -s --use-rostime --duration 1 /q geometry_msgs/PoseStamped '{header: auto}'")
    stamps = [message.header.stamp.to_sec() for _, message in heard]
    assert stamps == sorted(set(stamps))


SAME_START = [
    "-1 /t1 std_msgs/Strin 'hello'", "-1 /cmd geometry_msgs/Twist '{linear: {w: 0.1}}'",
    "-1 /t1 std_msgs/Header auto",
]  # fmt: skip


@pytest.mark.parametrize("line", SAME_START)
def test_what_does_not_fit_is_said_as_the_real_one_does(graph: Graph, line: str) -> None:
    text, status, _ = pub(graph, line)
    real, code = REAL[f"rostopic pub {line}"]
    assert status == code
    first = real.splitlines()[0].rstrip(":")
    assert text.startswith(first)
    assert real.splitlines()[-1] in text


def test_a_value_of_the_wrong_kind(graph: Graph) -> None:
    """The real one says so only where somebody listens; we do at once."""
    text, status, _ = pub(graph, "-1 /t1 std_msgs/Float64 hello")
    assert status == 1
    assert "ERROR: Unable to publish message. One of the fields has an incorrect type:\n  std_msgs/Float64" in text
    assert text.endswith("msg file:\nfloat64 data\n")


def test_a_type_that_nobody_knows(graph: Graph) -> None:
    assert "did you mean String?" in pub(graph, "-1 /t1 std_msgs/Strin hello")[0]
    assert "ERROR: invalid message type: String" in pub(graph, "-1 /t1 String hello")[0]
    assert "ERROR: invalid message type: nope/Nope" in pub(graph, "-1 /t1 nope/Nope hello")[0]


def test_an_alias_bomb_is_refused(graph: Graph) -> None:
    levels = ["a: &a [x, x, x, x, x, x, x, x, x]"]
    levels += [f"{new}: &{new} [{', '.join([f'*{old}'] * 9)}]" for old, new in zip("abcdefg", "bcdefgh", strict=True)]
    with pytest.raises(Exception, match="values with its aliases"):
        TOOL.run("pub", "/t", "std_msgs/String", "\n".join(levels), graph=graph)


def test_values_below_zero_come_after_two_dashes(capsys: pytest.CaptureFixture[str]) -> None:
    words = "rostopic pub -1 --duration 0.2 -v /x std_msgs/Float64 -- -1.5 + rosmini_sim/simulator"
    assert cli.main(words.split()) == 0
    assert capsys.readouterr().out == "publishing and latching [data: -1.5] for 3.0 seconds\n"
