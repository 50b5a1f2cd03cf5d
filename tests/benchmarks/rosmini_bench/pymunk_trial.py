"""What pymunk's solver does in place of the contacts of the engine: speed, repetition and accuracy.

`PYTHONPATH=tests/benchmarks uv run python -m rosmini_bench.pymunk_trial` (five minutes) measures, stores the figures in
assets/benchmarks/pymunk.json and writes the table on the design page. With `--write` it only writes the table again.

The trial is Chipmunk's own way to drive a vehicle seen from above: a joint with a limited force holds a robot to a
body that moves as its wheels do, and another one holds a crate to the ground. (`pymunk.batch`, which pymunk calls
experimental, sets all velocities at once. It makes a hundred robots faster, but not as fast as ours.)
"""

from __future__ import annotations

import argparse
import json
import math
import pickle
import re
import time
from collections.abc import Callable
from pathlib import Path
from typing import Any

import numpy as np
import pymunk

from rosmini.core.geometry.poses import Pose, arc, transform_points
from rosmini.sim.engine import Engine
from rosmini.sim.engine.bodies import FRICTION, GRIP, crate_body, pieces_of
from rosmini.sim.engine.bodies import Crate as EngineCrate
from rosmini.sim.engine.instant import STEP, Instant
from rosmini.sim.models import BURGER, GRAVITY
from rosmini.sim.world import Box, Obstacle, World

from . import sim_room
from .sim_engine import rng

ROOT = Path(__file__).resolve().parents[3]
FILE = ROOT / "assets" / "benchmarks" / "pymunk.json"
PAGE = ROOT / "book" / "about" / "design.md"
OVERLAP = 2e-5
"""The overlap [m] that bodies in contact keep, as `rosmini.sim.engine.kernels.PUSH_DEPTH`."""
GRIP_FORCE = GRIP * BURGER.mass * GRAVITY
"""The largest force of a Burger's wheels [N]."""


class Trial:
    """Burgers, crates and walls in a pymunk space; `fresh` makes a new space for each step, which forgets the last."""

    def __init__(self, world: World, *, fresh: bool = False) -> None:
        self.world, self.fresh, self.ticks = world, fresh, 0
        self.robots: dict[str, pymunk.Body] = {}
        self.crates: dict[str, pymunk.Body] = {}
        self.wheels: dict[str, list[float]] = {}
        """Speeds of the left and the right rim, and their targets [m/s]."""
        self.kinematic: dict[str, pymunk.Body] = {}
        self._make_space()
        for obstacle in world.obstacles:
            if obstacle.mass is not None:
                self._add_crate(obstacle.name, obstacle.pose)

    def _make_space(self) -> None:
        self.space = pymunk.Space()
        self.space.iterations, self.space.collision_slop, self.space.collision_bias = 30, OVERLAP, 0.0
        ground = self.space.static_body
        for x1, y1, x2, y2 in self.world.hard_walls.tolist():
            self._add_shapes([pymunk.Segment(ground, (x1, y1), (x2, y2), 0.0)])
        for obstacle in self.world.obstacles:
            if obstacle.mass is None:
                self._add_shapes(_shapes(ground, pieces_of(obstacle.shape, obstacle.pose)))

    def _add_shapes(self, shapes: list[pymunk.Shape]) -> None:
        for shape in shapes:
            shape.friction = FRICTION
        self.space.add(*shapes)

    def _hold(self, body: pymunk.Body, to: pymunk.Body, force: float, lever: float) -> None:
        """Hold a body to another one by a force [N] and a torque of at most `force` times `lever` [m]."""
        joints = pymunk.PivotJoint(to, body, (0, 0), body.center_of_gravity), pymunk.GearJoint(to, body, 0, 1)
        for joint, most in zip(joints, (force, force * lever), strict=True):
            joint.max_bias, joint.max_force = 0.0, most
        self.space.add(*joints)

    def _add_crate(self, name: str, pose: Pose) -> pymunk.Body:
        obstacle = next(each for each in self.world.obstacles if each.name == name)
        made = crate_body(EngineCrate(obstacle, Instant()))
        body = self.crates[name] = pymunk.Body(made.mass.mass, made.mass.inertia)
        body.center_of_gravity = made.mass.x, made.mass.y
        body.position, body.angle = pose[:2], pose[2]
        self.space.add(body)
        self._add_shapes(_shapes(body, made.pieces))
        drag, load, lever = made.ground_friction
        self._hold(body, self.space.static_body, (0.5 if drag is None else drag) * load * GRAVITY, lever)
        return body

    def add(self, name: str, pose: Pose) -> pymunk.Body:
        """Add a Burger."""
        body = self.robots[name] = pymunk.Body(BURGER.mass, BURGER.inertia)
        body.position, body.angle = pose[:2], pose[2]
        wheels = self.kinematic[name] = pymunk.Body(body_type=pymunk.Body.KINEMATIC)
        self.wheels.setdefault(name, [0.0] * 4)
        self.space.add(body, wheels)
        self._add_shapes([pymunk.Poly(body, list(BURGER.footprint))])
        self._hold(body, wheels, GRIP_FORCE, BURGER.wheel_separation / 2)
        return body

    def command(self, name: str, v: float, w: float) -> None:
        """Command speeds ahead [m/s] and to the left [rad/s]."""
        half = w * BURGER.wheel_separation / 2
        self.wheels[name][2:] = v - half, v + half

    def pose(self, name: str) -> Pose:
        """Return the pose of a robot or a crate."""
        body = self.robots.get(name) or self.crates[name]
        return (*body.position, body.angle)

    def advance(self, until: float) -> None:
        """Advance to a time on the grid of steps [s]."""
        while self.ticks < round(until / STEP):
            if self.fresh:
                self._renew()
            for name, wheels in self.wheels.items():
                self._turn_wheels(name, wheels)
            self.space.step(STEP)
            self.ticks += 1

    def _turn_wheels(self, name: str, wheels: list[float]) -> None:
        """Accelerate the wheels, and move the body that pulls the robot along the chord of its path."""
        limit = BURGER.wheel_acceleration * STEP
        before = wheels[:2]
        for side in (0, 1):
            wheels[side] += max(-limit, min(limit, wheels[2 + side] - wheels[side]))
        left, right = (before[0] + wheels[0]) / 2, (before[1] + wheels[1]) / 2
        v, w = (left + right) / 2, (right - left) / BURGER.wheel_separation
        heading, body = self.robots[name].angle + w * STEP / 2, self.kinematic[name]
        body.velocity, body.angular_velocity = (v * math.cos(heading), v * math.sin(heading)), w

    def _renew(self) -> None:
        """Make a new space with the same poses and velocities."""
        robots, crates = dict(self.robots), dict(self.crates)
        self._make_space()
        for olds, add in ((robots, self.add), (crates, self._add_crate)):
            for name, old in olds.items():
                new = add(name, (*old.position, old.angle))
                new.velocity, new.angular_velocity = old.velocity, old.angular_velocity


def _shapes(body: pymunk.Body, pieces: list[Any]) -> list[pymunk.Shape]:
    return [
        pymunk.Circle(body, radius, tuple(corners[0].tolist()))
        if len(corners) == 1
        else pymunk.Poly(body, corners.tolist())
        for corners, radius in pieces
    ]


# -- speed -----------------------------------------------------------------------------------------------------------

Make = Callable[[World], Any]
"""Makes an engine, or a trial, of a world."""

WAYS: dict[str, Make] = {
    "our engine": lambda world: Engine(world, rng, noise=0.0),
    "pymunk, one space": Trial,
    "pymunk, a new space for each step": lambda world: Trial(world, fresh=True),
}


def place(made: Any, name: str, pose: Pose) -> None:
    """Add a Burger to an engine or a trial."""
    if isinstance(made, Engine):
        made.add(name, BURGER, pose)
    else:
        made.add(name, pose)


def crates(count: int) -> World:
    """Return a world in which each robot of `sim_room.starts` has a crate in front, and pushes it on its circle."""
    things = [
        Obstacle(f"crate {i}", Box(0.1, 0.15), arc(start, 0.2, 0.0, 1.0), mass=0.3)
        for i, start in enumerate(sim_room.starts(count))
    ]
    return World("crates", tuple(things))


def speed(make: Make, world: World, count: int) -> float:
    """Return simulated seconds a second of processor time for robots on circles; poses are read at 100 Hz."""
    made, names = make(world), [f"robot_{i}" for i in range(count)]
    for name, start in zip(names, sim_room.starts(count), strict=True):
        place(made, name, start)
        made.command(name, sim_room.SPEED, sim_room.TURN_RATE)
    seconds, begin = max(4.0 / count, 0.5), 0.0
    for number in range(round((1 + seconds) * 100) + 1):
        if number == 100:
            begin = time.process_time()
        made.advance(number / 100)
        for name in names:
            made.pose(name)
    return seconds / (time.process_time() - begin)


def speeds(rounds: int = 3) -> dict[str, list[float | None]]:
    """Measure the ways in turns; return the best of the rounds. Without a contact, no new space is needed."""
    found: dict[str, list[float | None]] = {}
    for what, make_world, ways in (
        ("free", lambda _: sim_room.room(), list(WAYS.values())[:2]),
        ("pushing a crate", crates, list(WAYS.values())),
    ):
        for count in (1, 10, 100):
            world = make_world(count)
            rows = [[speed(make, world, count) for make in ways] for _ in range(rounds)]
            best = [max(column) for column in zip(*rows, strict=True)]
            found[f"{count} {'robot' if count == 1 else 'robots'}, {what}"] = [*best, *[None] * (len(WAYS) - len(best))]
    return found


# -- the same again --------------------------------------------------------------------------------------------------

HALF = 0.9
"""Half the width of the pen [m]."""

PEN = World(
    "pen",
    (Obstacle("crate", Box(0.15, 0.2), (0.0, 0.0, 0.4), mass=0.5),),
    HALF * np.array([(-1, -1, 1, -1), (1, -1, 1, 1), (1, 1, -1, 1), (-1, 1, -1, -1)]),
)
PLACES: dict[str, Pose] = {
    f"robot {i}": (0.62 * math.cos(angle), 0.62 * math.sin(angle), angle + 2.5)
    for i, angle in enumerate(math.tau / 12 * np.arange(12))
}


def run(trial: Any, between: Callable[[Any], Any] = lambda trial: trial) -> list[list[Pose]]:
    """Let the robots in the pen push one another and a crate for 3 s; return all poses every 50 ms."""
    draw, found = np.random.default_rng(0), []
    for number in range(60):
        if number % 10 == 0:
            for name in PLACES:
                trial.command(name, *draw.uniform((-0.05, -1.0), (0.22, 1.0)).tolist())
        trial.advance((number + 1) / 20)
        found.append([trial.pose(name) for name in (*PLACES, "crate")])
        trial = between(trial)
    return found


def off(one: list[list[Pose]], other: list[list[Pose]]) -> float:
    """Return the largest difference of any position [m] in two runs."""
    return max(math.dist(a[:2], b[:2]) for x, y in zip(one, other, strict=True) for a, b in zip(x, y, strict=True))


def penned(make: Make, *, far: bool = False) -> Any:
    """Put the robots into their pen; `far` adds one that drives far away."""
    made = make(PEN)
    for name, pose in PLACES.items():
        place(made, name, pose)
    if far:
        place(made, "far", (9.0, 9.0, 0.0))
        made.command("far", 0.2, 0.0)
    return made


def restored(made: Any) -> Any:
    """Save and restore: an engine by its own means, a trial by those of pymunk."""
    if isinstance(made, Engine):
        made.restore(pickle.loads(pickle.dumps(made.state())))
        return made
    return pickle.loads(pickle.dumps(made))


def repetition(make: Make) -> dict[str, float]:
    """Return how far runs are apart that should be equal [mm]."""
    first = run(penned(make))
    return {
        "the same run again": 1e3 * off(first, run(penned(make))),
        "saved and restored every 50 ms": 1e3 * off(first, run(penned(make), restored)),
        "another robot 12 m away": 1e3 * off(first, run(penned(make, far=True))),
    }


# -- accuracy --------------------------------------------------------------------------------------------------------


def wall_overlap(make: Make) -> float:
    """Return how deep a robot gets into walls in a minute of random commands [mm]."""
    made, draw, deepest = make(World("pen", walls=PEN.walls)), np.random.default_rng(4), 0.0
    place(made, "burger", (0.0, 0.0, 0.0))
    for number in range(60 * 20):
        if number % 20 == 0:
            made.command("burger", *draw.uniform((-0.22, -2.84), (0.22, 2.84)).tolist())
        made.advance((number + 1) / 20)
        corners = transform_points(made.pose("burger"), BURGER.footprint)
        deepest = max(deepest, float(abs(corners).max()) - HALF)
    return 1e3 * deepest


def circle_error(make: Make) -> float:
    """Return how far a robot is from the circle that its wheels describe, after a full turn [mm]."""
    made, turn = make(World("void")), 12.5
    place(made, "burger", (0.0, 0.0, 0.0))
    made.command("burger", 0.2, 0.5)
    made.advance(1.0)
    begin = made.pose("burger")
    made.advance(1.0 + turn)
    return 1e3 * math.dist(made.pose("burger")[:2], arc(begin, 0.2, 0.5, turn)[:2])


def measure() -> dict[str, dict[str, list[float | None]]]:
    """Measure all."""
    wrong: dict[str, list[float | None]] = {}
    for make in WAYS.values():
        rows = repetition(make) | {
            "deepest overlap with a wall": wall_overlap(make),
            "distance from the exact circle after one turn": circle_error(make),
        }
        for name, value in rows.items():
            wrong.setdefault(name, []).append(value)
    return {"speed": speeds(), "error": wrong}


# -- the table -------------------------------------------------------------------------------------------------------


def table(found: dict[str, dict[str, list[float | None]]]) -> str:
    """Return the table of the design page."""
    rows = [["", *WAYS], ["---", *["---:"] * len(WAYS)]]
    for name, values in found["speed"].items():
        ours = values[0] or math.nan
        others = (f"{_short(each)} ({each / ours:.2g})" if each else "as ours" for each in values[1:])
        rows.append([f"{name} [s/s]", _short(ours), *others])
    for name, values in found["error"].items():
        rows.append([f"{name} [mm]", *(_short(each or 0.0) for each in values)])
    return "\n".join(f"| {' | '.join(row)} |".replace("|  |", "| |") for row in rows)


def _short(number: float) -> str:
    """Write a number with few digits; 0 means exactly 0."""
    if 0 < number < 1e-9:
        return "under 0.000000001"
    return f"{number:,.0f}" if number > 100 else np.format_float_positional(float(f"{number:.2g}"), trim="-")


def updated(page: str) -> str:
    """Return a page with its table made again from the stored figures."""
    found = json.loads(FILE.read_text(encoding="utf-8"))
    part = r"(<!-- table: by rosmini_bench\.pymunk_trial -->\n\n).*?(\n\n<!-- end -->)"
    return re.sub(part, lambda old: old[1] + table(found) + old[2], page, flags=re.DOTALL)


def main() -> None:
    """Measure, unless told only to write, and write the table."""
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--write", action="store_true", help="measure nothing")
    if not parser.parse_args().write:
        FILE.write_text(json.dumps(measure(), indent=2) + "\n", encoding="utf-8")
    PAGE.write_text(updated(PAGE.read_text(encoding="utf-8")), encoding="utf-8", newline="\n")


if __name__ == "__main__":
    main()
