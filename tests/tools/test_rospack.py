"""`rosmini rospack`, `rosstack`, `rosversion`, `roscd` and `rosls` without a real ROS beside them."""

from __future__ import annotations

import os
from pathlib import Path

import pytest

from rosmini.core.verbs import VerbError
from rosmini.tools.main import main
from rosmini.tools.rospack import TOOL as ROSPACK

from ..core.packages.workspaces import a_workspace


@pytest.fixture
def workspace(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    monkeypatch.setenv("ROS_PACKAGE_PATH", str(a_workspace(tmp_path / "ws")))
    monkeypatch.delenv("ROS_WORKSPACE", raising=False)
    monkeypatch.delenv("CMAKE_PREFIX_PATH", raising=False)
    monkeypatch.chdir(tmp_path)
    return tmp_path / "ws"


@pytest.mark.parametrize(
    ("words", "says"),
    [
        (["find", "alpa"], "package 'alpa' not found\ndid you mean alpha"),
        (["depends", "mixd"], "no such package mixd\ndid you mean mixed"),
    ],
)
def test_an_error_says_what_to_do(workspace: Path, words: list[str], says: str) -> None:
    with pytest.raises(VerbError) as caught:
        ROSPACK.run(*words)
    assert str(caught.value).startswith("[rospack] Error: ")
    assert says in str(caught.value)


def test_a_broken_manifest_is_told_and_the_rest_is_listed(workspace: Path) -> None:
    (workspace / "gamma" / "package.xml").write_text("<package><name>", encoding="utf-8")
    result = ROSPACK.run("list-names")
    assert "alpha" in result.lines
    assert "gamma" not in result.lines
    assert [str(workspace / "gamma" / "package.xml") in each for each in result.complaints] == [True]


def test_needs_in_a_circle_come_to_an_end(workspace: Path) -> None:
    path = workspace / "gamma" / "package.xml"
    text = path.read_text(encoding="utf-8").replace("</package>", "<depend>mixed</depend></package>")
    path.write_text(text, encoding="utf-8")
    assert set(ROSPACK.run("depends", "mixed").lines) == {"alpha", "beta", "gamma"}


def test_dependencies_with_many_paths_are_listed_once(workspace: Path) -> None:
    manifest = (workspace / "gamma" / "package.xml").read_text(encoding="utf-8")
    for i in range(40):  # 2 ** 20 ways lead from the first to the last
        layer = i // 2
        needs = "".join(f"<depend>p{2 * (layer + 1) + side}</depend>" for side in (0, 1)) if layer < 19 else ""
        folder = workspace / f"p{i}"
        folder.mkdir()
        text = manifest.replace("gamma", f"p{i}").replace("</package>", f"{needs}</package>")
        (folder / "package.xml").write_text(text, encoding="utf-8")
    assert len(ROSPACK.run("depends", "p0").lines) == 38


def test_roscd_and_rosls(workspace: Path, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]) -> None:
    for words, printed in (
        (["roscd", "alpha"], f"{workspace / 'alpha'}\n"),
        (["roscd", "alpha/sub"], f"{workspace / 'alpha' / 'sub'}\n"),
        (["rosls", "alpha"], "package.xml\nsub\n"),
        (["rosls", "alpha/package.xml"], f"{workspace / 'alpha' / 'package.xml'}\n"),
        (["rosls"], "ws\n"),
    ):
        assert main(words) == 0
        assert capsys.readouterr().out == printed
    for words, says in (
        (["roscd", "alpa"], "No such package/stack 'alpa'; did you mean alpha"),
        (["roscd", "alpha/su"], "No such file or directory; did you mean sub"),
        (["roscd", "alpha/package.xml"], "is a file, not a folder"),
        (["roscd"], "Neither ROS_WORKSPACE is set"),
        (["rosls", "alpha/su"], "did you mean sub"),
    ):
        assert main(words) == 1
        assert says in capsys.readouterr().err
    devel = workspace / "devel"
    devel.mkdir()
    (devel / ".catkin").write_text("", encoding="utf-8")
    monkeypatch.setenv("CMAKE_PREFIX_PATH", os.pathsep.join(("/nowhere", str(devel))))
    assert main(["roscd"]) == 0
    assert capsys.readouterr().out == f"{devel}\n"
    monkeypatch.setenv("ROS_LOG_DIR", str(workspace))
    assert main(["roscd", "log"]) == 0
    assert capsys.readouterr().out == f"{workspace}\n"


def test_a_package_that_needs_what_every_robot_has(
    monkeypatch: pytest.MonkeyPatch, tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    """What `catkin_create_pkg example_pkg std_msgs rospy roscpp` writes is found without a real ROS."""
    monkeypatch.chdir(tmp_path)
    monkeypatch.setenv("ROS_PACKAGE_PATH", str(tmp_path))
    assert main(["catkin_create_pkg", "example_pkg", "std_msgs", "rospy", "roscpp"]) == 0
    assert ROSPACK.run("depends1", "example_pkg").lines == ("roscpp", "rospy", "std_msgs")
    assert {"rosgraph", "genpy", "message_runtime"} <= set(ROSPACK.run("depends", "example_pkg").lines)
    assert "example_pkg" in ROSPACK.run("depends-on1", "rospy").lines
    assert "example_pkg" in ROSPACK.run("depends-on", "genpy").lines
    for name in ("rospy", "roscpp", "catkin", "message_generation", "message_runtime", "actionlib", "tf", "tf2_ros"):
        assert ROSPACK.run("find", name).lines[0].endswith(name)
    capsys.readouterr()
    assert main(["rospack", "find", "rostime"]) == 1
    assert "a library for nodes in C++" in capsys.readouterr().err
