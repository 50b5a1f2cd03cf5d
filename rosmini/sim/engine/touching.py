"""What touches something: with what, where, and how hard; what a bumper feels, and a contact sensor."""

from __future__ import annotations

import math
from typing import NamedTuple

import pymunk

from .bodies import FEEL, IS_LOOK, Rover, put, shapes_of
from .physics import REST, Contacts


class Touch(NamedTuple):
    """One place where something touches another."""

    other: str
    """The name of the other: a robot's or an obstacle's; "wall" for a wall."""
    x: float
    """Where, in the frame map [m]."""
    y: float
    nx: float
    """The direction of the push: from the other into what was asked for, of length 1."""
    ny: float
    force: float
    """How hard the other pushes here along that direction [N], on average over the last step; friction along the contact is not counted."""


def touches(contacts: Contacts, name: str) -> list[Touch]:
    """What a robot or a thing touches now, and where; with the force of the last step."""
    rover = contacts.rovers.get(name)
    if rover is not None:
        return _touches(contacts, [rover.feel], rover.body, name, (0.0, rover.model.height), rover)
    thing = contacts.crate(name) or contacts.leaves[name]
    probe, obstacle = pymunk.Body(1.0, 1.0), thing.obstacle
    put(probe, thing.pose)
    shapes = shapes_of(obstacle, probe, (0.0, 0.0, 0.0))
    for shape in shapes:
        shape.unsafe_set_radius(shape.radius + FEEL)
        shape.filter = IS_LOOK
    return _touches(contacts, shapes, thing.body, name, (obstacle.bottom, obstacle.height), None)


def _touches(
    contacts: Contacts,
    shapes: list[pymunk.Shape],
    body: pymunk.Body,
    name: str,
    heights: tuple[float, float],
    rover: Rover | None,
) -> list[Touch]:
    forces = _forces(contacts, body, name)
    found = []
    for shape in shapes:
        for hit in contacts.space.shape_query(shape):
            if hit.shape is None:
                continue
            owner = contacts.owners[hit.shape]
            if owner.name == name or not owner.meets(*heights):
                continue
            n, points = -hit.contact_point_set.normal, hit.contact_point_set.points
            force = forces.get(hit.shape, 0.0)
            if rover is not None and owner.kind not in ("crate", "robot"):
                force = _pressed(contacts, rover, (n.x, n.y))
            found += [
                Touch(owner.name, point.point_b.x, point.point_b.y, n.x, n.y, force / len(points))
                for point in points
            ]
    return found


def _forces(contacts: Contacts, body: pymunk.Body, name: str) -> dict[pymunk.Shape, float]:
    """How hard others pushed a body in the last step [N]."""
    forces: dict[pymunk.Shape, float] = {}

    def note(arbiter: pymunk.Arbiter) -> None:
        one, other = arbiter.shapes
        partner = other if contacts.owners[one].name == name else one
        push = abs(arbiter.total_impulse.dot(arbiter.normal)) / contacts.dt
        forces[partner] = forces.get(partner, 0.0) + push

    if contacts.dt:
        body.each_arbiter(note)
    return forces


def _pressed(contacts: Contacts, rover: Rover, normal: tuple[float, float]) -> float:
    """How hard wheels that slip press a robot against what does not give way: Coulomb's mu m g, the part of it along the normal."""
    sx, sy = rover.slip
    speed = math.hypot(sx, sy)
    if speed < REST:
        return 0.0
    grip = contacts.surface.grip * rover.model.mass * contacts.surface.gravity
    return max(0.0, -(sx * normal[0] + sy * normal[1]) / speed * grip)
