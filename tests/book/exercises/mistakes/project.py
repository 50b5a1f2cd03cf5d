"""Wrong answers to the exercises of the chapter A project: the chapter's package and solutions with a fault put in."""

from __future__ import annotations

import os
import re
import shutil
from pathlib import Path
from typing import TYPE_CHECKING

from book.tools import notebooks, solutions
from rosmini.book.checks import Script
from rosmini.core.packages import PackageIndex

from .file_system import wrong

if TYPE_CHECKING:
    from collections.abc import Callable

CHAPTER = notebooks.read(Path(__file__).parents[4] / "notebooks" / "8_use_cases" / "60_project.ipynb")
PATROL, TEST = (solutions.solutions(CHAPTER)[name] for name in ("night_round", "patrol_test"))
TEST = TEST.partition('"""')[2].rpartition('"""')[0]
HERE = re.compile(r"^cat > (\S+) << 'EOF'\n(.*?)^EOF$", re.DOTALL | re.MULTILINE)
FILES = dict(pair for cell in CHAPTER.cells if cell.cell_type == "code" for pair in HERE.findall(cell.source))
FILES |= {"scripts/patrol.py": PATROL, "test/test_patrol.py": TEST.strip()}
DEPENDS = ["actionlib", "amcl", "map_server", "move_base", "robot_state_publisher", "rosmini_sim", "rospy", "std_msgs"]
FILES["package.xml"] = "\n".join(
    [
        '<package format="2"><name>patrol_robot</name><version>0.1.0</version><description>Tea</description>',
        '<maintainer email="ada@example.org">Ada</maintainer><license>MIT</license>',
        *(f"<exec_depend>{name}</exec_depend>" for name in DEPENDS),
        "</package>",
    ]
)
PACKAGE = {"scripts/none.py": ""}
"""The tests' folder of packages, in which `package` puts the chapter's package."""


def package(file: str, old: str, new: str = "") -> Callable[[], str]:
    """Return what writes the chapter's package with one place of a file changed; without the file if all of it is."""
    assert old in FILES[file]

    def write() -> str:
        folder = Path(os.environ["ROS_PACKAGE_PATH"]) / "patrol_robot"
        shutil.rmtree(folder, ignore_errors=True)
        for name, text in (FILES | {file: FILES[file].replace(old, new)}).items():
            (folder / name).parent.mkdir(parents=True, exist_ok=True)
            if text:
                (folder / name).write_text(text, encoding="utf-8")
                (folder / name).chmod(0o755)
        shutil.copytree(PackageIndex().path("rosmini_sim") / "maps", folder / "maps")
        return "patrol_robot"

    return write


def script(old: str, new: str = "") -> Callable[[], Script]:
    """Return what makes the chapter's patrol with one place of it changed."""
    assert old in PATROL
    return lambda: Script("patrol.py", PATROL.replace(old, new))


FOOTPRINT = "[[-0.16, -0.13], [-0.16, 0.13], [0.10, 0.13], [0.10, -0.13]]"
MISTAKES = {
    "night_round": [
        script('"map"', '"base_link"'),
        script("    client.wait_for_result()\n"),
        script("client.get_state() == actionlib.GoalStatus.SUCCEEDED", "True"),
        script("begin + 60", "begin"),
        script("begin + 60", "begin + 600"),
        script("rospy.get_time() < begin + 60", "not again"),
        script("todo.append((place, True))", "todo.append(place)"),
    ],
    "patrol_test": [
        wrong(TEST, '        self.assertIn("done", reports)\n        for', "        for"),
        wrong(TEST, ': reached", reports', ': arrived", reports'),
        wrong(TEST, "self.assertIn(place", "str(place"),
        wrong(TEST, "def test_every", "def every"),
        wrong(TEST, "< end", "< end + 1e9"),
        wrong(TEST, "import rostest\n"),
        lambda: 7,
    ],
    "project": [
        lambda: "no_such_package",
        lambda: 7,
        lambda: ("rosmini_sim", -1),
        package("launch/patrol.launch", FILES["launch/patrol.launch"]),
        package("param/places.yaml", FILES["param/places.yaml"]),
        package("test/patrol.test", FILES["test/patrol.test"]),
        package("test/test_patrol.py", FILES["test/test_patrol.py"]),
        package("test/patrol.test", 'test-name="test_patrol"', 'test-name="patrol"'),
        package("package.xml", "<exec_depend>amcl</exec_depend>"),
        package("param/costmaps.yaml", FOOTPRINT, "[[-0.1, -0.1], [-0.1, 0.1], [0.05, 0.1], [0.05, -0.1]]"),
        package("urdf/robot.urdf.xacro", '<box size="0.26 0.26 0.01"/>', '<sphere radius="0.1"/>'),
        package("launch/navigation.launch", "$(find patrol_robot)/maps", "$(find rosmini_sim)/maps"),
        package("launch/bringup.launch", '"x" value="0.3"', '"x" value="-1.0"'),
        package("scripts/patrol.py", "todo.append((place, True))", "pass"),
    ],
}
