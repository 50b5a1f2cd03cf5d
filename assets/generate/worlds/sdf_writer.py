"""Writes a flat world as an SDF file that Gazebo opens too; `load` and `to_world` give the same world back."""

from __future__ import annotations

import math
from collections.abc import Iterator
from itertools import pairwise
from xml.sax.saxutils import quoteattr

from rosmini.core.geometry.poses import Pose
from rosmini.sim.motion import Door, Walk
from rosmini.sim.sdf.doors import PLUGIN
from rosmini.sim.sdf.material_colours import HOUSE
from rosmini.sim.shapes import Box, Cylinder, Simple, Sphere, simple_parts
from rosmini.sim.world import Obstacle, World

THIN = 0.02
"""How thick a thin wall becomes [m]."""

_HEX = {name: colour for colour, name in HOUSE.items()}

_HEAD = """\
<?xml version="1.0"?>
<sdf version="1.7">
  <world name={name}>
    <physics type="ode">
      <max_step_size>0.001</max_step_size>
      <real_time_factor>1</real_time_factor>
      <real_time_update_rate>1000</real_time_update_rate>
    </physics>
    <gravity>0 0 -9.8</gravity>
    <include>
      <uri>model://ground_plane</uri>
    </include>
    <include>
      <uri>model://sun</uri>
    </include>
"""
_TAIL = "  </world>\n</sdf>\n"


def to_sdf(world: World, name: str = "default") -> str:
    """The text of an SDF file of a world.

    Obstacles whose names have the same part before `::` become one model. Thin walls become boxes, 2 cm thick.
    """
    lines = [_HEAD.format(name=quoteattr(name))]
    for i, start in enumerate(world.starts, 1):
        lines.append(f'    <frame name="start_{i}">\n      <pose>{_pose(start)}</pose>\n    </frame>\n')
    groups: dict[str, list[Obstacle]] = {}
    for each in (*world.obstacles, *_thin(world)):
        groups.setdefault(each.name.partition("::")[0], []).append(each)
    for model, things in groups.items():
        lines += _model(model, things)
    return "".join([*lines, _TAIL])


def _thin(world: World) -> Iterator[Obstacle]:
    for i, (x1, y1, x2, y2) in enumerate(world.walls.tolist(), 1):
        length = math.hypot(x2 - x1, y2 - y1)
        if length > 0:
            pose = ((x1 + x2) / 2, (y1 + y2) / 2, math.atan2(y2 - y1, x2 - x1))
            yield Obstacle(f"walls::{i}", Box(length, THIN), pose, world.wall_height, "wall")


def _model(name: str, things: list[Obstacle]) -> Iterator[str]:
    first = things[0]
    if isinstance(first.motion, Walk):
        yield from _actor(first, first.motion)
        return
    alone = len(things) == 1
    yield f"    <model name={quoteattr(name)}>\n"
    if first.fixed:
        yield "      <static>true</static>\n"
    if alone:
        yield f"      <pose>{_pose(first.pose)}</pose>\n"
    yield '      <link name="link">\n'
    if first.mass is not None:
        yield from _inertial(first)
    for each in things:
        own = simple_parts(each.shape) if alone else simple_parts(each.shape, each.pose)
        label = each.name.partition("::")[2] or "body"
        parts = list(own)
        for i, (shape, pose) in enumerate(parts, 1):
            yield from _solid(label if len(parts) == 1 else f"{label} {i}", shape, pose, each)
    yield "      </link>\n"
    if isinstance(first.motion, Door):
        yield from _door(first.motion)
    yield "    </model>\n"


def _inertial(thing: Obstacle) -> Iterator[str]:
    """The mass, in the middle, with the inertia of the box around it."""
    x, y = (max(0.01, 2 * reach) for reach in _reach(thing))
    z, mass = thing.height - thing.bottom, thing.mass or 1.0
    inertia = zip(("ixx", "iyy", "izz"), (y * y + z * z, x * x + z * z, x * x + y * y), strict=True)
    yield f"        <inertial>\n          <mass>{_number(mass)}</mass>\n"
    yield f"          <pose>0 0 {_number((thing.bottom + thing.height) / 2)} 0 0 0</pose>\n          <inertia>\n"
    for tag, square in inertia:
        yield f"            <{tag}>{mass * square / 12:.6g}</{tag}>\n"
    for tag in ("ixy", "ixz", "iyz"):
        yield f"            <{tag}>0</{tag}>\n"
    yield "          </inertia>\n        </inertial>\n"


def _reach(thing: Obstacle) -> tuple[float, float]:
    x = y = 0.0
    for shape, pose in simple_parts(thing.shape):
        if isinstance(shape, (Cylinder, Sphere)):
            x, y = max(x, abs(pose[0]) + shape.radius), max(y, abs(pose[1]) + shape.radius)
        else:
            far = abs(shape.outline).max(axis=0)
            x, y = max(x, abs(pose[0]) + float(far[0])), max(y, abs(pose[1]) + float(far[1]))
    return x, y


def _solid(name: str, shape: Simple, pose: Pose, thing: Obstacle) -> Iterator[str]:
    middle = (thing.bottom + thing.height) / 2
    tall = thing.height - thing.bottom
    z = middle
    if isinstance(shape, Box):
        inner = f"<box><size>{_number(shape.length)} {_number(shape.width)} {_number(tall)}</size></box>"
    elif isinstance(shape, Cylinder):
        inner = f"<cylinder><radius>{_number(shape.radius)}</radius><length>{_number(tall)}</length></cylinder>"
    elif isinstance(shape, Sphere):
        inner = f"<sphere><radius>{_number(shape.radius)}</radius></sphere>"
        z = thing.bottom + shape.radius
    else:
        points = "".join(f"<point>{_number(x)} {_number(y)}</point>" for x, y in shape.corners)
        inner = f"<polyline>{points}<height>{_number(tall)}</height></polyline>"
        z = thing.bottom
    at = _pose(pose, z)
    numbers = _HEX.get(thing.colour, thing.colour)
    rgb = " ".join(_number(round(int(numbers[i : i + 2], 16) / 255, 3)) for i in (1, 3, 5))
    for tag in ("collision", "visual"):
        yield f"        <{tag} name={quoteattr(name)}>\n          <pose>{at}</pose>\n"
        yield f"          <geometry>{inner}</geometry>\n"
        if tag == "collision":
            yield from _surface(thing)
        if tag == "visual":
            yield f"          <material><ambient>{rgb} 1</ambient><diffuse>{rgb} 1</diffuse></material>\n"
        yield f"        </{tag}>\n"


def _surface(thing: Obstacle) -> Iterator[str]:
    bounce = f"<bounce><restitution_coefficient>{_number(thing.restitution)}</restitution_coefficient></bounce>"
    mu = "" if thing.drag is None else _number(thing.drag)
    friction = f"<friction><ode><mu>{mu}</mu><mu2>{mu}</mu2></ode></friction>"
    if thing.restitution or thing.drag is not None:
        yield f"          <surface>{bounce if thing.restitution else ''}{friction if mu else ''}</surface>\n"


def _door(door: Door) -> Iterator[str]:
    kind = "revolute" if door.slide is None else "prismatic"
    axis = "0 0 1" if door.slide is None else f"{_number(math.cos(door.slide))} {_number(math.sin(door.slide))} 0"
    low, high = sorted((0.0, door.opening))
    yield f'      <joint name="hinge" type="{kind}">\n        <parent>world</parent>\n        <child>link</child>\n'
    yield f"        <pose>{_pose((*door.hinge, 0.0))}</pose>\n        <axis>\n          <xyz>{axis}</xyz>\n"
    yield f"          <limit><lower>{_number(low)}</lower><upper>{_number(high)}</upper></limit>\n"
    yield "        </axis>\n      </joint>\n"
    yield f'      <plugin name="door" filename="{PLUGIN}">\n'
    for tag in ("opening", "moving", "open", "closed", "phase"):
        yield f"        <{tag}>{_number(getattr(door, tag))}</{tag}>\n"
    yield "      </plugin>\n"


def _actor(thing: Obstacle, walk: Walk) -> Iterator[str]:
    yield f"    <actor name={quoteattr(thing.name)}>\n      <skin><filename>walk.dae</filename></skin>\n"
    yield '      <animation name="walking"><filename>walk.dae</filename>'
    yield "<interpolate_x>true</interpolate_x></animation>\n"
    yield f"      <script>\n        <loop>{str(walk.loop).lower()}</loop>\n"
    yield '        <trajectory id="0" type="walking">\n'
    points = [*walk.waypoints, walk.waypoints[0]] if walk.loop else list(walk.waypoints)
    moment, heading = 0.0, 0.0
    for i, (begin, end) in enumerate(pairwise(points)):
        heading = math.atan2(end[1] - begin[1], end[0] - begin[0])
        if i == 0:
            yield _waypoint(moment, begin, heading)
        moment += math.dist(begin, end) / walk.speed
        yield _waypoint(moment, end, heading)
        if walk.wait:
            moment += walk.wait
            yield _waypoint(moment, end, heading)
    yield "        </trajectory>\n      </script>\n    </actor>\n"


def _waypoint(moment: float, place: tuple[float, float], heading: float) -> str:
    at = _pose((*place, heading), 1.0)
    return f"          <waypoint><time>{_number(moment)}</time><pose>{at}</pose></waypoint>\n"


def _pose(pose: Pose, z: float = 0.0) -> str:
    x, y, theta = pose
    return f"{_number(x)} {_number(y)} {_number(z)} 0 0 {_number(theta)}"


def _number(value: float) -> str:
    """To a micrometre, without needless zeros."""
    text = f"{value:.6f}".rstrip("0").rstrip(".")
    return "0" if text == "-0" else text
