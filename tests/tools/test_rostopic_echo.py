"""`rostopic echo` prints what the real one does: text, fields, arrays' parts, comma-separated values."""

from __future__ import annotations

import shlex
from collections.abc import Iterator
from contextlib import suppress
from typing import Any

import pytest
from hypothesis import given
from hypothesis import strategies as st

from rosmini import Graph
from rosmini.core.time import Time
from rosmini.core.verbs import Call, VerbError
from rosmini.msgs.geometry_msgs.msg import PoseStamped, Twist
from rosmini.msgs.nav_msgs.msg import Odometry
from rosmini.msgs.nav_msgs.msg import Path as PathMessage
from rosmini.msgs.sensor_msgs.msg import LaserScan
from rosmini.msgs.std_msgs.msg import String
from rosmini.ros.introspection.fields import FieldError, field_type, reader
from rosmini.tools.rostopic import TOOL

from .transcripts import read

REAL = read("rostopic_echo")
STAMP = Time(1795217964, 173303604)


def scan() -> LaserScan:
    made = LaserScan(angle_max=6.28, angle_increment=0.785, range_max=3.5)
    made.header.stamp, made.header.frame_id = STAMP, "base_scan"
    made.ranges = [1.0, 2.0, float("inf"), float("nan"), 0.5, 3.25, 1e-7, 123456.789]
    return made


def odom() -> Odometry:
    made = Odometry(child_frame_id="base_footprint")
    made.header.stamp, made.header.frame_id = STAMP, "odom"
    made.pose.pose.orientation.w = 1.0
    return made


def pose(x: float) -> PoseStamped:
    made = PoseStamped()
    made.header.stamp, made.header.frame_id = STAMP, "map"
    made.pose.position.x, made.pose.orientation.w = x, 1.0
    return made


@pytest.fixture
def graph() -> Iterator[Graph]:
    with Graph() as made:
        poser = made.node("poser")
        twist = Twist()
        twist.linear.x, twist.angular.z = 0.5, -0.25
        for topic, message in (("latched", twist), ("scan", scan()), ("odom", odom()), ("pose", pose(34.1))):
            poser.publisher(topic, type(message), latch=True).publish(message)
        poser.publisher("chatter", String, latch=True).publish("hello world 1795217958.3510606")
        made.run(0.1)
        yield made


def echo(graph: Graph, line: str) -> tuple[str, Any]:
    """What is printed on standard output, and the result."""
    said: list[str] = []
    result = TOOL.run("echo", *shlex.split(line), graph=graph, say=said.append)
    return "".join(f"{text}\n" for text in said), result


def test_a_filter_lets_some_messages_through(graph: Graph) -> None:
    publisher = graph.node("other").publisher("numbers", PoseStamped)
    numbers = iter(range(-3, 100))
    graph.nodes["/other"].timer(0.1, lambda _: publisher.publish(pose(next(numbers))))
    _, result = echo(graph, "-n 2 --filter 'm.pose.position.x > 0 and topic == \"/numbers\"' /numbers/pose/position/x")
    assert result.messages == (1.0, 2.0)
    assert "/numbers" not in str(graph.ask_as("/t").ask("getSystemState")[1])  # it has left


def test_fields_that_are_lists_of_messages(graph: Graph) -> None:
    plan = PathMessage(poses=[pose(1.0), pose(2.0), pose(3.0)])
    graph.nodes["/poser"].publisher("plan", PathMessage, latch=True).publish(plan)
    assert echo(graph, "-n 1 /plan/poses[1:]/pose/position/x")[0] == "[2.0, 3.0]\n---\n"
    assert echo(graph, "-n 1 /plan/poses[-1]/header/stamp/secs")[0] == "1795217964\n---\n"
    text, _ = echo(graph, "-n 1 -p /plan/poses[0]/pose/position")
    assert text.splitlines()[0] == "%time,field.x,field.y,field.z"


def test_it_ends_after_some_time_in_python(graph: Graph) -> None:
    start = graph.now().to_sec()
    assert len(echo(graph, "/chatter")[1].messages) == 1
    assert graph.now().to_sec() == pytest.approx(start + 5.0)
    assert echo(graph, "--duration 0.5 -n 0 /chatter")[1].messages == ()


def test_it_waits_for_a_topic(graph: Graph, capsys: pytest.CaptureFixture[str]) -> None:
    def late() -> None:
        node.sleep(1.0)
        node.publisher("later", String, latch=True).publish("here")

    node = graph.node("late")
    node.run(late)
    assert echo(graph, "-n 1 /later/data")[1].messages == ("here",)
    assert echo(graph, "-n 1 --duration 0.5 /chater")[1].messages == ()
    said = capsys.readouterr().err
    real = REAL["rostopic echo -n 1 /nope"][0]
    assert real.replace("/nope", "/later/data") in said
    assert "did you mean /chatter?" in said


def test_a_part_that_a_message_does_not_have(graph: Graph, capsys: pytest.CaptureFixture[str]) -> None:
    assert echo(graph, "--duration 0.5 /scan/ranges[99]")[1].messages == ()
    assert "index out of range: /ranges[99]" in capsys.readouterr().err
    with pytest.raises(VerbError, match=r"missing closing '\]'.*\n.*/scan/ranges\[0:3\]"):
        echo(graph, "/scan/ranges[1")
    with pytest.raises(VerbError, match="invalid slice argument 'x'"):
        echo(graph, "/scan/ranges[x]")


HOSTILE = ["__import__('os').system('true')", "m.__class__", "10**10**10", "m._connection_header", "m.data +"]


@pytest.mark.parametrize("expression", HOSTILE)
def test_filters_cannot_do_anything(graph: Graph, expression: str) -> None:
    with pytest.raises(VerbError, match="ERROR: --filter"):
        TOOL.run("echo", "-n", 1, "--filter", expression, "/chatter", graph=graph, say=lambda _: None)


def test_a_type_that_is_not_known_here(graph: Graph) -> None:
    graph.ask_as("/far").ask("registerPublisher", "/odd", "their_pkg/Odd", "http://127.0.0.1:1/")
    with pytest.raises(VerbError, match=r"Cannot load message class for \[their_pkg/Odd\]. Are your messages built?"):
        echo(graph, "/odd")


def test_in_a_terminal_nothing_is_kept_and_the_screen_is_cleared(graph: Graph) -> None:
    said: list[str] = []
    verb = TOOL.find("echo")
    given_words = verb.parser().parse(["-c", "-n", "1", "/chatter/data"])
    result = verb.act(given_words, Call(graph, said.append, said.append, lambda: ""))
    assert vars(result)["messages"] == ()
    assert said == ['\033[2J\033[;H"hello world 1795217958.3510606"\n---']


# -- paths -----------------------------------------------------------------------------------------------------------


@given(st.text(alphabet="abx/[]:-01 ", max_size=12))
def test_any_path_is_read_or_refused(path: str) -> None:
    with suppress(FieldError):
        assert reader(path)(scan()) is not None
    field_type("sensor_msgs/LaserScan", path)


@given(st.lists(st.one_of(st.none(), st.integers(-9, 9)), min_size=2, max_size=3))
def test_slices_are_those_of_python(numbers: list[int | None]) -> None:
    if len(numbers) == 3 and numbers[2] == 0:
        numbers[2] = 1
    text = ":".join("" if number is None else str(number) for number in numbers)
    message = LaserScan(ranges=[float(n) for n in range(8)])
    assert reader(f"/ranges[{text}]")(message) == message.ranges[slice(*numbers)]
