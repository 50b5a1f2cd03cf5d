"""The `gz` verbs act on a running server, by Gazebo's own topics."""

from __future__ import annotations

import re
from collections.abc import Callable
from pathlib import Path

import pytest

from rosmini import Graph
from rosmini.cli.gz import Gz, _factor
from rosmini.cli.main import main
from rosmini.cli.verbs import Prompt
from rosmini.errors import UsageError
from rosmini.markup import MarkupError
from rosmini.sim import sdf
from rosmini.sim.gazebo import GazeboError
from rosmini.sim.gazebo.msgs import Time, WorldStatistics
from rosmini.sim.gazebo.transport import FIRST_PORT

from ..sim.gazebo.conftest import LASER, Bench, box, urdf

Start = Callable[..., Bench]


def lines(gz: Prompt, *words: object) -> list[str]:
    """What a terminal would show."""
    return str(gz.run(*words)).split("\n")


def test_topics_are_listed_told_of_echoed_and_measured(bench: Start) -> None:
    there = bench()
    gz = Gz(there.graph)
    names = lines(gz, "topic", "-l")
    # in the namespace of the world's name
    assert {"/gazebo/empty/world_stats", "/gazebo/empty/pose/info", "/gazebo/empty/request"} <= set(names)
    stats = "/gazebo/empty/world_stats"
    there.server.client()
    info = lines(gz, "topic", "-i", stats)
    server, client = (
        FIRST_PORT,
        FIRST_PORT + 2,
    )  # each node has the next port: the server, `gz topic -l`, the client
    assert info == [
        "Type: gazebo.msgs.WorldStatistics",
        "",
        "Publishers:",
        f"\t127.0.0.1:{server}",
        "",
        "Subscribers:",
        f"\t127.0.0.1:{client}",
        "",
    ]
    echoed = lines(gz, "topic", "-e", stats, "-n", 1)
    assert echoed[0] == "sim_time {"
    assert "paused: false" in echoed
    (short,) = lines(gz, "topic", "-u", "-e", stats, "-n", 1)
    assert short.startswith("sim_time { sec: ")
    assert "} paused: false iterations: " in short
    assert lines(gz, "topic", "-z", "~/world_stats", "-d", 2) == ["Hz:   5.00"]
    with pytest.raises(GazeboError, match="did you mean"):
        gz.run("topic", "-i", "/gazebo/empty/world_stat")


def test_a_ray_sensor_has_a_topic_of_gazebos_own(bench: Start) -> None:
    there = bench()
    silent = LASER[: LASER.index("<plugin")] + "</sensor></gazebo>"  # no plugin tells ROS of it
    there.spawn(urdf(silent), "r")
    there.spawn(box(static=True), "wall", 2.2)
    gz = Gz(there.graph)
    topic = "/gazebo/empty/r/base_footprint/lidar/scan"
    assert topic in lines(gz, "topic", "-l")
    told = lines(gz, "topic", "-e", topic, "-n", 1)
    assert '  frame: "r::base_footprint"' in told
    ranges = [float(line.split(":")[1]) for line in told if line.startswith("  ranges")]
    assert (len(ranges), ranges[90]) == (181, pytest.approx(2.0))
    assert lines(gz, "topic", "-z", topic, "-d", 2) == ["Hz:  10.00"]
    gz.run("model", "-m", "r", "-d")
    assert topic not in lines(gz, "topic", "-l")


def test_a_model_is_told_of_moved_and_deleted(bench: Start) -> None:
    there = bench()
    there.spawn(box(), "crate", 1.0, 2.0)
    gz = Gz(there.graph)
    assert lines(gz, "model", "-m", "crate", "-p") == [
        "1.000000 2.000000 0.000000 0.000000 0.000000 0.000000"
    ]
    gz.run("model", "-m", "crate", "-x", 3, "-Y", 0.5)
    assert there.pose("crate") == pytest.approx((3.0, 0.0, 0.5))  # as in Gazebo: what is not said is 0
    told = lines(gz, "model", "-m", "crate", "-i")
    assert told[0] == 'name: "crate"'
    assert "is_static: false" in told
    gz.run("model", "-m", "crate", "-d")
    assert "crate" not in there.server.world.models
    with pytest.raises(
        GazeboError,
        match=r"Unable to get info on model\[crate\] in the world\[empty\]: there is no model 'crate'",
    ):
        gz.run("model", "-m", "crate", "-p")


def test_a_model_is_spawned_from_a_file(bench: Start, tmp_path: Path) -> None:
    there = bench()
    path = tmp_path / "box.sdf"
    path.write_text(box("chest"), encoding="utf-8")
    gz = Gz(there.graph)
    gz.run("model", "-f", path, "-m", "one", "-x", 1)
    gz.run("model", "-f", path, "-y", 2)
    assert there.pose("one")[0] == 1.0
    assert there.pose("chest")[1] == 2.0
    with pytest.raises(GazeboError, match="there is a model 'one' already"):
        gz.run("model", "-f", path, "-m", "one", "-x", 4)
    with pytest.raises(GazeboError, match="there is no file"):
        gz.run("model", "-f", tmp_path / "none.sdf")


def test_the_world_stands_is_stepped_and_reset(bench: Start, capsys: pytest.CaptureFixture[str]) -> None:
    there = bench()
    there.spawn(urdf(), "robot")
    there.drive("/cmd_vel", 0.2)
    there.graph.run(2.0)
    gz = Gz(there.graph)
    capsys.readouterr()
    gz("world", "-p", 1)
    assert capsys.readouterr().out == ""  # not so much as an empty line
    now = there.server.world.now
    there.graph.run(1.0)
    assert there.server.world.now == now
    gz.run("world", "-s")
    assert there.server.world.now == pytest.approx(now + 0.001)
    x = there.pose("robot")[0]
    gz.run("world", "-m", 500)
    assert there.server.world.now == pytest.approx(now + 0.501)
    assert there.pose("robot")[0] == pytest.approx(x + 0.1, abs=1e-6)
    gz.run("world", "-o")
    assert there.pose("robot") == (0.0, 0.0, 0.0)
    assert there.server.world.now > 2.0
    gz.run("world", "-r")
    assert there.server.world.now == 0.0
    gz.run("world", "-p", 0)
    there.graph.run(1.0)
    assert there.server.world.now == pytest.approx(1.0, abs=0.01)
    with pytest.raises(UsageError, match="once or more often, not 0 times"):
        gz.run("world", "-m", 0)


def test_stats_tell_how_time_goes_on(bench: Start) -> None:
    there = bench()
    there.graph.run(1.0)
    told = lines(Gz(there.graph), "stats", "-d", 1.0)
    assert len(told) == 4  # the first of five messages says nothing of how fast time goes
    assert all(
        re.fullmatch(r"Factor\[1\.00\] SimTime\[[12]\.\d\d\] RealTime\[[12]\.\d\d\] Paused\[F\]", line)
        for line in told
    )
    told = lines(Gz(there.graph), "stats", "-p")
    assert told[0].startswith("# real-time factor")
    assert re.fullmatch(r"1\.00, {9}2\.\d{6}, {9}2\.\d{6}, F", told[1])


def test_topics_that_are_only_heard_are_listed_too(bench: Start) -> None:
    gz = Gz(bench().graph)
    assert {"/gazebo/empty/factory", "/gazebo/empty/model/modify"} <= set(lines(gz, "topic", "-l"))
    assert lines(gz, "topic", "-i", "~/factory")[0] == "Type: "


def test_how_fast_time_goes_is_told_over_the_last_messages() -> None:
    def told(sim: float, real: float) -> WorldStatistics:
        return WorldStatistics(Time.of(sim), Time(), Time.of(real), False, 0, 0)

    assert _factor([told(0.0, 0.0), told(1.0, 2.0), told(3.0, 4.0)]) == pytest.approx(4 / 6)
    assert _factor([told(1.0, 1.0), told(1.0, 1.0)]) is None


def test_files_are_checked_and_printed(tmp_path: Path) -> None:
    path = tmp_path / "robot.urdf"
    path.write_text(urdf().replace('<?xml version="1.0"?>\n', ""), encoding="utf-8")
    gz = Gz()
    assert lines(gz, "sdf", "-k", path)[-1] == "Check complete"
    text = str(gz.run("sdf", "-p", path))
    assert [link.name for link in sdf.load(text).models[0].links] == ["base_footprint", "left", "right"]
    path.write_text("<robot name='r'>\n<link nam='a'/></robot>", encoding="utf-8")
    with pytest.raises(MarkupError, match=r"robot\.urdf:2"):
        gz.run("sdf", "-k", path)


@pytest.mark.parametrize(
    ("words", "said"),
    [
        (("topc", "-l"), "did you mean topic?"),
        (("camera", "-l"), "is a command of the original tool, which rosmini does not have"),
        (("topic",), "say what to do"),
        (("model", "-p"), "which model?"),
        (("world", "-p", "2"), "invalid choice"),
        (("stats", "-q"), "unrecognized arguments: -q"),
    ],
)
def test_command_lines_that_make_no_sense(bench: Start, words: tuple[str, ...], said: str) -> None:
    with pytest.raises(UsageError, match=re.escape(said)):
        Gz(bench().graph).run(*words)


def test_without_a_server_it_says_how_to_start_one(graph: Graph) -> None:
    with pytest.raises(GazeboError, match=r"not running: there is no Master at http://localhost:11345"):
        Gz(graph).run("topic", "-l")


def test_the_command(capsys: pytest.CaptureFixture[str]) -> None:
    assert main(["gz", "topic", "-l", "+", "gazebo_ros/gzserver", "room"]) == 0
    assert "/world_stats" in capsys.readouterr().out
    assert main(["gz", "topic", "-l"]) == 1
    assert "name it after a +" in capsys.readouterr().err
    assert main(["gz", "topc"]) == 255
    assert "did you mean topic?" in capsys.readouterr().err
    assert main(["gz", "help"]) == 0
    assert "stats" in capsys.readouterr().out
    for verb, word in (("topic", "--list"), ("model", "--spawn-file"), ("world", "--pause")):
        assert main(["gz", verb, "--help"]) == 0
        assert word in capsys.readouterr().out


@pytest.mark.parametrize("verb", ["topic", "model", "world", "stats", "sdf"])
def test_help_has_an_example(verb: str) -> None:
    from rosmini.cli.gz import TOOL

    assert f"for example: rosmini gz {verb} -" in " ".join(str(TOOL.run(verb, "-h")).split())
