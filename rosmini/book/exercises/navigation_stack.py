"""Checks of the exercises in the chapter The Navigation Stack: a number, a goal from a node, and a length."""

from __future__ import annotations

import math
from types import SimpleNamespace
from typing import Any

from rosmini.book.checks import Script, Wrong, exercise, expect, expect_type
from rosmini.book.trials import Trial
from rosmini.msgs import message_class

# ---- demand: which demand is not met ----

UNMET = 1
SEEN = {
    2: "the transform from the map to the laser, through odom, exists",
    3: "five scans a second arrive, and the position of the laser is known",
    4: "the footprint is optional, and a robot in an open hall starts without it",
}


@exercise(
    "demand", praise="No node subscribes to the commands: the base's driver is not running, or uses another topic."
)
def demand(answer: Any) -> Any:
    """The first demand is not met: cmd_vel has no subscriber."""
    expect_type(answer, int, "The answer is", "the number of a demand")
    expect(answer in (1, *SEEN), f"There is no demand {answer}.", "there are four")
    expect(answer == UNMET, f"Demand {answer} is met: {SEEN.get(answer, '')}.", "read the first output again")
    return None


# ---- go_there: a goal from a program ----

PLACE = (-1.0, 2.6)
LATE = 3.0
"""Delay before the trial subscribes [s]."""


@exercise("go_there", praise="A goal is one message with a frame, a position and a heading.")
def go_there(script: Any) -> Any:
    """The script publishes the goal on move_base_simple/goal, in the frame map, with position and heading."""
    expect_type(script, Script, "The answer is", "a script")
    goal_class = message_class("geometry_msgs/PoseStamped")
    heard: list[Any] = []
    with Trial("room", is_shown=False) as trial:
        trial.start(script)
        trial.run(LATE)
        trial.graph.node("move_base").subscriber("/move_base_simple/goal", goal_class, heard.append)
        trial.run(10.0)
    expect(
        heard,
        "There was no goal on move_base_simple/goal. The check subscribed three seconds after the script had started.",
        "before you publish, wait until get_num_connections() is not 0",
    )
    _check_goal(heard[-1])
    return None


def _check_goal(goal: Any) -> None:
    frame, p, q = goal.header.frame_id, goal.pose.position, goal.pose.orientation
    expect(frame.lstrip("/") == "map", f"The goal is in the frame {frame!r}, not 'map'.", "set its frame_id")
    expect(
        math.dist((p.x, p.y), PLACE) < 0.01,
        f"The goal is at ({p.x:g}, {p.y:g}), not at {PLACE}.",
        "set goal.pose.position",
    )
    length = math.sqrt(q.x**2 + q.y**2 + q.z**2 + q.w**2)
    expect(
        abs(length - 1) < 0.01,
        f"The quaternion has the length {length:.2f}; move_base accepts only length 1.",
        "set z and w to 0.7071",
    )
    expect(
        abs(q.z - q.w) < 0.01 and abs(q.x) < 0.01 and abs(q.y) < 0.01,
        f"The quaternion is ({q.x:g}, {q.y:g}, {q.z:g}, {q.w:g}), which is a different heading.",
        "a quarter turn to the left has z = w = 0.7071",
    )


# ---- length: the length of a path ----


def _path(*places: tuple[float, float]) -> list[Any]:
    made = []
    for x, y in places:
        pose = message_class("geometry_msgs/PoseStamped")()
        pose.pose.position.x, pose.pose.position.y = x, y
        made.append(pose)
    return made


PATHS = SimpleNamespace(
    bent=_path((0.0, 0.0), (3.0, 4.0), (3.0, 5.0)),
    back=_path((1.0, 1.0), (2.0, 1.0), (1.0, 1.0)),
    one=_path((5.0, 5.0)),
)


@exercise("length", praise="This is the distance that the robot drives; the straight line is shorter.")
def length(function: Any) -> Any:
    """The sum of the distances from each pose to the next."""
    expect(callable(function), "The answer is not a function.", "write def length(poses): ...")
    for poses, wanted, what in (
        (PATHS.bent, 6.0, "a path of 5 m and then 1 m"),
        (PATHS.back, 2.0, "a path of 1 m and back again"),
        (PATHS.one, 0.0, "a path of one pose"),
        ([], 0.0, "an empty path"),
    ):
        try:
            found = function(poses)
        except Exception as error:
            raise Wrong(
                f"For {what} it fails: {type(error).__name__}: {error}", "try it with one pose and with none"
            ) from error
        expect_type(found, (int, float), f"For {what} the answer is", "a number")
        expect(
            abs(found - wanted) < 1e-6,
            f"For {what} it returned {found:.2f} m, not {wanted:.2f} m.",
            "add up the distances from each pose to the next",
        )
    return None
