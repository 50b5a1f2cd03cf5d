"""`%save_package`: what it writes, and what it refuses."""

from rosmini.core.packages import read_package
from rosmini.notebook.saving import imports
from rosmini.ros.catkin import Workspace, make

NODE = """%%node drive.py
import numpy, math, os.path
import rospy
from geometry_msgs.msg import Twist
from notebook.msg import Num
from tf.transformations import euler_from_quaternion
"""


def write(notebook):
    notebook.ok("%%msg Num\nstd_msgs/Header header\nint64 num\n")
    notebook.ok("%%action Dock\nsensor_msgs/LaserScan scan\n---\n---\n")
    notebook.ok(NODE)
    notebook.ok(
        '%%launch go.launch\n<launch>\n  <node pkg="notebook" type="drive.py" name="drive"/>\n'
        '  <node pkg="rosmini_sim" type="simulator" name="sim"/>\n</launch>\n'
    )


def test_a_package_that_builds(notebook, tmp_path):
    write(notebook)
    source = tmp_path / "src"
    source.mkdir()
    written = notebook.ok(f"%save_package {source}")
    assert written.endswith("notebook: scripts/drive.py, launch/go.launch, msg/Num.msg, action/Dock.action\n")
    package = read_package(source / "notebook")
    assert {str(each) for each in package.depends} >= {
        "actionlib_msgs", "geometry_msgs", "message_generation", "message_runtime", "python3-numpy", "rospy",
        "rosmini_sim", "sensor_msgs", "std_msgs", "tf",
    }  # fmt: skip
    script = source / "notebook" / "scripts" / "drive.py"
    assert script.read_text(encoding="utf-8").startswith("#!/usr/bin/env python3\nimport numpy")
    report = make(Workspace.at(tmp_path), say=lambda text: None)
    assert (report.failed, [each for each in report.findings if each.is_error]) == ([], [])


def test_it_is_written_again_and_another_package_is_left_alone(notebook, tmp_path):
    write(notebook)
    notebook.ok(f"%save_package {tmp_path}")
    (tmp_path / "notebook" / "scripts" / "old.py").touch()
    notebook.ok(f'%save_package "{tmp_path}"')
    assert [path.name for path in (tmp_path / "notebook" / "scripts").iterdir()] == ["drive.py"]
    own = tmp_path / "mine" / "notebook"
    own.mkdir(parents=True)
    (own / "kept").touch()
    assert "already exists" in notebook.fails(f"%save_package {own.parent}")
    assert [path.name for path in own.iterdir()] == ["kept"]


def test_what_is_refused(notebook, tmp_path):
    assert "usage: %save_package FOLDER" in notebook.fails("%save_package")
    assert "no cell has written a file yet" in notebook.fails(f"%save_package {tmp_path}")
    write(notebook)
    (tmp_path / "file").touch()
    assert "choose a writable folder" in notebook.fails(f"%save_package {tmp_path}/file")


def test_imports():
    assert imports("import os, rospy as r\nfrom tf.x import y\nfrom . import z\nimport a.b.c") == {"rospy", "tf", "a"}
    assert imports("this is no Python") == set()
