"""`move_base.explain()`: why the robot is where it is."""

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
    """The result of `explain()`: `numbers` for tables and tests, the text in words, and a picture from `show()`."""

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
    """Report the robot's state, its last problem, and its distances to obstacles."""
    costmap = move_base.global_costmap
    found = Explanation(grid=costmap.grid, options={"footprint": costmap.footprint, "name": "global_costmap"})
    found.numbers["state"] = move_base.state.value
    found.lines.append(f"move_base is {move_base.state.value}, {_about(move_base)}")
    if move_base.why:
        found.lines.append(f"the last trouble: {move_base.why}")
    _critics(move_base.failure, found)
    _room(move_base, found)
    _goal(move_base, found)
    _way(move_base, found)
    for text in move_base.recovered:
        found.lines.append(text)
    return found


def _about(move_base: MoveBase) -> str:
    if move_base.goal is None:
        return "without a goal"
    x, y, _ = planar_pose(move_base.goal)
    return f"on its way to ({x:.2f}, {y:.2f}) in {move_base.goal.header.frame_id}"


def _critics(failure: NavigationFailure | None, found: Explanation) -> None:
    rejected = {} if failure is None else failure.numbers.get("rejected", {})
    if rejected:
        found.numbers["rejected"] = dict(rejected)
        most = max(rejected, key=lambda name: rejected[name])
        found.lines.append(f"most velocities were rejected by the critic {most}: {rejected[most]}")


def _room(move_base: MoveBase, found: Explanation) -> None:
    """Report the distance from the footprint to the nearest obstacle in the local costmap."""
    costmap = move_base.local_costmap
    try:
        pose = planar_pose(costmap.robot_pose())
    except TransformMissing as error:
        found.lines.append(f"where the robot is, is unknown: {error}")
        return
    with suppress(TransformMissing):
        found.options["robot"] = planar_pose(move_base.global_costmap.robot_pose())
    room = clearance(costmap.grid, pose, costmap.footprint)
    found.numbers["clearance"] = room
    if room is None:
        found.lines.append("no obstacle is within 1 m of the robot")
    elif room == 0:
        found.lines.append("an obstacle is inside the footprint: no command can be valid until it is cleared")
    else:
        found.lines.append(f"the nearest obstacle is {room * 100:.0f} cm from the footprint")


def _goal(move_base: MoveBase, found: Explanation) -> None:
    """Report the cost of the goal's cell and the reason for it."""
    if move_base.goal is None:
        return
    costmap = move_base.global_costmap
    x, y, _ = planar_pose(move_base.goal)
    found.options["goal"] = (x, y)
    cell = costmap.grid.world_to_map(x, y)
    if cell is None or move_base.goal.header.frame_id.lstrip("/") != costmap.global_frame:
        found.lines.append("the goal is outside the global costmap")
        return
    costs = costmap.explain(*cell)
    found.numbers["goal_cost"] = costs.cost
    found.lines.append(f"the goal: {costs}")


def _way(move_base: MoveBase, found: Explanation) -> None:
    """Report the narrowest passage along the plan, compared with the footprint."""
    if not move_base.plan:
        found.lines.append("there is no plan")
        return
    costmap = move_base.global_costmap
    path = np.array([planar_pose(pose)[:2] for pose in move_base.plan])
    found.options["plan"] = path
    place = narrowest(costmap.grid, path)
    if place is None:
        found.lines.append("the plan keeps 1 m away from all obstacles")
        return
    x, y, away = place
    found.numbers["narrowest"] = place
    # The local costmap's footprint counts: the controller checks it, while plans may assume a disc.
    inscribed, circumscribed = (
        move_base.local_costmap.inscribed_radius,
        move_base.local_costmap.circumscribed_radius,
    )
    enough = (
        "enough for every heading"
        if away > circumscribed
        else "enough for some headings only"
        if away > inscribed
        else "not enough"
    )
    found.lines.append(
        f"the narrowest place on the way is at ({x:.2f}, {y:.2f}), {away:.2f} m from an obstacle: {enough} (the "
        f"footprint's radii are {inscribed:.2f} m and {circumscribed:.2f} m)"
    )
