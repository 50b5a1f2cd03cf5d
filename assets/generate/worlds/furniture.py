"""Furniture for our own worlds: obstacles of one or several parts, each at its place and height. Lengths in metres.

A part is called `thing::part`, so that an SDF file has one model of the thing. A robot passes under a table and between
the legs of a chair if it is low and narrow enough, and a laser sees what is at its height.
"""

from __future__ import annotations

import math
from collections.abc import Iterable

from rosmini.core.geometry.poses import compose
from rosmini.sim.shapes import Box, Colour, Cylinder, Polygon, Shape
from rosmini.sim.world import Obstacle, Pose

LEG = 0.02
"""The radius of a leg [m]."""


def block(
    name: str,
    size: tuple[float, float],
    pose: Pose,
    height: float = 0.8,
    colour: Colour = "grey",
    *,
    mass: float | None = None,
) -> list[Obstacle]:
    """Something that stands on the ground with all of its underside."""
    return [Obstacle(name, Box(*size), pose, height, colour, mass)]


def post(name: str, radius: float, pose: Pose, height: float = 0.8, colour: Colour = "green") -> list[Obstacle]:
    """Something round: a plant, a bin, a pillar."""
    return [Obstacle(name, Cylinder(radius), pose, height, colour)]


def corner(name: str, corners: Iterable[tuple[float, float]], height: float, colour: Colour) -> list[Obstacle]:
    """Something of any outline, its corners in the world."""
    return [Obstacle(name, Polygon(tuple(corners)), (0.0, 0.0, 0.0), height, colour)]


def table(
    name: str, size: tuple[float, float], pose: Pose, height: float = 0.74, colour: Colour = "orange"
) -> list[Obstacle]:
    """A table on four legs."""
    x, y = size[0] / 2 - 0.06, size[1] / 2 - 0.06
    parts: list[tuple[str, Shape, Pose, float, float]] = [("top", Box(*size), (0.0, 0.0, 0.0), height - 0.04, height)]
    parts += _legs([(-x, -y), (x, -y), (x, y), (-x, y)], height - 0.04, 0.03)
    return _built(name, pose, parts, colour)


def round_table(
    name: str, radius: float, pose: Pose, height: float = 0.74, colour: Colour = "orange"
) -> list[Obstacle]:
    """A round table on one foot."""
    return _built(
        name,
        pose,
        [
            ("top", Cylinder(radius), (0.0, 0.0, 0.0), height - 0.04, height),
            ("foot", Cylinder(0.08), (0.0, 0.0, 0.0), 0.0, height - 0.04),
        ],
        colour,
    )


def desk(name: str, size: tuple[float, float], pose: Pose, colour: Colour = "orange") -> list[Obstacle]:
    """A desk between two panels, and a cabinet behind the left one; who sits at it looks along its y."""
    x, y = size
    return _built(
        name,
        pose,
        [
            ("top", Box(x, y), (0.0, 0.0, 0.0), 0.70, 0.74),
            ("panel", Box(0.04, y), (x / 2 - 0.02, 0.0, 0.0), 0.0, 0.70),
            ("cabinet", Box(0.4, y), (0.2 - x / 2, 0.0, 0.0), 0.0, 0.70),
        ],
        colour,
    )


def chair(name: str, pose: Pose, colour: Colour = "sky", size: float = 0.42) -> list[Obstacle]:
    """A chair on four legs; who sits on it looks along its x."""
    at = size / 2 - LEG
    parts: list[tuple[str, Shape, Pose, float, float]] = [
        ("seat", Box(size, size), (0.0, 0.0, 0.0), 0.42, 0.46),
        ("back", Box(0.04, size), (0.02 - size / 2, 0.0, 0.0), 0.46, 0.9),
    ]
    parts += _legs([(-at, -at), (at, -at), (at, at), (-at, at)], 0.42, LEG)
    return _built(name, pose, parts, colour)


def sofa(name: str, size: tuple[float, float], pose: Pose, colour: Colour = "blue") -> list[Obstacle]:
    """A sofa `size` wide and deep, with a back and two arms; who sits on it looks along its y."""
    width, depth = size
    return _built(
        name,
        pose,
        [
            ("seat", Box(width - 0.36, depth - 0.2), (0.0, 0.1, 0.0), 0.0, 0.42),
            ("back", Box(width, 0.2), (0.0, 0.1 - depth / 2, 0.0), 0.0, 0.8),
            ("left arm", Box(0.18, depth - 0.2), (0.09 - width / 2, 0.1, 0.0), 0.0, 0.6),
            ("right arm", Box(0.18, depth - 0.2), (width / 2 - 0.09, 0.1, 0.0), 0.0, 0.6),
        ],
        colour,
    )


def bed(name: str, size: tuple[float, float], pose: Pose, colour: Colour = "sky") -> list[Obstacle]:
    """A bed `size` long and wide, its head at the end of its negative x."""
    length, width = size
    return _built(
        name,
        pose,
        [
            ("mattress", Box(length - 0.08, width), (0.04, 0.0, 0.0), 0.0, 0.5),
            ("head", Box(0.08, width), (0.04 - length / 2, 0.0, 0.0), 0.0, 0.95),
        ],
        colour,
    )


def _legs(
    places: Iterable[tuple[float, float]], height: float, radius: float
) -> list[tuple[str, Shape, Pose, float, float]]:
    return [(f"leg {i}", Cylinder(radius), (x, y, 0.0), 0.0, height) for i, (x, y) in enumerate(places, 1)]


def _built(
    name: str, pose: Pose, parts: Iterable[tuple[str, Shape, Pose, float, float]], colour: Colour
) -> list[Obstacle]:
    return [
        Obstacle(f"{name}::{part}", shape, _round(compose(pose, place)), top, colour, bottom=bottom)
        for part, shape, place, bottom, top in parts
    ]


def _round(pose: Pose) -> Pose:
    x, y, theta = (round(float(value), 6) for value in pose)
    return (x, y, theta)


def facing(x: float, y: float, degrees: float = 0.0) -> Pose:
    """A pose with the heading in degrees."""
    return (x, y, round(math.radians(degrees), 6))
