"""Random worlds: rooms with doors and obstacles, always connected, the same for the same seed.

A rectangle is split repeatedly by a wall with a door in it, so every room can be reached. Obstacles are placed far
enough from the walls and each other for a robot to pass around each of them.
"""

from __future__ import annotations

import math
from dataclasses import dataclass, field
from functools import cached_property

import numpy as np
from numpy.typing import NDArray

from rosmini.core.errors import shown
from rosmini.core.geometry import polygons
from rosmini.sim.shapes import Box, Cylinder, Polygon, Shape, is_finite
from rosmini.sim.world import Obstacle, Pose, World, WorldError

from .walls import wall

PASSAGE = 0.7
"""Maximum diameter of a robot that can reach every place [m]."""
DOOR = 1.0
THICKNESS = 0.12
NARROWEST = 2.0
"""Minimum length and width of a room [m]."""
HEIGHT = 0.6
COLOURS = ("blue", "orange", "green", "vermilion", "sky")
TRIES = 400
MAX_COUNT = 10_000
"""Maximum number of objects of a kind, and maximum size of the floor [m]."""


def random_world(
    seed: int,
    *,
    size: tuple[float, float] = (10.0, 8.0),
    rooms: int = 4,
    obstacles: int = 10,
    movable: int = 0,
    starts: int = 3,
) -> World:
    """Return a walled floor of `size` [m] around the origin, split into furnished rooms; equal for equal arguments.

    A robot narrower than 0.7 m can go from every start to every room and around every obstacle. In addition, `movable`
    obstacles can be pushed. There are fewer rooms and obstacles than requested if there is no space for more. Raises
    `WorldError` if there is no space for all `starts`, for a floor narrower than 2 m, and for invalid numbers.
    """
    _check(size, seed=seed, rooms=rooms, obstacles=obstacles, movable=movable, starts=starts)
    plan = _Plan(np.random.default_rng(seed), (-size[0] / 2, -size[1] / 2, size[0] / 2, size[1] / 2))
    plan.split(rooms)
    for i in range(obstacles + movable):
        plan.place_thing(i, pushed=i >= obstacles)
    found = plan.free_places(starts)
    if len(found) < starts:
        raise WorldError(
            f"in a world of {size[0]:g} m by {size[1]:g} m with these obstacles there is no room for {starts} starts"
        )
    return World(
        f"random_{seed}",
        (*plan.walls, *plan.things),
        wall_height=HEIGHT,
        starts=tuple(found),
        title=f"A world by chance, of the seed {seed}",
    )


def _check(size: tuple[float, float], **counts: int) -> None:
    if len(size) != 2 or not all(is_finite(side) and NARROWEST <= side <= MAX_COUNT for side in size):
        raise WorldError(f"size is {shown(size)}; it must be a length and a width of {NARROWEST:g} m to {MAX_COUNT} m")
    for name, value in counts.items():
        least = 1 if name in ("rooms", "starts") else 0
        if not isinstance(value, (int, np.integer)) or isinstance(value, bool) or value < least:
            raise WorldError(f"{name} is {shown(value)}; it must be a whole number, {least} or more")
        if name != "seed" and value > MAX_COUNT:
            raise WorldError(f"{name} is {value}; it must be {MAX_COUNT} or less")


Floats = NDArray[np.float64]

Rectangle = tuple[float, float, float, float]
"""x and y of the lower left and of the upper right corner [m]."""


@dataclass
class _Plan:
    """A floor to which walls and obstacles are added."""

    rng: np.random.Generator
    floor: Rectangle
    walls: list[Obstacle] = field(default_factory=list)
    things: list[Obstacle] = field(default_factory=list)
    discs: list[tuple[float, float, float]] = field(default_factory=list)
    """Circles around the obstacles: x, y, radius."""
    doors: list[tuple[bool, float, float, float]] = field(default_factory=list)
    """Doors: True in a wall along x; the wall's y or x; the ends of the door."""

    def __post_init__(self) -> None:
        x0, y0, x1, y1 = self.floor
        t = THICKNESS / 2
        for name, begin, end in (
            ("south", (x0 - t, y0), (x1 + t, y0)),
            ("north", (x0 - t, y1), (x1 + t, y1)),
            ("west", (x0, y0 + t), (x0, y1 - t)),
            ("east", (x1, y0 + t), (x1, y1 - t)),
        ):
            self.walls += wall(name, begin, end, THICKNESS, height=HEIGHT)

    # ---- rooms ----

    def split(self, count: int) -> None:
        """Split the floor into rooms, the largest first."""
        rooms = [self.floor]
        while len(rooms) < count:
            rooms.sort(key=lambda room: (room[2] - room[0]) * (room[3] - room[1]), reverse=True)
            for i, room in enumerate(rooms):
                parts = self._parts(room)
                if parts:
                    rooms[i : i + 1] = parts
                    break
            else:
                return

    def _parts(self, room: Rectangle) -> list[Rectangle]:
        """Return two rooms that replace one, and add a wall with a door between them; none if the room is too small."""
        x0, y0, x1, y1 = room
        for upright in (x1 - x0 >= y1 - y0, x1 - x0 < y1 - y0):  # across the longer side first
            low, high = (x0, x1) if upright else (y0, y1)
            begin, end = (y0, y1) if upright else (x0, x1)
            if high - low < 2 * NARROWEST or end - begin < NARROWEST:
                continue
            for _ in range(TRIES // 10):
                at = round(float(self.rng.uniform(low + NARROWEST, high - NARROWEST)), 3)
                if self._meets_door(at, begin, end, upright=upright):
                    continue
                door = round(float(self.rng.uniform(begin + 0.3, end - 0.3 - DOOR)), 3)
                self._add_wall(at, begin, end, door, upright=upright)
                return [(x0, y0, at, y1), (at, y0, x1, y1)] if upright else [(x0, y0, x1, at), (x0, at, x1, y1)]
        return []

    def _meets_door(self, at: float, begin: float, end: float, *, upright: bool) -> bool:
        """Return True if a wall at x (upright) or y would end in, or beside, a door."""
        return any(
            along == upright and min(abs(where - begin), abs(where - end)) < 0.01 and a - 0.3 < at < b + 0.3
            for along, where, a, b in self.doors
        )

    def _add_wall(self, at: float, begin: float, end: float, door: float, *, upright: bool) -> None:
        ends = ((at, begin), (at, end)) if upright else ((begin, at), (end, at))
        gap = (door, door + DOOR)
        self.walls += wall(f"inner {len(self.doors) + 1}", *ends, THICKNESS, [gap], HEIGHT)
        self.doors.append((not upright, at, *gap))

    # ---- things ----

    @cached_property
    def sides(self) -> Floats:
        """Sides of all walls (n, 4); used after the walls are complete."""
        return np.vstack([polygons.sides_of(each.outline()) for each in self.walls])

    def place_thing(self, number: int, *, pushed: bool) -> None:
        """Add an obstacle at a place with a passage all around; do nothing if there is no such place."""
        shape, reach = self._shape(pushed=pushed)
        place = self._place(reach + PASSAGE, reach)
        if place is None:
            return
        pose = (*place, round(float(self.rng.uniform(-math.pi, math.pi)), 3))
        colour = COLOURS[int(self.rng.integers(len(COLOURS)))]
        name = f"{'crate' if pushed else 'thing'} {number + 1}"
        self.discs.append((*place, reach))
        self.things.append(
            Obstacle(name, shape, pose, HEIGHT / 2 if pushed else HEIGHT, colour, 1.0 if pushed else None)
        )

    def _shape(self, *, pushed: bool) -> tuple[Shape, float]:
        kind = 0 if pushed else int(self.rng.integers(3))
        if kind == 1:
            radius = round(float(self.rng.uniform(0.1, 0.35)), 3)
            return Cylinder(radius), radius
        if kind == 2:
            count, radius = int(self.rng.integers(3, 8)), float(self.rng.uniform(0.2, 0.45))
            corners = tuple(
                (round(radius * math.cos(a), 3), round(radius * math.sin(a), 3))
                for a in (2 * math.pi * i / count for i in range(count))
            )
            return Polygon(corners), max(math.hypot(*corner) for corner in corners)
        low, high = (0.15, 0.35) if pushed else (0.2, 0.8)
        length, width = (round(float(side), 3) for side in self.rng.uniform(low, high, 2))
        return Box(length, width), math.hypot(length, width) / 2

    def _place(self, from_walls: float, reach: float) -> tuple[float, float] | None:
        """Return a position at this distance from walls, and a passage from obstacles."""
        x0, y0, x1, y1 = self.floor
        for _ in range(TRIES):
            x, y = (round(float(v), 3) for v in self.rng.uniform((x0, y0), (x1, y1)))
            if self._clear((x, y), from_walls, reach + PASSAGE):
                return (x, y)
        return None

    def _clear(self, place: tuple[float, float], from_walls: float, from_things: float) -> bool:
        """Return True if a position keeps away from walls and obstacles."""
        point = np.array([place])
        if polygons.distances(point, self.sides).min() < from_walls:
            return False
        discs = np.array(self.discs).reshape(-1, 3)
        return bool((np.hypot(*(discs[:, :2] - point).T) - discs[:, 2] >= from_things).all())

    def free_places(self, count: int) -> list[Pose]:
        """Return free starts for robots, with a passage between them."""
        found: list[Pose] = []
        x0, y0, x1, y1 = self.floor
        for _ in range(count * TRIES):
            if len(found) == count:
                break
            x, y = (round(float(v), 3) for v in self.rng.uniform((x0, y0), (x1, y1)))
            apart = all(math.dist((x, y), other[:2]) >= PASSAGE for other in found)
            if apart and self._clear((x, y), PASSAGE / 2, PASSAGE / 2 + 0.1):
                found.append((x, y, round(float(self.rng.uniform(-math.pi, math.pi)), 3)))
        return found
