import sys
from pathlib import Path

import pytest

from rosmini.core.plugins import PluginError
from rosmini.navigation.nav_core import BaseGlobalPlanner, RecoveryBehavior
from rosmini.navigation.nav_core.plugin_files import create

PACKAGE = """<package format="2">
  <name>my_pkg</name><version>0.1.0</version><description>d</description>
  <maintainer email="a@b.invalid">A</maintainer><license>MIT</license>
  <export><nav_core plugin="${prefix}/planner_plugin.xml"/></export>
</package>
"""
XML = """<library path="my_pkg.planner">
  <class name="my_pkg/MyPlanner" type="MyPlanner" base_class_type="nav_core::BaseGlobalPlanner"/>
</library>
"""
CODE = """
from geometry_msgs.msg import PoseStamped
from rosmini.navigation.nav_core import BaseGlobalPlanner
from my_pkg.words import SAYS


class MyPlanner(BaseGlobalPlanner):
    says = SAYS

    def make_plan(self, start, goal):
        return [start, PoseStamped(), goal]
"""


@pytest.fixture
def package(tmp_path, monkeypatch):
    folder = tmp_path / "src/my_pkg"
    (folder / "src/my_pkg").mkdir(parents=True)
    (folder / "package.xml").write_text(PACKAGE, encoding="utf-8")
    (folder / "planner_plugin.xml").write_text(XML, encoding="utf-8")
    (folder / "src/my_pkg/__init__.py").touch()
    (folder / "src/my_pkg/words.py").write_text("SAYS = 'hello'", encoding="utf-8")
    (folder / "src/my_pkg/planner.py").write_text(CODE, encoding="utf-8")
    monkeypatch.setenv("ROS_PACKAGE_PATH", str(tmp_path / "src"))
    before = set(sys.modules)
    yield folder
    for name in set(sys.modules) - before:
        if Path(getattr(sys.modules[name], "__file__", None) or "/").is_relative_to(tmp_path):
            del sys.modules[name]


@pytest.mark.parametrize("name", ["my_pkg/MyPlanner", "my_pkg::MyPlanner"])
def test_a_plugin_of_a_package(package, name):
    made = create(BaseGlobalPlanner, name)
    assert isinstance(made, BaseGlobalPlanner)
    assert made.says == "hello"
    assert len(made.make_plan(1, 2)) == 3


def test_what_was_edited_takes_effect(package):
    create(BaseGlobalPlanner, "my_pkg/MyPlanner")
    (package / "src/my_pkg/words.py").write_text("SAYS = 'good-bye, all'", encoding="utf-8")
    assert create(BaseGlobalPlanner, "my_pkg/MyPlanner").says == "good-bye, all"


def test_several_libraries_in_one_file(package):
    other = XML.replace("my_pkg/MyPlanner", "my_pkg/Other")
    (package / "planner_plugin.xml").write_text(f"<class_libraries>{XML}{other}</class_libraries>", encoding="utf-8")
    assert create(BaseGlobalPlanner, "my_pkg/Other").says == "hello"


def test_a_module_beside_the_manifest(package):
    (package / "alone.py").write_text(CODE.replace("from my_pkg.words import SAYS", "SAYS = 1"), encoding="utf-8")
    (package / "planner_plugin.xml").write_text(XML.replace("my_pkg.planner", "alone"), encoding="utf-8")
    assert create(BaseGlobalPlanner, "my_pkg/MyPlanner").says == 1


def write(package, xml=XML, code=CODE):
    (package / "planner_plugin.xml").write_text(xml, encoding="utf-8")
    (package / "src/my_pkg/planner.py").write_text(code, encoding="utf-8")


@pytest.mark.parametrize(
    ("xml", "code", "message"),
    [
        (XML, CODE.replace("class MyPlanner", "class Mine"), "as the class MyPlanner of my_pkg.planner"),
        (XML, "class MyPlanner: pass", r"does not derive from BaseGlobalPlanner: class MyPlanner\(BaseGlobalPlanner\)"),
        (XML, "import nosuchthing", "cannot be loaded: .*nosuchthing"),
        (XML, "def f(:", "cannot be loaded: SyntaxError"),
        (XML.replace("my_pkg.planner", "lib/libmy_planner"), CODE, r"C\+\+ libraries cannot be loaded"),
        (XML.replace("my_pkg.planner", "your_pkg.planner"), CODE, "which is not in"),
        (XML, CODE + "    def __init__(self, x): pass", "created without arguments"),
    ],
)
def test_what_is_wrong_is_said(package, xml, code, message):
    write(package, xml, code)
    with pytest.raises(PluginError, match=message):
        create(BaseGlobalPlanner, "my_pkg/MyPlanner")


def test_a_description_that_is_not_there(package):
    (package / "planner_plugin.xml").unlink()
    with pytest.raises(PluginError, match="does not exist"):
        create(BaseGlobalPlanner, "my_pkg/MyPlanner")


def test_an_unknown_name(package):
    with pytest.raises(PluginError, match=r"there is no RecoveryBehavior .* did you mean clear_costmap_recovery/Cl"):
        create(RecoveryBehavior, "clear_costmap_recovery/ClearCostmapRecoveri")


@pytest.mark.parametrize("broken", [PACKAGE.replace("a@b.invalid", "nobody"), PACKAGE])
def test_a_package_that_cannot_be_read_is_in_nobodys_way(package, broken):
    other = package.parent / "another"
    other.mkdir()
    (other / "package.xml").write_text(broken.replace("my_pkg", "another"), encoding="utf-8")
    assert create(BaseGlobalPlanner, "navfn/NavfnROS")
    assert create(BaseGlobalPlanner, "my_pkg/MyPlanner").says == "hello"
    with pytest.raises(PluginError, match=r"could not be read:\n.*another"):
        create(BaseGlobalPlanner, "third/Planner")


def test_sources_of_a_planner_in_c_leave_ours_in_its_place(package):
    name = "my_pkg/MyPlanner"
    (package / "package.xml").write_text(PACKAGE.replace("my_pkg", "navfn"), encoding="utf-8")
    write(package, XML.replace("my_pkg.planner", "lib/libnavfn").replace(name, "navfn/NavfnROS"))
    assert type(create(BaseGlobalPlanner, "navfn/NavfnROS")) is BaseGlobalPlanner.named("navfn/NavfnROS")
