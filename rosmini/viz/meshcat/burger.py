"""The TurtleBot3 Burger as solids: plates, wheels, boards and laser, with the dimensions of its model.

Dimensions that a model does not contain (thickness of a plate, spacing of its holes) follow the robot's proportions:
a stack of four "waffle" plates on standoffs; motors at the bottom, then battery, controller and computer.
"""

from __future__ import annotations

import math
from itertools import pairwise

import numpy as np

from rosmini.sim.models import RobotModel

from .solids import Ball, Facets, Part, Prism, Rod, Solid, box, plate

PLATE, EDGE, HOLE = "#3b444d", "#2a3138", "#20262c"
METAL, RUBBER, RIM = "#c9d0d6", "#1d2125", "#59636d"
BATTERY, BOARD, CHIP, SERVO = "#2456a6", "#1f7a4d", "#14181c", "#30363d"
LASER, WINDOW = "#171b1f", "#7a1f2b"

THICKNESS = 0.005
TYRE = 0.018
"""Width of a wheel [m]."""


def body(model: RobotModel, node: str) -> list[Part]:
    """Return all parts except the wheels, in the frame base_footprint."""
    x = model.laser.mount[0]
    length, width = 0.138, model.wheel_separation - TYRE - 0.006
    # four floors between the axles and the bottom of the laser
    laser_foot = model.laser.mount[2] - 0.030
    low = model.wheel_radius - 0.017
    floors = [low + i * (laser_foot - THICKNESS - low) / 3 for i in range(4)]
    outline = plate(x, 0.0, length, width, 0.022)
    plates = tuple(Prism(outline, z, z + THICKNESS) for z in floors)
    posts = tuple(
        Rod((x + a * 0.048, b * (width / 2 - 0.014), (z + above + THICKNESS) / 2), 0.0032, above - z - THICKNESS)
        for z, above in pairwise(floors)
        for a in (-1, 1)
        for b in (-1, 1)
    )
    return [
        Part(node, "plates", PLATE, plates, shine=0.15),
        Part(node, "holes", HOLE, (_holes(x, length, width, [z + THICKNESS for z in floors]),), fine=True),
        Part(node, "standoffs", METAL, posts, shine=0.6),
        Part(node, "caster", METAL, (_caster(low),), shine=0.8),
        *_inside(node, x, floors),
        *_laser(node, model, laser_foot),
    ]


def wheel(model: RobotModel, node: str, outwards: int) -> list[Part]:
    """Return the parts of a wheel in its own frame, turning about y; `outwards` is 1 on the left, -1 on the right."""
    radius, hub = model.wheel_radius, 0.62 * model.wheel_radius
    spokes = tuple(
        Rod(
            (0.68 * hub * math.cos(angle), outwards * (TYRE / 2 + 0.0008), 0.68 * hub * math.sin(angle)),
            0.0042,
            0.0016,
            "y",
        )
        for angle in (i * math.pi / 3 for i in range(6))
    )
    return [
        Part(node, "tyre", RUBBER, (Rod((0.0, 0.0, 0.0), radius - 0.0012, TYRE, "y"),)),
        Part(node, "treads", RUBBER, (_treads(radius),), fine=True),
        Part(node, "rim", RIM, (Rod((0.0, outwards * 0.0006, 0.0), hub, TYRE, "y"),), shine=0.3),
        Part(node, "hub", METAL, (Rod((0.0, outwards * 0.0014, 0.0), 0.0065, TYRE, "y"),), shine=0.6),
        Part(node, "spokes", RUBBER, spokes),
    ]


def _treads(radius: float, count: int = 16) -> Facets:
    """Return bars across the tyre, which make its rotation visible: the outer side of each and its two flanks."""
    low, high, right = radius - 0.002, radius, -TYRE / 2 + 0.002
    left = -right
    faces = []
    for i in range(count):
        turn = 2 * math.pi * i / count
        ring = [(low, turn - 0.09), (high, turn - 0.07), (high, turn + 0.07), (low, turn + 0.09)]
        edge = [(r * math.cos(a), r * math.sin(a)) for r, a in ring]
        for (x1, z1), (x2, z2) in pairwise(edge):
            faces.append(np.array([(x1, left, z1), (x1, right, z1), (x2, right, z2), (x2, left, z2)]))
    return Facets(tuple(faces))


def _holes(x: float, length: float, width: float, heights: list[float]) -> Facets:
    """Return the dark square holes of the plates, as tiles; below the highest plate, only the visible ones."""
    pitch, half = 0.0125, 0.0036
    rows, columns = int((length / 2 - 0.008) / pitch), int((width / 2 - 0.008) / pitch)
    tile = np.array([(-half, -half, 0.0002), (half, -half, 0.0002), (half, half, 0.0002), (-half, half, 0.0002)])
    return Facets(
        tuple(
            tile + np.array([x + i * pitch, j * pitch, z])
            for z in heights
            for i in range(-rows, rows + 1)
            for j in range(-columns, columns + 1)
            if abs(i) + abs(j) < rows + columns - 1 and (z == heights[-1] or abs(i) == rows or abs(j) == columns)
        )
    )


def _caster(low: float) -> Solid:
    """Return the ball that supports the rear, at the x of the robot's description (-0.081 m)."""
    radius = low / 2
    return Ball((-0.081, 0.0, radius), radius)


def _inside(node: str, x: float, floors: list[float]) -> list[Part]:
    """Return the motors on the lowest floor, then battery, controller and computer, one per floor."""
    z0, z1, z2 = (z + THICKNESS for z in floors[:3])
    motors = tuple(box(0.004, side * 0.036, z0, 0.046, 0.052, 0.034) for side in (-1, 1))
    controller = (box(x, 0.0, z1 + 0.010, 0.105, 0.075, 0.0018), box(x, 0.0, z2 + 0.008, 0.085, 0.056, 0.0018))
    chips = (
        box(x + 0.012, 0.008, z2 + 0.0098, 0.015, 0.015, 0.0024),
        box(x - 0.014, -0.012, z2 + 0.0098, 0.012, 0.012, 0.0018),
        box(x - 0.010, 0.010, z1 + 0.0118, 0.018, 0.018, 0.0022),
    )
    ports = tuple(box(x - 0.036, y, z2 + 0.0098, 0.017, 0.014, 0.0135) for y in (-0.018, 0.0, 0.018))
    return [
        Part(node, "motors", SERVO, motors, shine=0.1),
        Part(node, "battery", BATTERY, (box(x - 0.042, 0.0, z0, 0.036, 0.086, 0.026),), shine=0.2),
        Part(node, "boards", BOARD, controller, shine=0.2),
        Part(node, "chips", CHIP, chips),
        Part(node, "ports", METAL, ports, shine=0.6),
    ]


def _laser(node: str, model: RobotModel, foot: float) -> list[Part]:
    """Return the LDS-01: a flat base, and the rotating head with its window in the plane of the scan."""
    x, y, scan = model.laser.mount
    top = model.height
    low, high = scan - 0.0045, scan + 0.0045
    head = tuple(Rod((x, y, (a + b) / 2), 0.0345, b - a) for a, b in ((foot + 0.014, low), (high, top)))
    base = Prism(plate(x - 0.006, y, 0.092, 0.068, 0.030), foot, foot + 0.014)
    return [
        Part(node, "laser_base", EDGE, (base,), shine=0.2),
        Part(node, "laser_head", LASER, head, shine=0.5),
        Part(node, "laser_window", WINDOW, (Rod((x, y, scan), 0.0350, 0.009),), shine=0.9),
        Part(node, "laser_cap", RIM, (Rod((x, y, top + 0.0006), 0.020, 0.0012),), shine=0.3),
    ]
