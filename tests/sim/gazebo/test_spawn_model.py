"""The script `gazebo_ros/spawn_model`, with the arguments that it has in Noetic."""

import math

import pytest

from rosmini.core.packages import PackageIndex
from rosmini.ros.scripts import ScriptSpec, run_scripts

from .conftest import box, urdf


def spawn_model(there, *words, stdin="", duration=20.0):
    """Its exit status."""
    path = PackageIndex().find_executable("gazebo_ros", "spawn_model").path
    spec = ScriptSpec(str(path), tuple(str(word) for word in words))
    return run_scripts([spec], graph=there.graph, stdin=stdin, duration=duration).status


def test_from_a_parameter_with_a_pose_and_a_namespace(bench):
    there = bench()
    there.node.set_param("/robot_description", urdf())
    place = ("-x", 1, "-y", -2, "-z", 0.1, "-Y", 0.5)
    assert (
        spawn_model(there, "-urdf", "-param", "robot_description", "-model", "r", *place, "-robot_namespace", "ns") == 0
    )
    assert there.pose("r") == pytest.approx((1.0, -2.0, 0.5))
    assert ["/ns/scan", "sensor_msgs/LaserScan"] in there.graph.master.getTopicTypes("/x")[2]


def test_its_own_namespace_is_the_robots(bench):
    there = bench()
    there.node.set_param("/tb/robot_description", urdf())
    assert spawn_model(there, "-urdf", "-param", "robot_description", "-model", "r", "__ns:=/tb") == 0
    assert ["/tb/scan", "sensor_msgs/LaserScan"] in there.graph.master.getTopicTypes("/x")[2]


def test_from_a_file_and_from_the_standard_input(bench, tmp_path):
    there = bench()
    path = tmp_path / "box.sdf"
    path.write_text(box(), encoding="utf-8")
    assert spawn_model(there, "-sdf", "-file", path, "-model", "a", "-x", 1) == 0
    assert spawn_model(there, "-sdf", "-stdin", "-model", "b", "-x", 2, stdin=box()) == 0
    assert spawn_model(there, "-sdf", "-file", path, "-model", "c", "-x", 1, "-reference_frame", "b") == 0
    assert [there.pose(name)[0] for name in "abc"] == [1.0, 2.0, 3.0]


def test_a_robot_whose_meshes_are_missing_comes_without_them(bench, tmp_path, capsys):
    there = bench()
    shapes = "".join(
        f'<{tag}><geometry><mesh filename="package://nowhere/{tag}.dae"/></geometry></{tag}>'
        for tag in ("visual", "collision")
    )
    path = tmp_path / "r.urdf"
    path.write_text(urdf().replace('<link name="laser"/>', f'<link name="laser">{shapes}</link>'), encoding="utf-8")
    assert spawn_model(there, "-urdf", "-file", path, "-model", "r") == 0
    there.drive("/cmd_vel", 0.2)
    there.graph.run(2.0)
    assert there.pose("r")[0] > 0.2
    said = "".join(capsys.readouterr())
    assert said.count("the model 'r' is incomplete") == 1
    assert said.count("there is no package 'nowhere'") == 2


def test_time_goes_on_afterwards(bench, tmp_path):
    there = bench("empty", "-u")
    path = tmp_path / "box.sdf"
    path.write_text(box(), encoding="utf-8")
    assert spawn_model(there, "-sdf", "-file", path, "-model", "a", "-unpause") == 0
    assert not there.server.world.paused


def test_it_waits_for_another_model(bench, tmp_path):
    there = bench()
    path = tmp_path / "box.sdf"
    path.write_text(box(), encoding="utf-8")
    there.spawn(box(), "first", 5.0)
    assert spawn_model(there, "-sdf", "-file", path, "-model", "a", "-wait", "first") == 0


def test_it_takes_the_model_along_when_it_ends(bench, tmp_path):
    there = bench()
    path = tmp_path / "box.sdf"
    path.write_text(box(), encoding="utf-8")
    spawn_model(there, "-sdf", "-file", path, "-model", "a", "-b", duration=2.0)
    assert "a" not in there.server.world.models


def test_failures_have_a_status_and_a_reason(bench, tmp_path, capsys):
    there = bench()
    assert spawn_model(there, "-sdf", "-file", tmp_path / "none", "-model", "a") == 1
    assert spawn_model(there, "-urdf", "-param", "none", "-model", "a") == 1
    assert spawn_model(there, "-sdf", "-stdin", "-model", "a", stdin="<sdf>") == 1
    assert "is still open" in "".join(capsys.readouterr())
    assert spawn_model(there, "-sdf", "-stdin", "-model", "a", stdin=box()) == 0
    assert spawn_model(there, "-sdf", "-stdin", "-model", "a", "-x", 3, stdin=box()) == 1
    assert "SpawnModel: Failure - entity already exists." in "".join(capsys.readouterr())
    assert spawn_model(there, "-sdf", "-model", "a") == 2
    assert math.isclose(there.pose("a")[0], 0.0)
