"""A log file per node: what is in it, when it ends, and what happens when the disk does not play along."""

from __future__ import annotations

import re
from pathlib import Path

import pytest

from rosmini import Graph
from rosmini.core.errors import RosminiError
from rosmini.core.graph.log_file import LogFile

RUN = "00000000-0000-0000-0000-000000000001"


def conversation(folder: Path, *, simulated: bool = True) -> dict[str, str]:
    """Two nodes that log; the files by their names."""
    with Graph(simulated=simulated, log_dir=folder) as graph:
        talker = graph.node("talker")
        camera = graph.node("camera", namespace="/robot1")
        talker.loginfo("hello")
        talker.logdebug("unseen")
        graph.run(0.25)
        camera.logwarn("two\nlines: größer")
        camera.logger.set_level("rosout", "debug")
        camera.logdebug("seen", logger="driver")
        camera.shutdown("enough")
        camera.loginfo("too late")
        talker.logfatal("over")
    return {path.name: path.read_text(encoding="utf-8") for path in sorted((folder / RUN).iterdir())}


def test_each_node_has_a_file(tmp_path: Path) -> None:
    files = conversation(tmp_path)
    assert list(files) == ["robot1-camera-3.log", "rosout-1.log", "talker-2.log"]
    assert files["talker-2.log"].splitlines() == [
        "[rospy.client][INFO] 1970-01-01 00:16:40,000: init_node, name[/talker]",
        "[rospy.init][INFO] 1970-01-01 00:16:40,000: ROS Slave URI: [http://rosmini:2/]",
        "[rosout][INFO] 1970-01-01 00:16:40,000: hello",
        "[rosout][CRITICAL] 1970-01-01 00:16:40,250: over",
        "[rospy.core][INFO] 1970-01-01 00:16:40,250: signal_shutdown [the graph was closed]",
    ]
    assert files["robot1-camera-3.log"].splitlines()[2:] == [
        "[rosout][WARNING] 1970-01-01 00:16:40,250: two",
        "lines: größer",
        "[rosout.driver][DEBUG] 1970-01-01 00:16:40,250: seen",
        "[rospy.core][INFO] 1970-01-01 00:16:40,250: signal_shutdown [enough]",
    ]


def test_simulated_time_gives_the_same_files_again(tmp_path: Path) -> None:
    assert conversation(tmp_path) == conversation(tmp_path)


def test_wall_time_gives_the_same_lines_at_other_times(tmp_path: Path) -> None:
    stamp = r"\d{4}-\d\d-\d\d \d\d:\d\d:\d\d,\d{3}"
    simulated, wall = conversation(tmp_path / "s"), conversation(tmp_path / "w", simulated=False)
    plain = {name: re.sub(stamp, "T", text) for name, text in wall.items()}
    assert plain == {name: re.sub(stamp, "T", text) for name, text in simulated.items()}
    assert "1970" not in wall["talker-2.log"]


def test_nothing_is_written_unless_somebody_asks(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.chdir(tmp_path)
    monkeypatch.setenv("HOME", str(tmp_path))
    monkeypatch.delenv("ROS_LOG_DIR", raising=False)
    with Graph() as graph:
        node = graph.node("node")
        node.loginfo("hello")
        assert graph.log_folder is None
        assert node.logger.path is None
    assert list(tmp_path.iterdir()) == []
    monkeypatch.setenv("ROS_LOG_DIR", str(tmp_path / "logs"))
    with Graph() as graph:
        assert graph.node("node").logger.path == tmp_path / "logs" / RUN / "node-2.log"


def test_a_node_that_takes_anothers_name_has_a_file_of_its_own(tmp_path: Path) -> None:
    with Graph(log_dir=tmp_path, strict=False) as graph:
        graph.node("twin")
        graph.node("twin").loginfo("the second")
        graph.run(0.1)
    first, second = ((tmp_path / RUN / f"twin-{number}.log").read_text(encoding="utf-8") for number in (2, 3))
    assert "new node registered with same name" in first
    assert "the second" in second
    assert "the second" not in first


def test_a_folder_that_cannot_be_made_is_an_error(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    (tmp_path / "file").write_text("", encoding="utf-8")
    with pytest.raises(RosminiError, match=r"cannot make the folder .* Set log_dir to a folder"):
        Graph(log_dir=tmp_path / "file")
    monkeypatch.setenv("ROS_LOG_DIR", str(tmp_path / "file"))
    with pytest.raises(RosminiError, match="Set the environment variable ROS_LOG_DIR"):
        Graph()


def test_a_full_disk_ends_the_file_and_not_the_node(capsys: pytest.CaptureFixture[str]) -> None:
    full = Path("/dev/full")
    if not full.exists():
        pytest.skip("this system has no /dev/full")
    file = LogFile(full, simulated=True)
    file.write("rosout", 2, 0, "one")
    file.write("rosout", 2, 0, "two")
    file.close()
    (line,) = capsys.readouterr().err.splitlines()
    assert line.startswith("[WARN] ") and "/dev/full " in line and line.endswith(": No space left on device")


def test_log_names_the_file_of_a_node_and_a_file_of_wall_time_is_continued(tmp_path: Path) -> None:
    """As `rosrun ... __log:=FILE` has it; roslaunch names the files of its nodes so."""
    path = tmp_path / "new" / "mine.log"
    for text in ("first", "second"):
        with Graph(simulated=False, log_dir=tmp_path) as graph:
            graph.node("talker", remappings={"__log": str(path)}).loginfo(text)
    assert re.findall(r"\[rosout\]\[INFO\] .*: (\w+)\n", path.read_text(encoding="utf-8")) == ["first", "second"]
    assert [found.name for found in (tmp_path / RUN).iterdir()] == ["rosout-1.log"]
