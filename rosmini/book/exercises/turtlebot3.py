"""Checks of the exercises in the chapter TurtleBot3: each runs a script with a separate robot."""

from __future__ import annotations

import math
from itertools import pairwise
from typing import Any

from rosmini.book.checks import Script, exercise, expect
from rosmini.book.trials import Trial

from .nodes_and_master import driver

Pose = tuple[float, float, float]


def poses(trial: Trial, seconds: float, period: float = 0.5) -> list[Pose]:
    """Let time pass, and return the true poses of the robot after each period [m, m, rad]."""
    found = []
    for _ in range(round(seconds / period)):
        trial.run(period)
        found.append(trial.robot.truth())
    return found


# ---- eight: a figure of eight ----

RADIUS = 0.4
"""Radius of both circles of the eight [m]."""


@exercise("eight", praise="Both circles have the right size, and the robot is back where it started.")
def eight(answer: Script) -> Any:
    """The robot drives a circle to the left and one to the right, and stops where it started."""
    with Trial("empty") as trial:
        trial.start(answer)
        way = poses(trial, 60.0)
        if math.dist(way[-1][:2], way[-3][:2]) > 0.01:  # a slow eight
            way += poses(trial, 120.0)
        highest, lowest = max(y for _, y, _ in way), min(y for _, y, _ in way)
        expect(
            highest > 0.1 or lowest < -0.1,
            "The robot did not drive a circle.",
            "publish a Twist with linear.x and angular.z ten times a second, for the time of a full circle",
        )
        expect(
            math.dist(way[-1][:2], way[-3][:2]) < 0.01,
            "The robot is still driving.",
            "after the second circle, publish Twist() once",
        )
        first = next(y for _, y, _ in way if abs(y) > 0.1)
        expect(first > 0, "The first circle is to the right.", "left turns have positive angular.z")
        for side, found in (("left", highest), ("right", -lowest)):
            expect(
                abs(found - 2 * RADIUS) < 0.06,
                f"The circle to the {side} has a radius of {max(found, 0.0) / 2:.2f} m, not {RADIUS} m.",
                "the radius is v / w, and a full circle takes 2 pi / w seconds",
            )
        gap = math.dist(way[-1][:2], (0.0, 0.0))
        expect(
            gap < 0.12,
            f"The robot stopped {gap:.2f} m from where it started.",
            "a full circle takes 2 pi / w seconds; the robot needs no stop between the circles",
        )
        return trial.view()


# ---- dock: stop with the laser 0.30 m from a wall ----

DOCK_X, LASER_BEHIND = -8.0, 0.032
"""x coordinate of the house's west wall, and how far behind the robot's position the laser is [m]."""


@exercise("dock", praise="It found a wall that was out of sight at first, and stopped within 2 cm.")
def dock(answer: Script) -> Any:
    """The robot docks at a wall, from near and from out of the laser's reach."""
    docks_from(answer, -6.5)
    return docks_from(answer, -3.9)


def docks_from(answer: Script, start: float) -> Any:
    """Run the script with a robot that faces the west wall from x = `start` [m]; return the drive."""
    with Trial("house", f"_x:={start}", "_y:=0.8", "_yaw:=3.14159265", "_use_rep_117:=false") as trial:
        trial.start(answer)
        trial.run(start - DOCK_X + 45.0)
        before = trial.robot.truth()[0]
        trial.run(4.0)
        x = trial.robot.truth()[0]
        trial.expect_no_errors()
        seen = "near" if start < -6.0 else "out of the laser's reach"
        expect(
            x < start - 0.05,
            f"The wall was {seen}, and the robot did not drive.",
            "a range of 0.0 is not a distance: nothing was measured, so the wall is far away",
        )
        distance = x - DOCK_X + LASER_BEHIND
        expect(distance > 0.12, "The robot ran into the wall.", "the nearer the wall, the slower")
        expect(abs(x - before) < 0.02, "The robot is still driving.", "its speed must reach 0 at a distance of 0.30 m")
        expect(
            abs(distance - 0.30) <= 0.02,
            f"The laser is {distance:.3f} m from the wall, not 0.30 m to within 0.02 m.",
            "make the speed proportional to the remaining distance; if the robot is too near the wall, drive back",
        )
        return trial.view()


# ---- follow_wall: around the arena ----

HALF = 2.0
"""The walls of the arena are at x and y = +-2 m."""


@exercise("follow_wall", praise="It went around the arena and kept its distance, corners included.")
def follow_wall(answer: Script) -> Any:
    """The robot follows the wall on its right at 0.4 m."""
    with Trial("arena", "_x:=-0.5", "_y:=-1.4") as trial:
        trial.start(answer)
        poses(trial, 15.0)
        way = poses(trial, 105.0)
        trial.expect_no_errors()
        gaps = [HALF - max(abs(x), abs(y)) for x, y, _ in way]
        driven = sum(math.dist(a[:2], b[:2]) for a, b in pairwise(way))
        expect(
            driven > 5.0,
            f"The robot drove only {driven:.1f} m in 105 s.",
            "set linear.x while there is room ahead, and turn left where there is none",
        )
        expect(min(gaps) > 0.13, "The robot touched a wall.", "turn left on the spot if something is near ahead")
        turns = (way[-1][2] - way[0][2]) / (2 * math.pi)
        expect(
            turns > 0.6,
            f"The robot made {turns:.1f} turns to the left in 105 s; around the arena there is one in about 90 s.",
            "the wall is on the right: beams 180 to 359",
        )
        far = max(gaps)
        expect(
            far < 0.75,
            f"The robot was up to {far:.2f} m from the nearest wall; follow it at about 0.4 m.",
            "if the wall is too far to the right, turn right",
        )
        usual = sorted(gaps)[len(gaps) // 2]
        expect(
            0.3 <= usual <= 0.5,
            f"Most of the time the robot was about {usual:.2f} m from the wall, not 0.4 m.",
            "a beam at 45 degrees measures the distance divided by sin(45 degrees)",
        )
        return trial.view()


# ---- low_battery: stop with an empty battery ----

CHARGED, EMPTY = 0.5, 0.02
"""Charge levels with a voltage above and below 11.0 V."""


@exercise("low_battery", praise="It drives with a good battery, and stops when the voltage falls.", gaps=2)
def low_battery(answer: Script) -> Any:
    """The node passes wishes on while the battery is good."""
    with Trial("arena", "_board:=true", f"_battery:={EMPTY}") as trial:
        trial.start(answer)
        trial.start(driver(turn=0.5), "cmd_vel:=wish")
        trial.run(6.0)
        x, y, _ = trial.robot.truth()
        expect(
            math.hypot(x, y) < 0.02,
            "The battery was below 11.0 V, and the robot drove.",
            "compare the last voltage with 11.0, and publish Twist() if it is lower",
        )
        trial.expect_no_errors()
    with Trial("arena", "_board:=true", f"_battery:={CHARGED}") as trial:
        trial.start(answer)
        trial.start(driver(turn=0.5), "cmd_vel:=wish")
        way = poses(trial, 12.0)
        trial.expect_no_errors()
        expect(
            max(math.hypot(x, y) for x, y, _ in way) > 0.5,
            "The battery was good, and the robot did not drive.",
            "publish the wish itself while the voltage is 11.0 or more; does `on_battery` set a global variable?",
        )
        return trial.view()
