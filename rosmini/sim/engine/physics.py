"""What touches what, and what gives way: the bodies of a world, in pymunk.

A robot that touches nothing moves by its own equations (`rosmini.sim.engine.drive`), exactly. Where it comes to touch something it is asked here, a few
milliseconds at a time, how far it gets. Walls and fixed obstacles do not move; movable ones are pushed, held by the friction of the ground; and the
wheels cannot push harder than their grip allows (Coulomb: the force is at most mu m g).

Robots that touch nothing are ghosts here: their bodies may be where they were long ago, and nothing bumps into them.
"""

from __future__ import annotations

from collections.abc import Iterable
from dataclasses import replace

import pymunk

from rosmini.geometry.poses import Pose
from rosmini.sim.models import RobotModel
from rosmini.sim.world import Obstacle, World

from .bodies import (
    IS_GHOST,
    IS_LOOK,
    IS_SOLID,
    VIEW,
    Crate,
    Leaf,
    Owner,
    Rover,
    Surface,
    depths_of,
    grip_again,
    hold,
    make_crate,
    make_leaf,
    make_rover,
    put,
    shapes_of,
)
from .crowd import Crowd, fast
from .pushing import SLACK, make_way

__all__ = ["VIEW", "Contacts", "Surface"]

OVERLAP = 1e-4
"""By so much [m] a robot may be put into something, for want of digits."""

REST = 1e-4
"""A movable obstacle that is slower [m/s, rad/s] stands."""

SOFT = ("robot", "crate", "leaf")
KINDS = ("wall", "fixed", *SOFT)
"""What there is: SOFT is what can be elsewhere than it was."""

Velocity = tuple[float, float, float]
"""Along x and y of the world [m/s], and to the left [rad/s]."""

AT_REST: Velocity = (0.0, 0.0, 0.0)

RoverMemory = tuple[float, float, float, tuple[float, float]]
"""The velocity of a robot's body, and how fast its wheels slide over the ground [m/s]."""


class Contacts:
    """The bodies of one world; robots and things come and go by name."""

    def __init__(self, world: World, surface: Surface | None = None) -> None:
        self.surface = Surface() if surface is None else surface
        self.space = pymunk.Space()
        self.space.collision_slop = SLACK
        self.space.iterations = 30
        self.owners: dict[pymunk.Shape, Owner] = {}
        self.rovers: dict[str, Rover] = {}
        self._crates: list[Crate] = []
        self.leaves: dict[str, Leaf] = {}
        self.fixed: dict[str, list[pymunk.Shape]] = {}
        self._crowd: Crowd | None = None
        self.dt = 0.0
        """How long the last step was [s]; 0 before the first."""
        self.pruned = False
        """True once a fixed thing was taken away."""
        self.space.on_collision(1, None, pre_solve=self._pass_under)
        ground = self.space.static_body
        for x1, y1, x2, y2 in world.walls.tolist():
            wall = pymunk.Segment(ground, (x1, y1), (x2, y2), 0.0)
            wall.filter = IS_SOLID
            self._add(wall, Owner("wall", "wall", 0.0, world.wall_height, (x1, y1, x2, y2)))
        for obstacle in world.obstacles:
            self.insert(obstacle)

    def _add(self, shape: pymunk.Shape, owner: Owner) -> None:
        shape.friction = self.surface.friction
        if owner.kind in ("wall", "fixed"):
            shape.elasticity = 1.0  # how much a thing rebounds from it is told by the thing alone
        self.owners[shape] = owner
        self.space.add(shape)

    def _pass_under(self, arbiter: pymunk.Arbiter, *_: object) -> None:
        one, other = (self.owners[shape] for shape in arbiter.shapes)
        if not one.meets(other.bottom, other.top):
            arbiter.process_collision = False

    def tune(self, surface: Surface) -> None:
        """Let things rub otherwise from now on."""
        self.surface = surface
        for shape in self.owners:
            shape.friction = surface.friction
        for crate in self._crates:
            self.space.remove(*crate.drag)
            hold(crate, self.space.static_body, surface)
            self.space.add(*crate.drag)
        for rover in self.rovers.values():
            if rover.awake:
                self.space.remove(*rover.grip)
            grip_again(rover, surface)
            if rover.awake:
                self.space.add(*rover.grip)

    # -- things --------------------------------------------------------------------------------------------------

    def insert(self, obstacle: Obstacle, *, shown: bool = True, loose: bool = False) -> None:
        """Put a thing where its pose is; `loose` for one that nobody pushes, but that may be put elsewhere."""
        if obstacle.movable:
            crate = make_crate(obstacle)
            crate.shown = shown
            self._crates.append(crate)
            self._enter(crate)
            self.place(obstacle.name, obstacle.pose)
        elif obstacle.motion is not None or loose:
            leaf = self.leaves[obstacle.name] = make_leaf(obstacle)
            self._enter(leaf)
            self.place(obstacle.name, obstacle.at(0.0))
        else:
            self._crowd = None
            shapes = self.fixed[obstacle.name] = shapes_of(obstacle, self.space.static_body, obstacle.pose)
            for shape in shapes:
                self._add(shape, Owner("fixed", obstacle.name, obstacle.bottom, obstacle.height))

    def _enter(self, thing: Crate | Leaf) -> None:
        obstacle, kind = thing.obstacle, "crate" if isinstance(thing, Crate) else "leaf"
        self.space.add(thing.body)
        for shape in thing.shapes:
            self._add(shape, Owner(kind, obstacle.name, obstacle.bottom, obstacle.height))
        if isinstance(thing, Crate):
            hold(thing, self.space.static_body, self.surface)
            self.space.add(*thing.drag)

    def _leave(self, thing: Crate | Leaf) -> None:
        drag = thing.drag if isinstance(thing, Crate) else ()
        self.space.remove(*drag, *thing.shapes, thing.body)
        for shape in thing.shapes:
            del self.owners[shape]

    def take_away(self, name: str) -> None:
        """Take a thing away."""
        crate = self.crate(name)
        if crate is not None:
            self._crates.remove(crate)
            self._leave(crate)
        elif name in self.leaves:
            self._leave(self.leaves.pop(name))
        else:
            shapes = self.fixed.pop(name)
            self.pruned, self._crowd = True, None
            self.space.remove(*shapes)
            for shape in shapes:
                del self.owners[shape]

    def crate(self, name: str) -> Crate | None:
        """The thing of this name that can be pushed, if there is one."""
        return next((crate for crate in self._crates if crate.obstacle.name == name), None)

    @property
    def crates(self) -> list[Crate]:
        """All things that can be pushed."""
        return self._crates

    def place(self, name: str, pose: Pose, velocity: Velocity = AT_REST) -> None:
        """Put a thing that is not fixed elsewhere; only what can be pushed has a velocity there."""
        crate = self.crate(name)
        body = self.leaves[name].body if crate is None else crate.body
        put(body, pose)
        if crate is not None:
            (vx, vy, w), lever = velocity, body.center_of_gravity.rotated(body.angle)
            body.velocity, body.angular_velocity = (vx - w * lever.y, vy + w * lever.x), w
        self.space.reindex_shapes_for_body(body)

    @property
    def moving(self) -> bool:
        """True while something that was pushed still moves."""
        return any(_slides(crate.body) for crate in self._crates)

    def sliding(self) -> list[Crate]:
        """The things that were pushed and still move."""
        return [crate for crate in self._crates if _slides(crate.body)]

    def obstacles(self) -> tuple[Obstacle, ...]:
        """The movable obstacles where they are now."""
        return tuple(replace(crate.obstacle, pose=crate.pose) for crate in self._crates if crate.shown)

    def reset(self) -> None:
        """Put the movable obstacles back to where they were."""
        for crate in self._crates:
            self.place(crate.obstacle.name, crate.obstacle.pose)

    def stuck(self, name: str, pose: Pose) -> bool:
        """Tell whether something that can give way is where a thing that moves by itself would be at `pose`, more than where it is now."""
        leaf = self.leaves[name]
        owner = self.owners[leaf.shapes[0]]
        put(leaf.probe, pose)
        return any(
            self._depth_in_others(probe, owner) > max(10 * SLACK, self._depth_in_others(shape, owner))
            for probe, shape in zip(leaf.probes, leaf.shapes, strict=True)
        )

    def _depth_in_others(self, shape: pymunk.Shape, owner: Owner) -> float:
        deepest = 0.0
        for hit in self.space.shape_query(shape):
            if hit.shape is not None:
                other = self.owners[hit.shape]
                if other.kind in SOFT and other.name != owner.name and owner.meets(other.bottom, other.top):
                    deepest = max(deepest, *depths_of(hit.contact_point_set))
        return deepest

    # -- robots --------------------------------------------------------------------------------------------------

    def add(self, name: str, model: RobotModel, pose: Pose) -> None:
        """Put a robot there."""
        self._crowd = None
        rover = self.rovers[name] = make_rover(model, self.surface)
        self.space.add(rover.body, rover.axle)
        self._add(rover.shape, Owner("robot", name, 0.0, model.height))
        self.move(name, pose)

    def remove(self, name: str) -> None:
        """Take a robot away."""
        self._crowd = None
        rover = self.rovers.pop(name)
        del self.owners[rover.shape]
        if rover.awake:
            self.space.remove(*rover.grip)
        self.space.remove(rover.shape, rover.body, rover.axle)

    def wake(self, names: Iterable[str]) -> None:
        """Let these robots, and no others, be bumped into."""
        wanted = set(names)
        for name, rover in self.rovers.items():
            if rover.awake != (name in wanted):
                self._wake(rover, awake=name in wanted)

    def _wake(self, rover: Rover, *, awake: bool) -> None:
        rover.awake = awake
        rover.shape.filter = IS_SOLID if awake else IS_GHOST
        if awake:
            grip_again(rover, self.surface)
            self.space.add(*rover.grip)
        else:
            self.space.remove(*rover.grip)
            rover.body.velocity, rover.body.angular_velocity = (0.0, 0.0), 0.0
            rover.told = None
            rover.slip = (0.0, 0.0)

    def move(self, name: str, pose: Pose, velocity: Velocity = AT_REST) -> None:
        """Tell where a robot is that has moved by itself, and how fast it goes in the world's directions."""
        rover = self.rovers[name]
        if rover.told == (pose, velocity):
            return
        rover.told, body = (pose, velocity), rover.body
        put(body, pose)
        body.velocity, body.angular_velocity = velocity[:2], velocity[2]
        self.space.reindex_shapes_for_body(body)

    def speed(self, name: str, velocity: Velocity) -> None:
        """Tell how fast a robot goes of which `step` will be told where it goes."""
        rover = self.rovers[name]
        rover.told, body = None, rover.body
        body.velocity, body.angular_velocity = velocity[:2], velocity[2]

    def hindrance(self, model: RobotModel, pose: Pose, ignoring: str = "") -> str | None:
        """Return what a robot of this model would overlap with at `pose`, in words; None if it has room there."""
        probe = pymunk.Body(1.0, 1.0)
        return self._in_the_way(
            [pymunk.Poly(probe, model.footprint)], probe, pose, ignoring, 0.0, model.height
        )

    def hindrance_of(self, obstacle: Obstacle, pose: Pose) -> str | None:
        """The same of a thing; fixed things and walls do not count."""
        probe = pymunk.Body(1.0, 1.0)
        shapes, bottom, top = shapes_of(obstacle, probe, (0.0, 0.0, 0.0)), obstacle.bottom, obstacle.height
        return self._in_the_way(shapes, probe, pose, obstacle.name, bottom, top, SOFT)

    def _in_the_way(
        self,
        shapes: list[pymunk.Shape],
        probe: pymunk.Body,
        pose: Pose,
        ignoring: str,
        bottom: float,
        top: float,
        kinds: tuple[str, ...] = KINDS,
    ) -> str | None:
        put(probe, pose)
        found: list[pymunk.Shape | None] = []
        for shape in shapes:
            shape.filter = IS_LOOK
            hits = self.space.shape_query(shape)
            found += [hit.shape for hit in hits if max(depths_of(hit.contact_point_set)) > OVERLAP]
        for shape in shapes:
            # of two shapes that coincide pymunk knows no depth
            middle = probe.local_to_world(shape.center_of_gravity)
            found += [hit.shape for hit in self.space.point_query(middle, 0.0, IS_LOOK)]
        for each in found:
            if each is not None:
                owner = self.owners[each]
                if owner.kind in kinds and owner.name != ignoring and owner.meets(bottom, top):
                    return owner.words()
        return None

    def room(self, name: str) -> float:
        """How far [m] any point of a robot can move before it touches something, if that is not more than VIEW.

        Of the way to another robot that is half, for both may be coming.
        """
        return min([VIEW, *(gap / 2 if moves else gap for gap, _, moves in self.around(name))])

    @property
    def crowd(self) -> Crowd:
        """All robots as tables."""
        if self._crowd is None:
            self._crowd = Crowd(self)
        return self._crowd

    @property
    def quick(self) -> bool:
        """True if `crowd` brings many robots out of each other: with numba."""
        return fast()

    @property
    def at_once(self) -> bool:
        """True if `crowd` can look around many robots at once: with numba, if nothing moves by itself but robots."""
        return not self.leaves and self.quick

    def around(self, name: str) -> list[tuple[float, str, bool]]:
        """What is within VIEW of a robot: how far away [m], whose it is, and whether that moves by itself.

        Of robots that sleep it is told how far they are from where they were last told to be.
        """
        rover = self.rovers[name]
        found = []
        for hit in self.space.shape_query(rover.view):
            if hit.shape is None or hit.shape is rover.shape:
                continue
            owner = self.owners[hit.shape]
            if owner.bottom <= rover.model.height:
                gap = VIEW - max(depths_of(hit.contact_point_set))
                found.append((gap, owner.name, owner.kind in ("robot", "leaf")))
        return found

    # -- contact -------------------------------------------------------------------------------------------------

    def step(
        self, ways: dict[str, tuple[Pose, Pose]], dt: float, watched: set[str] | None = None
    ) -> dict[str, tuple[Pose, bool]]:
        """Let `dt` seconds pass in which each robot's wheels take it from the first pose to the second, if nothing is in the way.

        Return where each robot is then, and whether anything kept it from where it would have gone. Only those that are `watched` can touch anything
        at the end, or all. Robots that are not told of are ghosts.
        """
        for name in ways:
            if not self.rovers[name].awake:
                self._wake(self.rovers[name], awake=True)
        poses = {name: after for name, (_, after) in ways.items()}
        held = make_way(self, poses, dt, list(poses) if watched is None else sorted(watched))
        for name, (before, after) in ways.items():
            rover = self.rovers[name]
            body, axle = rover.body, rover.axle
            axle.velocity = ((after[0] - before[0]) / dt, (after[1] - before[1]) / dt)
            axle.angular_velocity = (after[2] - before[2]) / dt
            # pymunk moves each body by the velocity it has, looks what touches, and then changes the velocities
            (vx, vy), w = body.velocity, body.angular_velocity
            x, y, theta = poses[name]
            put(body, (x - vx * dt, y - vy * dt, theta - w * dt))
            rover.told = None
            rover.slip = ((after[0] - x) / dt, (after[1] - y) / dt) if name in held else (0.0, 0.0)
        self.space.step(dt)
        self.dt = dt
        for name, pose in poses.items():
            put(self.rovers[name].body, pose)
        return {name: (pose, name in held) for name, pose in poses.items()}

    # -- the same again ------------------------------------------------------------------------------------------

    def memory(self) -> dict[str, RoverMemory]:
        """What the bodies of robots have that may touch something: it is nowhere else."""
        return {
            name: (*rover.body.velocity, rover.body.angular_velocity, rover.slip)
            for name, rover in self.rovers.items()
            if rover.awake
        }

    def things(self) -> dict[str, tuple[Pose, Velocity]]:
        """Where things are that are not fixed, and how fast they move."""
        loose = {each.obstacle.name: (each.pose, each.velocity) for each in self._crates}
        return loose | {name: (leaf.pose, AT_REST) for name, leaf in self.leaves.items()}

    def renew(
        self, things: dict[str, tuple[Pose, Velocity]], poses: dict[str, Pose], memory: dict[str, RoverMemory]
    ) -> None:
        """Make all that moves anew, in the order of the names: what the solver remembers of earlier steps is forgotten.

        Things get these poses and velocities, robots these poses, and those that may touch something what `memory` says.
        """
        models = {name: rover.model for name, rover in self.rovers.items()}
        for name in models:
            self.remove(name)
        loose: list[Crate | Leaf] = [*self._crates, *self.leaves.values()]
        for each in loose:
            self._leave(each)
        for each in sorted(loose, key=lambda thing: thing.obstacle.name):
            if isinstance(each, Crate):
                # a new body too: an old one has a velocity more, by which pymunk parts what overlaps
                fresh = make_crate(each.obstacle)
                each.body, each.shapes = fresh.body, fresh.shapes
            self._enter(each)
            self.place(each.obstacle.name, *things[each.obstacle.name])
        for name in sorted(models):
            self.add(name, models[name], poses[name])
        for name, (vx, vy, w, slip) in sorted(memory.items()):
            self._wake(self.rovers[name], awake=True)
            self.move(name, poses[name], (vx, vy, w))
            self.rovers[name].slip = slip
        self.rovers = {name: self.rovers[name] for name in models}
        self.dt = 0.0


def _slides(body: pymunk.Body) -> bool:
    return body.velocity.length > REST or abs(body.angular_velocity) > REST
