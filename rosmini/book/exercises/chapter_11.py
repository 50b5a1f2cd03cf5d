"""What is right in the exercises of chapter 11, Nodes and the Master: scripts, each tried on a robot of its own."""

from __future__ import annotations

import math
from typing import Any

from rosmini.book.checks import Script, exercise, expect
from rosmini.book.trials import Trial
from rosmini.msgs.geometry_msgs.msg import Twist

WALL_X = 3.3
"""Where the east wall of the room begins [m]; a robot in the origin looks at it."""

NEAR_M, TOUCH_M = 0.5, 0.11
"""How far from the wall the middle of the robot may stand at most, and where its front touches [m]."""

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


def way(trial: Trial, seconds: float) -> float:
    """Let time pass, and return how far the robot is then from where it was [m]."""
    x, y, _ = trial.robot.truth()
    trial.run(seconds)
    new_x, new_y, _ = trial.robot.truth()
    return math.hypot(new_x - x, new_y - y)


# ---- 11.1: stop before the wall ----


@exercise("11.1", praise="From two starts it came near the wall, and stood. It looks where it goes.")
def stop(answer: Script) -> Any:
    """The robot drives up to a wall and stands before it, wherever it starts."""
    stops_from(answer, 1.2)
    return stops_from(answer, 0.0)


def stops_from(answer: Script, start: float) -> Any:
    """Run the script with a robot at x = `start` [m]; return the drive. Raises `Wrong` if it does not stop in time."""
    with Trial("room", f"_x:={start}") as trial:
        trial.start(answer)
        trial.run(25.0)
        moved = way(trial, 1.0)
        if moved > 0.01:  # a careful robot is still on its way
            trial.run(35.0)
            moved = way(trial, 1.0)
        x, _, _ = trial.robot.truth()
        expect(
            x > start + 0.1,
            "The robot did not drive, although the wall was far away.",
            "compare scan.ranges[0] with a distance, and publish at every scan",
        )
        gap = WALL_X - x
        expect(gap > TOUCH_M, "The robot ran against the wall.", "compare scan.ranges[0] with a distance")
        expect(
            moved < 0.01,
            "The robot is still driving, long after it should have reached the wall.",
            "a command of zero stops it",
        )
        expect(
            gap < NEAR_M + 0.01,
            f"The robot stopped {gap:.2f} m from the wall; it should come nearer than half a metre.",
            "beam 0 looks straight ahead; it starts 3 cm behind the middle of the robot",
        )
        trial.expect_no_errors()
        return trial.view()


# ---- 11.2: a node in the middle ----

WISHES = ((0.2, 0.0), (0.1, 1.0), (-0.08, -0.6), (0.0, 0.0))


@exercise("11.2", praise="Neither the driver nor the robot knows that your node is between them.", gaps=2)
def gentle(answer: Script) -> Any:
    """What comes on /wish goes to /cmd_vel at half the speed."""
    got: list[tuple[float, float]] = []
    with Trial("arena") as trial:
        trial.start(answer)
        listener, wisher = trial.graph.node("listener"), trial.graph.node("wisher")
        listener.subscriber("cmd_vel", Twist, lambda m: got.append((m.linear.x, m.angular.z)))
        wish = wisher.publisher("wish", Twist, queue_size=10)
        trial.run(2.0)
        expect(not got, "It sent a command before anybody wished for one.", "publish in the callback only")
        expect(wish.num_connections(), "Nobody subscribes to /wish.", "rospy.Subscriber, with the type Twist")
        for speed, turn in WISHES:
            command = Twist()
            command.linear.x, command.angular.z = speed, turn
            wish.publish(command)
            trial.run(0.2)
        wanted = [(speed / 2, turn / 2) for speed, turn in WISHES]
        said = f"For {len(WISHES)} wishes it sent {len(got)} commands, not {len(WISHES)}."
        expect(len(got) == len(wanted), said, "one command for each wish, published in the callback")
        for (speed, turn), sent in zip(WISHES, got, strict=True):
            expect(
                math.isclose(sent[0], speed / 2) and math.isclose(sent[1], turn / 2),
                f"For the wish {speed} m/s, {turn} rad/s it sent {sent[0]:g} m/s, {sent[1]:g} rad/s.",
                "half of linear.x, and half of angular.z",
            )
        trial.start(driver(turn=0.5), "cmd_vel:=wish")
        trial.run(12.0)
        return trial.view()


# ---- 11.3: the reader as the Master ----


@exercise("11.3", praise="One call, and the robot drives. It is all that the Master would have done.")
def introduce(answer: Script) -> Any:
    """A driver and a robot are brought together, of which the Master has forgotten what they have in common."""
    with Trial("arena") as trial:
        graph = trial.graph
        simulator = graph.nodes["/simulator"].uri
        graph.ask_as("/simulator").call("unregisterSubscriber", "/cmd_vel", simulator)
        trial.start(driver(turn=0.4))
        trial.run(1.0)
        graph.ask_as("/driver").call("unregisterPublisher", "/cmd_vel", graph.nodes["/driver"].uri)
        trial.start(answer)
        moved = way(trial, 3.0)
        state = graph.ask_as("/check").call("getSystemState")[2]
        known = {
            node
            for registry in state[:2]
            for topic, nodes in registry
            if topic == "/cmd_vel"
            for node in nodes
        }
        expect(
            not known & {"/simulator", "/driver"},
            "You registered them at the Master. Leave the Master's directory alone.",
            "speak to the subscriber itself: rospy.core.xmlrpcapi(address)",
        )
        expect(
            moved > 0.2,
            "The robot does not drive: it still does not know the driver.",
            'publisherUpdate("/master", "/cmd_vel", [address of the driver]), called at the address of the subscriber',
        )
        return trial.view()


# ---- 11.4: too many drivers ----


@exercise("11.4", praise="One driver is left, and the robot does what it says.")
def referee(answer: Script) -> Any:
    """Every publisher of /cmd_vel but /driver is asked to shut down."""
    with Trial("room") as trial:
        trial.start(driver(speed=0.15))
        strangers = {"prankster": 2.0, "imp": -1.0}
        for name, turn in strangers.items():
            trial.start(driver(f"{name}.py", -0.1, turn), f"__name:={name}")
        trial.run(2.0)
        trial.start(answer)
        trial.run(1.0)
        there = trial.graph.nodes
        expect("/driver" in there, "You ended /driver too.", "compare each name with the one that may stay")
        expect(
            "/simulator" in there,
            "You ended the robot itself.",
            "the first list of getSystemState has the publishers, the second one the subscribers",
        )
        left = [name for name in strangers if f"/{name}" in there]
        expect(
            not left,
            f"Somebody still drives beside /driver: /{', /'.join(left)}.",
            "ask the Master who publishes /cmd_vel, look up each one's address, and call shutdown there",
        )
        trial.run(4.0)
        return trial.view()
