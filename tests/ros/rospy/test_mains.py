"""The command lines of ROS's modules, as scripts call them."""

from __future__ import annotations

import sys
from collections.abc import Iterator

import pytest

from rosmini import Graph, set_default_graph
from rosmini.ros.rospy.aliases.rosbag import rosbagmain
from rosmini.ros.rospy.aliases.rosparam import yamlmain


@pytest.fixture(autouse=True)
def graph() -> Iterator[Graph]:
    with Graph() as made:
        before = set_default_graph(made)
        yield made
        set_default_graph(before)


def test_they_print_what_the_tools_do(capsys: pytest.CaptureFixture[str], monkeypatch: pytest.MonkeyPatch) -> None:
    yamlmain(["rosparam", "set", "/rate", "10", "__name:=asking"])
    monkeypatch.setattr(sys, "argv", ["rosparam", "get", "/rate"])
    yamlmain()
    assert capsys.readouterr().out == "10\n"


def test_a_failure_is_an_exit_status(capsys: pytest.CaptureFixture[str]) -> None:
    for main, words, status in (
        (yamlmain, ["rosparam", "get", "/nothing"], 1),
        (yamlmain, ["rosparam", "lisst"], 2),
        (rosbagmain, ["rosbag", "info", "none.bag"], 1),
    ):
        with pytest.raises(SystemExit) as ended:
            main(words)
        assert ended.value.code == status
    said = capsys.readouterr().err
    assert "[/nothing] is not set" in said
    assert "did you mean list?" in said
    assert "none.bag" in said
