"""Bags of types that have changed since they were recorded."""

from __future__ import annotations

import re
from pathlib import Path
from typing import Any

import pytest

from rosmini.core.time import Time
from rosmini.msgs.geometry_msgs.msg import Polygon, PolygonStamped
from rosmini.msgs.std_msgs.msg import String
from rosmini.ros.bag import Bag, ROSBagException, fix_bag
from rosmini.ros.bag.tools import differences, migrated
from rosmini.ros.rospy.aliases.genpy.dynamic import generate_dynamic
from rosmini.tools.main import main

RULE = "=" * 80
REORDERED = f"""std_msgs/Header header
geometry_msgs/Polygon polygon
{RULE}
MSG: std_msgs/Header
uint32 seq
time stamp
string frame_id
{RULE}
MSG: geometry_msgs/Polygon
geometry_msgs/Point32[] points
{RULE}
MSG: geometry_msgs/Point32
float32 z
float32 y
float32 x
"""


def old(kind: str, text: str) -> Any:
    return generate_dynamic(kind, text)[kind]


def record(path: Path, *messages: Any) -> Path:
    with Bag(path, "w") as bag:
        for number, message in enumerate(messages):
            header = {
                "topic": "/t", "type": message._type, "md5sum": message._md5sum, "callerid": "/who",
                "message_definition": message._full_text,
            }  # fmt: skip
            bag.write("/t", message, Time(100 + number), connection_header=header)
    return path


def polygon() -> Any:
    classes = generate_dynamic("geometry_msgs/PolygonStamped", REORDERED)
    message = classes["geometry_msgs/PolygonStamped"]()
    message.header.frame_id, message.header.stamp = "map", Time(5)
    message.polygon.points = [classes["geometry_msgs/Point32"](x=1.0, y=2.0, z=3.0)]
    return message


def test_fields_keep_their_values_by_name_however_deep(tmp_path: Path) -> None:
    source = record(tmp_path / "old.bag", polygon(), polygon())
    fixed = fix_bag(source, tmp_path / "new.bag")
    assert (fixed.copied, fixed.obstacles) == ((2, 2), {})
    with Bag(tmp_path / "new.bag") as bag:
        (conn,) = bag.connections()
        assert (conn.md5sum, conn.caller) == (PolygonStamped._md5sum, "/who")
        first, second = bag.read_messages()
    assert (first.timestamp, second.timestamp) == (Time(100), Time(101))
    (point,) = first.message.polygon.points
    assert (point.x, point.y, point.z) == (1.0, 2.0, 3.0)
    assert (first.message.header.frame_id, first.message.header.stamp) == ("map", Time(5))


def test_what_does_not_go_together_is_named_and_nothing_is_written(tmp_path: Path) -> None:
    source = record(tmp_path / "old.bag", old("std_msgs/String", "int32 data\nstring lost")(data=3, lost="x"))
    target = tmp_path / "new.bag"
    fixed = fix_bag(source, target)
    assert fixed.copied is None
    [(changed, gone)] = fixed.obstacles.values()
    assert re.findall("data|int32|string", changed) == ["data", "int32", "string"]
    assert re.findall("data|lost", gone) == ["lost"]
    assert [path.name for path in tmp_path.iterdir()] == ["old.bag"]
    assert fix_bag(source, target, force=True).copied == (1, 1)
    with Bag(target) as bag:
        assert [message.data for _, message, _ in bag.read_messages()] == [""]


def test_what_is_not_changed_or_unknown_stays_as_it_is(tmp_path: Path) -> None:
    unknown = old("far_away/Thing", "int32 x")(x=7)
    source = record(tmp_path / "old.bag", String("same"), unknown)
    assert fix_bag(source, tmp_path / "new.bag").copied == (2, 2)
    with Bag(source) as before, Bag(tmp_path / "new.bag") as after:
        assert [message.data for message in after.read_raw()] == [message.data for message in before.read_raw()]
        assert [conn.raw for conn in after.connections()] == [conn.raw for conn in before.connections()]


def test_differences_and_messages() -> None:
    new_field = old("std_msgs/String", "string data\nfloat64 more")
    assert differences(String, new_field) == ["the field more is new"]
    assert differences(String, String) == []
    assert migrated(String("a"), new_field).data == "a"
    array = old("geometry_msgs/Polygon", f"geometry_msgs/Point32 points\n{RULE}\nMSG: geometry_msgs/Point32\nfloat32 x")
    (changed,) = differences(array, Polygon)
    assert "points" in changed
    assert re.findall(r"geometry_msgs\S+", changed) == ["geometry_msgs/Point32", "geometry_msgs/Point32[]"]


def test_a_bag_is_not_written_over_itself(tmp_path: Path) -> None:
    source = record(tmp_path / "old.bag", String("same"))
    with pytest.raises(ROSBagException, match="same file"):
        fix_bag(source, source)


def test_the_command(tmp_path: Path, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]) -> None:
    monkeypatch.chdir(tmp_path)
    record(tmp_path / "old.bag", polygon())
    record(tmp_path / "hard.bag", old("std_msgs/String", "int32 data")(data=3))
    assert main(["rosbag", "fix", "old.bag", "new.bag"]) == 0
    assert capsys.readouterr().out == "Bag migrated successfully.\n"
    assert main(["rosbag", "check", "new.bag"]) == 0
    capsys.readouterr()
    assert main(["rosbag", "fix", "hard.bag", "x.bag"]) == 1
    said = capsys.readouterr().err
    assert said.startswith(
        "Bag could not be migrated.  The following migrations could not be performed:\n * From: std_msgs/"
    )
    assert "the field data was int32 and is string" in said
    assert main(["rosbag", "fix", "--force", "hard.bag", "x.bag"]) == 0
    for words, status, problem in (
        ([], 2, "You must pass input and output bag files."), (["a.bag"], 2, "You must pass an output bag file."),
        (["old.bag", "x.txt"], 2, "Output file must be a bag file."),
        (["old.bag", "x.bag", "rules.bmr"], 2, "rule files are programs"),
        (["none.bag", "x.bag"], 1, "ERROR reading none.bag"),
    ):  # fmt: skip
        capsys.readouterr()
        assert main(["rosbag", "fix", *words]) == status
        assert problem in capsys.readouterr().err
