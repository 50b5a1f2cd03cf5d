"""The errors of the simulator's physics and sensors against closed forms and stated distributions.

Each function returns an error. One that is larger than it may be raises, so that there is no figure.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Iterator, Sequence

import numpy as np
from numpy.typing import NDArray

from rosmini.core.errors import RosminiError
from rosmini.core.geometry.poses import arc
from rosmini.sim.engine import Engine
from rosmini.sim.models import BURGER, GRAVITY
from rosmini.sim.sensors.imu import Imu
from rosmini.sim.world import Cylinder, Obstacle, World

from . import Measure, sim_room
from .sim_checks import first_hit
from .sim_engine import rng

Floats = NDArray[np.float64]

LEAST_LIKELY = 1e-4
"""A sample that is less likely than this is not of the distribution that it should be of."""


def _within(error: float, limit: float, what: str) -> float:
    if not error <= limit:
        msg = f"{what} is off by {error:.3g}, and may be off by {limit:.3g}"
        raise RosminiError(msg)
    return error


def _alone(world: World | None = None) -> Engine:
    """A world with a Burger without errors at the origin."""
    engine = Engine(World("empty") if world is None else world, rng, noise=0.0)
    engine.add("burger", BURGER, (0.0, 0.0, 0.0))
    return engine


def arc_error() -> float:
    """The distance [m] of a robot at 0.2 m/s and 0.5 rad/s after a minute from (x, y) = v/w (sin wt, 1 - cos wt)."""
    engine = _alone()
    engine.command("burger", 0.2, 0.5)
    engine.advance(1.0)  # it has its speed after 0.24 s
    start = engine.robots["burger"].pose
    worst = 0.0
    for second in range(2, 62):
        engine.advance(float(second))
        x, y, _ = engine.robots["burger"].pose
        exact = arc(start, 0.2, 0.5, second - 1.0)
        worst = max(worst, math.dist((x, y), exact[:2]))
    return _within(worst, 1e-9, "an arc")


def braking_error() -> float:
    """By how much [m] the way of a robot that stops from u differs from u^2 / 2a."""
    engine = _alone()
    engine.command("burger", BURGER.max_linear, 0.0)
    engine.advance(2.0)
    begin = engine.robots["burger"].pose[0]
    engine.command("burger", 0.0, 0.0)
    engine.advance(4.0)
    way = engine.robots["burger"].pose[0] - begin
    exact = BURGER.max_linear**2 / (2 * BURGER.wheel_acceleration)
    return _within(abs(way - exact), 1e-9, "a way of braking")


def collision_error(restitution: float, drag: float = 0.0) -> float:
    """By how much [m/s] the speeds of two equal discs after a head-on blow differ from u (1 - e) / 2 and u (1 + e) / 2.

    With `drag` they rub on the ground, and it is compared where they come to rest [m]: each s = u^2 / (2 mu g) from
    where they met.
    """
    radius, speed, gap = 0.1, 1.0, 0.05
    one = math.sqrt(restitution)  # of two things the product counts
    discs = [
        Obstacle(name, Cylinder(radius), (x, 0.0, 0.0), mass=0.5, drag=drag, restitution=one)
        for name, x in (("a", 0.0), ("b", 2 * radius + gap))
    ]
    engine = Engine(World("discs", tuple(discs)), rng, noise=0.0)
    engine.put("a", (0.0, 0.0, 0.0), (speed, 0.0, 0.0))
    engine.advance(0.5 if not drag else 10.0)
    slower, faster = (1 - restitution) / 2, (1 + restitution) / 2
    if not drag:
        found = engine.velocity("a")[0], engine.velocity("b")[0]
        exact = speed * slower, speed * faster
        return _within(math.dist(found, exact), 2e-3, "a speed after a blow")
    rub = 2 * drag * GRAVITY
    met = speed**2 - rub * gap
    rest = engine.pose("a")[0], engine.pose("b")[0]
    exact = gap + slower**2 * met / rub, gap + 2 * radius + faster**2 * met / rub
    return _within(math.dist(rest, exact), 0.01, "the rest after a blow")


def slip_error() -> float:
    """By how much [m] the way that the wheels show, against a wall, differs from v t, or the robot moves at all."""
    wall = np.array([[BURGER.footprint[1][0] + 0.05, -1.0, BURGER.footprint[1][0] + 0.05, 1.0]])
    engine = _alone(World("wall", walls=wall))
    engine.command("burger", 0.1, 0.0)
    engine.advance(2.0)  # it has been there for a second
    robot = engine.robots["burger"]
    where, ticks = robot.pose, sum(robot.ticks) / 2
    engine.advance(12.0)
    turned = (sum(robot.ticks) / 2 - ticks) / BURGER.ticks_per_turn * 2 * math.pi * BURGER.wheel_radius
    tick = 2 * math.pi * BURGER.wheel_radius / BURGER.ticks_per_turn
    return _within(
        max(abs(turned - 1.0) - tick, math.dist(robot.pose[:2], where[:2]), 0.0), 1e-4, "slip against a wall"
    )


def lidar_error(places: int = 5) -> float:
    """By how much [m] ranges without noise differ from a loop over all walls and pillars.

    But for rays that just pass a corner.
    """
    world = sim_room.room()
    engine = Engine(world, rng, noise=0.0)
    engine.add("burger", BURGER, sim_room.START)
    lidar = BURGER.laser
    worst = 0.0
    for start in sim_room.starts(places):
        engine.place("burger", start)
        x, y, theta = start
        found = engine.scan("burger")
        x, y = x + lidar.mount[0] * math.cos(theta), y + lidar.mount[0] * math.sin(theta)
        exact = np.array([first_hit(world, x, y, theta + 2 * math.pi * i / lidar.beams) for i in range(lidar.beams)])
        exact[exact > lidar.range_max] = np.inf
        wrong = np.isfinite(exact) != np.isfinite(found)
        both = np.isfinite(exact) & np.isfinite(found)
        errors = np.sort(np.abs(found[both] - exact[both]))
        if wrong.sum() > 2 or not both.any():
            msg = f"{wrong.sum()} of {lidar.beams} rays hit what they should miss, or miss what they should hit"
            raise RosminiError(msg)
        worst = max(worst, float(errors[-3]))
    return _within(worst, 1e-9, "a range")


def likelihood(sample: Sequence[float] | Floats) -> float:
    """The p-value of a sample of the normal distribution (0, 1): the test of Kolmogorov and Smirnov.

    By Kolmogorov's series with Stephens' correction for the number of values (Journal of the Royal Statistical Society
    B 32, 1970).
    """
    ordered = np.sort(np.asarray(sample, dtype=float))
    n = len(ordered)
    expected = np.array([(1 + math.erf(value / math.sqrt(2))) / 2 for value in ordered.tolist()])
    steps = np.arange(n)
    apart = max(float((expected - steps / n).max()), float(((steps + 1) / n - expected).max()))
    x = apart * (math.sqrt(n) + 0.12 + 0.11 / math.sqrt(n))
    if x < 0.2:
        return 1.0
    return min(1.0, 2 * sum((-1.0) ** (k - 1) * math.exp(-2 * k * k * x * x) for k in range(1, 101)))


def _likely(sample: Floats, what: str) -> float:
    p = likelihood(sample)
    if p < LEAST_LIKELY:
        msg = f"{what} is not of its distribution: the test of Kolmogorov and Smirnov gives p = {p:.2g}"
        raise RosminiError(msg)
    return p


def lidar_noise(scans: int = 30) -> float:
    """The p-value of a Burger's range errors for the stated deviation: the test of Kolmogorov and Smirnov."""
    engine = Engine(sim_room.room(), rng)
    engine.add("burger", BURGER, sim_room.START)
    lidar, noise = BURGER.laser, rng("lidar")
    exact = engine.scan("burger")
    inside = np.isfinite(exact) & (exact < lidar.range_max - 0.1)
    errors = [
        engine.scan("burger", noise.standard_normal(lidar.beams) * lidar.noise)[inside] - exact[inside]
        for _ in range(scans)
    ]
    return _likely(np.concatenate(errors) / lidar.noise, "the noise of the laser")


def imu_noise(samples: int = 10_000) -> float:
    """The same of the gyroscope and the accelerometer at rest, less their biases."""
    model = BURGER.unit
    imu = Imu(model, rng("imu"))
    read = np.array([imu.sample(number, 0.0, 0.0, 0.0, 0.0, 0.0)[1:] for number in range(samples)])
    read[:, 5] -= GRAVITY
    deviations = np.array([model.gyro_noise] * 3 + [model.accel_noise] * 3)
    return _likely(((read - imu.bias) / deviations).ravel(), "the noise of the imu")


def wheel_noise(robots: int = 400) -> float:
    """The same of the distance of the wheels, and of how they roll: of their radii and slip together."""
    errors = BURGER.errors
    engine = Engine(World("empty"), rng)
    drawn: list[float] = []
    for i in range(robots):
        name = f"burger {i}"
        wheels = engine.add(name, BURGER, (0.0, 0.0, 0.0)).wheels
        drawn.append((wheels.separation / BURGER.wheel_separation - 1) / errors.separation)
        # its radius and its slip in one, so near to 1 both
        drawn.append((wheels.left - 1) / math.hypot(errors.radius, errors.slip))
        engine.remove(name)
    return _likely(np.array(drawn), "the error of wheels")


def measures(scale: float) -> Iterator[Measure]:
    """Yield everything that is compared."""
    some = max(int(10_000 * scale), 500)
    forms: list[tuple[str, str, Callable[[], float]]] = [
        ("arc of 0.2 m/s and 0.5 rad/s, a minute, off its circle", "m", arc_error),
        ("way of braking, off u^2 / 2a", "m", braking_error),
        ("equal discs, elastic blow, off (0, u)", "m/s", lambda: collision_error(1.0)),
        ("equal discs, e = 0.5, off (u / 4, 3 u / 4)", "m/s", lambda: collision_error(0.5)),
        ("equal discs, e = 0.5, with friction, off their places of rest", "m", lambda: collision_error(0.5, 0.3)),
        ("wheels that slip against a wall, off v t", "m", slip_error),
        ("ranges without noise, off exact geometry", "m", lidar_error),
    ]
    for name, unit, error in forms:
        yield Measure(name, unit, error, more_is_better=False, once=True)
    noises: list[tuple[str, Callable[[], float]]] = [
        ("noise of the laser, normal as stated", lambda: lidar_noise(max(some // 300, 3))),
        ("noise of the imu, normal as stated", lambda: imu_noise(some)),
        ("errors of the wheels, normal as stated", lambda: wheel_noise(max(some // 20, 50))),
    ]
    for name, p in noises:
        yield Measure(name, "p of KS", p, once=True)
