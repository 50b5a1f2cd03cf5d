"""Checks of the exercises in the chapter A node that moves: each runs a script with a separate turtle."""

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
"""Largest x and y of a turtle [m]."""
SLANTING = (5.5, 5.5, 0.5)
"""Start from which the turtle meets the wall at an angle and slides into the corner: x, y, heading."""
STEP_S = 0.02
MOST_COMMANDS = 1000
"""Number of commands above which a turn of three seconds came from a loop that does not sleep."""


def _turtle(trial: TurtleTrial) -> Turtle:
    return trial.sim.turtles["turtle1"]


def _run_to_the_end(trial: TurtleTrial, answer: Script, seconds: float) -> None:
    """Run a script; expect it to end within that time and to leave the turtle at rest."""
    handle = trial.start(answer)
    trial.run(seconds)
    expect(
        handle.poll() is not None,
        f"The script is still running after {seconds:g} s.",
        "end the loop, and let the script end after it",
    )
    turtle = _turtle(trial)
    expect(
        turtle.forward == 0 and turtle.angular_velocity == 0,
        "The script has ended, but the turtle is still moving.",
        "publish a Twist() at the end",
    )


# ---- turn: a quarter turn ----


@exercise("turn", praise="The turtle made a quarter turn, and the node ended by itself.")
def turn(answer: Script) -> Any:
    """The turtle turns to the left on the spot by pi / 2 at 0.5 rad/s, from any heading."""
    for heading in (0.0, 1.0):
        with TurtleTrial() as trial:
            turtle = _turtle(trial)
            turtle.teleport_absolute(5.5, 5.5, heading)
            trial.start(answer)
            trial.run(1.5)
            expect(
                abs(turtle.angular_velocity - 0.5) < 0.01,
                f"After 1.5 s the turtle turns at {turtle.angular_velocity:.2f} rad/s, not at 0.5.",
                "set command.angular.z = 0.5, and publish it repeatedly",
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
                f"The turtle turned by {angle:.2f} rad, but a quarter turn is {math.pi / 2:.2f}.",
                "the angle so far is 0.5 times the elapsed seconds",
            )
            away = math.hypot(turtle.x - 5.5, turtle.y - 5.5)
            expect(away < 0.01, f"The turtle moved by {away:.2f} m.", "keep linear.x at 0")
            expect(
                len(heard) < MOST_COMMANDS,
                f"The script sent {len(heard)} commands, because its loop does not sleep.",
                "call rate.sleep() in the loop",
            )
            view = trial.view()
    return view


# ---- wall: up to the wall ----


@exercise("wall", praise="The turtle has no contact sensor; its pose was enough to detect the wall.")
def wall(answer: Script) -> Any:
    """The turtle drives to the wall in any direction; the script logs it once and ends."""
    for start in (SLANTING, (3.0, 3.0, -math.pi / 2), (2.5, 7.0, math.pi), (5.0, 5.0, math.pi / 2)):
        with TurtleTrial() as trial:
            turtle = _turtle(trial)
            turtle.teleport_absolute(*start)
            _run_to_the_end(trial, answer, 40.0)
            left = sorted(min(place, EDGE - place) for place in (turtle.x, turtle.y))
            expect(
                left[0] < 0.05,
                f"The turtle stopped {left[0]:.2f} m from the wall.",
                "continue while the turtle is still moving",
            )
            expect(
                start != SLANTING or left[1] < 0.05,
                f"The turtle met the wall at an angle and stopped {left[1]:.2f} m from the corner, although "
                "it was still sliding.",
                "stop only if the distance moved in one cycle, in x and y together, is almost 0",
            )
            count = sum(line.endswith("]: wall") for line in trial.output.splitlines())
            expect(count == 1, f"It logged 'wall' {count} times, not once.", "log it after the loop")
            view = trial.view()
    return view


# ---- corners: round the corners ----


@exercise("corners", praise="A robot follows a path in the same way: one goal after the other.")
def corners(answer: Script) -> Any:
    """The path passes each corner in order, and ends at the last one."""
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
            f"The turtle did not reach {missed}: it is at ({turtle.x:.2f}, {turtle.y:.2f}).",
            "atan2(y - pose.y, x - pose.x) is the direction to the corner, and pose.theta the heading",
        )
        trial.run(3.0)
        expect(
            handle.poll() is not None,
            "The turtle is at the last corner, but the script does not end.",
            "use a tolerance of 0.05",
        )
        away = math.hypot(turtle.x - CORNERS[-1][0], turtle.y - CORNERS[-1][1])
        expect(
            away < 0.1,
            f"The turtle ended {away:.2f} m from the last corner.",
            "slow down: make the speed proportional to the distance",
        )
        return trial.view()
