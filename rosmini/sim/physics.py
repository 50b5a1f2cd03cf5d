"""What touches what, and what gives way: the bodies of a world, in pymunk.

A robot that touches nothing moves by its own equations (`rosmini.sim.drive`), exactly. Where it comes to touch something it is asked here, a few
milliseconds at a time, how far it gets. Walls and fixed obstacles do not move; movable ones are pushed, held by the friction of the ground; and the
wheels cannot push harder than their grip allows (Coulomb: the force is at most mu m g).
"""

from __future__ import annotations

import math
from dataclasses import dataclass
from functools import partial

import numpy as np
import pymunk
from numpy.typing import NDArray
from pymunk import autogeometry

from rosmini.geometry.poses import Pose

from .imu import GRAVITY
from .models import RobotModel
from .shapes import ROUND, Simple, simple_parts
from .world import Obstacle, World

VIEW = 0.5
"""So far [m] a robot looks around itself; what is farther away does not matter yet."""

GRIP = 0.7
"""Friction of rubber wheels on the ground. This number and the next two are ordinary ones for such materials; none is published for the robot."""

DRAG = 0.5
"""Friction of a movable obstacle on the ground."""

FRICTION = 0.3
"""Friction of bodies on each other."""

TOUCH = 1e-9
"""Bodies that overlap by less [m] only touch."""

SLACK = 2e-5
"""So deep [m] a robot reaches into what it pushes: bodies that do not overlap do not push each other."""

OVERLAP = 1e-4
"""By so much [m] a robot may be put into something, for want of digits."""

ROUNDS = 20
"""So often at most a robot is pushed out of what it has driven into; a wedge between two walls takes the most."""

REST = 1e-4
"""A movable obstacle that is slower [m/s, rad/s] stands."""


@dataclass
class _Crate:
    obstacle: Obstacle
    body: pymunk.Body
    shapes: list[pymunk.Shape]


@dataclass
class _Rover:
    model: RobotModel
    body: pymunk.Body
    shape: pymunk.Poly
    view: pymunk.Poly
    """The footprint grown by VIEW, which nothing bumps into."""
    axle: pymunk.Body
    """Goes as the wheels turn, and takes the body along as well as the grip allows."""
    grip: tuple[pymunk.PivotJoint, pymunk.GearJoint]


class Contacts:
    """The bodies of one world; robots come and go by name."""

    def __init__(self, world: World) -> None:
        self._space = pymunk.Space()
        self._space.collision_slop = SLACK
        self._space.iterations = 30
        self._names: dict[pymunk.Shape, str] = {}
        self._rovers: dict[str, _Rover] = {}
        self._crates: list[_Crate] = []
        ground = self._space.static_body
        for x1, y1, x2, y2 in world.walls.tolist():
            wall = pymunk.Segment(ground, (x1, y1), (x2, y2), 0.0)
            self._add(wall, f"the wall from ({x1:.2f}, {y1:.2f}) to ({x2:.2f}, {y2:.2f})")
        for obstacle in world.obstacles:
            if obstacle.movable:
                self._crates.append(self._crate(obstacle))
            else:
                for shape in _shapes(obstacle, ground, obstacle.pose):
                    self._add(shape, f"the obstacle {obstacle.name!r}")

    def _add(self, shape: pymunk.Shape, name: str) -> None:
        shape.friction = FRICTION
        self._names[shape] = name
        self._space.add(shape)

    def _crate(self, obstacle: Obstacle) -> _Crate:
        mass = obstacle.mass or 0.0
        body = pymunk.Body()
        shapes = _shapes(obstacle, body, (0.0, 0.0, 0.0))
        area = sum(shape.area for shape in shapes)
        for shape in shapes:
            shape.density = mass / area
        self._space.add(body)
        for shape in shapes:
            self._add(shape, f"the obstacle {obstacle.name!r}")
        x, y, theta = obstacle.pose
        _put(body, (x, y, theta))
        ground = self._space.static_body
        slide = pymunk.PivotJoint(ground, body, (0, 0), body.center_of_gravity)
        turn = pymunk.GearJoint(ground, body, 0.0, 1.0)
        slide.max_bias = turn.max_bias = 0.0  # they hold what moves and pull nothing back
        slide.max_force = DRAG * mass * GRAVITY
        # the lever of friction that is spread over a disc of this size is two thirds of its radius
        turn.max_force = slide.max_force * 2 / 3 * math.sqrt(area / math.pi)
        self._space.add(slide, turn)
        self._space.reindex_shapes_for_body(body)
        return _Crate(obstacle, body, shapes)

    # -- robots --------------------------------------------------------------------------------------------------

    def add(self, name: str, model: RobotModel, pose: Pose) -> None:
        """Put a robot there."""
        body = pymunk.Body(model.mass, model.inertia)
        shape = pymunk.Poly(body, model.footprint)
        view = pymunk.Poly(body, model.footprint, radius=VIEW)
        axle = pymunk.Body(body_type=pymunk.Body.KINEMATIC)
        along, around = pymunk.PivotJoint(axle, body, (0, 0), (0, 0)), pymunk.GearJoint(axle, body, 0.0, 1.0)
        along.max_bias = around.max_bias = 0.0  # they bring speeds together, not places
        along.max_force = GRIP * model.mass * GRAVITY
        around.max_force = along.max_force * model.wheel_separation / 2
        self._space.add(body, axle, along, around)
        self._add(shape, f"the robot {name!r}")
        self._rovers[name] = _Rover(model, body, shape, view, axle, (along, around))
        self.move(name, pose)

    def remove(self, name: str) -> None:
        """Take a robot away."""
        rover = self._rovers.pop(name)
        del self._names[rover.shape]
        self._space.remove(*rover.grip, rover.shape, rover.body, rover.axle)

    def move(self, name: str, pose: Pose, velocity: tuple[float, float, float] = (0.0, 0.0, 0.0)) -> None:
        """Tell where a robot is that has moved by itself, and how fast it goes in the world's directions."""
        body = self._rovers[name].body
        _put(body, pose)
        body.velocity, body.angular_velocity = velocity[:2], velocity[2]
        self._space.reindex_shapes_for_body(body)

    def hindrance(self, model: RobotModel, pose: Pose, ignoring: str = "") -> str | None:
        """Return what a robot of this model would overlap with at `pose`, in words; None if it has room there."""
        probe = pymunk.Body(model.mass, model.inertia)
        shape = pymunk.Poly(probe, model.footprint)
        _put(probe, pose)
        rover = self._rovers.get(ignoring)
        found = [
            hit.shape
            for hit in self._space.shape_query(shape)
            if max(_depths(hit.contact_point_set)) > OVERLAP
        ]
        # of two shapes that coincide pymunk knows no depth
        middle = probe.local_to_world(shape.center_of_gravity)
        found += [hit.shape for hit in self._space.point_query(middle, 0.0, pymunk.ShapeFilter())]
        names = [
            self._names[each]
            for each in found
            if each is not None and (rover is None or each is not rover.shape)
        ]
        return names[0] if names else None

    def room(self, name: str) -> float:
        """How far [m] any point of a robot can move before it touches something, if that is not more than VIEW.

        Of the way to another robot that is half, for both may be coming.
        """
        rover = self._rovers[name]
        free = VIEW
        for hit in self._space.shape_query(rover.view):
            if hit.shape is None or hit.shape is rover.shape:
                continue
            gap = VIEW - max(_depths(hit.contact_point_set))
            free = min(free, gap / 2 if self._is_robot(hit.shape) else gap)
        return free

    def _is_robot(self, shape: pymunk.Shape) -> bool:
        return any(shape is rover.shape for rover in self._rovers.values())

    # -- movable obstacles ---------------------------------------------------------------------------------------

    @property
    def moving(self) -> bool:
        """True while an obstacle moves."""
        return any(_slides(crate.body) for crate in self._crates)

    def obstacles(self) -> tuple[Obstacle, ...]:
        """The movable obstacles where they are now."""
        return tuple(_moved(crate.obstacle, crate.body) for crate in self._crates)

    def reset(self) -> None:
        """Put the movable obstacles back to where they were."""
        for crate in self._crates:
            _put(crate.body, crate.obstacle.pose)
            crate.body.velocity, crate.body.angular_velocity = (0.0, 0.0), 0.0
            self._space.reindex_shapes_for_body(crate.body)

    # -- contact -------------------------------------------------------------------------------------------------

    def step(self, ways: dict[str, tuple[Pose, Pose]], dt: float) -> dict[str, tuple[Pose, bool]]:
        """Let `dt` seconds pass in which each robot's wheels take it from the first pose to the second, if nothing is in the way.

        Return where each robot is then, and whether anything kept it from where it would have gone.
        """
        poses = {name: after for name, (_, after) in ways.items()}
        for name, pose in poses.items():
            _put(self._rovers[name].body, pose)
        held = self._make_way(poses, dt)
        for name, (before, after) in ways.items():
            rover = self._rovers[name]
            body, axle = rover.body, rover.axle
            axle.velocity = ((after[0] - before[0]) / dt, (after[1] - before[1]) / dt)
            axle.angular_velocity = (after[2] - before[2]) / dt
            # pymunk moves each body by the velocity it has, looks what touches, and then changes the velocities
            (vx, vy), w = body.velocity, body.angular_velocity
            x, y, theta = poses[name]
            _put(body, (x - vx * dt, y - vy * dt, theta - w * dt))
        self._space.step(dt)
        for name, pose in poses.items():
            _put(self._rovers[name].body, pose)
        return {name: (pose, name in held) for name, pose in poses.items()}

    def _make_way(self, poses: dict[str, Pose], dt: float) -> set[str]:
        """Bring the robots out of what they have driven into, and out of each other; return who was moved by that."""
        sliding = [crate.body for crate in self._crates if _slides(crate.body)]
        kept = [(*body.position, body.angle) for body in sliding]
        for body in sliding:  # to where they will be when the step is over
            body.angle += body.angular_velocity * dt
            body.position += body.velocity * dt
            self._space.reindex_shapes_for_body(body)
        for name in poses:
            self._space.reindex_shapes_for_body(self._rovers[name].body)
        moved: set[str] = set()
        for _ in range(ROUNDS):
            pushed = [other for name in poses for other in self._push_out(name, poses)]
            if not pushed:
                break
            moved.update(pushed)
        for body, pose in zip(sliding, kept, strict=True):
            _put(body, pose)
        return moved

    def _push_out(self, name: str, poses: dict[str, Pose]) -> list[str]:
        """Move a robot out of the thing into which it reaches deepest, and a robot there likewise; return who was moved."""
        worst, hit = TOUCH, None
        for each in self._space.shape_query(self._rovers[name].shape):
            depth = max(_depths(each.contact_point_set)) - self._slack(each.shape)
            if depth > worst:
                worst, hit = depth, each
        if hit is None:
            return []
        n = hit.contact_point_set.normal
        slack = self._slack(hit.shape)
        depths = [depth - slack for depth in _depths(hit.contact_point_set)]
        places = [point.point_a for point in hit.contact_point_set.points]
        others = [
            other for other, rover in self._rovers.items() if rover.shape is hit.shape and other in poses
        ]
        for who, nx, ny in [(name, -n.x, -n.y), *((other, n.x, n.y) for other in others)]:
            x, y, theta = poses[who]
            model = self._rovers[who].model
            levers = [(place.x - x) * ny - (place.y - y) * nx for place in places]
            along, turn = correction(depths, levers, model.mass, model.inertia)
            part = 1 / (1 + len(others))
            poses[who] = (x + part * along * nx, y + part * along * ny, theta + part * turn)
            body = self._rovers[who].body
            _put(body, poses[who])
            self._space.reindex_shapes_for_body(body)
        return [name, *others]

    def _slack(self, shape: pymunk.Shape | None) -> float:
        """How deep a robot may reach into a shape."""
        body = None if shape is None else shape.body
        return SLACK if body is not None and body.body_type == pymunk.Body.DYNAMIC else 0.0


def correction(depths: list[float], levers: list[float], mass: float, inertia: float) -> tuple[float, float]:
    """How far to move a body along the normal of a contact [m], and how far to turn it [rad], so that it just touches.

    The contact has one or two points, each with the depth of the overlap there and its lever, the part of its place across the normal. The
    answer is what forces k >= 0 at these points do, along = sum k / m and turn = sum k r / I, that make the overlap vanish.
    """
    if len(depths) == 2:
        (first, second), (r, q) = depths, levers
        if abs(r - q) > 1e-9:
            turn = (first - second) / (r - q)
            along = first - turn * r
            k = (inertia * turn - mass * along * q) / (r - q)
            if 0 <= k <= mass * along:  # both points push, and none pulls
                return along, turn
    depth, lever = max(zip(depths, levers, strict=True))
    k = depth / (1 / mass + lever * lever / inertia)
    return k / mass, k * lever / inertia


def _slides(body: pymunk.Body) -> bool:
    return body.velocity.length > REST or abs(body.angular_velocity) > REST


def _depths(contacts: pymunk.ContactPointSet) -> list[float]:
    """How deep two shapes overlap at each point of their contact; pymunk's own `distance` has either sign."""
    n = contacts.normal
    return [(point.point_a - point.point_b).dot(n) for point in contacts.points]


def _put(body: pymunk.Body, pose: Pose) -> None:
    # in this order: pymunk turns a body about its centre of mass, which takes its origin elsewhere
    body.angle = pose[2]
    body.position = (pose[0], pose[1])


def _moved(obstacle: Obstacle, body: pymunk.Body) -> Obstacle:
    from dataclasses import replace

    return replace(obstacle, pose=(body.position.x, body.position.y, body.angle))


def _shapes(obstacle: Obstacle, body: pymunk.Body, pose: Pose) -> list[pymunk.Shape]:
    """The convex parts of an obstacle that stands at `pose` of the body's frame."""
    return [
        piece for shape, place in simple_parts(obstacle.shape, pose) for piece in _pieces(shape, body, place)
    ]


def _pieces(shape: Simple, body: pymunk.Body, pose: Pose) -> list[pymunk.Shape]:
    x, y, theta = pose
    if isinstance(shape, ROUND):
        return [pymunk.Circle(body, shape.radius, (x, y))]
    outline: NDArray[np.float64] = shape.outline
    placed = pymunk.Transform(
        a=math.cos(theta), b=math.sin(theta), c=-math.sin(theta), d=math.cos(theta), tx=x, ty=y
    )
    make = partial(pymunk.Poly, body, transform=placed)
    corners = [(float(px), float(py)) for px, py in outline]
    if _convex(corners):
        return [make(corners)]
    return [make(part) for part in autogeometry.convex_decomposition([*corners, corners[0]], 0.0)]


def _convex(corners: list[tuple[float, float]]) -> bool:
    turns = [
        (bx - ax) * (cy - by) - (by - ay) * (cx - bx)
        for (ax, ay), (bx, by), (cx, cy) in zip(
            corners, corners[1:] + corners[:1], corners[2:] + corners[:2], strict=True
        )
    ]
    return all(turn >= 0 for turn in turns)
