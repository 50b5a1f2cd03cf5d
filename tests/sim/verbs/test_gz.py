"""The `gz` verbs act on a running server."""

import re

import pytest

from rosmini.core.errors import UsageError
from rosmini.core.markup import MarkupError
from rosmini.sim import sdf
from rosmini.sim.gazebo.errors import GazeboError
from rosmini.sim.gazebo.topics import FIRST_PORT
from rosmini.sim.verbs.gz import Gz
from rosmini.tools.main import main

from ..gazebo.conftest import box, urdf


def lines(gz, *words):
    """What a terminal would show."""
    return str(gz.run(*words)).split("\n")


def test_topics_are_listed_shown_and_measured(bench):
    there = bench()
    gz = Gz(there.graph)
    names = lines(gz, "topic", "-l")
    # in the namespace of the world's name
    assert {"/gazebo/empty/world_stats", "/gazebo/empty/pose/info", "/gazebo/empty/request"} <= set(names)
    stats = "/gazebo/empty/world_stats"
    there.server.client()
    info = lines(gz, "topic", "-i", stats)
    server, client = FIRST_PORT, FIRST_PORT + 1
    assert info == [
        "Type: gazebo.msgs.WorldStatistics", "", "Publishers:", f"\t127.0.0.1:{server}", "", "Subscribers:",
        f"\t127.0.0.1:{client}", "",
    ]  # fmt: skip
    assert lines(gz, "topic", "-z", "~/world_stats", "-d", 2) == ["Hz:   5.00"]
    with pytest.raises(GazeboError, match="did you mean"):
        gz.run("topic", "-i", "/gazebo/empty/world_stat")


def test_a_model_is_shown_moved_and_deleted(bench):
    there = bench()
    there.spawn(box(), "crate", 1.0, 2.0)
    gz = Gz(there.graph)
    assert lines(gz, "model", "-m", "crate", "-p") == ["1.000000 2.000000 0.000000 0.000000 0.000000 0.000000"]
    gz.run("model", "-m", "crate", "-x", 3, "-Y", 0.5)
    assert there.pose("crate") == pytest.approx((3.0, 0.0, 0.5))  # as in Gazebo: the rest is 0
    gz.run("model", "-m", "crate", "-d")
    assert "crate" not in there.server.world.models
    with pytest.raises(GazeboError, match="there is no model 'crate'"):
        gz.run("model", "-m", "crate", "-p")


def test_a_model_is_spawned_from_a_file(bench, tmp_path):
    there = bench()
    path = tmp_path / "box.sdf"
    path.write_text(box("chest"), encoding="utf-8")
    gz = Gz(there.graph)
    gz.run("model", "-f", path, "-m", "one", "-x", 1)
    gz.run("model", "-f", path, "-y", 2)
    assert there.pose("one")[0] == 1.0
    assert there.pose("chest")[1] == 2.0
    with pytest.raises(GazeboError, match="entity already exists"):
        gz.run("model", "-f", path, "-m", "one", "-x", 4)
    with pytest.raises(GazeboError, match="there is no file"):
        gz.run("model", "-f", tmp_path / "none.sdf")


def test_the_world_stands_is_stepped_and_reset(bench, capsys):
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
    with pytest.raises(UsageError, match="at least 1, not 0"):
        gz.run("world", "-m", 0)


def test_stats_show_how_time_passes(bench):
    there = bench()
    there.graph.run(1.0)
    shown = lines(Gz(there.graph), "stats", "-d", 1.0)
    assert len(shown) == 4  # the first of five samples does not show a speed
    pattern = r"Factor\[1\.00\] SimTime\[[12]\.\d\d\] RealTime\[[01]\.\d\d\] Paused\[F\]"
    assert all(re.fullmatch(pattern, line) for line in shown)


def test_files_are_checked_and_printed(tmp_path):
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
def test_command_lines_that_make_no_sense(bench, words, said):
    with pytest.raises(UsageError, match=re.escape(said)):
        Gz(bench().graph).run(*words)


def test_without_a_server_it_says_how_to_start_one(graph):
    with pytest.raises(GazeboError, match=r"not running: there is no Master at http://localhost:11345"):
        Gz(graph).run("topic", "-l")


def test_the_command(capsys):
    assert main(["gz", "topic", "-l", "+", "gazebo_ros/gzserver", "room"]) == 0
    assert "/world_stats" in capsys.readouterr().out
    assert main(["gz", "topc"]) == 255
    assert "did you mean topic?" in capsys.readouterr().err
    assert main(["gz", "help"]) == 0
    assert "stats" in capsys.readouterr().out
    for verb, word in (("topic", "--list"), ("model", "--spawn-file"), ("world", "--pause")):
        assert main(["gz", verb, "--help"]) == 0
        assert word in capsys.readouterr().out
