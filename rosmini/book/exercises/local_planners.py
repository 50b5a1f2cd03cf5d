"""Checks of the exercises in the chapter Local planners."""

from __future__ import annotations

import math
from typing import Any

import numpy as np

from rosmini.book.checks import Script, exercise, expect, expect_number
from rosmini.book.drives import Drive, navigation, settings_of
from rosmini.book.trials import Trial

# ---- manners: a critic that keeps away from a person ----

WALK = np.column_stack([np.linspace(0, 1, 11), np.zeros(11), np.zeros(11)])
PEOPLE = (
    ((0.5, 2.0), 0.0, "beyond 1 m the cost is 0, never negative"),
    ((0.5, 0.7), 0.5, "from 1 m to 0.4 m the cost grows linearly from 0 to 1"),
    ((1.5, 0.0), 5 / 6, "take all points into account, the last one included"),
    ((0.5, 0.3), -1.0, "a point in the middle may be the nearest: take all points into account"),
    ((-0.3, 0.0), -1.0, "reject a trajectory that comes nearer than 0.4 m, at the first point as well"),
    ((0.3, -0.8), 1 / 3, "a distance is never negative"),
)


@exercise("manners", praise="With a weight and the other critics, it keeps the robot at a distance.")
def manners(answer: Any) -> None:
    """A critic that keeps the robot away from a person."""
    for person, wanted, hint in PEOPLE:
        found = expect_number(answer(WALK.copy(), person), "number")
        expect(
            math.isclose(found, wanted, abs_tol=1e-6),
            f"A trajectory from (0, 0) to (1, 0) with a person at {person} gets {found:.3g}, not {wanted:.3g}.",
            hint,
        )


# ---- wander: a local planner without a plan ----

STARTS = (((2.9, 0.5, 1.57), 2.0, 0.0), ((-0.4, 0.0, 3.14), 0.0, 1.5))
"""Poses in the room, and how far the robot drives [m] and turns [rad] from each, at least. At the second one it faces a
wall, and has to turn first. Whether it gets away afterwards depends on the errors of its laser: once it is nearer than
0.2 m to something, every trajectory is rejected."""
SECONDS = 20.0
FREE_SECONDS, FREE_TURN = 4.0, 0.25
"""At the first start nothing is in the way for this time [s], and the robot turns by less than this angle [rad]."""


@exercise("wander", praise="It samples, simulates, rejects and chooses, five times a second.")
def wander(answer: Script) -> Any:
    """The robot wanders through the room, and touches nothing."""
    for (x, y, yaw), least, least_turn in STARTS:
        with Trial("room", f"_x:={x}", f"_y:={y}", f"_yaw:={yaw}") as trial:
            trial.start(answer)
            driven, turned, before = 0.0, 0.0, (x, y, yaw)
            for step in range(round(2 * SECONDS)):
                trial.run(0.5)
                touched = trial.robot.engine.contacts.touches(trial.robot.name)
                expect(
                    not touched,
                    f"From ({x:g}, {y:g}) the robot touched something after {(step + 1) / 2:g} s.",
                    "reject w if any of its points is nearer than 0.2 m to any obstacle",
                )
                here = trial.robot.truth()
                driven += math.dist(here[:2], before[:2])
                turned += abs(math.remainder(here[2] - before[2], math.tau))
                before = here
                expect(
                    (x, y, yaw) != STARTS[0][0] or (step + 1) / 2 > FREE_SECONDS or turned < FREE_TURN,
                    f"From ({x:g}, {y:g}) the robot turned by {math.degrees(turned):.0f} degrees, although nothing is "
                    "in front of it.",
                    "of the turning speeds that are left, choose the one with the smallest absolute value",
                )
            expect(
                driven >= least,
                f"From ({x:g}, {y:g}) the robot drove only {driven:.1f} m in {SECONDS:g} s.",
                "drive at 0.15 m/s if a turning speed is left",
            )
            expect(
                turned >= least_turn,
                f"From ({x:g}, {y:g}), in front of a wall, the robot turned by only {math.degrees(turned):.0f} degrees "
                f"in {SECONDS:g} s.",
                "if no turning speed is left, turn on the spot until one is",
            )
            view = trial.view()
    return view


# ---- past_the_crate: two wrong numbers ----


@exercise("past_the_crate", praise="It looks far enough ahead, and passes the crate.")
def past_the_crate(answer: Any) -> Any:
    """Settings of the local planner with which the robot passes the crate."""
    settings = settings_of(answer, "settings")
    with Drive(navigation((0.1, 1.4, 0.0), settings, world="room")) as drive:
        drive.expect_arrival(
            (2.05, 1.2, 0.0),
            20.0,
            "one number makes the robot afraid of the crate, the other makes it turn on the spot",
        )
        return drive.view()
