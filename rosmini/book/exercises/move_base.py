"""Checks of the exercises in the chapter move_base: each starts the Navigation Stack in a house, and a robot drives."""

from __future__ import annotations

import math
from typing import Any

from rosmini.book.checks import Script, exercise, expect, expect_type
from rosmini.book.drives import Drive, navigation, settings_of
from rosmini.core.actionlib import Status
from rosmini.msgs.geometry_msgs.msg import PoseStamped
from rosmini.msgs.move_base_msgs.msg import MoveBaseActionGoal, MoveBaseActionResult, RecoveryStatus
from rosmini.msgs.std_msgs.msg import String
from rosmini.navigation.move_base.recoveries import InvalidList, parsed_entries
from rosmini.navigation.nav_core import BadGoal, pose_stamped
from rosmini.navigation.nav_core.poses import checked_goal

Place = tuple[float, float]


class Watched(Drive):
    """The Navigation Stack in the house, and what passes through the action `move_base`."""

    def __init__(self, start: tuple[float, float, float], settings: dict[str, Any]) -> None:
        super().__init__(navigation(start, settings))
        self.clerk = self.graph.node("clerk")
        self.goals: list[Any] = []
        """The goals, as poses."""
        self.ends: list[Any] = []
        """The last status of each goal that has ended, in the order in which they ended."""
        self._places: dict[str, Place] = {}
        self.clerk.subscriber("/move_base/goal", MoveBaseActionGoal, self._on_goal)
        self.clerk.subscriber(
            "/move_base/result", MoveBaseActionResult, lambda message: self.ends.append(message.status)
        )
        self.run(0.5)

    def _on_goal(self, message: Any) -> None:
        pose = message.goal.target_pose
        self.goals.append(pose)
        self._places[message.goal_id.id] = _place(pose)

    def replaced(self) -> list[Place]:
        """Return the places of goals that another goal has replaced."""
        cut = (Status.PREEMPTED, Status.RECALLED)
        return [self._places[status.goal_id.id] for status in self.ends if status.status in cut]

    def expect_waiting(self) -> None:
        """Expect that no goal has replaced another one."""
        cut = self.replaced()
        expect(
            not cut,
            f"The goal {str(cut[:1])[1:-1]} was preempted: the script sent the next goal while the robot was driving "
            "to this one.",
            "send_goal() returns at once; wait_for_result() waits until the goal has ended",
        )

    def expect_valid_goals(self) -> None:
        """Expect goals in the frame of the map, with an orientation."""
        for pose in self.goals:
            frame = pose.header.frame_id
            expect(frame.lstrip("/") == "map", f"A goal has the frame {frame!r}, not 'map'.", "set header.frame_id")
            try:
                checked_goal(pose)
            except BadGoal as error:
                expect(False, f"A goal is wrong: {error}", "set orientation.w to 1")


def _place(pose: Any) -> Place:
    return round(pose.pose.position.x, 3), round(pose.pose.position.y, 3)


# ---- patrol: three goals, one after the other ----

ROUND = [(-1.0, 0.9), (0.3, 0.9), (0.9, 2.4)]


@exercise("patrol", praise="The robot visits all three places, and each goal ends before the next begins.")
def patrol(answer: Script) -> Any:
    """The script sends three goals, one after the other, and ends."""
    with Watched((-2.0, 0.9, 0.0), {}) as drive:
        handle = drive.start(answer)
        for _ in range(50):
            drive.run(1.0)
            if len(drive.ends) == len(ROUND) or (handle.poll() is not None and len(drive.ends) >= len(drive.goals)):
                break
        drive.run(1.0)
        expect(bool(drive.goals), "move_base received no goal.", "call client.send_goal(goal)")
        drive.expect_valid_goals()
        drive.expect_waiting()
        places = [_place(pose) for pose in drive.goals]
        expect(places == ROUND, f"The goals were {places}, not {ROUND}.", "send one goal for each x, y of the list")
        lost = [status.text for status in drive.ends if status.status != Status.SUCCEEDED]
        expect(not lost, f"A goal failed: {''.join(lost[:1])}", "send the places in the list, as they are")
        expect(handle.poll() is not None, "The script is still running after the third goal.", "end without spin()")
        return drive.view()


# ---- courier: goals from a topic, and a report for each ----

PLACES = [(-1.0, 0.9), (-3.5, 2.1), (-0.2, 0.9)]
"""The second one is in a wall."""
IMPATIENT = {"planner_patience": 0.5, "recovery_behavior_enabled": False}


@exercise("courier", praise="Every sender learns what happened to the parcel.")
def courier(answer: Script) -> Any:
    """The script sends goals from a topic one after the other, and reports how each ended."""
    with Watched((-2.0, 0.9, 0.0), IMPATIENT) as drive:
        heard: list[str] = []
        drive.clerk.subscriber("/report", String, lambda message: heard.append(message.data))
        sender = drive.clerk.publisher("/places", PoseStamped, queue_size=10)
        handle = drive.start(answer)
        drive.run(1.0)
        for x, y in PLACES:
            sender.publish(pose_stamped("map", drive.clerk.now(), (x, y, 0.0)))
            drive.run(1.0)
        for _ in range(40):
            if len(drive.ends) == len(PLACES) or handle.poll() is not None:
                break
            drive.run(1.0)
        drive.run(1.0)
        expect(bool(drive.goals), "move_base received no goal.", "send_goal(MoveBaseGoal(target_pose=pose))")
        drive.expect_valid_goals()
        drive.expect_waiting()
        places = [_place(pose) for pose in drive.goals]
        expect(
            places == PLACES,
            f"The places on the topic were {PLACES}, and the second one is in a wall; the goals were {places}.",
            "continue after a goal that has failed",
        )
        wanted = ["arrived" if status.status == Status.SUCCEEDED else status.text for status in drive.ends]
        expect(
            heard == wanted,
            f"The reports were {heard}, not {wanted}.",
            "get_state() says whether the robot has arrived, get_goal_status_text() why not",
        )
        return drive.view()


# ---- no_turning: a list of recovery behaviours ----

CLEAR = "clear_costmap_recovery/ClearCostmapRecovery"
CRATES = {"crate 1": (-1.27, -0.05, 0.0), "crate 2": (-0.82, -0.05, 0.0), "toy box": (-1.03, -0.45, 0.0)}
"""Things that block the door of the child's room."""


@exercise("no_turning", praise="It forgot twice without turning, and the cable stays straight.")
def no_turning(answer: Any) -> Any:
    """Two resets of the costmaps, the larger square first, and no rotation."""
    settings = settings_of(answer, "settings")
    names = _recoveries(settings)
    with Watched((-1.0, 0.9, -math.pi / 2), {**settings, "planner_patience": 1.0}) as drive:
        ran: list[str] = []
        drive.clerk.subscriber(
            "/move_base/recovery_status", RecoveryStatus, lambda message: ran.append(message.recovery_behavior_name)
        )
        for name, pose in CRATES.items():
            drive.robot.drag(name, pose)
        drive.run(1.0)
        drive.go((-1.6, -1.2, 0.0), 30.0)
        expect(ran == names, f"The robot before the blocked door ran {ran}, not {names}.", "look at the names")
        return drive.view()


def _recoveries(settings: dict[str, Any]) -> list[str]:
    """Return the names of the behaviours. Raises `Wrong` unless they are two resets with the right parameters."""
    try:
        named = parsed_entries(settings.get("recovery_behaviors"))
    except InvalidList as error:
        expect(False, f"move_base refuses this list: {error}", "write a list of {name: ..., type: ...}")
        return []
    kinds = [kind.replace("::", "/") for _, kind in named]
    expect("rotate_recovery/RotateRecovery" not in kinds, "With this list the robot turns.", "remove rotate_recovery")
    expect(
        kinds == [CLEAR, CLEAR],
        f"The types are {kinds}.",
        f"use two recovery behaviors of type {CLEAR}, with different names",
    )
    for (name, _), side in zip(named, (4.0, 1.0), strict=True):
        own: Any = settings.get(name)
        expect_type(own, dict, f"The value of {name} is", "a mapping of parameters")
        expect(
            own.get("reset_distance") == side,
            f"reset_distance of {name} is {own.get('reset_distance')!r}, but should be {side:g}.",
            "set 4 m first, then 1 m; it is the side of the square, not half of it",
        )
        expect(
            own.get("layer_names") == ["obstacle_layer"],
            f"layer_names of {name} is {own.get('layer_names')!r}: in our costmaps this clears nothing, or too much.",
            "write a list with obstacle_layer",
        )
    return [name for name, _ in named]
