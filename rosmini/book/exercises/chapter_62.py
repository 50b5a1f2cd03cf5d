"""What is right in the exercises of chapter 62, a node that moves: scripts tried with a turtle of their own."""

from __future__ import annotations

import math
from typing import TYPE_CHECKING, Any

from rosmini.book.checks import Script, exercise, expect
from rosmini.book.trials import TurtleTrial
from rosmini.msgs.geometry_msgs.msg import Twist

if TYPE_CHECKING:
    from rosmini.sim.turtlesim import Turtle

CORNERS = ((8.0, 2.0), (8.0, 8.0), (2.0, 8.0))
EDGE = 499 / 45
"""The largest x and y of a turtle [m]."""
SLANTING = (5.5, 5.5, 0.5)
"""A start from where it meets the wall at a slant, and slides along it into the corner: x, y, heading."""
STEP_S = 0.02
MOST_COMMANDS = 1000
"""More than this, in a turn that takes three seconds, come out of a loop that does not sleep."""


def _turtle(trial: TurtleTrial) -> Turtle:
    return trial.sim.turtles["turtle1"]


def _run_to_the_end(trial: TurtleTrial, answer: Script, seconds: float) -> None:
    """Run a script; it has to end in that time, and to leave a turtle that stands."""
    handle = trial.start(answer)
    trial.run(seconds)
    expect(
        handle.poll() is not None,
        f"It still runs after {seconds:g} s.",
        "the loop has to end, and then the script",
    )
    turtle = _turtle(trial)
    expect(
        turtle.forward == 0 and turtle.angular_velocity == 0,
        "It has ended, and the turtle still moves.",
        "publish a Twist() at the end",
    )


# ---- 62.1: a quarter turn ----


@exercise("62.1", praise="A quarter turn by the clock, and a node that knows its end.")
def turn(answer: Script) -> Any:
    """It turns to the left by pi / 2 at 0.5 rad/s, on the spot, whatever the heading was before."""
    for heading in (0.0, 1.0):
        with TurtleTrial() as trial:
            turtle = _turtle(trial)
            turtle.teleport_absolute(5.5, 5.5, heading)
            trial.start(answer)
            trial.run(1.5)
            expect(
                abs(turtle.angular_velocity - 0.5) < 0.01,
                f"After 1.5 s the turtle turns at {turtle.angular_velocity:.2f} rad/s, not at 0.5.",
                "command.angular.z = 0.5, published again and again",
            )
        with TurtleTrial() as trial:
            turtle = _turtle(trial)
            turtle.teleport_absolute(5.5, 5.5, heading)
            heard: list[Twist] = []
            trial.graph.node("ear").subscriber("/turtle1/cmd_vel", Twist, heard.append)
            _run_to_the_end(trial, answer, 8.0)
            angle = math.remainder(turtle.theta - heading, 2 * math.pi)
            expect(
                abs(angle - math.pi / 2) < 0.1,
                f"It turned by {angle:.2f} rad, and a quarter turn is {math.pi / 2:.2f}.",
                "0.5 times the seconds is the angle so far",
            )
            away = math.hypot(turtle.x - 5.5, turtle.y - 5.5)
            expect(away < 0.01, f"It left its place by {away:.2f} m.", "linear.x stays 0")
            expect(
                len(heard) < MOST_COMMANDS,
                f"It sent {len(heard)} commands, as fast as the computer can.",
                "rate.sleep() in the loop",
            )
            view = trial.view()
    return view


# ---- 62.2: up to the wall ----


@exercise("62.2", praise="The turtle feels the wall, though it has no sensor for that: the pose was enough.")
def wall(answer: Script) -> Any:
    """It reaches the wall in any direction, does not stop before, says so once, and ends."""
    for start in (SLANTING, (3.0, 3.0, -math.pi / 2), (2.5, 7.0, math.pi), (5.0, 5.0, math.pi / 2)):
        with TurtleTrial() as trial:
            turtle = _turtle(trial)
            turtle.teleport_absolute(*start)
            _run_to_the_end(trial, answer, 40.0)
            left = sorted(min(place, EDGE - place) for place in (turtle.x, turtle.y))
            expect(
                left[0] < 0.05,
                f"It stopped {left[0]:.2f} m before the wall.",
                "it gets on as long as there is no wall",
            )
            expect(
                start != SLANTING or left[1] < 0.05,
                f"It met the wall at a slant, and stopped {left[1]:.2f} m before the corner, while it still got on.",
                "compare how far it came in a round, in x and y together, with nearly nothing",
            )
            count = sum(line.endswith("]: wall") for line in trial.output.splitlines())
            expect(
                count == 1,
                f"It logged 'wall' {count} times, not once.",
                'rospy.loginfo("wall"), after the loop',
            )
            view = trial.view()
    return view


# ---- 62.3: round the corners ----


@exercise("62.3", praise="Three goals, one after the other: that is how a robot follows a path.")
def corners(answer: Script) -> Any:
    """The path comes near each corner, in their order, and ends at the last one."""
    with TurtleTrial() as trial:
        turtle = _turtle(trial)
        handle = trial.start(answer)
        reached = 0
        for _ in range(round(60 / STEP_S)):
            trial.run(STEP_S)
            x, y = CORNERS[reached]
            if math.hypot(turtle.x - x, turtle.y - y) < 0.1:
                reached += 1
            if reached == len(CORNERS) or handle.poll() is not None:
                break
        missed = CORNERS[min(reached, len(CORNERS) - 1)]
        expect(
            reached == len(CORNERS),
            f"It did not come to {missed}: it is at ({turtle.x:.2f}, {turtle.y:.2f}).",
            "atan2(y - pose.y, x - pose.x) is the course, and pose.theta the heading",
        )
        trial.run(3.0)
        expect(
            handle.poll() is not None, "It is at the last corner, and does not end.", "a tolerance of 0.05"
        )
        away = math.hypot(turtle.x - CORNERS[-1][0], turtle.y - CORNERS[-1][1])
        expect(
            away < 0.1,
            f"It ended {away:.2f} m from the last corner.",
            "slow down: a speed in proportion to the distance",
        )
        return trial.view()
