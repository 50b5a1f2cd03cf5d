"""Our node and a real one under our roscore and under the real one: all that nodes do with one another."""

from __future__ import annotations

from pathlib import Path
from typing import TYPE_CHECKING, Any

import pytest

if TYPE_CHECKING:
    from .harness import Peer, Stage

pytestmark = pytest.mark.ros

Peers = tuple["Peer", "Peer"]
STRING = "std_msgs/String"
CONFIG = Path("/usr/lib/python3/dist-packages/dynamic_reconfigure/cfg/TestConfig.py")

SCAN = {
    "header": {"seq": 7, "stamp": {"secs": 12, "nsecs": 34}, "frame_id": "laser"},
    "angle_min": -1.5,
    "angle_max": 1.5,
    "angle_increment": 1.0,
    "time_increment": 0.0,
    "scan_time": 0.5,
    "range_min": 0.25,
    "range_max": 4.0,
    "ranges": [1.0, 2.5, 3.0, 0.5],
    "intensities": [],
}


def connect(first: Peer, second: Peer, topic: str, type: str, **options: Any) -> None:
    """Let the first publish to the second."""
    second.ask("subscribe", topic, type)
    first.ask("advertise", topic, type, **options)
    assert first.ask("connected", topic) == 1


def test_messages_arrive_in_order_and_complete(core: Stage, first_second: Peers) -> None:
    first, second = first_second
    topic = f"/scan{first.node}"
    connect(first, second, topic, "sensor_msgs/LaserScan")
    scans = [SCAN | {"scan_time": float(number), "header": SCAN["header"] | {"seq": number}} for number in range(1, 21)]
    first.ask("publish", topic, scans)
    assert second.ask("hear", topic, 20) == scans
    assert core.master("getTopicTypes").count([topic, "sensor_msgs/LaserScan"]) == 1
    first.ask("unadvertise", topic)
    core.wait_for(topic, "publishers")


def test_a_message_of_a_megabyte_arrives_whole(first_second: Peers) -> None:
    first, second = first_second
    topic = f"/large{first.node}"
    second.ask("subscribe", topic, STRING, what="size")
    first.ask("advertise", topic, STRING)
    assert first.ask("connected", topic) == 1
    first.ask("flood", topic, 1_000_000, 3)
    assert second.ask("hear", topic, 3) == [[1_000_000, 1]] * 3


def test_a_latched_message_waits_for_who_comes_late(first_second: Peers) -> None:
    first, second = first_second
    topic = f"/latched{first.node}"
    first.ask("advertise", topic, STRING, latch=True)
    first.ask("publish", topic, ["old"])
    first.ask("publish", topic, ["newest"])
    second.ask("subscribe", topic, STRING)
    assert second.ask("hear", topic) == [{"data": "newest"}]
    assert second.ask("header", topic)["latching"] == "1"


def test_the_connection_header_tells_who_publishes_what(first_second: Peers) -> None:
    first, second = first_second
    topic = f"/header{first.node}"
    first.ask("advertise", topic, STRING, latch=True)
    first.ask("publish", topic, ["text"])
    second.ask("subscribe", topic, what="header")  # of any type: md5sum=*
    (header,) = second.ask("hear", topic)
    assert {key: header[key] for key in ("callerid", "topic", "type", "md5sum", "latching", "message_definition")} == {
        "callerid": first.node,
        "topic": topic,
        "type": STRING,
        "md5sum": "992ce8a1687cec8c8bd883ec73ca41d1",
        "latching": "1",
        "message_definition": "string data\n",
    }


def test_a_subscriber_that_leaves_is_noticed(core: Stage, first_second: Peers) -> None:
    first, second = first_second
    topic = f"/leaves{first.node}"
    connect(first, second, topic, STRING)
    second.ask("unsubscribe", topic)
    assert first.ask("connected", topic, 0) == 0
    core.wait_for(topic, "subscribers")
    second.ask("subscribe", topic, STRING)
    first.ask("connected", topic)
    first.ask("publish", topic, ["again"])
    assert second.ask("hear", topic) == [{"data": "again"}]


INFO = {
    "camera_info": {
        "header": {"seq": 1, "stamp": {"secs": 2, "nsecs": 3}, "frame_id": "camera"},
        "height": 480,
        "width": 640,
        "distortion_model": "plumb_bob",
        "D": [0.5],
        "K": [float(number) for number in range(9)],
        "R": [float(number) for number in range(9)],
        "P": [float(number) for number in range(12)],
        "binning_x": 0,
        "binning_y": 0,
        "roi": {"x_offset": 1, "y_offset": 2, "height": 3, "width": 4, "do_rectify": True},
    }
}


@pytest.mark.parametrize("persistent", [False, True], ids=["once", "persistent"])
def test_services_answer(core: Stage, first_second: Peers, persistent: bool) -> None:
    first, second = first_second
    service, kind = f"/set_info_{persistent}{first.node}", "sensor_msgs/SetCameraInfo"
    first.ask("serve", service, kind, {"success": True, "status_message": "set"})
    answer = second.ask("call", service, kind, INFO, count=3, persistent=persistent)
    assert answer == {"success": True, "status_message": "set"}
    assert first.ask("hear", service, 3) == [INFO] * 3
    first.ask("stop_serving", service)
    core.wait_for(service, "services")


@pytest.mark.parametrize(
    ("answer", "text"),
    [("raise", "error processing request: not today"), (None, "service handler returned None")],
    ids=["raises", "none"],
)
def test_a_service_that_fails_says_why(first_second: Peers, answer: object, text: str) -> None:
    first, second = first_second
    service, kind = f"/fails_{answer}{first.node}", "sensor_msgs/SetCameraInfo"
    first.ask("serve", service, kind, answer)
    for persistent in (False, True):
        said = second.ask("call", service, kind, INFO, persistent=persistent)
        assert said["error"].startswith(f"service [{service}] responded with an error: ")
        assert text in said["error"]


def test_parameters_are_one_tree(first_second: Peers) -> None:
    first, second = first_second
    space = f"/tree{first.node}"
    values = {"int": -5, "float": 2.5, "text": "käse & <xml>", "flag": True, "list": [1, "two", [3.0]], "empty": {}}
    first.ask("param", "set_param", space, values)
    assert second.ask("param", "get_param", space) == values
    assert second.ask("param", "get_param", f"{space}/text") == values["text"]
    second.ask("param", "set_param", f"{space}/sub/deep", 7)
    assert first.ask("param", "get_param", f"{space}/sub") == {"deep": 7}
    assert second.ask("param", "has_param", f"{space}/nothing") is False
    assert "nothing" in second.ask("param", "get_param", f"{space}/nothing")["KeyError"]
    assert f"{space}/sub/deep" in second.ask("param", "get_param_names")
    second.ask("param", "delete_param", f"{space}/sub")
    assert first.ask("param", "has_param", f"{space}/sub/deep") is False


def test_a_cached_parameter_follows_the_other_node(first_second: Peers) -> None:
    first, second = first_second
    name = f"/cached{first.node}"
    first.ask("param", "set_param", name, 1)
    assert second.ask("param", "get_param_cached", name) == 1
    first.ask("param", "set_param", name, 2)
    assert second.ask("cached_becomes", name, 2) == 2


@pytest.mark.parametrize("goal", [21, -1], ids=["succeeds", "cancelled"])
def test_actions(first_second: Peers, goal: int) -> None:
    first, second = first_second
    name = f"act_{abs(goal)}{first.node}".replace("/", "_")
    first.ask("serve_action", name)
    expected = [3, 42, "there"] if goal > 0 else [2, 0, "cancelled"]
    assert second.ask("send_goal", name, goal, cancel=goal < 0) == expected


def test_a_client_waits_until_its_server_sends_to_it(pair: Peers) -> None:
    """rospy answers a subscriber before it sends to it, and nobody gets what it publishes in between."""
    ours, theirs = pair
    theirs.ask("serve_action", "late")
    theirs.ask("answer_late", "late/feedback", 0.5)
    assert ours.ask("send_goal", "late", -1, cancel=True) == [2, 0, "cancelled"]


@pytest.mark.parametrize("static", [False, True], ids=["moving", "static"])
def test_transforms(first_second: Peers, static: bool) -> None:
    first, second = first_second
    child = f"child_{static}{first.node}".replace("/", "_")
    if static:
        first.ask("send_transform", "world", child, 1.5, static=True)
    else:
        first.ask("broadcast", "world", child, 1.5)
    assert second.ask("look_up", "world", child) == 1.5


def test_dynamic_reconfigure(first_second: Peers) -> None:
    first, second = first_second
    first.ask("serve_config", str(CONFIG))
    number, text, names = second.ask("configure", first.node, {"int_": 3, "str_": "changed"})
    assert (number, text) == (3, "changed")
    assert "int_" in names
    assert "double_" in names
    assert first.ask("configured")[-1] == [3, "changed"]


def test_log_messages_reach_rosout_and_its_log(core: Stage, first_second: Peers) -> None:
    first, second = first_second
    for topic in ("/rosout", "/rosout_agg"):
        second.ask("subscribe", topic, "rosgraph_msgs/Log")
    core.wait_until_sent("/rosout", first.node, second.node)
    core.wait_until_sent("/rosout", first.node, "/rosout")
    core.wait_until_sent("/rosout_agg", "/rosout", second.node)
    text = f"a warning of {first.node}"
    first.ask("log", "warn", text)
    heard = second.ask("hear_until", "/rosout", "msg", text)
    assert (heard["name"], heard["level"], heard["function"]) == (first.node, 4, "log")
    gathered = second.ask("hear_until", "/rosout_agg", "msg", text)
    assert gathered | {"header": 0} == heard | {"header": 0}
    assert gathered["header"]["stamp"] == heard["header"]["stamp"]
    first.wait_for(r"\[WARN\] \[\d+\.\d+\]: " + text)
    for topic in ("/rosout", "/rosout_agg"):
        second.ask("unsubscribe", topic)
