"""The chapter Nodes and the Master with a real Master: its calls by hand, and the solutions of its exercises."""

from __future__ import annotations

import xmlrpc.client
from contextlib import contextmanager
from pathlib import Path
from typing import TYPE_CHECKING, Any

import pytest

from book.tools import notebooks, solutions

from ..processes import run, start, wait_until
from .conftest import SYSTEM_PYTHON, need_ros, rosmaster

if TYPE_CHECKING:
    from collections.abc import Callable, Iterator

CHAPTER = Path(__file__).resolve().parents[2] / "notebooks" / "2_graph/10_nodes_and_master.ipynb"

ROBOT = """
import rospy
from geometry_msgs.msg import Twist
from sensor_msgs.msg import LaserScan

ahead = [2.0]

def on_command(command):
    print("command", command.linear.x, command.angular.z, flush=True)
    ahead[0] = 0.3 if command.linear.x > 0 else ahead[0]

rospy.init_node("simulator")
rospy.Subscriber("cmd_vel", Twist, on_command)
scan, wish = rospy.Publisher("scan", LaserScan, queue_size=1), rospy.Publisher("wish", Twist, queue_size=1)
wanted = Twist()
wanted.linear.x, wanted.angular.z = 0.2, 0.5
while not rospy.is_shutdown():
    scan.publish(LaserScan(ranges=ahead * 360))
    wish.publish(wanted)
    rospy.rostime.wallsleep(0.1)
"""
"""Stands in the place of the robot: it prints commands, and is near a wall once it was told to drive."""


class Play:
    """The chapter's files in a folder, and the real nodes that run them."""

    def __init__(self, folder: Path, environment: dict[str, str]) -> None:
        self.folder, self.environment = folder, environment | {"PYTHONUNBUFFERED": "1"}
        notebook = solutions.solved(notebooks.read(CHAPTER))
        self.cells = [cell.source for cell in notebook.cells if cell.cell_type == "code"]
        (folder / "robot.py").write_text(ROBOT, encoding="utf-8")
        for source in self.cells:
            if source.startswith("%%node "):
                line, _, text = source.partition("\n")
                (folder / line.split()[1]).write_text(text, encoding="utf-8")

    @contextmanager
    def node(self, name: str, *words: str) -> Iterator[tuple[Any, Callable[[], str]]]:
        """Run a script as a node; yields its process and what reads its output."""
        log = self.folder / f"{name}{len(words)}.out"
        with (
            log.open("wb") as out,
            start(
                [SYSTEM_PYTHON, name, *words], env=self.environment, stdout=out, stderr=out, cwd=self.folder
            ) as process,
        ):
            yield process, lambda: log.read_text(encoding="utf-8")

    def run(self, name: str) -> str:
        """Run a script to its end, which has to be a good one."""
        done = run([SYSTEM_PYTHON, name], env=self.environment, cwd=self.folder)
        assert done.returncode == 0, done.stdout + done.stderr
        return str(done.stdout)

    def by_hand(self, *marks: str) -> list[str]:
        """Run the chapter's plain cells with these marks as one program; the lines that it prints."""
        lines = ["import rosgraph", "import rospy"]
        for mark in marks:
            (source,) = (cell for cell in self.cells if mark in cell and not cell.startswith("%%"))
            lines += [line for line in source.splitlines() if not line.startswith(("%", "rosmini."))]
        calls = ("as_driver.register", "as_simulator.register", "rospy.core.")
        lines = [f"print({line})" if line.startswith(calls) else line for line in lines]
        (self.folder / "by_hand.py").write_text("\n".join(lines), encoding="utf-8")
        return self.run("by_hand.py").splitlines()

    def master(self, method: str, *arguments: Any) -> Any:
        """Return the value of the Master's answer."""
        with xmlrpc.client.ServerProxy(self.environment["ROS_MASTER_URI"]) as proxy:
            code, _, value = getattr(proxy, method)(*arguments)  # type: ignore[misc, str-unpack]
        assert code == 1
        return value

    def drivers(self) -> list[str]:
        """Return who publishes /cmd_vel, as far as the Master knows."""
        publishers = dict(self.master("getSystemState", "/test")[0])
        return sorted(publishers.get("/cmd_vel", []))


@pytest.fixture
def play(tmp_path: Path) -> Iterator[Play]:
    need_ros("rosmaster", modules="rospy, sensor_msgs.msg, geometry_msgs.msg")
    home = tmp_path / "home"
    home.mkdir()
    with rosmaster(home) as environment:
        yield Play(tmp_path, environment)


def hears(robot: tuple[Any, Callable[[], str]], command: str, *, anew: bool = False) -> None:
    """Wait until the robot has heard a command; `anew`: once more than now."""
    process, output = robot
    before = output().count(command) if anew else 0
    wait_until(lambda: output().count(command) > before, f"a {command!r}", process)


FIND = ("master = rosgraph.Master", "def directory")
FORGET = "as_simulator.unregisterSubscriber"


def test_the_robot_drives_on_when_the_master_forgets(play: Play) -> None:
    with play.node("robot.py") as robot, play.node("circle.py"):
        hears(robot, "command 0.2 0.4")
        lines = play.by_hand(*FIND, FORGET)
        assert lines[-3:] == ["/cmd_vel", "  publishers:  []", "  subscribers: []"]
        hears(robot, "command 0.2 0.4", anew=True)


def test_registered_by_hand_the_master_answers_as_in_the_chapter(play: Play) -> None:
    with play.node("robot.py") as robot, play.node("circle.py"):
        hears(robot, "command 0.2 0.4")
        lines = play.by_hand(*FIND, FORGET, "as_driver.register", "as_simulator.register", "rospy.core.")
        driver, _ = lines[0].split()
        assert lines[-3:-1] == ["[]", f"['{driver}']"]
        assert lines[-1].startswith("[1, 'ready on ")
        assert "['TCPROS', " in lines[-1]


def test_a_second_driver_of_the_same_name_ends_the_first(play: Play) -> None:
    with play.node("robot.py") as robot, play.node("circle.py") as (circle, output):
        hears(robot, "command 0.2 0.4")
        with play.node("wave.py"):
            wait_until(lambda: circle.poll() is not None, "the end of circle.py")
            assert "new node registered with same name" in output()
            hears(robot, "command 0.1 ")


def test_the_robot_stops_before_the_wall_and_half_of_what_is_wished_for_arrives(play: Play) -> None:
    """The solutions: the listener, the node that stops the robot, and the one in the middle."""
    with play.node("robot.py") as robot:
        with play.node("watch.py") as (process, output):
            wait_until(lambda: "2.00 m ahead" in output(), "a distance", process)
        with play.node("stop.py"):
            hears(robot, "command 0.2 0.0")
            hears(robot, "command 0.0 0.0")
        with play.node("gentle.py"):
            hears(robot, "command 0.1 0.25")


def test_a_script_introduces_two_nodes_in_the_place_of_the_master(play: Play) -> None:
    with play.node("robot.py") as robot:
        wait_until(lambda: "/simulator" in str(play.master("getSystemState", "/test")[1]), "the robot", robot[0])
        uri = play.master("lookupNode", "/test", "/simulator")
        wait_until(
            lambda: play.master("unregisterSubscriber", "/simulator", "/cmd_vel", uri) == 1, "its entry", robot[0]
        )
        with play.node("circle.py") as (driver, _):
            wait_until(lambda: play.drivers() == ["/driver"], "the driver", driver)
            play.run("introduce.py")
            hears(robot, "command 0.2 0.4")


def test_a_script_ends_all_drivers_but_one(play: Play) -> None:
    with play.node("circle.py") as (driver, _), play.node("circle.py", "__name:=prankster") as (prankster, _):
        wait_until(lambda: play.drivers() == ["/driver", "/prankster"], "two drivers", driver)
        with play.node("referee.py"):
            wait_until(lambda: prankster.poll() is not None, "the end of the prankster", driver)
        wait_until(lambda: play.drivers() == ["/driver"], "one driver", driver)
