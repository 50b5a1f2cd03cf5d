"""Checks of the exercises in the chapter Files: packages, manifests and stacks."""

from __future__ import annotations

from pathlib import Path
from tempfile import TemporaryDirectory
from typing import Any

from rosmini.book.checks import Script, Wrong, exercise, expect, expect_fields, expect_type
from rosmini.book.trials import Trial
from rosmini.core.errors import RosminiError
from rosmini.core.packages import Package, read_package
from rosmini.msgs import define_message
from rosmini.ros.launch import read

OTHERS = ("turtlebot3_bringup", "turtlebot3_gazebo", "turtlebot3_navigation", "turtlebot3_slam")
"""The packages that need turtlebot3_description."""

WANTED = """
uint8 COLD = 0
uint8 HOT = 1
Header header
float32 motor
float32[3] sonar
string note
"""

NEEDS = ("geometry_msgs", "rospy", "sensor_msgs")

TURN = """
import rospy
from geometry_msgs.msg import Twist

rospy.init_node("driver")
cmd_vel = rospy.Publisher("cmd_vel", Twist, queue_size=1)
command = Twist()
command.linear.x, command.angular.z = 0.1, 0.5
while not rospy.is_shutdown():
    cmd_vel.publish(command)
    rospy.sleep(0.1)
"""


@exercise("users", praise="These packages may break when the description changes.")
def users(answer: object) -> None:
    """The packages that need turtlebot3_description, sorted."""
    expect_type(answer, (list, tuple), "users is", "a list", 'write names in brackets: ["one", "another"]')
    names = [str(each) for each in answer]  # type: ignore[attr-defined]
    for name in OTHERS:
        expect(name in names, "A package is missing.", "try rospack depends-on turtlebot3_description")
    extra = [name for name in names if name not in OTHERS]
    expect(not extra, f"{', '.join(extra)} does not belong in the list.", "list the packages that need it")
    expect(names == sorted(names), "They are not in alphabetical order.", "use sorted(...)")


@exercise("message_definition", praise="From this text, ROS generates a class for each language.")
def definition(answer: object) -> None:
    """The text of a message with two constants and four fields."""
    expect_type(answer, str, "definition is", "a text")
    given, wanted = (_message(str(text)) for text in (answer, WANTED))
    expect_fields(given, wanted, "message")
    for name in ("COLD", "HOT"):
        value = getattr(given, name, None)
        expect(value is not None, f"There is no constant {name}.", "a constant is 'type NAME = value'")
        expect(value == getattr(wanted, name), f"{name} is {value!r}, not {getattr(wanted, name)}.")
    expect(given._md5sum == wanted._md5sum, "The types or the order of the constants are wrong.")


def _message(text: str) -> Any:
    try:
        return define_message("exercise/Feeling", text)
    except RosminiError as error:
        raise Wrong(f"This is not a message definition: {error}") from error


@exercise("repaired", praise="It now declares every package that it imports, and no others.")
def repaired(answer: object) -> None:
    """The manifest of patrol: a licence, and the three packages that it imports."""
    expect_type(answer, str, "corrected is", "a text")
    expect("<license>" in str(answer), "It has no licence.", "add <license>MIT</license>")
    expect(">TODO<" not in str(answer), "TODO is not a licence.", "write <license>MIT</license>")
    package = _package(str(answer))
    expect(package.name == "patrol", f"The package is now called {package.name!r}, not 'patrol'.")
    missing = [name for name in NEEDS if name not in package.exec_depends]
    expect(not missing, f"It does not declare that it needs {', '.join(missing)} to run.", "use <exec_depend>")
    extra = [name for name in package.exec_depends if name not in NEEDS]
    expect(not extra, f"It does not need {', '.join(extra)}.", "compare with the imports of the script")


def _package(text: str) -> Package:
    with TemporaryDirectory() as folder:
        (Path(folder) / "package.xml").write_text(text, encoding="utf-8")
        try:
            return read_package(Path(folder))
        except RosminiError as error:
            said = str(error).replace(f"{folder}/", "")
            raise Wrong(f"This is not a valid manifest: {said}") from error


@exercise("launch", praise="Your launch file puts a Waffle into the maze.")
def launch(answer: object) -> Any:
    """A launch file that starts the simulator with a Waffle in the maze."""
    expect_type(answer, str, "launch is", "a text")
    try:
        plan = read(text=str(answer))
    except RosminiError as error:
        raise Wrong(f"roslaunch refuses this file: {error}") from error
    executables = [node.executable for node in plan.nodes]
    expect(
        executables == ["rosmini_sim/simulator"],
        f"It starts {', '.join(executables) or 'no node'}, not just rosmini_sim/simulator.",
        'write one <node pkg="rosmini_sim" type="simulator" name="simulator">',
    )
    given = {name.rpartition("/")[2]: value for name, value in plan.parameters.items()}
    space = plan.nodes[0].full_name
    words = [word.partition(":=") for word in plan.nodes[0].args.split()]
    own = {name.removeprefix("_"): value for name, _, value in words}
    for name, wanted in (("model", "waffle"), ("world", "maze")):
        value = own.get(name, plan.parameters.get(f"{space}/{name}"))
        said = f"~{name} is {value!r}, not {wanted!r}." if value else f"The node has no parameter {name}."
        elsewhere = name in given and value is None
        hint = (
            "put <param> inside <node>: it is a private parameter of the node"
            if elsewhere
            else 'use <param name="..." value="..."/>'
        )
        expect(value == wanted, said, hint)
    with Trial("maze", "_model:=waffle") as trial:
        trial.start(Script("turn.py", TURN))
        trial.run(6.0)
        return trial.view()
