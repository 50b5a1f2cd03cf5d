"""Checks of the exercises in the chapter Local planners."""

from __future__ import annotations

import math
from dataclasses import fields
from numbers import Real
from typing import Any

import numpy as np

from rosmini.book.checks import Wrong, exercise, expect, expect_number, expect_type
from rosmini.book.trials import TurtleTrial
from rosmini.core.dynamic_reconfigure import Client
from rosmini.core.errors import RosminiError
from rosmini.msgs.geometry_msgs.msg import PoseStamped
from rosmini.navigation.dwa_local_planner.dwa_planner import DWAPlannerParameters
from rosmini.ros.launch import roslaunch

# ---- window: the window ----

NAMES = ("low v", "high v", "low w", "high w")
WINDOWS = (
    (
        (0.15, 0.0),
        (-1.0, 1.0, 2.0),
        (1.0, 3.0),
        0.1,
        "the window is acceleration times period on either side of the velocity",
    ),
    ((0.05, 0.0), (0.0, 1.0, 2.0), (1.0, 3.0), 0.1, "the low v is never below the minimum v"),
    ((0.02, 0.0), (-0.2, 0.22, 2.0), (1.0, 3.0), 0.1, "the low v may be negative: this robot can reverse"),
    ((0.20, 0.0), (0.0, 0.22, 2.0), (1.0, 3.0), 0.1, "the high v is never above the maximum v"),
    ((0.15, 1.9), (0.0, 0.22, 2.0), (0.5, 3.0), 0.1, "the high w is never above the maximum w"),
    ((0.15, -1.9), (0.0, 0.22, 2.0), (0.5, 3.0), 0.1, "the low w is never below minus the maximum w"),
    ((0.1, 0.5), (-0.2, 0.22, 2.0), (0.5, 3.0), 0.05, "use the argument: the period is not always 0.1 s"),
)


@exercise("window", praise="With 1.7 s instead of the period, this is the window of Trajectory Rollout.")
def window(answer: Any) -> None:
    """The velocities that the robot can reach in one period."""
    for velocity, limits, accelerations, period, hint in WINDOWS:
        found = answer(velocity, limits, accelerations, period)
        expect(
            isinstance(found, tuple | list | np.ndarray) and len(found) == 4,
            f"It returned {found!r}.",
            "return four numbers: low v, high v, low w, high w",
        )
        (v, w), (least, most, turn) = velocity, limits
        gain_v, gain_w = accelerations[0] * period, accelerations[1] * period
        wanted = (max(v - gain_v, least), min(v + gain_v, most), max(w - gain_w, -turn), min(w + gain_w, turn))
        for name, value, right in zip(NAMES, found, wanted, strict=True):
            number = expect_number(value, "number")
            expect(
                math.isclose(number, right, abs_tol=1e-9),
                f"At {velocity} with the limits {limits}, accelerations {accelerations} and a period of {period} s, "
                f"{name} is {right:.3g}, not {number:.3g}.",
                hint,
            )


# ---- manners: manners ----

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


# ---- refused_by: which critic ----

RAW = np.array(
    [[0.0, 12.0, 3.0], [0.0, -1.0, 4.0], [-5.0, -1.0, 2.0], [0.0, 1.0, -3.0], [-5.0, 2.0, -3.0], [0.0, 0.0, 0.0]]
)


@exercise("refused_by", praise="Counted per critic, this is the planner's report when no trajectory is left.")
def refused_by(answer: Any) -> None:
    """The first critic with a weight that returned a negative number."""
    for weights in ([1.0, 0.02, 0.8], [0.0, 0.02, 0.8], [1.0, 0.0, 0.0]):
        found = answer(RAW.copy(), list(weights))
        expect_type(found, list, "It returned", "a list")
        expect(len(found) == len(RAW), f"For {len(RAW)} trajectories it returned {len(found)} entries.")
        for row, given in zip(RAW.tolist(), found, strict=True):
            asked = [n for n, (value, weight) in enumerate(zip(row, weights, strict=True)) if weight and value < 0]
            wanted = asked[0] if asked else None
            expect(
                (given is None) == (wanted is None) and given == wanted,
                f"With the weights {weights} the trajectory {row} is refused by {wanted}, not by {given}.",
                "take the first negative score among critics whose weight is not 0; index 0 is not the same as None",
            )


# ---- changes: the dance ----

DANCE = {"min_vel_theta": 1.37, "yaw_goal_tolerance": 0.05}
GOALS = ((0.5, 0.0, 1.5), (0.5, 0.0, -1.0))


@exercise("changes", praise="The robot stops, turns and stays still.")
def changes(answer: Any) -> None:
    """Parameters with which a robot reaches its goal although its slowest turn is too fast for the tolerance."""
    expect_type(answer, dict, "The changes are", "a dictionary")
    known = {each.name for each in fields(DWAPlannerParameters)}
    for name, value in answer.items():
        expect(
            name in known,
            f"DWAPlannerROS has no parameter {name!r}.",
            "the exercise lists the names, such as min_vel_theta",
        )
        expect(isinstance(value, Real), f"{name} is {value!r}, which is not a number.")
    width = answer.get("yaw_goal_tolerance", 0.05)
    expect(
        0 < width <= 0.05,
        f"With a yaw_goal_tolerance of {width:g} the robot may stop with a wrong heading.",
        "keep the tolerance; what else decides how far the robot turns between two commands?",
    )
    with TurtleTrial(None) as trial:
        roslaunch(
            "rosmini_sim", "navigation.launch", "world:=room", graph=trial.graph, console={"capture_output": True}
        )
        _arrives(trial, {**DANCE, **answer})


def _arrives(trial: TurtleTrial, parameters: dict[str, float]) -> None:
    graph = trial.graph
    trial.run(1.0)
    move_base = graph.nodes["/move_base"].program
    room = graph.nodes["/simulator"].program
    tuner = graph.node("tuner")
    try:
        Client(tuner, "/move_base/DWAPlannerROS", timeout=5.0).update_configuration(parameters)
    except RosminiError as error:
        raise Wrong(f"The planner refuses these parameters: {error}") from error
    goals = tuner.publisher("move_base_simple/goal", PoseStamped, queue_size=1)
    trial.run(0.5)
    for x, y, yaw in GOALS:
        goal = PoseStamped()
        goal.header.frame_id = "map"
        goal.pose.position.x, goal.pose.position.y = x, y
        goal.pose.orientation.z, goal.pose.orientation.w = math.sin(yaw / 2), math.cos(yaw / 2)
        goals.publish(goal)
        trial.run(0.5)
        for _ in range(20):
            trial.run(0.5)
            if move_base.goal is None:
                break
        off = abs(math.remainder(room.truth()[2] - yaw, math.tau))
        expect(
            move_base.goal is None,
            f"After 10 s it had not arrived at ({x}, {y}); its heading was {math.degrees(off):.0f} degrees off.",
            "compare the smallest turn between two commands with the width of the target",
        )
        expect(off < 0.1, f"The robot stopped with its heading {math.degrees(off):.0f} degrees off.")
