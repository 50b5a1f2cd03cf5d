"""What roswtf finds in launch files."""

from __future__ import annotations

from pathlib import Path

import pytest

from rosmini.core.packages import PackageIndex
from rosmini.ros.launch.wtf import launch_findings

from .workspace import make

ALL_THERE = '<node pkg="speaking" type="talker.py" name="talker"/><param name="rate" value="3"/>'


@pytest.fixture
def packages(tmp_path: Path) -> PackageIndex:
    folder = make(
        tmp_path,
        fine=ALL_THERE,
        bad=(
            '<node pkg="speakin" type="talker.py" name="a"/><node pkg="speaking" type="talkr.py" name="b" odd="1"/>'
            '<node pkg="turtlebot3_bringup" type="x" name="c"/><rosparam file="$(find speaking)/no.yaml"/>'
        ),
        far='<machine name="far" address="10.9.9.9"/><node pkg="speaking" type="talker.py" name="f" machine="far"/>',
        broken='<node pkg="speaking"/>',
        arguments='<arg name="which"/><node pkg="speaking" type="$(arg which)" name="talker"/>',
    )
    return PackageIndex([folder, *PackageIndex().paths])


def found(packages: PackageIndex, name: str, *args: str) -> dict[str, tuple[str, ...]]:
    words = ("speaking", f"{name}.launch", *args)
    return {each.rule: each.where for each in launch_findings(words, packages, {})}


def test_a_file_of_which_all_is_there(packages: PackageIndex) -> None:
    assert found(packages, "fine") == {}


def test_everything_that_is_missing_is_listed_with_its_place(packages: PackageIndex) -> None:
    listed = found(packages, "bad")
    missing = "\n".join(listed["launch_missing"])
    assert "package speakin (" in missing
    assert "did you mean speaking?" in missing
    assert "executable speaking/talkr.py (" in missing
    assert "no.yaml" in missing
    assert any("odd" in line for line in listed["launch_warnings"])


def test_nodes_of_other_machines_are_told_with_what_to_type_there(packages: PackageIndex) -> None:
    (line,) = found(packages, "far")["launch_elsewhere"]
    assert "ssh 10.9.9.9 rosrun speaking talker.py __name:=f" in line


@pytest.mark.parametrize(
    ("words", "text"),
    [
        (("speaking", "broken.launch"), "broken.launch:2: <node> tag is missing required attribute"),
        (("speaking", "fin.launch"), "fin.launch"),
        (("nowhere.launch",), "nowhere.launch"),
    ],
)
def test_a_file_that_cannot_be_read_is_a_finding(packages: PackageIndex, words: tuple[str, ...], text: str) -> None:
    (finding,) = launch_findings(words, packages, {})
    assert finding.rule == "launch_file"
    assert text in str(finding)


def test_arguments_are_given_as_to_roslaunch(packages: PackageIndex) -> None:
    assert found(packages, "arguments", "which:=talker.py") == {}
    assert found(packages, "arguments")["launch_missing"][0].startswith("arg which (")
