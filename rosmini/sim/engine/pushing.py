"""How robots are brought out of what they have driven into, and out of each other: pymunk tells where, and how deep.

Of many robots that go in steps together the crowd's tables do the same (`rosmini.sim.engine.crowd`), where machine code can be made of it.
"""

from __future__ import annotations

from typing import TYPE_CHECKING

import pymunk

from rosmini.geometry.poses import Pose

from .bodies import correction, depths_of, put
from .crowd import fast

if TYPE_CHECKING:
    from .physics import Contacts

TOUCH = 1e-9
"""Bodies that overlap by less [m] only touch."""

SLACK = 2e-5
"""So deep [m] a robot reaches into what it pushes: bodies that do not overlap do not push each other."""

ROUNDS = 20
"""So often at most a robot is pushed out of what it has driven into; a wedge between two walls takes the most."""

QUICK, NEARLY = 4, 1e-6
"""After so many rounds, robots that push one another may still overlap by so much [m]."""

FEW = 5
"""From so many robots on that go in steps together, they are a crowd."""


def make_way(contacts: Contacts, poses: dict[str, Pose], dt: float, names: list[str]) -> set[str]:
    """Bring robots out of what they have driven into, first of these names, and change their poses; return who was moved by that.

    What slides is where it will be after `dt` seconds.
    """
    sliding = [crate.body for crate in contacts.sliding()]
    kept = [(*body.position, body.angle) for body in sliding]
    for body in sliding:  # to where they will be when the step is over
        body.angle += body.angular_velocity * dt
        body.position += body.velocity * dt
        contacts.space.reindex_shapes_for_body(body)
    if len(poses) >= FEW and fast():
        moved = contacts.crowd.make_way(contacts, poses, names, (ROUNDS, QUICK, TOUCH, NEARLY, SLACK))
    else:
        moved = one_by_one(contacts, poses, names)
    for body, pose in zip(sliding, kept, strict=True):
        put(body, pose)
    return moved


def one_by_one(contacts: Contacts, poses: dict[str, Pose], names: list[str]) -> set[str]:
    """`make_way` of a few robots."""
    for name, pose in poses.items():
        body = contacts.rovers[name].body
        put(body, pose)
        contacts.space.reindex_shapes_for_body(body)
    moved: set[str] = set()
    for number in range(ROUNDS):
        least = TOUCH if number < QUICK or len(poses) == 1 else NEARLY
        fair = 2 * number >= ROUNDS
        pushed = {name: push_out(contacts, name, poses, least, fair=fair) for name in names}
        again = {other for others in pushed.values() for other in others}
        if not again:
            break
        moved |= again
        names = [name for name in names if name in again] + sorted(again.difference(names))
    return moved


def push_out(contacts: Contacts, name: str, poses: dict[str, Pose], least: float, *, fair: bool) -> list[str]:
    """Move a robot out of the thing into which it reaches deepest, if by more than `least` [m]; return who was moved.

    Of two robots the one gives way whose wheels grip less, or, if both grip alike, or in any case if it is to be `fair`, both by half.
    """
    rover = contacts.rovers[name]
    worst, hit = least, None
    for each in contacts.space.shape_query(rover.shape):
        depth = max(depths_of(each.contact_point_set)) - _slack(each.shape)
        if (
            depth > worst
            and each.shape is not None
            and contacts.owners[each.shape].bottom <= rover.model.height
        ):
            worst, hit = depth, each
    if hit is None or hit.shape is None:
        return []
    n = hit.contact_point_set.normal
    slack = _slack(hit.shape)
    depths = [depth - slack for depth in depths_of(hit.contact_point_set)]
    places = [point.point_a for point in hit.contact_point_set.points]
    owner = contacts.owners[hit.shape]
    others = [owner.name] if owner.kind == "robot" and owner.name in poses else []
    for who, nx, ny in [(name, -n.x, -n.y), *((other, n.x, n.y) for other in others)]:
        x, y, theta = poses[who]
        model = contacts.rovers[who].model
        levers = [(place.x - x) * ny - (place.y - y) * nx for place in places]
        along, turn = correction(depths, levers, model.mass, model.inertia)
        other = owner.name if who == name else name
        part = _share(contacts, who, other, fair=fair) if others else 1.0
        if not part:
            continue
        poses[who] = (x + part * along * nx, y + part * along * ny, theta + part * turn)
        body = contacts.rovers[who].body
        put(body, poses[who])
        contacts.space.reindex_shapes_for_body(body)
    return [name, *others]


def _share(contacts: Contacts, name: str, other: str, *, fair: bool) -> float:
    """How much of the way out of another robot is a robot's."""
    own, others = contacts.rovers[name].model.mass, contacts.rovers[other].model.mass
    return 0.5 if fair or own == others else float(own < others)


def _slack(shape: pymunk.Shape | None) -> float:
    """How deep a robot may reach into a shape."""
    body = None if shape is None else shape.body
    return SLACK if body is not None and body.body_type == pymunk.Body.DYNAMIC else 0.0
