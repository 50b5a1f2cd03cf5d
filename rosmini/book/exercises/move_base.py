"""Checks of the exercises in the chapter move_base."""

from __future__ import annotations

import math
from collections.abc import Collection, Sequence
from typing import Any

import numpy as np

from rosmini.book.checks import Script, exercise, expect, expect_type
from rosmini.book.trials import TurtleTrial
from rosmini.core.actionlib import SimpleActionServer
from rosmini.core.graph import Graph
from rosmini.core.time import Time
from rosmini.msgs.geometry_msgs.msg import PoseStamped
from rosmini.msgs.move_base_msgs.msg import MoveBaseAction
from rosmini.msgs.std_msgs.msg import String
from rosmini.navigation.costmap_2d import Costmap2D
from rosmini.navigation.move_base.recoveries import InvalidList, parsed_entries
from rosmini.navigation.nav_core import BadGoal, pose_stamped
from rosmini.navigation.nav_core.poses import checked_goal

Point = tuple[float, float]

# ---- 39.1 and 39.2: a played move_base ----

TAKES = 3.0
"""Time that the simulated `move_base` needs for a goal [s]."""


class PlayedMoveBase:
    """A node that offers the action `move_base` and aborts the goals in `failures` with their texts.

    It never reaches the goals in `lasting`. `begun` lists the goals, `cut` those that were preempted, and `took` the
    duration of each [s].
    """

    def __init__(
        self, graph: Graph, failures: dict[Point, str] | None = None, *, lasting: Collection[Point] = ()
    ) -> None:
        self.node = graph.node("move_base")
        self.failures, self.lasting = failures or {}, lasting
        self.took: dict[Point, float] = {}
        self.begun: list[Point] = []
        self.cut: list[Point] = []
        self.faults: list[str] = []
        self.server = SimpleActionServer(self.node, "move_base", MoveBaseAction, self._execute, auto_start=False)
        self.server.start()

    def _execute(self, goal: Any) -> None:
        pose = goal.target_pose
        place = (round(pose.pose.position.x, 3), round(pose.pose.position.y, 3))
        self.begun.append(place)
        if pose.header.frame_id.lstrip("/") != "map":
            self.faults.append(f"its frame is {pose.header.frame_id!r}, not 'map'")
        try:
            checked_goal(pose)
        except BadGoal as error:
            self.faults.append(str(error))
        start = self.node.now().to_sec()
        while self.node.now().to_sec() < start + TAKES or place in self.lasting:
            self.took[place] = self.node.now().to_sec() - start
            if self.server.is_preempt_requested():
                self.cut.append(place)
                self.server.set_preempted()
                return
            self.node.sleep(0.1)
        if place in self.failures:
            self.server.set_aborted(None, self.failures[place])
        else:
            self.server.set_succeeded(None, "Goal reached.")


@exercise("patrol", praise="The robot visits all three places, and each goal ends before the next begins.")
def patrol(answer: Script) -> None:
    """The script sends three goals, one after the other, and ends."""
    with TurtleTrial(None) as trial:
        played = PlayedMoveBase(trial.graph)
        handle = trial.start(answer)
        trial.run(15.0)
        wanted = [(1.0, 0.0), (2.0, 1.0), (0.0, 2.0)]
        expect(bool(played.begun), "move_base received no goal within 15 s.", "call client.send_goal(goal)")
        expect(
            not played.faults,
            f"A goal is wrong: {''.join(played.faults[:1])}.",
            "set header.frame_id, and orientation.w to 1",
        )
        expect(
            not played.cut,
            f"The goal {str(played.cut[:1])[1:-1]} was preempted by the next one.",
            "call wait_for_result() before the next goal",
        )
        expect(
            played.begun == wanted,
            f"The goals were {played.begun}, not {wanted}.",
            "call wait_for_result() after each goal: the next goal replaces one that has not ended"
            if played.begun == wanted[-1:]
            else "send one goal for each x, y of the list",
        )
        expect(handle.poll() is not None, "The script still runs after the third goal.", "end without spin()")


SHUT = "Failed to find a valid plan. Even after executing recovery behaviors."
SLIPPED = "Robot is oscillating. Even after executing recovery behaviors."


@exercise("courier", praise="Every sender learns what happened to the parcel.")
def courier(answer: Script) -> None:
    """The script executes goals from a topic one after the other, and reports the outcome of each."""
    failures = {(2.0, 0.0): SHUT, (4.0, 1.0): SLIPPED}
    places = [(1.0, 0.0), (2.0, 0.0), (3.0, 1.0), (4.0, 1.0), (5.0, 2.0)]
    with TurtleTrial(None) as trial:
        played = PlayedMoveBase(trial.graph, failures)
        trial.start(answer)
        desk = trial.graph.node("desk")
        heard: list[str] = []
        desk.subscriber("report", String, lambda message: heard.append(message.data))
        sender = desk.publisher("places", PoseStamped, queue_size=10)
        trial.run(2.0)
        for x, y in places:
            sender.publish(pose_stamped("map", Time(), (x, y, 0.5)))
            trial.run(1.0)
        trial.run(16.0)
        expect(bool(played.begun), "move_base received no goal.", "send_goal(MoveBaseGoal(target_pose=pose))")
        expect(
            not played.cut,
            f"The goal {str(played.cut[:1])[1:-1]} was preempted by the next one.",
            "call wait_for_result() in the callback",
        )
        expect(
            played.begun == places,
            f"There were five places on the topic, but the goals were {played.begun}.",
            "continue after a failed goal",
        )
        expect(not played.faults, f"A goal is wrong: {''.join(played.faults[:1])}.", "use the received pose")
        wanted = [failures.get(place, "arrived") for place in places]
        expect(
            heard == wanted,
            f"The reports were {heard}, not {wanted}.",
            "get_state() says whether the robot arrived, get_goal_status_text() says why not",
        )


# ---- keep_right: keep to the right ----

SIDE = 0.2
RESOLUTION = 0.05


class _Costmap:
    """A stand-in for `Costmap2DROS`: a corridor along x with a wall that leaves a gap of 0.3 m."""

    global_frame = "map"
    name = "global_costmap"

    def __init__(self, graph: Graph) -> None:
        self.node = graph.node("move_base")
        costs = np.zeros((40, 120), np.uint8)
        costs[[0, -1], :] = 254
        costs[:, 60:62] = 254
        costs[17:23, 60:62] = 0
        self.grid = Costmap2D.of(costs, RESOLUTION, (0.0, 0.0))
        self.footprint = np.array([[0.1, 0.1], [-0.1, 0.1], [-0.1, -0.1], [0.1, -0.1]])


@exercise("keep_right", praise="Two robots that meet now pass each other.")
def keep_right(answer: Any) -> None:
    """Plans in both directions, each moved a little to the right if there is room."""
    from rosmini.navigation.navfn.plugin import NavfnROS

    with Graph(strict=False) as graph:
        costmap: Any = _Costmap(graph)
        theirs = NavfnROS()
        theirs.initialize("NavfnROS", costmap)
        expect(
            isinstance(answer, type) and issubclass(answer, NavfnROS),
            "It is not a class that derives from NavfnROS.",
            "begin with class KeepRight(NavfnROS, plugin=...)",
        )
        mine = answer()
        mine.initialize("KeepRight", costmap)
        for start, goal, where in (
            ((0.5, 1.0, 0.0), (5.5, 1.0, 0.0), "towards x"),
            ((5.5, 1.0, 3.14), (0.5, 1.0, 3.14), "against x"),
            ((1.0, 0.4, 1.57), (1.0, 1.6, 1.57), "towards y"),
        ):
            ends = [pose_stamped("map", Time(), pose) for pose in (start, goal)]
            plan = mine.make_plan(*ends)
            expect_type(plan, list, "make_plan returned", "a list of poses")
            _expect_right(costmap.grid, theirs.make_plan(*ends), plan, where)


def _expect_right(grid: Costmap2D, theirs: Sequence[Any], mine: Sequence[Any], where: str) -> None:
    expect(
        len(theirs) == len(mine),
        f"{where} the plan of navfn has {len(theirs)} poses, but yours has {len(mine)}.",
        "move the poses, and keep all of them",
    )
    before, after = (np.array([(p.pose.position.x, p.pose.position.y) for p in plan]) for plan in (theirs, mine))
    expect(
        np.allclose(before[-1], after[-1]),
        f"{where} the plan ends at {_named(after[-1])}, but the goal is {_named(before[-1])}.",
        "do not move the last pose",
    )
    steps = np.diff(before, axis=0)
    lengths = np.hypot(*steps.T)
    right = np.stack([steps[:, 1], -steps[:, 0]], axis=1) / np.maximum(lengths, 1e-9)[:, None]
    wanted = before[:-1] + SIDE * right
    for number, (old, new, best) in enumerate(zip(before, after, wanted, strict=False)):
        if lengths[number] < 1e-6:
            continue
        cell = grid.world_to_map(*best)
        is_free = cell is not None and grid.cost(*cell) < 253
        aim, said = (best, "the point to its right is free") if is_free else (old, "there is an obstacle to its right")
        expect(
            math.dist(new, aim) < 0.02,
            f"{where} the pose at {_named(old)} was moved to {_named(new)}, but should be at {_named(aim)}: {said}.",
            "(dy, -dx) points to the right of (dx, dy); compute it from the old poses, and check the cost at "
            "the new point",
        )


def _named(point: Any) -> str:
    return f"({point[0]:.2f}, {point[1]:.2f})"


# ---- no_turning: a list of recoveries ----

CLEAR = "clear_costmap_recovery/ClearCostmapRecovery"


@exercise(
    "no_turning",
    praise="The robot clears its costmaps without turning, so the cable stays straight.",
    truths=("force_updating",),
)
def no_turning(answer: Any) -> None:
    """Two clearing behaviours, the larger area first, and no rotation."""
    expect_type(answer, dict, "parameters is", "a dictionary")
    try:
        named = parsed_entries(answer.get("recovery_behaviors"))
    except InvalidList as error:
        expect(False, f"move_base refuses this list: {error}", 'write a list of {"name": ..., "type": ...}')
        return
    kinds = [kind.replace("::", "/") for _, kind in named]
    expect("rotate_recovery/RotateRecovery" not in kinds, "With this list the robot turns.", "remove rotate_recovery")
    expect(
        kinds == [CLEAR, CLEAR],
        f"The types are {kinds}.",
        f"use two behaviours of the type {CLEAR}, with different names",
    )
    for (name, _), side in zip(named, (4.0, 1.0), strict=True):
        own = answer.get(name)
        expect_type(own, dict, f"parameters[{name!r}] is", "a dictionary")
        expect(
            own.get("reset_distance") == side,
            f"reset_distance of {name} is {own.get('reset_distance')!r}, but should be {side:g}.",
            "set 4 m first, then 1 m; it is the side of the square, not half of it",
        )
        expect(
            own.get("layer_names") == ["obstacle_layer"],
            f"layer_names of {name} is {own.get('layer_names')!r}: in our costmaps this clears nothing, or too much.",
            'write a list with "obstacle_layer"',
        )
        unknown = sorted(set(own) - {"reset_distance", "layer_names", "affected_maps", "force_updating"})
        expect(not unknown, f"{name} has other parameters, too: {unknown}.", "two parameters are enough")
