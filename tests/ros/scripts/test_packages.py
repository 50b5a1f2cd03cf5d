"""Scripts inside ROS packages, and the modules that they bring: what ``rosrun`` gives after sourcing a workspace."""

from __future__ import annotations

import sys

import pytest

from rosmini.ros.scripts import ScriptSpec, run_scripts

MANIFEST = """<package><name>{}</name><version>0.0.1</version><description>x</description>
<maintainer email="a@b.c">a</maintainer><license>x</license></package>"""

SCRIPT = """
import rospkg, roslib.packages, rospy
from my_pkg.msg import Speed
from my_pkg import double
import my_pkg.helper, tools.more
rospy.init_node("x")
print(double(Speed(1.5)).x, my_pkg.helper.thing is rospy.Time, tools.more.here)
print(rospkg.RosPack().get_path("my_pkg"))
print(roslib.packages.get_pkg_dir("my_pkg"))
"""


@pytest.fixture
def workspace(tmp_path, monkeypatch):
    """A workspace with a package of messages, scripts and Python packages, and one with a Python package only."""
    monkeypatch.delenv("ROS_PACKAGE_PATH", raising=False)
    monkeypatch.delenv("PYTHONPATH", raising=False)
    files = {
        "my_pkg/package.xml": MANIFEST.format("my_pkg"),
        "my_pkg/msg/Speed.msg": "float64 x\n",
        "my_pkg/src/my_pkg/__init__.py": "from .helper import double\n",
        "my_pkg/src/my_pkg/helper.py": "import rospy\nfrom std_msgs.msg import String\nfrom my_pkg.msg import Speed\n"
        "from .deeper import thing\ndef double(speed):\n    return Speed(2 * speed.x)\n",
        "my_pkg/src/my_pkg/deeper.py": "import rospy\nimport geometry_msgs.msg\nthing = rospy.Time\n",
        "my_pkg/src/tools/__init__.py": "",
        "my_pkg/src/tools/more.py": "import rospy\nhere = rospy.__name__\n",
        "my_pkg/src/random.py": "raise AssertionError('a script beside the packages is no module')\n",
        "my_pkg/scripts/x.py": SCRIPT,
        "other/package.xml": MANIFEST.format("other"),
        "other/src/other/__init__.py": "import rospy\nfrom my_pkg.msg import Speed\nvalue = Speed(7.0)\n",
        "folder/on_path.py": "import rospy\nfrom my_pkg.msg import Speed\nimport beside\nvalue = Speed(8.0)\n",
        "folder/beside.py": "from std_srvs.srv import Empty\n",
    }
    for name, text in files.items():
        path = tmp_path / "src" / name
        path.parent.mkdir(parents=True, exist_ok=True)
        path.write_text(text, encoding="utf-8")
    return tmp_path / "src"


def said(capsys, path):
    assert run_scripts([ScriptSpec(str(path))], stdin="", prefix=False).status == 0
    return capsys.readouterr().out.splitlines()


def test_a_script_in_a_package_finds_that_package_and_its_modules(workspace, capsys):
    lines = said(capsys, workspace / "my_pkg" / "scripts" / "x.py")
    assert lines == ["3.0 True rosmini.ros.rospy", *[str(workspace / "my_pkg")] * 2]
    assert "my_pkg" not in sys.modules


def test_a_package_of_a_sourced_workspace_gives_its_modules_too(workspace, capsys, monkeypatch):
    monkeypatch.setenv("ROS_PACKAGE_PATH", str(workspace))
    script = workspace / "alone.py"
    script.write_text("import random, other\nprint(other.value.x)\n", encoding="utf-8")
    assert said(capsys, script) == ["7.0"]


def test_a_module_on_pythonpath_may_import_rospy_and_messages(workspace, capsys, monkeypatch):
    monkeypatch.setenv("PYTHONPATH", str(workspace / "folder"))
    monkeypatch.syspath_prepend(str(workspace / "folder"))
    script = workspace / "my_pkg" / "scripts" / "y.py"
    script.write_text("import on_path\nprint(on_path.value.x)\n", encoding="utf-8")
    assert said(capsys, script) == ["8.0"]
    assert "on_path" not in sys.modules


@pytest.mark.parametrize("module", ["", "other/src/other/cfg/__init__.py"], ids=["no module", "a module without it"])
def test_parameters_that_are_not_built_yet(workspace, capsys, module):
    files = {"other/cfg/Speed.cfg": "PACKAGE = 'other'", "other/x.py": "from other.cfg import SpeedConfig"}
    for name, text in {**files, **({module: ""} if module else {})}.items():
        (workspace / name).parent.mkdir(parents=True, exist_ok=True)
        (workspace / name).write_text(text, encoding="utf-8")
    assert run_scripts([ScriptSpec(str(workspace / "other" / "x.py"))], stdin="", prefix=False).status == 1
    said = capsys.readouterr().err
    assert "catkin_make" in said
    assert "cfg/Speed.cfg" in said


def test_a_module_that_is_not_in_ours_although_a_package_has_its_name(workspace, capsys):
    (workspace / "other" / "package.xml").write_text(MANIFEST.format("roslib"), encoding="utf-8")
    (workspace / "other" / "x.py").write_text("import roslib.nothing", encoding="utf-8")
    assert run_scripts([ScriptSpec(str(workspace / "other" / "x.py"))], stdin="", prefix=False).status == 1
    said = capsys.readouterr().err
    assert "ModuleNotFoundError: No module named 'roslib.nothing'" in said
    assert "scriptutil" in said
