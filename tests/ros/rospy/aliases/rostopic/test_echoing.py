"""`rostopic.CallbackEcho`, with which scripts print messages."""

from __future__ import annotations

from typing import Any

import pytest

from rosmini.core.time import Time
from rosmini.msgs.geometry_msgs.msg import PoseStamped
from rosmini.msgs.std_msgs.msg import String
from rosmini.ros.rospy.aliases.rostopic import CallbackEcho, create_field_filter, msgevalgen

POSE = PoseStamped()
POSE.header.stamp, POSE.header.frame_id, POSE.pose.position.x = Time(5), "map", 1.5
TITLES = ",".join(["%time", "field.header.seq", "field.header.stamp", *(f"field.pose.position.{a}" for a in "xyz")])


@pytest.mark.parametrize(
    ("options", "message", "printed"),
    [
        ({}, String("hi"), 'data: "hi"\n---\n'),
        ({"msg_eval": msgevalgen("/pose/position/x")}, POSE, "1.5\n---\n"),
        ({"plot": True}, String("hi"), "%time,field.data\n7000000000,hi\n"),
        ({"plot": True, "field_filter_fn": create_field_filter(True, False)}, String("a"), "%time,\n7000000000,\n"),
        ({"filter_fn": lambda message: message.data == "x"}, String("hi"), ""),
        ({"echo_clear": True}, String("x"), '\033[2J\033[;Hdata: "x"\n---\n'),
        ({"value_transform_fn": lambda value, kind: f"{kind} {value.data}"}, String("x"), '"std_msgs/String x"\n---\n'),
        ({"fixed_numeric_width": 6, "msg_eval": msgevalgen("/pose/position/x")}, POSE, "1.5000\n---\n"),
    ],
)  # fmt: skip
def test_it_prints_a_message_as_the_options_ask(
    capsys: pytest.CaptureFixture[str], options: dict[str, Any], message: Any, printed: str
) -> None:
    echo = CallbackEcho("/topic", options.pop("msg_eval", None), **options)
    echo.callback(message, {"topic": "/topic", "type_information": message._type}, current_time=Time(7))
    assert capsys.readouterr().out == printed


def test_a_line_of_values_has_the_time_of_the_header_and_titles_once(capsys: pytest.CaptureFixture[str]) -> None:
    echo = CallbackEcho(
        "/p", None, plot=True, count=2, field_filter_fn=create_field_filter(echo_nostr=True, echo_noarr=False)
    )
    for _ in range(3):
        echo.callback(POSE, {"topic": "/p"})
    titles, *lines = capsys.readouterr().out.splitlines()
    assert titles.startswith(TITLES)
    assert [line.split(",")[:3] for line in lines] == [["5000000000", "0", "5000000000"]] * 2
    assert echo.done


def test_messages_of_other_topics_are_passed_over(capsys: pytest.CaptureFixture[str]) -> None:
    one, every = CallbackEcho("/a/data", msgevalgen("/data")), CallbackEcho("/", None, echo_all_topics=True)
    for topic in ("/a", "/b"):
        one.callback(String(topic), {"topic": topic})
    assert capsys.readouterr().out == '"/a"\n---\n'
    every.callback(String("x"), {"topic": "/b"})
    assert capsys.readouterr().out == 'data: "x"\n---\n'
