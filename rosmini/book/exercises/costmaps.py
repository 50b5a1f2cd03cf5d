"""Checks of the exercises in the chapter Costmaps."""

from __future__ import annotations

import math
from itertools import product
from typing import Any

import numpy as np
import yaml

from rosmini.book.checks import Wrong, exercise, expect, expect_type
from rosmini.book.trials import Trial
from rosmini.core.errors import RosminiError
from rosmini.core.tf import StaticTransformBroadcaster
from rosmini.msgs.geometry_msgs.msg import Twist
from rosmini.navigation.costmap_2d import Costmap2D
from rosmini.navigation.costmap_2d.costmap_ros import CellCosts
from rosmini.navigation.costmap_2d.footprint import footprint_from_radius, padded, radii
from rosmini.navigation.costmap_2d.inflation import cost_at, inflated
from rosmini.navigation.navfn import NavfnSearch
from rosmini.ros.scripts import rosrun

# ---- cost: a cost by its distance ----


@exercise("cost", praise="The inflation layer computes exactly this for each cell.")
def cost(answer: Any) -> Any:
    """The cost at a distance, including the ends of each range."""
    for r, big, s in ((0.051, 0.6, 5.0), (0.17, 0.55, 10.0), (0.2, 1.0, 2.5), (0.3, 0.2, 3.0)):
        for d in (0.0, 0.05, 0.1, 0.15, r, r + 0.05, 0.3, 0.45, big, big + 0.05, 2.0):
            wanted = 0 if d > big else cost_at(d, r, s)
            got = answer(d, r, big, s)
            where = f"At d = {d:g} m, with r = {r:g}, R = {big:g} and s = {s:g}, the cost"
            hint = (
                "it is 254 at distance 0, 253 up to r, the formula up to R, and 0 beyond"
                if wanted in (0, 253, 254)
                else "it is 252 exp(-s (d - r)), rounded down"
            )
            expect(got == wanted, f"{where} is {wanted}, not {got!r}.", hint)
            expect_type(got, (int, np.integer), f"{where} is", "a whole number")
    return None


# ---- door: a door and a gap ----

CELL = 0.05
DOOR, GAP = (24, 40), (56, 60)
"""Rows of the openings in the wall: 80 cm and 20 cm."""
WALL = (58, 61)
"""Its columns."""
START, GOAL = (20.0, 57.0), (100.0, 57.0)


def _apartment() -> Costmap2D:
    """Two rooms and a wall with a door, and with a gap on the line from start to goal."""
    grid = Costmap2D(120, 80, CELL)
    costs = grid.costs
    costs[[0, -1]] = 254
    costs[:, [0, -1]] = 254
    costs[:, WALL[0] : WALL[1]] = 254
    for low, high in (DOOR, GAP):
        costs[low:high, WALL[0] : WALL[1]] = 0
    return grid


@exercise("door", praise="The robot's size closes the gap, and the costs lead the plan through the middle of the door.")
def door(answer: Any) -> Any:
    """Three parameters with which the plan passes through the middle of the door."""
    names = ("robot_radius", "inflation_radius", "cost_scaling_factor")
    expect_type(answer, dict, "numbers is", "a dictionary from parameter to value")
    for name in names:
        expect(name in answer, f"{name} is missing.", "set all three parameters")
        expect_type(answer[name], (int, float), f"{name} is", "a number")
    radius, reach, scaling = (float(answer[name]) for name in names)
    expect(radius >= 0.105, f"The Burger is 21 cm wide; a radius of {radius:g} m is too small.", "use at least 0.105")
    expect(
        radius <= 0.2,
        f"A radius of {radius:g} m is much larger than the Burger, whose corners are about 0.16 m from its centre.",
        "use at most 0.2",
    )
    inscribed, _ = radii(padded(footprint_from_radius(radius), 0.01))
    costmap = inflated(_apartment(), inscribed_radius=inscribed, inflation_radius=reach, cost_scaling_factor=scaling)
    search = NavfnSearch(costmap.costs, START, GOAL)
    search.expand()
    if not search.arrived:
        view = costmap.show(title="No path leads through the wall")
        raise Wrong("There is no path: inflation closes the door.", "the radius must be less than half of 80 cm", view)
    path = search.path()
    view = costmap.show(plan=(path + 0.5) * CELL, title="The plan with your numbers")
    at_wall = path[(path[:, 0] >= WALL[0]) & (path[:, 0] < WALL[1]), 1] + 0.5
    if (at_wall > sum(DOOR) / 2 + 10).any():
        raise Wrong(
            "The plan leads through the gap of 20 cm.",
            "a cost of 253 closes it: which parameter sets that distance?",
            view,
        )
    off = float(np.abs(at_wall - sum(DOOR) / 2).max()) * CELL
    if off > 0.1:
        raise Wrong(
            f"The plan passes the door {off * 100:.0f} cm from its middle.",
            "the middle is 40 cm from each post: costs must reach that far and still be above 0 there",
            view,
        )
    return view


# ---- blocker: which layer ----


class _Costmap:
    """A costmap with the costs of its layers, as in `Costmap2DROS`."""

    def __init__(self, layers: dict[str, int | None]) -> None:
        known = [cost for cost in layers.values() if cost is not None]
        self.grid = Costmap2D(20, 10, 0.05, (-1.0, 2.0))
        self.grid.costs[3, 5] = max(known, default=0)
        self._layers = layers

    def explain(self, mx: int, my: int) -> CellCosts:
        here = (mx, my) == (5, 3)
        return CellCosts(self.grid, mx, my, {n: (cost if here else 0, "") for n, cost in self._layers.items()})


@exercise("blocker", praise="The answer names the cause: the map, the laser, or the inflation.")
def blocker(answer: Any) -> Any:
    """The lowest layer that blocks a point; None if no layer does, and outside the costmap."""
    names = ("static_layer", "obstacle_layer", "inflation_layer"), ("walls", "sonar", "people", "inflation")
    for layers in names:
        for costs in product((None, 0, 200, 253, 254), repeat=len(layers)):
            wanted = next((n for n, c in zip(layers, costs, strict=True) if c in (253, 254)), None)
            told = dict(zip(layers, costs, strict=True))
            got = answer(_Costmap(told), -0.73, 2.16)
            expect(
                got == wanted,
                f"The layers say {told}: the answer is {wanted or 'None'}, not {got!r}.",
                "go through costmap.explain(mx, my).items(), which starts with the lowest layer; a cost may be None",
            )
    full = _Costmap({"static_layer": 254})
    for x, y in ((-0.5, 2.16), (-0.73, 2.3)):
        got = answer(full, x, y)
        expect(got is None, f"No layer blocks ({x}, {y}), but you return {got!r}.", "use world_to_map")
    for x, y in ((-1.02, 2.16), (0.2, 2.16), (-0.73, 1.9)):
        got = answer(full, x, y)
        expect(got is None, f"({x}, {y}) is outside, but you return {got!r}.", "world_to_map returns None")
    return None


# ---- params: a parameter file with faults ----


def _of(answer: Any) -> dict[str, Any]:
    expect_type(answer, str, "params is", "the text of a parameter file")
    try:
        read = yaml.safe_load(answer)
    except yaml.YAMLError as error:
        raise Wrong(f"It is not valid YAML: {str(error).splitlines()[0]}", "check the indentation") from error
    expect_type(read, dict, "The file contains", "a dictionary of parameters")
    settings: dict[str, Any] = read
    return settings


@exercise("params", praise="Your costmap marks, clears and inflates obstacles, and moves with the robot.")
def params(answer: Any) -> Any:
    """A local costmap with a rolling window that marks, clears and inflates."""
    read = _of(answer)
    with Trial(is_shown=False) as trial:
        graph = trial.graph
        StaticTransformBroadcaster(graph.node("state")).send("base_footprint", "base_scan", (-0.03, 0, 0.18))
        graph.node("loader").set_param("/eyes/costmap", read)
        trial.run(1.0)
        trial.robot.drag("crate", (0.8, 0.0, 0.0))
        try:
            rosrun("costmap_2d", "costmap_2d_node", "__name:=eyes", graph=graph, capture_output=True)
            trial.run(3.0)
        except RosminiError as error:
            raise Wrong(f"The costmap does not start: {error}", "the message names the parameter") from error
        costmap = getattr(graph.nodes["/eyes"].program if "/eyes" in graph.nodes else None, "costmap", None)
        expect(
            costmap is not None,
            "The costmap does not start: it waits for a frame or a map that does not exist.",
            "compare the names of the frames with those of the robot; a rolling window needs no map",
        )
        return _tried(trial, costmap)


def _tried(trial: Trial, costmap: Any) -> Any:
    """Test the costmap of a file with an obstacle and a drive."""
    grid = costmap.grid

    def cost_of(x: float, y: float) -> int:
        cell = grid.world_to_map(x, y)
        return 0 if cell is None else grid.cost(*cell)

    def box() -> int:
        return max(cost_of(0.6 + 0.025 * i, y) for i in range(9) for y in (-0.05, 0.0, 0.05))

    def shown(title: str) -> Any:
        return costmap.show(title=title)

    def require(condition: bool, message: str, hint: str) -> None:
        if not condition:
            raise Wrong(message, hint, shown("The costmap of your file"))

    x, y = grid.origin[0] + grid.size_m[0] / 2, grid.origin[1] + grid.size_m[1] / 2
    require(
        max(abs(x), abs(y)) < 0.2,
        f"The robot is at (0, 0), but the centre of the window is at ({x:.1f}, {y:.1f}).",
        "rolling_window",
    )
    require(
        box() == 254,
        "There is a crate 0.8 m ahead of the robot, but no lethal cell there.",
        "observation_sources lists the names of blocks; one of them needs marking: true",
    )
    radius = costmap.inscribed_radius
    require(radius < 0.25, f"The robot's inscribed radius is {radius:.2f} m: a Burger is smaller.", "set robot_radius")
    levels = {int(value) for value in np.unique(grid.costs)}
    require(
        253 in levels and bool(levels & set(range(1, 253))),
        "There are no costs below 253 around obstacles.",
        "the inflation layer must be the last plugin, and inflation_radius larger than the robot's radius",
    )
    final = shown("The costmap of your file")
    trial.robot.drag("crate", (-0.5, 1.3, 0.0))
    trial.run(2.0)
    require(box() < 254, "The crate is gone, but its cells are still lethal.", "a source needs clearing: true")
    before = grid.origin
    node = trial.graph.node("driver")
    cmd_vel, command = node.publisher("cmd_vel", Twist, queue_size=1), Twist()
    command.linear.x = 0.2
    node.timer(0.1, lambda _: cmd_vel.publish(command))
    trial.run(3.0)
    moved = math.dist(before, grid.origin)
    require(moved > 0.3, "The robot has moved, but the window has not.", "set update_frequency")
    return final
