"""Checks of the exercises in the chapter Names: one program for several robots."""

from __future__ import annotations

from typing import Any

from rosmini.book.checks import Script, Wrong, exercise, expect, expect_type
from rosmini.book.trials import Trial
from rosmini.msgs.geometry_msgs.msg import Twist
from rosmini.msgs.sensor_msgs.msg import LaserScan
from rosmini.msgs.std_msgs.msg import String

PATROL = """
import rospy
from geometry_msgs.msg import Twist
from sensor_msgs.msg import LaserScan

def on_scan(scan):
    command = Twist()
    if min(scan.ranges[:30] + scan.ranges[-30:]) > 0.5:
        command.linear.x = speed
    else:
        command.angular.z = 0.8
    cmd_vel.publish(command)

rospy.init_node("patrol")
speed = rospy.get_param("~speed", 0.2)
cmd_vel = rospy.Publisher("cmd_vel", Twist, queue_size=1)
rospy.Subscriber("scan", LaserScan, on_scan)
rospy.spin()
"""


# ---- arguments: start it right ----

SPEED = 0.15
"""Speed of the courier [m/s]."""


def _driven(arguments: list[str], space: str) -> tuple[dict[str, list[str]], list[float], Any]:
    """Start patrol.py; return the topics that each node publishes, the speeds of the commands, and the drive."""
    speeds: list[float] = []
    with Trial("room", f"__ns:={space}", "cmd_vel:=wheels/cmd_vel") as trial:
        wheels = trial.graph.node("wheels")
        wheels.subscriber(f"{space}/wheels/cmd_vel", Twist, lambda message: speeds.append(message.linear.x))
        before = set(trial.graph.nodes)
        try:
            trial.start(Script("patrol.py", PATROL), *arguments)
            trial.run(8.0)
        except Wrong:
            raise
        except Exception as error:
            raise Wrong(f"patrol.py does not accept the arguments: {error}", "each argument contains one :=") from error
        publishers = trial.graph.ask_as("/check").call("getSystemState")[2][0]
        new = {name: [topic for topic, names in publishers if name in names] for name in trial.graph.nodes}
        return {name: topics for name, topics in new.items() if name not in before}, speeds, trial.view()


@exercise("arguments", praise="Only one argument contains the namespace, and everything else is relative to it.")
def arguments(answer: Any) -> Any:
    """The arguments that set the namespace, the name, the topic and the speed of a driver."""
    expect_type(answer, (list, tuple), "arguments is", "a list", "[...]")
    expect(all(isinstance(word, str) for word in answer), "All arguments are strings.", 'such as "from:=to"')
    started, speeds, _ = _driven(list(answer), "/amy")
    node = next(iter(started), "missing")
    expect(node == "/amy/courier", f"The node is called {node}, not /amy/courier.", "use __ns:= and __name:=")
    topics = [topic for topic in started[node] if topic != "/rosout"]
    expect(
        "/amy/wheels/cmd_vel" in topics,
        f"It publishes on {', '.join(topics)}, not on /amy/wheels/cmd_vel.",
        "use cmd_vel:=...",
    )
    expect(bool(speeds), "No command arrived at the wheels: it gets no scans.", "do not remap scan")
    expect(
        abs(max(speeds) - SPEED) < 1e-9,
        f"It drives at {max(speeds):g} m/s, not at {SPEED:g} m/s.",
        "use _speed:=, with one underscore",
    )
    moved = ["__ns:=/team" if word.startswith("__ns:=") else word for word in answer]
    started, _, view = _driven(moved, "/team")
    found = [topic for topic in started.get("/team/courier", []) if topic != "/rosout"]
    expect(
        "/team/wheels/cmd_vel" in found,
        f"With the namespace /team instead, {', '.join(started)} publishes on {', '.join(found) or 'another topic'}.",
        "write a relative name on the right side of the remapping",
    )
    return view


# ---- report: one report for all ----


@exercise("report", praise="For a third robot, start your script once more, without a change.", gaps=2)
def report(answer: Script) -> Any:
    """One node for each robot, which reads that robot's scans and writes to a common topic."""
    got: list[str] = []
    with Trial("room", "_robots:=[{name: amy}, {name: bob, namespace: /lab/bob}]") as trial:
        graph = trial.graph
        graph.node("screen").subscriber("/report", String, lambda message: got.append(message.data))
        seen: dict[str, list[str]] = {"/amy": [], "/lab/bob": []}
        for space, texts in seen.items():
            graph.node("witness" + space.replace("/", "_")).subscriber(
                f"{space}/scan", LaserScan, lambda scan, space=space, texts=texts: texts.append(
                    f"{space}: {scan.ranges[0]:.2f} m"
                )
            )  # fmt: skip
            trial.start(answer, f"__ns:={space}")
            trial.start(Script("patrol.py", PATROL), f"__ns:={space}")
        trial.run(8.0)
        expect(
            f"{next(iter(seen))}/report" in graph.nodes,
            "There is no node /amy/report.",
            "init_node takes the name without the namespace",
        )
        expect(
            got,
            "There was no message on /report.",
            "the common topic has a global name, the robot's scan a relative one",
        )
        known = {text for texts in seen.values() for text in texts}
        strange = [text for text in got if text not in known]
        example = seen["/amy"][-1]
        expect(
            not strange,
            f"A message on /report was {strange[0] if strange else ''!r}. It should look like {example!r}.",
            'rospy.get_namespace() ends with a "/"; format the number with :.2f',
        )
        for space in seen:
            count = sum(text.startswith(f"{space}: ") for text in got)
            expect(count > 30, f"In 8 s there were {count} reports of {space}; it scans five times a second.")
        trial.expect_no_errors()
        return trial.view()


# ---- dance: all robots dance ----


@exercise("dance", praise="The script found the robots by the topics that they publish.")
def dance(answer: Script) -> Any:
    """Every robot turns in place, whatever its name is and however many there are."""
    _dances(answer, "[{name: rosa, namespace: /}]", {"rosa": "/"})
    robots = {"amy": "/amy", "bob": "/lab/bob", "eve": "/eve"}
    given = ", ".join(
        f"{{name: {name}, namespace: {space}, x: {x}}}"
        for (name, space), x in zip(robots.items(), (-1, 0, 1), strict=True)
    )
    return _dances(answer, f"[{given}]", robots)


def _dances(answer: Script, given: str, robots: dict[str, str]) -> Any:
    """Run the script with robots; return the drive. Raises `Wrong` if one of them does not turn."""
    with Trial("arena", f"_robots:={given}") as trial:
        trial.run(0.5)
        trial.start(answer)
        trial.run(1.0)
        before = {name: trial.robot.truth(name) for name in robots}
        trial.run(1.0)
        for name, space in robots.items():
            x, y, yaw = trial.robot.truth(name)
            old_x, old_y, old_yaw = before[name]
            turned = yaw - old_yaw
            expect(
                0.5 < turned % 6.283185 < 1.5,
                f"The robot in the namespace {space} does not turn at 1 rad/s.",
                "publish on cmd_vel in the namespace of each topic that ends with /scan",
            )
            expect(abs(x - old_x) + abs(y - old_y) < 0.05, f"The robot in {space} does not turn in place.")
        trial.run(4.0)
        trial.expect_no_errors()
        return trial.view()
