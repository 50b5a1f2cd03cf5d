"""A laser that takes its time: each beam from where the robot is then, past others where they are then."""

import math
from dataclasses import replace

import numpy as np
import pytest

from rosmini.core.geometry.poses import arc
from rosmini.sim.engine import Engine
from rosmini.sim.engine.cross_sections import robot_section
from rosmini.sim.geometry.raycast import raycast
from rosmini.sim.models import BURGER
from rosmini.sim.motion import Walk
from rosmini.sim.world import Box, Cylinder, Obstacle, World

HALF = 1.7
ROOM = World(
    "room",
    walls=np.array(
        [(-HALF, -HALF, HALF, -HALF), (HALF, -HALF, HALF, HALF), (HALF, HALF, -HALF, HALF), (-HALF, HALF, -HALF, -HALF)]
    ),
)
LASER = BURGER.laser
BEAMS = np.arange(360)


def engine_of(world=ROOM, noise=0.0):
    engine = Engine(world, lambda name: np.random.default_rng(len(name)), noise=noise)
    engine.trails.remember(0.21)
    return engine


def sensor(poses):
    """Where the beams start, and where they look."""
    x, y, theta = poses.T
    mx, my, _ = LASER.mount
    c, s = np.cos(theta), np.sin(theta)
    return x + c * mx - s * my, y + s * mx + c * my, theta + np.radians(BEAMS)


def to_the_walls(x, y, angle):
    """How far it is from inside the square room to its walls."""
    c, s = np.cos(angle), np.sin(angle)
    with np.errstate(divide="ignore"):
        return np.minimum((np.copysign(HALF, c) - x) / c, (np.copysign(HALF, s) - y) / s)


@pytest.mark.parametrize(("v", "w"), [(0.0, 2.84), (0.22, 0.0), (0.15, -1.3)])
@pytest.mark.parametrize("backend", ["numpy", "numba"])
def test_a_robot_that_goes_on_evenly_sees_a_square_room_exactly(v, w, backend, monkeypatch):
    if backend == "numba":
        pytest.importorskip("numba")
    monkeypatch.setenv("ROSMINI_RAYCAST", backend)
    engine = engine_of()
    robot = engine.add("r", BURGER, (0.1, -0.2, 0.3))
    engine.command("r", v, w)
    engine.advance(1.5)
    ranges, poses = engine.sweep("r", 0.2 / 360)
    then = np.array([arc(robot.pose, v, w, -i * 0.2 / 360) for i in BEAMS])
    np.testing.assert_allclose(poses, then, atol=1e-12)
    exact = to_the_walls(*sensor(then))
    np.testing.assert_allclose(ranges, np.where(exact > 3.5, np.inf, exact), atol=1e-9)


def test_while_speeds_change_beams_start_as_near_to_the_truth_as_is_said():
    engine, watched = engine_of(), engine_of()
    for each in (engine, watched):
        each.add("r", BURGER, (0.0, 0.0, 0.0))
    worst = 0.0
    for v, w in ((0.2, 2.8), (-0.2, -2.8), (0.0, 0.0)):
        truth = []
        for each in (engine, watched):
            each.command("r", v, w)
        begin = engine.now
        for i in range(720):
            truth.append(watched.robots["r"].pose)
            watched.advance(begin + (i + 1) * 0.2 / 360)
        for at in (0.2, 0.27, 0.33):
            engine.advance(begin + at)
            _, poses = engine.sweep("r", 0.2 / 360)
            then = np.array([truth[round(at * 1800) - i] for i in BEAMS])
            worst = max(worst, float(np.abs(poses - then).max()))
        engine.advance(begin + 0.4)
    assert 1e-6 < worst < 12.5 * 0.2**2 / (8 * 10**2) + 1e-9


def test_another_robot_is_seen_where_it_is_at_each_beams_time():
    engine = engine_of(World("empty"))
    engine.add("r", BURGER, (0.0, 0.0, 0.0))
    other = engine.add("other", BURGER, (1.0, -0.05, math.pi / 2))
    engine.command("other", 0.22, 0.0)
    engine.advance(1.0)
    ranges, _ = engine.sweep("r", 0.2 / 360)
    _, discs = robot_section(BURGER, LASER.mount[2])
    exact = np.full(360, np.inf)
    for i in BEAMS:
        x, y, theta = arc(other.pose, 0.22, 0.0, -i * 0.2 / 360)
        px, py = math.cos(theta) * discs[0, 0] + x, math.sin(theta) * discs[0, 0] + y
        exact[i] = raycast([], [(px, py, discs[0, 2])], LASER.mount[0], 0.0, math.radians(i), 0.1, 1, 3.5)[0]
    both = np.isfinite(ranges) & np.isfinite(exact)
    assert both.sum() >= 4
    assert (np.isfinite(ranges) != np.isfinite(exact)).sum() <= 1
    half = 0.22 * 4 * 0.2 / 360  # as far as it goes in four beams, and what that is along a beam that grazes it
    assert np.abs(ranges[both] - exact[both]).max() < 8 * half
    assert np.median(np.abs(ranges[both] - exact[both])) < half


def test_what_is_pushed_is_seen_on_its_way():
    crate = Obstacle("crate", Box(0.2, 0.2), (0.3, 0.0, 0.0), mass=0.2)
    engine = engine_of(World("hall", obstacles=(crate,)))
    engine.add("r", BURGER, (0.0, 0.0, 0.0))
    engine.command("r", 0.2, 0.0)
    engine.advance(1.8)
    ranges, poses = engine.sweep("r", 0.2 / 360, lidar=replace(LASER, range_min=0.0))
    # both moved on by 4 cm meanwhile, so the distance ahead stays
    assert np.ptp(poses[:, 0]) == pytest.approx(0.04, abs=0.005)
    ahead = np.concatenate([ranges[:20], ranges[-20:]]) * np.cos(np.radians([*range(20), *range(-20, 0)]))
    assert np.ptp(ahead) < 2e-3


def test_who_walks_is_seen_where_it_was():
    walk = Walk(((-1.5, 1.0), (1.5, 1.0)), 1.0)
    walker = Obstacle("walker", Cylinder(0.1), (-1.5, 1.0, 0.0), motion=walk)
    engine = engine_of(World("hall", obstacles=(walker,)))
    engine.add("r", BURGER, (0.032, 0.0, 0.0))
    engine.advance(1.5)
    ranges, _ = engine.sweep("r", 0.2 / 360)
    seen, at_once = (float(np.flatnonzero(np.isfinite(each)).mean()) for each in (ranges, engine.scan("r")))
    assert at_once == pytest.approx(90.0, abs=0.6)
    # the beam at 93 degrees looked 52 ms ago, when it was 52 mm farther to the left
    assert seen == pytest.approx(90.0 + math.degrees(math.atan(0.052)), abs=0.6)


def test_a_robot_that_is_put_elsewhere_sees_all_from_there():
    engine = engine_of()
    engine.add("r", BURGER, (0.0, 0.0, 0.0))
    engine.command("r", 0.2, 1.0)
    engine.advance(1.0)
    engine.place("r", (0.5, 0.5, 1.0))
    ranges, poses = engine.sweep("r", 0.2 / 360)
    assert (poses == (0.5, 0.5, 1.0)).all()
    assert ranges.tobytes() == engine.scan("r").tobytes()
    engine.advance(1.1)
    engine.reset()
    assert (engine.sweep("r", 0.2 / 360)[1] == (0.0, 0.0, 0.0)).all()


@pytest.mark.parametrize("turn", [0.0, 2.8, -2.8, 40.0])
@pytest.mark.parametrize("increment", [1.0, -1.0, 0.01])
def test_with_and_without_numba_a_laser_sees_the_same_to_the_last_bit(turn, increment, monkeypatch):
    pytest.importorskip("numba")
    crate = Obstacle("crate", Box(0.2, 0.3), (0.0, 1.0, 0.0), mass=0.2)
    walker = Obstacle("walker", Cylinder(0.2), (1.0, 1.0, 0.0), motion=Walk(((1.0, 1.0), (-1.0, 1.0)), 1.4))
    quick = replace(BURGER, max_angular=math.inf, wheel_acceleration=math.inf)
    fan = replace(LASER, angle_min=-1.0 * increment, angle_max=2.0 * increment)
    seen = []
    for backend in ("numpy", "numba"):
        monkeypatch.setenv("ROSMINI_RAYCAST", backend)
        engine = engine_of(replace(ROOM, obstacles=(crate, walker)))
        engine.add("r", quick, (-0.5, 0.2, 0.3))
        for name, x in (("stands", 0.4), ("goes", -1.2)):
            engine.add(name, BURGER, (x, -0.8, 0.0))
        engine.command("goes", 0.2, 0.5)
        engine.command("r", 0.1, turn)
        engine.advance(0.73)
        engine.command("r", -0.2, turn / 2)
        noise = np.random.default_rng(0).standard_normal(360) * 0.01
        for name in ("r", "stands"):
            for when in (0.85, 1.3):
                engine.advance(when)
                seen.append(engine.sweep(name, 0.2 / 360, noise, fan))
    half = len(seen) // 2
    for one, other in zip(seen[:half], seen[half:], strict=True):
        for mine, theirs in zip(one, other, strict=True):
            assert mine.tobytes() == theirs.tobytes()


def test_each_of_several_that_move_sees_the_one_that_stands():
    seen = {}
    for order in (("a", "c", "b"), ("b", "c", "a")):
        engine = engine_of()
        for name in order:
            engine.add(name, BURGER, {"a": (-1.0, 0.0, 0.0), "b": (0.0, 0.9, 0.0), "c": (0.7, 0.0, 0.0)}[name])
        for name in ("a", "b"):
            engine.command(name, 0.1, 0.4)
        engine.advance(1.0)
        for name in order:
            ranges, _ = engine.sweep(name, 0.2 / 360)
            seen.setdefault(name, []).append(ranges)
    for one, other in seen.values():
        np.testing.assert_allclose(one, other, atol=1e-9)
