"""Checks of the exercises in the chapter Nodes and the Master: each runs a script with a separate robot."""

from __future__ import annotations

import math
from typing import Any

from rosmini.book.checks import Script, exercise, expect
from rosmini.book.trials import Trial
from rosmini.msgs.geometry_msgs.msg import Twist

WALL_X = 3.3
"""x coordinate of the east wall [m]; a robot at the origin faces it."""

NEAR_M, TOUCH_M = 0.5, 0.11
"""Largest distance of the robot's centre from the wall, and its distance on contact [m]."""

DRIVER = """
import rospy
from geometry_msgs.msg import Twist

def drive(event):
    cmd_vel.publish(command)

rospy.init_node("driver")
cmd_vel = rospy.Publisher("cmd_vel", Twist, queue_size=1)
command = Twist()
command.linear.x, command.angular.z = {speed}, {turn}
rospy.Timer(rospy.Duration(0.1), drive)
rospy.spin()
"""


def driver(name: str = "driver.py", speed: float = 0.2, turn: float = 0.0) -> Script:
    """Return a script that sends one command ten times a second [m/s, rad/s]."""
    return Script(name, DRIVER.format(speed=speed, turn=turn))


def distance(trial: Trial, seconds: float) -> float:
    """Let time pass, and return the distance that the robot moved [m]."""
    x, y, _ = trial.robot.truth()
    trial.run(seconds)
    new_x, new_y, _ = trial.robot.truth()
    return math.hypot(new_x - x, new_y - y)


# ---- stop: stop before the wall ----


@exercise("stop", praise="From two different starting points, it came close to the wall and stopped there.")
def stop(answer: Script) -> Any:
    """The robot drives up to a wall and stops in front of it, wherever it starts."""
    stops_from(answer, 1.2)
    return stops_from(answer, 0.0)


def stops_from(answer: Script, start: float) -> Any:
    """Run the script with a robot at x = `start` [m]; return the drive. Raises `Wrong` if it does not stop in time."""
    with Trial("room", f"_x:={start}") as trial:
        trial.start(answer)
        trial.run(25.0)
        moved = distance(trial, 1.0)
        if moved > 0.01:  # a careful robot is still on its way
            trial.run(35.0)
            moved = distance(trial, 1.0)
        x, _, _ = trial.robot.truth()
        expect(
            x > start + 0.1,
            "The robot did not drive, although the wall was far away.",
            "compare scan.ranges[0] with a distance, and publish a command for every scan",
        )
        gap = WALL_X - x
        expect(
            gap > TOUCH_M,
            "The robot ran into the wall.",
            "compare scan.ranges[0] with a distance, and publish zero when it is smaller",
        )
        expect(
            moved < 0.01,
            "The robot is still driving, long after it should have reached the wall.",
            "publish a zero command to stop it",
        )
        expect(
            gap < NEAR_M + 0.01,
            f"The robot stopped {gap:.2f} m from the wall; it should stop less than half a metre from it.",
            "beam 0 points straight ahead; it starts 3 cm behind the robot's centre",
        )
        trial.expect_no_errors()
        return trial.view()


# ---- gentle: a node in the middle ----

WISHES = ((0.2, 0.0), (0.1, 1.0), (-0.08, -0.6), (0.0, 0.0))


@exercise("gentle", praise="Neither the driver nor the robot had to change: your node fits in between.", gaps=2)
def gentle(answer: Script) -> Any:
    """The node passes messages from /wish to /cmd_vel at half the speed."""
    got: list[tuple[float, float]] = []
    with Trial("arena") as trial:
        trial.start(answer)
        listener, wisher = trial.graph.node("listener"), trial.graph.node("wisher")
        listener.subscriber("cmd_vel", Twist, lambda m: got.append((m.linear.x, m.angular.z)))
        wish = wisher.publisher("wish", Twist, queue_size=10)
        trial.run(2.0)
        expect(not got, "It sent a command without a message on /wish.", "publish only in the callback")
        expect(wish.num_connections(), "No node subscribes to /wish.", "use rospy.Subscriber with type Twist")
        for speed, turn in WISHES:
            command = Twist()
            command.linear.x, command.angular.z = speed, turn
            wish.publish(command)
            trial.run(0.2)
        wanted = [(speed / 2, turn / 2) for speed, turn in WISHES]
        said = f"For {len(WISHES)} wishes it sent {len(got)} commands, not {len(WISHES)}."
        expect(len(got) == len(wanted), said, "publish one command for each wish, in the callback")
        for (speed, turn), sent in zip(WISHES, got, strict=True):
            expect(
                math.isclose(sent[0], speed / 2) and math.isclose(sent[1], turn / 2),
                f"For the wish {speed} m/s, {turn} rad/s it sent {sent[0]:g} m/s, {sent[1]:g} rad/s.",
                "halve both linear.x and angular.z",
            )
        trial.start(driver(turn=0.5), "cmd_vel:=wish")
        trial.run(12.0)
        return trial.view()


# ---- introduce: the reader as the Master ----


@exercise("introduce", praise="One call made the robot drive; it is the same call that the Master makes.")
def introduce(answer: Script) -> Any:
    """Connect a driver and a robot after the Master has forgotten both."""
    with Trial("arena") as trial:
        graph = trial.graph
        simulator = graph.nodes["/simulator"].uri
        graph.ask_as("/simulator").call("unregisterSubscriber", "/cmd_vel", simulator)
        trial.start(driver(turn=0.4))
        trial.run(1.0)
        graph.ask_as("/driver").call("unregisterPublisher", "/cmd_vel", graph.nodes["/driver"].uri)
        trial.start(answer)
        moved = distance(trial, 3.0)
        state = graph.ask_as("/check").call("getSystemState")[2]
        known = {node for registry in state[:2] for topic, nodes in registry if topic == "/cmd_vel" for node in nodes}
        expect(
            not known & {"/simulator", "/driver"},
            "You registered them with the Master. Connect them without changing its registrations.",
            "call the subscriber itself: rospy.core.xmlrpcapi(address)",
        )
        expect(
            moved > 0.2,
            "The robot does not drive: it does not know the driver's address yet.",
            'call publisherUpdate("/master", "/cmd_vel", [address of the driver]) at the address of the subscriber',
        )
        return trial.view()


# ---- referee: too many drivers ----


@exercise("referee", praise="Only one driver is left, and the robot follows it.")
def referee(answer: Script) -> Any:
    """The script asks every publisher of /cmd_vel except /driver to shut down."""
    with Trial("room") as trial:
        trial.start(driver(speed=0.15))
        strangers = {"prankster": 2.0, "imp": -1.0}
        for name, turn in strangers.items():
            trial.start(driver(f"{name}.py", -0.1, turn), f"__name:={name}")
        trial.run(2.0)
        trial.start(answer)
        trial.run(1.0)
        there = trial.graph.nodes
        expect(
            "/driver" in there,
            "You ended /driver too.",
            "leave out the node that may stay: compare each name with /driver",
        )
        expect(
            "/simulator" in there,
            "You ended the simulator, and the robot with it.",
            "the first list of getSystemState contains the publishers, the second the subscribers",
        )
        left = [name for name in strangers if f"/{name}" in there]
        expect(
            not left,
            f"Nodes other than /driver still publish commands: /{', /'.join(left)}.",
            "ask the Master for the publishers of /cmd_vel, look up the address of each, and call shutdown there",
        )
        trial.run(4.0)
        return trial.view()
