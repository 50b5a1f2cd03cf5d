"""Checks of the exercises in the chapter From scratch: they build the files and run the scripts."""

from __future__ import annotations

from pathlib import Path
from tempfile import TemporaryDirectory
from typing import TYPE_CHECKING, Any

from rosmini.book.checks import Script, Wrong, exercise, expect, expect_type
from rosmini.book.trials import Trial
from rosmini.core.errors import RosminiError
from rosmini.msgs.geometry_msgs.msg import Twist
from rosmini.msgs.std_msgs.msg import String
from rosmini.ros.catkin import Workspace, make

if TYPE_CHECKING:
    from rosmini.core.graph import Publisher

# ---- cures: which command fixes it ----

CURES = {1: "c", 2: "a", 3: "e", 4: "b"}
"""The command that fixes the cause of each message."""

COMMANDS = {
    "chmod +x scripts/drive.py": "a",
    "catkin_make": "b",
    "source devel/setup.bash": "c",
    "roscore": "d",
    "mkdir src": "e",
}
"""The letter of each command; the command itself is accepted as well."""


@exercise("cures", praise="Each message names its own cause.")
def cures(answer: object) -> None:
    """The letter of a command for each of four messages."""
    expect_type(answer, dict, "cures is", "a dictionary")
    given: dict[object, object] = dict(answer)  # type: ignore[call-overload]
    missing = [number for number in CURES if number not in given]
    expect(not missing, f"There is no command for message {next(iter(missing), None)}.")
    letters = {number: COMMANDS.get(str(word).strip(), str(word).strip().lower()) for number, word in given.items()}
    wrong = [number for number, letter in CURES.items() if letters[number] != letter]
    said = f"{len(wrong)} of 4 commands would not help; start with message {next(iter(wrong), None)}."
    expect(not wrong, said, "read which file or command the message names")


# ---- package_with_types: a message and a service ----

MANIFEST = """<?xml version="1.0"?>
<package format="2">
  <name>survey</name>
  <version>0.1.0</version>
  <description>Visits spots.</description>
  <maintainer email="ada@example.org">Ada</maintainer>
  <license>MIT</license>
  <buildtool_depend>catkin</buildtool_depend>
  <depend>geometry_msgs</depend>
  <depend>rospy</depend>
  <build_depend>message_generation</build_depend>
  <exec_depend>message_runtime</exec_depend>
</package>
"""

FILES = {
    "package.xml": MANIFEST,
    "msg/Spot.msg": "geometry_msgs/Point where\nstring name\n",
    "srv/Visit.srv": "string name\n---\nbool found\n",
}
"""The files of the package, without a CMakeLists.txt."""


@exercise("package_with_types", praise="catkin_make built the package without a warning.")
def cmake(answer: object) -> None:
    """The CMakeLists.txt of a package with a message and a service."""
    expect_type(answer, str, "cmake is", "a text")
    with TemporaryDirectory() as name:
        package = Path(name) / "src" / "survey"
        for file, text in {**FILES, "CMakeLists.txt": str(answer)}.items():
            (package / file).parent.mkdir(parents=True, exist_ok=True)
            (package / file).write_text(text, encoding="utf-8")
        lines: list[str] = []
        try:
            report = make(Workspace.at(Path(name)), say=lines.append)
        except RosminiError as error:
            raise Wrong(f"It cannot be built: {str(error).replace(str(package), 'survey')}") from error
        for found in sorted(report.findings, key=lambda each: not each.is_error):
            raise Wrong(
                f"catkin_make says: {str(found).replace(str(package), 'survey')}",
                "the manifest is correct; the mistake is in CMakeLists.txt",
            )
        expect(report.built, "Nothing was built.", "begin with project(survey)")
    said = "\n".join(lines)
    for kind, file in (("MSG", "Spot"), ("SRV", "Visit")):
        expect(f"{kind} survey/{file}" in said, f"No code was generated from {file}.{kind.lower()}.")


# ---- obey: a robot that obeys ----

ORDERS = (("ahead", 1, 0), ("left", 0, 1), ("stop", 0, 0), ("right", 0, -1), ("dance", 0, 0))
"""Words, and the signs of the forward and left-turn speeds that they request."""


@exercise("obey", praise="One callback is enough to make the robot obey.")
def obey(answer: Script) -> Any:
    """The robot moves as the word on /order says."""
    with Trial("room") as trial:
        trial.start(answer)
        captain = trial.graph.node("captain")
        order = captain.publisher("order", String, queue_size=10)
        commands: list[Any] = []
        captain.subscriber("cmd_vel", Twist, commands.append)
        trial.run(0.5)
        for word, ahead, left in ORDERS:
            _say(trial, order, word, 1.0)  # until the motors have come up to speed, or down
            before = trial.robot.truth()
            commands.clear()
            _say(trial, order, word, 0.5)
            expect(commands, f"There is no message on /cmd_vel after the word {word!r}.", "publish one for each")
            moved = _moved(before, trial.robot.truth())
            for wanted, got, what in ((ahead, moved[0], "drive ahead"), (left, moved[1], "turn left")):
                sign = (got > 0.005) - (got < -0.005)
                expect(
                    sign == wanted,
                    f"After the word {word!r} the robot does {'not ' if wanted else ''}{_said(what, wanted or sign)}.",
                    "ahead sets linear.x; left and right set angular.z, positive and negative; every other "
                    "word stops the robot",
                )
        return trial.view()


def _say(trial: Trial, order: Publisher, word: str, seconds: float) -> None:
    """Publish a word ten times a second."""
    for _ in range(round(seconds * 10)):
        order.publish(String(word))
        trial.run(0.1)


def _moved(before: tuple[float, ...], after: tuple[float, ...]) -> tuple[float, float]:
    """Return the distance between two poses [m] and the turn to the left [rad]."""
    way = ((after[0] - before[0]) ** 2 + (after[1] - before[1]) ** 2) ** 0.5
    return way, after[2] - before[2]


def _said(what: str, sign: int) -> str:
    return what if sign > 0 else what.replace("left", "right").replace("ahead", "back")


# ---- parrot: a listener in many copies ----


@exercise("parrot", praise="Each copy has a unique name, so both run and answer.")
def parrot(answer: Script) -> None:
    """Two copies of one script run at once, and each repeats what it hears."""
    heard: list[str] = []
    with Trial("arena", is_shown=False) as trial:
        for _ in range(2):
            trial.start(answer)
        node = trial.graph.node("listener")
        node.subscriber("echo", String, lambda message: heard.append(message.data))
        chatter = node.publisher("chatter", String, queue_size=10)
        trial.run(1.0)
        for word in ("hello", "robot"):
            chatter.publish(String(word))
            trial.run(1.0)
    expect(heard, "There was no message on /echo.", "publish the message that the callback receives")
    expect(len(heard) > 2, "Only one copy has answered.", "anonymous=True gives each a unique name")
    expect(heard == ["hello", "hello", "robot", "robot"], f"The messages on /echo were {', '.join(heard[:6])}.")
