"""Checks of the exercises in the chapter A goal by click: nodes that send goals to a robot in the house."""

from __future__ import annotations

import math
from typing import Any

from rosmini.book.checks import Script, Wrong, exercise, expect
from rosmini.book.drives import Drive, navigation
from rosmini.msgs.actionlib_msgs.msg import GoalID
from rosmini.msgs.geometry_msgs.msg import PointStamped
from rosmini.msgs.move_base_msgs.msg import MoveBaseActionGoal, MoveBaseActionResult
from rosmini.msgs.std_msgs.msg import Empty
from rosmini.navigation.nav_core import BadGoal
from rosmini.navigation.nav_core.poses import checked_goal

SUCCEEDED, PREEMPTED = 3, 2

Point = tuple[float, float]
Pose = tuple[float, float, float]


class Errands(Drive):
    """A robot in the house, and a list of the goals that move_base receives and of their ends."""

    def __init__(self, start: Pose, localization: str = "fake_localization") -> None:
        super().__init__(navigation(start, {}, localization=localization))
        self.goals: list[Any] = []
        """The poses of the goals."""
        self.begun: list[float] = []
        """The times of the goals [s]."""
        self.ends: list[tuple[int, float]] = []
        """The state in which each goal ended, and when [s]."""
        self._desk.subscriber("/move_base/goal", MoveBaseActionGoal, self._on_goal)
        self._desk.subscriber("/move_base/result", MoveBaseActionResult, self._on_result)
        self.cancels: list[Any] = []
        """The requests to cancel a goal."""
        self._desk.subscriber("/move_base/cancel", GoalID, self.cancels.append)
        self.run(0.1)

    def _on_goal(self, message: Any) -> None:
        self.goals.append(message.goal.target_pose)
        self.begun.append(self.graph.now().to_sec())

    def _on_result(self, message: Any) -> None:
        self.ends.append((message.status.status, self.graph.now().to_sec()))

    @property
    def places(self) -> list[Point]:
        """The positions of the goals [m]."""
        return [(round(each.pose.position.x, 2), round(each.pose.position.y, 2)) for each in self.goals]

    def expect_valid_goals(self) -> None:
        """Expect that the goals so far are in the frame map, and have an orientation."""
        for goal in self.goals:
            frame = goal.header.frame_id
            expect(frame == "map", f"A goal is in the frame {frame!r}, not 'map'.", "set header.frame_id of the goal")
            try:
                checked_goal(goal)
            except BadGoal as error:
                raise Wrong(f"move_base refuses a goal: {error}.", "set orientation.z and w") from error

    def expect_pose(self, goal: Pose, seconds: float, what: str, hint: str, heading_hint: str) -> None:
        """Expect that the goal that was just sent is this one, and that the robot reaches it in time.

        The hints are those for a wrong position and for a wrong heading.
        """
        self.expect_valid_goals()
        before = len(self.ends)
        for _ in range(round(2 * seconds)):
            if len(self.ends) > before:
                break
            self.run(0.5)
        self.expect_no_errors()
        x, y, yaw = self.robot.truth()
        off, turned = math.dist((x, y), goal[:2]), math.remainder(yaw - goal[2], math.tau)
        expect(
            off < 0.3,
            f"{what} the robot should be at {_named(goal)} after at most {seconds:g} s, but is at {_named((x, y))}.",
            hint,
        )
        expect(
            abs(turned) < 0.4,
            f"{what} the robot arrived, but its heading is off by {math.degrees(turned):.0f} degrees.",
            heading_hint,
        )


def _named(point: Any) -> str:
    return f"({point[0]:.1f}, {point[1]:.1f})"


# ---- one_click: a goal without a drag ----

CLICKS = ((-1.0, 0.9), (-1.05, -0.8))


@exercise("one_click", praise="One click is enough, and the robot faces the way it was going.")
def one_click(answer: Script) -> Any:
    """The robot drives to each point that is clicked, and looks in the direction from which it set out."""
    with Errands((-2.5, 0.6, 0.0)) as errands:
        points = errands.graph.node("clicker").publisher("/clicked_point", PointStamped, queue_size=1)
        errands.start(answer)
        errands.run(2.0)
        for number, (x, y) in enumerate(CLICKS, start=1):
            from_x, from_y, _ = errands.robot.truth()
            clicked = PointStamped()
            clicked.header.frame_id = "map"
            clicked.point.x, clicked.point.y = x, y
            points.publish(clicked)
            errands.run(1.0)
            errands.expect_no_errors()
            what = f"After a click at ({x}, {y})"
            expect(
                len(errands.goals) == number,
                f"{what} move_base received {len(errands.goals) - number + 1} goals; one is expected.",
                "publish one goal for each point",
            )
            heading = math.atan2(y - from_y, x - from_x)
            errands.expect_pose(
                (x, y, heading), 25.0, what, "copy the clicked point to goal.pose.position",
                "use math.atan2(dy, dx); z and w of a quaternion are the sine and the cosine of half the angle",
            )  # fmt: skip
        return errands.view()


# ---- home: take me back ----

BEGIN, AWAY = (-2.0, 0.6, 0.8), (-1.0, 0.6, 0.0)


@exercise("home", praise="One message brings the robot home from anywhere.")
def home(answer: Script) -> Any:
    """The first pose becomes the goal on each request, and only then."""
    with Errands(BEGIN, "amcl") as errands:
        ask = errands.graph.node("phone").publisher("home", Empty, queue_size=5)
        errands.start(answer)
        errands.run(1.0)
        expect(not errands.goals, "It sent a goal before there was a message on home.", "publish in on_home")
        errands.go(AWAY, 20.0)
        ask.publish(Empty())
        errands.run(1.0)
        errands.expect_no_errors()
        expect(
            len(errands.goals) == 2,
            "There was a message on home, but move_base received no goal.",
            "fill in the goal, then publish it",
        )
        errands.expect_pose(
            BEGIN, 20.0, "After a message on home", "use the first pose, not the last",
            "copy the orientation of the first pose as well as its position",
        )  # fmt: skip
        return errands.view()


# ---- waiter: no time to lose ----

TABLES = ((-2.0, 0.7), (-1.05, -0.8), (-2.3, 1.2))
PATIENCE = 25.0
BLOCKED = TABLES[1]
CRATES = {"crate 1": (-1.27, -0.05, 0.0), "crate 2": (-0.82, -0.05, 0.0), "toy box": (-1.03, -0.45, 0.0)}
"""Things that block the door to this table."""


@exercise("waiter", praise="Two of three tables are served, and no guest waits for the third.")
def waiter(answer: Script) -> Any:
    """Three goals in order; the one that cannot be reached is cancelled after 25 s."""
    with Errands((-3.0, 1.0, 0.0)) as errands:
        for name, pose in CRATES.items():
            errands.robot.drag(name, pose)
        errands.run(1.0)
        handle = errands.start(answer)
        while handle.poll() is None and errands.graph.now().to_sec() < 1080.0:
            errands.run(1.0)
            _expect_goals(errands)
        errands.expect_no_errors()
        expect(bool(errands.goals), "move_base received no goal.", "call client.send_goal(goal)")
        expect(handle.poll() is not None, "The script is still running after 75 s.", "end without spin()")
        expect(
            errands.places == list(TABLES),
            f"The goals were {errands.places}.",
            "send one goal for each x, y in the list, even after one that was cancelled",
        )
        errands.run(1.0)
        _expect_goals(errands)
        reached = [table for table, (end, _) in zip(TABLES, errands.ends, strict=False) if end == SUCCEEDED]
        expect(
            reached == [TABLES[0], TABLES[2]],
            f"The robot served only {reached}.",
            "wait for the result of each goal, even the last",
        )
        expect(
            bool(errands.cancels),
            f"The blocked goal {BLOCKED} ended only because the next goal replaced it.",
            "call cancel_goal() after the timeout, since the last goal of a list has no successor",
        )
        return errands.view()


def _expect_goals(errands: Errands) -> None:
    """Expect valid goals that ended as they should, so far."""
    errands.expect_valid_goals()
    for number, (state, end) in enumerate(errands.ends):
        place, took = errands.places[number], end - errands.begun[number]
        if place == BLOCKED:
            expect(
                state == PREEMPTED and abs(took - PATIENCE) < 1.0,
                f"The blocked goal {place} ended after {took:.0f} s; it should be cancelled after {PATIENCE:g} s.",
                "wait_for_result(rospy.Duration(25)) returns False at the timeout; then call cancel_goal()",
            )
        else:
            expect(
                state == SUCCEEDED,
                f"The goal {place} was cancelled after {took:.0f} s, although the robot was on its way.",
                "wait for the result of each goal before you send the next one",
            )
    if errands.begun and len(errands.ends) < len(errands.begun):
        waited = errands.graph.now().to_sec() - errands.begun[-1]
        expect(
            waited < PATIENCE + 3.0,
            f"The goal {errands.places[-1]} is still active after {waited:.0f} s.",
            "wait_for_result(rospy.Duration(25)) returns False at the timeout; then call cancel_goal()",
        )
