"""Checks of the exercises in the chapter Topics and messages: each runs a script with a separate robot."""

from __future__ import annotations

import math
from itertools import pairwise
from typing import Any

import numpy as np

from rosmini.book.checks import Script, exercise, expect
from rosmini.book.trials import Trial
from rosmini.core.time import Duration
from rosmini.msgs.geometry_msgs.msg import Twist, TwistStamped
from rosmini.msgs.sensor_msgs.msg import LaserScan
from rosmini.msgs.std_msgs.msg import Bool

# ---- face: turn towards the nearest thing ----

STARTS = (("arena", "_x:=0.0", "_y:=1.2", "_yaw:=0.4"), ("room", "_x:=0.4", "_y:=0.2", "_yaw:=2.0"))


@exercise("face", praise="From two starting points, it turned to the nearest object and stopped there.")
def face(answer: Script) -> Any:
    """The robot turns on the spot until the smallest range is straight ahead."""
    return [_faces(answer, *start) for start in STARTS][-1]


def _faces(answer: Script, world: str, *start: str) -> Any:
    scans: list[Any] = []
    with Trial(world, *start) as trial:
        trial.graph.node("listener").subscriber("scan", LaserScan, scans.append)
        before = trial.robot.truth()
        trial.start(answer)
        trial.run(40.0)
        del scans[:]
        headings = [trial.robot.truth()[2]]
        for _ in range(10):
            trial.run(0.2)
            headings.append(trial.robot.truth()[2])
        after = trial.robot.truth()
        trial.expect_no_errors()
        moved = math.hypot(after[0] - before[0], after[1] - before[1])
        expect(moved < 0.05, f"The robot drove {moved:.2f} m; it should turn on the spot.", "set only angular.z")
        expect(abs(after[2] - before[2]) > 0.05, "The robot did not turn.", "publish a command for every scan")
        expect(
            sum(abs(now - last) > 0.01 for last, now in pairwise(headings)) <= 3,  # the laser errs
            "The robot is still turning after 40 s.",
            "the nearest beam varies by 10 with the laser's errors: within 10 degrees publish a zero command",
        )
        ranges = np.mean([scan.ranges for scan in scans], axis=0)  # the errors of a single scan hide the nearest beam
        beam = int(ranges.argmin())
        angle = min(beam, 360 - beam)
        side = "left" if beam < 180 else "right"
        expect(
            angle <= 12,
            f"The robot stopped, but the nearest object is {angle} degrees to the {side}.",
            "turn left while the nearest beam is one of 1 to 180, and right otherwise",
        )
        return trial.view()


# ---- fresh: ignore old commands ----

LATE_S = (0.0, 0.3, 2.0, 0.7, 0.0)
"""Ages of the commands [s]: those over 0.5 s are too old."""


@exercise("fresh", praise="Late commands stop the robot, so it never acts on an outdated one.")
def fresh(answer: Script) -> Any:
    """The node passes stamped commands on, and stops the robot if one is too old."""
    got: list[tuple[float, float]] = []
    with Trial("arena") as trial:
        trial.start(answer)
        listener, operator = trial.graph.node("listener"), trial.graph.node("operator")
        listener.subscriber("cmd_vel", Twist, lambda m: got.append((m.linear.x, m.angular.z)))
        remote = operator.publisher("remote_vel", TwistStamped, queue_size=10)
        trial.run(2.0)
        expect(not got, "It sent a command without a message on /remote_vel.", "publish only in the callback")
        expect(remote.num_connections(), "No node subscribes to /remote_vel.", "keep the stub's last lines")
        for late in LATE_S:
            for _ in range(10):
                command = TwistStamped()
                command.header.stamp = operator.now() - Duration.from_sec(late)
                command.twist.linear.x, command.twist.angular.z = 0.1, 0.5
                before = len(got)
                remote.publish(command)
                trial.run(0.1)
                trial.expect_no_errors()
                expect(len(got) == before + 1, f"For one command it sent {len(got) - before}.", "publish one for each")
                wanted = (0.0, 0.0) if late > 0.5 else (0.1, 0.5)
                expect(
                    got[-1] == wanted,
                    f"For a command that was {late:g} s old it sent {got[-1][0]:g} m/s, {got[-1][1]:g} rad/s.",
                    "compare rospy.Time.now() - command.header.stamp with rospy.Duration(0.5)",
                )
        return trial.view()


# ---- blocked: a latched state ----


@exercise("blocked", praise="It published twice in the whole drive, and a late node still knew the state.", gaps=2)
def blocked(answer: Script) -> Any:
    """The node publishes on a latched topic whether the way is blocked, when that changes."""
    early: list[bool] = []
    late: list[bool] = []
    with Trial("room", "_x:=1.5") as trial:
        listener, driver = trial.graph.node("listener"), trial.graph.node("driver")
        listener.subscriber("blocked", Bool, lambda m: early.append(m.data))
        wheels = driver.publisher("cmd_vel", Twist, queue_size=1)
        trial.start(answer)
        trial.run(2.0)
        trial.expect_no_errors()
        expect(early, "It published nothing on /blocked.", "the publisher has the type Bool and the name blocked")
        expect(
            early[0] is False,
            "It says that the path is blocked, but the wall is 1.8 m away.",
            "the path is blocked if scan.ranges[0] is less than 0.5",
        )
        for _ in range(75):
            command = Twist()
            command.linear.x = 0.2
            wheels.publish(command)
            trial.run(0.1)
        wheels.publish(Twist())
        trial.run(1.0)
        expect(early[-1] is True, "The wall is 0.3 m ahead, but it says that the path is free.", "use scan.ranges[0]")
        expect(
            early == [False, True],
            f"It published {len(early)} times while the state changed once.",
            "compare the state with the last one, and store it: last = ...",
        )
        trial.graph.node("late_listener").subscriber("blocked", Bool, lambda m: late.append(m.data))
        trial.run(0.5)
        expect(late == [True], f"A node that starts late receives {late}, not [True].", "publish with latch=True")
        return trial.view()


# ---- priority: one of two sources ----


@exercise("priority", praise="The operator took over at once, and the navigation came back a second later.", gaps=2)
def priority(answer: Script) -> Any:
    """The node drops the navigation's commands for a second after each command of the joystick."""
    got: list[tuple[float, float]] = []
    with Trial("arena", "_x:=-1.5", "_y:=-1.0") as trial:
        trial.start(answer)
        graph = trial.graph
        graph.node("listener").subscriber("cmd_vel", Twist, lambda m: got.append((m.linear.x, m.angular.z)))
        joystick = graph.node("joystick").publisher("joy_vel", Twist, queue_size=10)
        navigation = graph.node("navigation").publisher("nav_vel", Twist, queue_size=10)
        trial.run(1.0)
        for publisher, topic in ((joystick, "/joy_vel"), (navigation, "/nav_vel")):
            expect(publisher.num_connections(), f"No node subscribes to {topic}.", "keep the stub's last lines")
        ahead, turn = (0.2, 0.0), (0.0, 0.8)

        def send(held: bool, tenths: int) -> list[tuple[float, float]]:
            got.clear()
            for _ in range(tenths):
                for publisher, (speed, rate) in ((navigation, ahead), (joystick, turn))[: 1 + held]:
                    command = Twist()
                    command.linear.x, command.angular.z = speed, rate
                    publisher.publish(command)
                trial.run(0.1)
            trial.expect_no_errors()
            return got

        expect(
            send(False, 20) == [ahead] * 20,
            "While nobody held the joystick, it did not pass on every command from the navigation.",
            "without any command from the joystick, on_navigation publishes each command",
        )
        held = send(True, 20)
        passed = [command for command in held if command == turn]
        expect(
            len(passed) == 20, f"Of 20 commands from the joystick it passed on {len(passed)}.", "publish each of them"
        )
        expect(
            held.count(ahead) <= 1,
            "It passed on commands from the navigation while somebody held the joystick.",
            "remember rospy.get_time() in on_joystick, and compare in on_navigation",
        )
        expect(
            not send(False, 7),
            "It let the navigation drive 0.7 s after the last command from the joystick.",
            "drop its commands while rospy.get_time() is at most one second later",
        )
        expect(
            len(send(False, 10)) in range(6, 9),
            "After one second without the joystick it does not pass on the navigation's commands again.",
            "the time must be that of the last command from the joystick, not from the navigation",
        )
        return trial.view()
