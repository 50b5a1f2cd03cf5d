"""Flat worlds from SDF: static models are fixed, other models can be pushed, actors walk, and doors open.

Collisions are used, since bodies touch them and Gazebo's ray sensors see them; visuals provide the colours. A static
model becomes one obstacle for each solid part: `MODEL` if there is one, else `MODEL::COLLISION` (with more than one
link: `MODEL::LINK::COLLISION`). A model that is not static becomes one obstacle `MODEL` with the mass of its links
and the smallest friction and restitution of its surfaces; its inertia follows from its mass and outline, and its joints
are locked. So the name of every part of a model is `MODEL`, or begins with `MODEL::`.
"""

from __future__ import annotations

import math
from collections import Counter
from collections.abc import Iterator
from dataclasses import dataclass, replace
from itertools import pairwise

from rosmini.core.geometry.errors import GeometryError
from rosmini.core.geometry.poses import Pose
from rosmini.sim.motion import Motion, Walk
from rosmini.sim.shapes import Compound, Cylinder, Shape, Sphere
from rosmini.sim.urdf.meshes import MeshError
from rosmini.sim.world import Obstacle, World, WorldError

from .document import Note, Pose6, SdfActor, SdfCollision, SdfJoint, SdfLink, SdfModel, SdfWorld
from .doors import door_of
from .errors import SdfError
from .material_colours import HOUSE
from .poses import compose, placed_links
from .solids import FLAT, Meshes, Solid, solids

WALKER = Cylinder(0.2)
"""Shape of an actor on the ground [m]; in Gazebo actors have no body."""
WALKER_HEIGHT = 1.75
WALKER_COLOUR = "purple"

START = "start"
"""Prefix of the names of frames at which robots start."""


@dataclass(frozen=True)
class _Piece:
    """A solid part of a collision."""

    name: str
    """LINK::COLLISION, preceded by the names of nested models."""
    solid: Solid
    colour: str


def to_world(world: SdfWorld, *, title: str = "") -> World:
    """Return the flat world of an SDF world; see `converted` for what was left out. Raises `SdfError`."""
    return converted(world, title=title)[0]


def converted(world: SdfWorld, *, title: str = "") -> tuple[World, tuple[Note, ...]]:
    """Return the flat world of an SDF world, and notes on what was left out or simplified. Raises `SdfError`."""
    notes: list[Note] = []
    meshes = Meshes()
    obstacles = [each for model in world.models for each in _obstacles(model, model.pose, notes, meshes)]
    obstacles += [to_walker(actor) for actor in world.actors]
    starts = tuple((pose[0], pose[1], pose[5]) for name, pose in world.frames if name.lower().startswith(START))
    try:
        made = World(
            world.name, tuple(obstacles), starts=starts or ((0.0, 0.0, 0.0),), title=title or f"The world {world.name}"
        )
    except WorldError as error:
        raise SdfError(str(error), world.path, world.line) from error
    return made, tuple(notes)


def to_obstacles(model: SdfModel, pose: Pose | Pose6 | None = None) -> tuple[Obstacle, ...]:
    """Return a model's obstacles at `pose` (x, y, heading, or all six numbers), or at its own. Raises `SdfError`."""
    if pose is None:
        place = model.pose
    elif len(pose) == 3:
        place = (pose[0], pose[1], model.pose[2], *model.pose[3:5], pose[2])
    else:
        place = pose
    return tuple(_obstacles(model, place, [], Meshes()))


def to_walker(actor: SdfActor) -> Obstacle:
    """Return an actor as a person who walks the waypoints at constant speed, and waits where a position is repeated.

    Raises `SdfError`.
    """
    points: list[tuple[float, float]] = []
    waits: list[float] = []
    walked = 0.0
    for (begin, a), (end, b) in pairwise(actor.waypoints):
        if math.dist(a[:2], b[:2]) < 1e-6:
            waits.append(end - begin)
        else:
            walked += end - begin
    for _, place in actor.waypoints:
        if not points or math.dist(points[-1], place[:2]) >= 1e-6:
            points.append((place[0], place[1]))
    x, y, _, _, _, yaw = actor.waypoints[0][1]
    motion = None
    try:
        if len(points) > 1:
            length = math.fsum(math.dist(a, b) for a, b in pairwise(points))
            if actor.loop and len(points) > 2 and math.dist(points[0], points[-1]) < 1e-6:
                points.pop()
            wait = math.fsum(waits) / (len(points) if actor.loop else len(points) - 1)
            motion = Walk(tuple(points), length / walked if walked > 0 else Walk.speed, round(wait, 6), actor.loop)
        return Obstacle(actor.name, WALKER, (x, y, yaw), WALKER_HEIGHT, WALKER_COLOUR, motion=motion)
    except WorldError as error:
        raise SdfError(f"the actor {actor.name!r}: {error}", actor.path, actor.line) from error


def _obstacles(model: SdfModel, pose: Pose6, notes: list[Note], meshes: Meshes) -> list[Obstacle]:
    motion = door_of(model)
    fixed = model.static and motion is None
    try:
        if fixed:
            return _fixed(model, list(_pieces(model, pose, notes, meshes, sliced=True)))
        lifted: Pose6 = (0.0, 0.0, *pose[2:5], 0.0)
        found = list(_pieces(model, lifted, notes, meshes, sliced=False))
        if not found:
            notes.append(
                Note(
                    model.path,
                    model.line,
                    f"the model {model.name!r} has nothing solid: left out",
                    left_out="a model that has nothing solid",
                )
            )
            return []
        if motion is None and any(joint.type != "fixed" for joint in _joints(model)):
            notes.append(
                Note(model.path, model.line, f"the joints of the model {model.name!r} are held: it moves as one")
            )
        return [_one(model, (pose[0], pose[1], pose[5]), motion, found)]
    except WorldError as error:
        raise SdfError(f"the model {model.name!r}: {error}", model.path, model.line) from error


def _fixed(model: SdfModel, found: list[_Piece]) -> list[Obstacle]:
    """Return one obstacle for each piece."""
    short = len({each.name.rpartition("::")[0] for each in found}) == 1
    names = [each.name.rpartition("::")[2] if short else each.name for each in found]
    counts, seen = Counter(names), Counter[str]()
    obstacles = []
    for name, each in zip(names, found, strict=True):
        seen[name] += 1
        called = f"{name} {seen[name]}" if counts[name] > 1 else name
        whole = model.name if len(found) == 1 else f"{model.name}::{called}"
        solid = each.solid
        obstacles.append(Obstacle(whole, solid.shape, solid.pose, solid.top, each.colour, bottom=solid.bottom))
    return obstacles


def _one(model: SdfModel, pose: Pose, motion: Motion | None, found: list[_Piece]) -> Obstacle:
    """Return one obstacle made of all pieces, which are in the frame of the model."""
    solid = [each.solid for each in found]
    shape: Shape = solid[0].shape
    if len(solid) > 1 or solid[0].pose != (0.0, 0.0, 0.0):
        shape = Compound(
            tuple(
                (Cylinder(each.shape.radius) if isinstance(each.shape, Sphere) else each.shape, each.pose)
                for each in solid
            )
        )
    surfaces = [collision for _, link, _ in placed_links(model) for collision in link.collisions]
    frictions = [each.friction for each in surfaces if each.friction is not None]
    return Obstacle(
        model.name,
        shape,
        pose,
        max(each.top for each in solid),
        found[0].colour,
        None if motion else math.fsum(link.inertial.mass for _, link, _ in placed_links(model)),
        min(each.bottom for each in solid),
        motion,
        drag=min(frictions) if frictions and motion is None else None,
        restitution=min((each.restitution for each in surfaces), default=0.0) if motion is None else 0.0,
    )


# ---- the solid parts of a model ----


def _pieces(model: SdfModel, pose: Pose6, notes: list[Note], meshes: Meshes, *, sliced: bool) -> Iterator[_Piece]:
    """Yield the solid parts of a model and its nested models, above the ground, at a pose."""
    for name, link, place in placed_links(model, pose):
        for collision in link.collisions:
            try:
                at = compose(place, collision.pose)
                found, remark = solids(collision.geometry, at, meshes, sliced=sliced)
            except (MeshError, GeometryError) as error:
                raise SdfError(str(error), model.path, collision.line) from error
            if remark:
                text = f"{collision.name!r} of the model {model.name!r} {remark}"
                left_out = "a plane" if not found and collision.geometry.kind == "plane" else ""
                notes.append(Note(model.path, collision.line, text, left_out=left_out))
            colour = _colour(collision, link)
            for each in found:
                if each.top > FLAT:
                    bottom = each.bottom if isinstance(each.shape, Sphere) else max(0.0, each.bottom)
                    yield _Piece(f"{name}::{collision.name}", replace(each, bottom=bottom), colour)
                elif each.top > 0:
                    what = f"{collision.name!r} of the model {model.name!r} is {each.top * 1000:.0f} mm high"
                    text = f"{what}: wheels roll over it, left out"
                    notes.append(Note(model.path, collision.line, text, left_out="something flat"))


def _joints(model: SdfModel) -> Iterator[SdfJoint]:
    yield from model.joints
    for each in model.models:
        yield from _joints(each)


def _colour(collision: SdfCollision, link: SdfLink) -> str:
    """Return the colour of the visual with the same name, or at the same place, or of the first coloured one."""
    coloured = [visual for visual in link.visuals if visual.colour is not None]
    alike = [
        *(each for each in coloured if each.name == collision.name),
        *(each for each in coloured if each.pose == collision.pose and each.geometry.kind == collision.geometry.kind),
        *coloured,
    ]
    if not alike or alike[0].colour is None:
        return "grey"
    return HOUSE.get(alike[0].colour, alike[0].colour)
