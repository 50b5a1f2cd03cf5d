"""What is right in the exercises of chapter 39, move_base."""

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
from rosmini.navigation.move_base.recoveries import BadList, checked
from rosmini.navigation.nav_core import BadGoal, pose_stamped
from rosmini.navigation.nav_core.poses import checked_goal

Point = tuple[float, float]

# ---- 39.1 and 39.2: a played move_base ----

TAKES = 3.0
"""How long the played `move_base` is on its way to a goal [s]."""


class PlayedMoveBase:
    """A node that offers the action `move_base`, and gives up goals at the places of `failures`, with these texts.

    At the places of `lasting` it never arrives. `begun` has the places, `cut` those that were preempted, and `took` how
    long each lasted [s].
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
        self.server = SimpleActionServer(
            self.node, "move_base", MoveBaseAction, self._execute, auto_start=False
        )
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


@exercise("39.1", praise="Three places, and he is never in a hurry.")
def patrol(answer: Script) -> None:
    """Three goals, one after the other, then the script ends."""
    with TurtleTrial(None) as trial:
        played = PlayedMoveBase(trial.graph)
        handle = trial.start(answer)
        trial.run(15.0)
        wanted = [(1.0, 0.0), (2.0, 1.0), (0.0, 2.0)]
        expect(bool(played.begun), "No goal came to move_base within 15 s.", "client.send_goal(goal)")
        expect(
            not played.faults,
            f"A goal is wrong: {''.join(played.faults[:1])}.",
            "header.frame_id, orientation.w = 1",
        )
        expect(
            not played.cut,
            f"The goal {str(played.cut[:1])[1:-1]} was preempted by the next one.",
            "wait_for_result() before the next goal",
        )
        expect(
            played.begun == wanted,
            f"The goals were {played.begun}, not {wanted}.",
            "one goal for each x, y of the list",
        )
        expect(handle.poll() is not None, "After the third goal the script goes on.", "no spin() at the end")


SHUT = "Failed to find a valid plan. Even after executing recovery behaviors."
SLIPPED = "Robot is oscillating. Even after executing recovery behaviors."


@exercise("39.2", praise="Whoever sent it knows where his parcel is.")
def courier(answer: Script) -> None:
    """Goals from a topic, one after the other, and a report of each, whatever becomes of it."""
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
        expect(
            bool(played.begun),
            "No goal came to move_base.",
            "client.send_goal(MoveBaseGoal(target_pose=pose))",
        )
        expect(
            not played.cut,
            f"The goal {str(played.cut[:1])[1:-1]} was preempted by the next one.",
            "wait_for_result() in the callback",
        )
        expect(
            played.begun == places,
            f"Five places came, and the goals were {played.begun}.",
            "go on after a goal that failed",
        )
        expect(
            not played.faults,
            f"A goal is wrong: {''.join(played.faults[:1])}.",
            "the pose that came is the goal",
        )
        wanted = [failures.get(place, "arrived") for place in places]
        expect(
            heard == wanted,
            f"The reports were {heard}, and not {wanted}.",
            "get_state() says whether it has arrived, get_goal_status_text() why not",
        )


# ---- 39.3: keep to the right ----

SIDE = 0.2
RESOLUTION = 0.05


class _Costmap:
    """What planners ask of a `Costmap2DROS`: a corridor along x, with a wall that leaves a gap of 0.3 m."""

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


@exercise("39.3", praise="Two robots that meet will now get past each other.")
def keep_right(answer: Any) -> None:
    """Plans there and back, each a little to the right where there is room."""
    from rosmini.navigation.navfn.plugin import NavfnROS

    with Graph(strict=False) as graph:
        costmap: Any = _Costmap(graph)
        theirs = NavfnROS()
        theirs.initialize("NavfnROS", costmap)
        expect(
            isinstance(answer, type) and issubclass(answer, NavfnROS),
            "It is not a class that derives from NavfnROS.",
            "class KeepRight(NavfnROS, plugin=...)",
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
        f"{where} the plan of navfn has {len(theirs)} poses, and yours {len(mine)}.",
        "move the poses, and leave none out",
    )
    before, after = (
        np.array([(p.pose.position.x, p.pose.position.y) for p in plan]) for plan in (theirs, mine)
    )
    expect(
        np.allclose(before[-1], after[-1]),
        f"{where} the plan ends at {_named(after[-1])}, and the goal is {_named(before[-1])}.",
        "leave the last pose where it is",
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
        aim, said = (
            (best, "the place right of it is free") if is_free else (old, "right of it is an obstacle")
        )
        expect(
            math.dist(new, aim) < 0.02,
            f"{where} the pose at {_named(old)} was moved to {_named(new)}, and belongs to {_named(aim)}: {said}.",
            "right of the direction (dx, dy) is (dy, -dx); work with the old places, and look at the cost of the new",
        )


def _named(point: Any) -> str:
    return f"({point[0]:.2f}, {point[1]:.2f})"


# ---- 39.4: a list of recoveries ----

CLEAR = "clear_costmap_recovery/ClearCostmapRecovery"


@exercise("39.4", praise="The cable stays straight.", truths=("force_updating",))
def no_turning(answer: Any) -> None:
    """Two behaviours that clear, the far one first, and none that turns."""
    expect_type(answer, dict, "parameters is", "a dictionary")
    try:
        named = checked(answer.get("recovery_behaviors"))
    except BadList as error:
        expect(False, f"move_base would say: {error}", 'a list of {"name": ..., "type": ...}')
        return
    kinds = [kind.replace("::", "/") for _, kind in named]
    expect(
        "rotate_recovery/RotateRecovery" not in kinds,
        "With this list the robot turns.",
        "leave rotate_recovery out",
    )
    expect(
        kinds == [CLEAR, CLEAR],
        f"The types are {kinds}.",
        f"two behaviours of the type {CLEAR}, under two names",
    )
    for (name, _), side in zip(named, (4.0, 1.0), strict=True):
        own = answer.get(name)
        expect_type(own, dict, f"parameters[{name!r}] is", "a dictionary")
        expect(
            own.get("reset_distance") == side,
            f"reset_distance of {name} is {own.get('reset_distance')!r}, and should be {side:g}.",
            "first 4 m, then 1 m; the side of the square, not half of it",
        )
        expect(
            own.get("layer_names") == ["obstacle_layer"],
            f"layer_names of {name} is {own.get('layer_names')!r}: in our costmaps it clears nothing, or too much.",
            'a list with "obstacle_layer"',
        )
        unknown = sorted(set(own) - {"reset_distance", "layer_names", "affected_maps", "force_updating"})
        expect(
            not unknown, f"{name} has parameters that nobody asked for: {unknown}.", "two parameters will do"
        )
