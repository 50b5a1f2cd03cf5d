"""The report's commands of chapter 9 in cells, in its order; `test_shell` has those of 9.5 in terminals."""

import shutil

import pytest

from rosmini.core.packages import assets_dir

STAGE = "%roslaunch navigation_stage move_base_gmapping_5cm.launch"


@pytest.mark.nightly
def test_a_goal_and_exploration_on_stage(notebook, tmp_path, monkeypatch):
    """9.3 and 9.4: the launch files, the nodes that they start twice, the map that is saved, and the slips."""
    monkeypatch.chdir(tmp_path)
    notebook.ok("%load_ext rosmini")
    notebook.ok("%roscore")
    notebook.ok(STAGE)
    notebook.ok("import rosmini; rosmini.wait(3)")
    assert "new node registered with same name" in notebook.ok("%roslaunch navigation_stage move_base.xml")
    notebook.ok("rosmini.wait(1)")
    _, written = notebook.run("%roslaunch map_server map_saver -f my map")
    assert "rosrun map_server map_saver" in written
    notebook.ok("%rosrun map_server map_saver -f mymap\nrosmini.wait(1)")
    assert (tmp_path / "mymap.pgm").is_file()
    _, written = notebook.run("%roslaunch frontier-exploration global_map.launch")
    assert "did you mean frontier_exploration?" in written
    notebook.ok("%roslaunch frontier_exploration global_map.launch")
    _, written = notebook.run("%roslaunch explore_lite global_map.launch")
    assert "the package has explore.launch" in written
    notebook.ok("%roslaunch explore_lite explore.launch\nrosmini.wait(1)")
    there = notebook.ok("%rosnode list").split()
    assert {"/explore", "/explore_client", "/explore_server", "/slam_gmapping", "/stageros"} <= set(there)


def test_two_turtlebots(notebook, tmp_path, monkeypatch):
    """9.4.3: two robots in the house, and the keys of each."""
    shutil.copytree(assets_dir() / "workspaces" / "report_ws" / "src", tmp_path / "src")
    monkeypatch.setenv("ROS_PACKAGE_PATH", str(tmp_path / "src"))
    monkeypatch.setenv("TURTLEBOT3_MODEL", "burger")
    notebook.ok("%load_ext rosmini")
    notebook.ok("%roscore")
    notebook.ok("%roslaunch turtlebot3_ds my_multi_turtlebot3.launch\nimport rosmini; rosmini.wait(1)")
    for robot in ("tb3_0", "tb3_1"):
        notebook.ok(f"%roslaunch turtlebot3_ds turtlebot3_teleop_key_{robot}.launch\nrosmini.wait(0.2)")
    topics = notebook.ok("%rostopic list").split()
    assert {"/tb3_0/scan", "/tb3_1/scan", "/tb3_0/cmd_vel", "/tb3_1/cmd_vel"} <= set(topics)
