"""`move_base.explain()`: a report of the robot's state, its last problem, and the obstacles around it and its plan."""

from __future__ import annotations

from contextlib import suppress
from dataclasses import dataclass, field
from typing import Any

import numpy as np

from rosmini.navigation.nav_core import NavigationFailure, TransformMissing, planar_pose

from .measures import clearance, narrowest

MoveBase = Any


@dataclass
class Explanation:
    """The result of `explain()`: `str()` gives the text, `numbers` its values, and `show()` draws a picture."""

    lines: list[str] = field(default_factory=list)
    numbers: dict[str, Any] = field(default_factory=dict)
    grid: Any = None
    options: dict[str, Any] = field(default_factory=dict)

    def __str__(self) -> str:
        return "\n".join(self.lines)

    __repr__ = __str__

    def show(self, **options: Any) -> Any:
        """Draw the global costmap with the robot, its plan and its goal; options as in `Costmap2D.show`."""
        return self.grid.show(**{**self.options, **options})


def explain(move_base: MoveBase) -> Explanation:
    """Return a report of the robot's state, its last problem, and its distances to obstacles."""
    costmap = move_base.global_costmap
    result = Explanation(grid=costmap.grid, options={"footprint": costmap.footprint, "name": "global_costmap"})
    result.numbers["state"] = move_base.state.value
    result.lines.append(f"move_base is {move_base.state.value}, {_activity(move_base)}")
    if move_base.problem:
        result.lines.append(f"the last trouble: {move_base.problem}")
    _add_critics(move_base.failure, result)
    _add_clearance(move_base, result)
    _add_goal_cost(move_base, result)
    _add_narrowest_passage(move_base, result)
    for text in move_base.recovery_log:
        result.lines.append(text)
    return result


def _activity(move_base: MoveBase) -> str:
    if move_base.goal is None:
        return "without a goal"
    x, y, _ = planar_pose(move_base.goal)
    return f"driving to ({x:.2f}, {y:.2f}) in {move_base.goal.header.frame_id}"


def _add_critics(failure: NavigationFailure | None, result: Explanation) -> None:
    rejected = {} if failure is None else failure.numbers.get("rejected", {})
    if rejected:
        result.numbers["rejected"] = dict(rejected)
        most = max(rejected, key=lambda name: rejected[name])
        result.lines.append(f"most velocities were rejected by the critic {most}: {rejected[most]}")


def _add_clearance(move_base: MoveBase, result: Explanation) -> None:
    """Add the distance from the footprint to the nearest obstacle in the local costmap to the report."""
    costmap = move_base.local_costmap
    try:
        pose = planar_pose(costmap.robot_pose())
    except TransformMissing as error:
        result.lines.append(f"the robot's pose is unknown: {error}")
        return
    with suppress(TransformMissing):
        result.options["robot"] = planar_pose(move_base.global_costmap.robot_pose())
    room = clearance(costmap.grid, pose, costmap.footprint)
    result.numbers["clearance"] = room
    if room is None:
        result.lines.append("no obstacle is within 1 m of the robot")
    elif room == 0:
        result.lines.append("an obstacle is inside the footprint: no command can be valid until it is cleared")
    else:
        result.lines.append(f"the nearest obstacle is {room * 100:.0f} cm from the footprint")


def _add_goal_cost(move_base: MoveBase, result: Explanation) -> None:
    """Add the cost of the goal's cell and the reason for it to the report."""
    if move_base.goal is None:
        return
    costmap = move_base.global_costmap
    x, y, _ = planar_pose(move_base.goal)
    result.options["goal"] = (x, y)
    cell = costmap.grid.world_to_map(x, y)
    if cell is None or move_base.goal.header.frame_id.lstrip("/") != costmap.global_frame:
        result.lines.append("the goal is outside the global costmap")
        return
    costs = costmap.explain(*cell)
    result.numbers["goal_cost"] = costs.cost
    result.lines.append(f"the goal: {costs}")


def _add_narrowest_passage(move_base: MoveBase, result: Explanation) -> None:
    """Add the narrowest passage along the plan, compared with the footprint, to the report."""
    if not move_base.plan:
        result.lines.append("there is no plan")
        return
    costmap = move_base.global_costmap
    path = np.array([planar_pose(pose)[:2] for pose in move_base.plan])
    result.options["plan"] = path
    narrowest_place = narrowest(costmap.grid, path)
    if narrowest_place is None:
        result.lines.append("the plan stays at least 1 m away from all obstacles")
        return
    x, y, away = narrowest_place
    result.numbers["narrowest"] = narrowest_place
    # The local costmap's footprint counts: the controller checks it, while plans may assume a disc.
    inscribed, circumscribed = (move_base.local_costmap.inscribed_radius, move_base.local_costmap.circumscribed_radius)
    enough = (
        "enough for every heading"
        if away > circumscribed
        else "enough for some headings only"
        if away > inscribed
        else "not enough"
    )
    result.lines.append(
        f"the narrowest place on the way is at ({x:.2f}, {y:.2f}), {away:.2f} m from an obstacle: {enough} (the "
        f"footprint's radii are {inscribed:.2f} m and {circumscribed:.2f} m)"
    )
