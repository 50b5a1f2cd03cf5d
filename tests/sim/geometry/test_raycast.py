"""The raycast against closed forms, against a plain loop over all pairs, and the two backends against each other."""

import importlib.util
import logging
import math
import sys

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from rosmini.core.errors import RosminiError
from rosmini.core.geometry.errors import GeometryError
from rosmini.core.geometry.machine_code import LOADING, Deferral
from rosmini.sim.geometry import raycast as module
from rosmini.sim.geometry import raycast_numba
from rosmini.sim.geometry.raycast import BACKENDS, backend, raycast, raycast_each

HAS_NUMBA = importlib.util.find_spec("numba") is not None
TURN = 2 * math.pi
ENOUGH = LOADING + 1
"""Rays after which numba is worth loading."""
NO_SEGMENTS, NO_DISCS = np.empty((0, 4)), np.empty((0, 3))

both = pytest.mark.parametrize(
    "name", ["numpy", pytest.param("numba", marks=pytest.mark.skipif(not HAS_NUMBA, reason="numba is not installed"))]
)


def closed(*corners):
    points = np.array(corners, dtype=float)
    return np.hstack([points, np.roll(points, -1, axis=0)])


ROOM = closed((-2, -1), (3, -1), (3, 4), (-2, 4))


def look(
    segments=NO_SEGMENTS, discs=NO_DISCS, x=0.0, y=0.0, *, start=0.0, step=TURN / 360, count=360, reach=50.0, **options
):
    return raycast(segments, discs, x, y, start, step, count, reach, **options)


def one(segments=NO_SEGMENTS, discs=NO_DISCS, angle=0.0, **options):
    return float(look(segments, discs, start=angle, count=1, **options)[0])


# ---- closed forms ----


@both
def test_a_room_is_seen_as_large_as_it_is(name):
    angles = 1e-4 + TURN / 720 * np.arange(720)
    to_x = np.where(np.cos(angles) > 0, 3, -2) / np.cos(angles)
    to_y = np.where(np.sin(angles) > 0, 4, -1) / np.sin(angles)
    seen = look(ROOM, start=1e-4, step=TURN / 720, count=720, backend=name)
    np.testing.assert_allclose(seen, np.minimum(to_x, to_y), rtol=0, atol=1e-12)


@both
def test_a_disc_is_seen_as_a_circle(name):
    distance, radius, angles = 2.0, 0.3, TURN / 3600 * np.arange(3600)
    aside = distance * np.sin(angles)
    hit = (np.abs(aside) < radius) & (np.cos(angles) > 0)
    expected = np.full(3600, np.inf)
    expected[hit] = distance * np.cos(angles[hit]) - np.sqrt(radius**2 - aside[hit] ** 2)
    seen = look(discs=[(distance, 0, radius)], step=TURN / 3600, count=3600, backend=name)
    np.testing.assert_allclose(seen, expected, rtol=0, atol=1e-12)
    assert seen[0] == pytest.approx(1.7, abs=1e-15)


@both
def test_nothing_is_seen_as_infinitely_far(name):
    assert np.isinf(look(backend=name)).all()
    assert np.isinf(look([], [], backend=name)).all()
    assert look(ROOM, count=0, backend=name).shape == (0,)


@both
def test_the_reach_itself_is_still_seen(name):
    wall = [(3.5, -1, 3.5, 1)]
    assert one(wall, reach=3.5, backend=name) == 3.5
    assert one(wall, reach=math.nextafter(3.5, 0), backend=name) == math.inf
    assert one(wall, reach=math.inf, backend=name) == 3.5
    assert one(discs=[(4.0, 0, 0.5)], reach=3.5, backend=name) == 3.5


# ---- what is easily wrong ----


@both
@pytest.mark.parametrize(
    ("wall", "distance"),
    [
        ((1, 0, 3, 0), 1.0),
        ((3, 0, 1, 0), 1.0),
        ((-1, 0, -3, 0), math.inf),
        ((-1, 0, 2, 0), 0.0),
        ((1, 0.5, 3, 0.5), math.inf),
        ((2, 0, 2, 1), 2.0),
        ((2, -1, 2, 0), 2.0),
        ((2, 0, 2, 0), 2.0),
        ((-2, 0, -2, 0), math.inf),
        ((2, 0.1, 2, 0.1), math.inf),
        ((0, 0, 1, 1), 0.0),
        ((0, 0, 0, 0), 0.0),
        ((-1, -1, 1, 1), 0.0),
        ((-5, 0, 0, 0), 0.0),
    ],
    ids=str,
)
def test_walls_along_the_ray_ends_on_it_and_walls_without_length(name, wall, distance):
    assert one([wall], backend=name) == distance


@both
def test_a_sensor_in_or_on_a_thing_sees_nothing_but_it(name):
    for x in (0.0, 0.2, 0.5):
        assert (look(ROOM, [(0, 0, 0.5)], x, backend=name) == 0).all()
    np.testing.assert_allclose(look(ROOM, x=3.0, backend=name), 0, atol=1e-15)
    np.testing.assert_allclose(look(ROOM, x=3.0, y=4.0, backend=name), 0, atol=1e-15)


@both
def test_no_ray_slips_between_walls_that_share_a_corner(name):
    """Sides of a polygon around the sensor, each with corners rounded in its own way, and rays at the corners."""
    rng = np.random.default_rng(3)
    for corners in (3, 4, 7, 50):
        for _ in range(20):
            angles = np.sort(rng.uniform(0, TURN, corners)) + rng.uniform(-20, 20)
            if np.diff(angles, append=angles[0] + TURN).max() > 3:
                continue
            radii = rng.uniform(0.5, 30, corners)
            points = np.column_stack([radii * np.cos(angles), radii * np.sin(angles)])
            sides = np.hstack([points, np.roll(points, -1, axis=0)]) + rng.uniform(-3e-10, 3e-10, (corners, 4))
            for angle, radius in zip(angles, radii, strict=True):
                assert one(sides, angle=float(angle), backend=name) <= radius + 1e-6


@both
@given(start=st.floats(-1e4, 1e4), x=st.floats(-1.9, 2.9), y=st.floats(-0.9, 3.9))
def test_a_closed_room_is_closed_wherever_the_first_ray_looks(name, start, x, y):
    assert np.isfinite(look(ROOM, x=x, y=y, start=start, step=TURN / 97, count=97, backend=name)).all()


# ---- against a plain loop, and each other ----


def plain(segments, discs, x, y, angle, reach):
    """The range, and whether a hair's breadth would change it, by Cramer's rule and the quadratic formula."""
    c, s = math.cos(angle), math.sin(angle)
    best, unsure = math.inf, False
    for x1, y1, x2, y2 in segments:
        ends = [c * (py - y) - s * (px - x) for px, py in ((x1, y1), (x2, y2))]
        unsure |= min(map(abs, ends)) < 1e-6
        ex, ey = x2 - x1, y2 - y1
        cross = c * ey - s * ex
        if cross == 0:
            continue
        t = ((x1 - x) * ey - (y1 - y) * ex) / cross
        u = ((x1 - x) * s - (y1 - y) * c) / cross
        if t >= 0 and 0 <= u <= 1:
            best = min(best, t)
        unsure |= abs(t) < 1e-6
    for px, py, radius in discs:
        dx, dy = x - px, y - py
        half_b, square = c * dx + s * dy, dx * dx + dy * dy - radius * radius
        root = half_b * half_b - square
        unsure |= abs(root) < 1e-6 or abs(square) < 1e-6
        if square <= 0:
            return 0.0, unsure
        if root > 0 and half_b < 0:
            best = min(best, -half_b - math.sqrt(root))
    return (best if best <= reach else math.inf), unsure or abs(best - reach) < 1e-6


grid = st.integers(-12, 12).map(lambda number: number / 4)
place = st.one_of(grid, st.floats(-3, 3))
walls = st.lists(st.tuples(place, place, place, place), max_size=12)
pillars = st.lists(st.tuples(place, place, st.floats(0, 1.5)), max_size=5)
fans = st.fixed_dictionaries(
    {
        "x": grid,
        "y": grid,
        "start": st.floats(-10, 10),
        "step": st.one_of(st.floats(-0.5, 0.5), st.just(TURN / 60), st.floats(-20, 20)),
        "count": st.integers(1, 70),
        "reach": st.floats(0, 6),
    }
)


@both
@given(walls, pillars, fans)
def test_culling_changes_nothing(name, segments, discs, fan):
    seen = look(segments, discs, **fan, backend=name)
    for i, found in enumerate(seen):
        angle = fan["start"] + i * fan["step"]
        expected, unsure = plain(segments, discs, fan["x"], fan["y"], angle, fan["reach"])
        if not unsure:
            assert found == pytest.approx(expected, rel=0, abs=1e-9)


@pytest.mark.skipif(not HAS_NUMBA, reason="numba is not installed")
@given(walls, pillars, fans)
def test_the_backends_agree_to_the_last_bit_even_where_a_hair_decides(segments, discs, fan):
    found = [look(segments, discs, **fan, backend=name).tobytes() for name in BACKENDS]
    assert found[0] == found[1]


# ---- bad input ----


@both
@pytest.mark.parametrize(
    ("arguments", "words"),
    [
        ({"segments": [(0, 0, 1, 1), (0, 0, math.nan, 1)]}, "row 1 of segments is not finite"),
        ({"discs": [(0, math.inf, 1)]}, "row 0 of discs is not finite"),
        ({"discs": [(0, 0, 1), (0, 0, -0.1)]}, "disc 1 has the radius -0.1"),
        ({"segments": [(0, 0, 1)]}, r"segments are an array \(n, 4\), not \(1, 3\)"),
        ({"discs": [1.0, 1.0, 1.0]}, r"discs are an array \(n, 3\), not \(3,\)"),
        ({"x": math.nan}, "x=nan"),
        ({"y": math.inf}, "y=inf"),
        ({"start": math.nan}, "angle_min=nan"),
        ({"step": math.inf}, "angle_increment=inf"),
        ({"reach": math.nan}, r"max_range \(nan\)"),
        ({"reach": -1.0}, r"max_range \(-1.0\)"),
        ({"count": -1}, r"count \(-1\)"),
    ],
)
def test_numbers_that_are_none_are_refused(name, arguments, words):
    with pytest.raises(GeometryError, match=words):
        look(**arguments, backend=name)


# ---- the choice of a backend ----


@pytest.fixture
def fresh(monkeypatch):
    """Nothing is remembered of the numba that is installed, before and after."""
    module._numba.cache_clear()
    module._kernel.cache_clear()
    monkeypatch.setattr(module, "_LASERS", module._Lasers())
    monkeypatch.setattr(Deferral, "total", 0)
    yield
    module._numba.cache_clear()
    module._kernel.cache_clear()


@pytest.fixture
def without_numba(fresh, monkeypatch):
    monkeypatch.setitem(sys.modules, "numba", None)
    monkeypatch.delenv(module.VARIABLE, raising=False)


def test_without_numba_numpy_does_it_in_silence(without_numba, caplog):
    assert backend(ENOUGH) == "numpy"
    assert look(ROOM)[0] == 3.0
    assert not caplog.records


def test_numba_by_name_needs_numba(without_numba, monkeypatch):
    with pytest.raises(RosminiError, match="pip install numba"):
        look(ROOM, backend="numba")
    monkeypatch.setenv(module.VARIABLE, "numba")
    with pytest.raises(RosminiError, match="pip install numba"):
        look(ROOM)
    assert look(ROOM, backend="numpy")[0] == 3.0


def test_a_numba_that_does_not_work_is_named_once(fresh, monkeypatch, caplog):
    class Refusing:
        @staticmethod
        def find_spec(name, path=None, target=None):
            if name == "numba":
                raise ImportError("Numba needs NumPy 2.5 or less")

    monkeypatch.delitem(sys.modules, "numba", raising=False)
    monkeypatch.setattr(sys, "meta_path", [Refusing, *sys.meta_path])
    monkeypatch.delenv(module.VARIABLE, raising=False)
    assert [backend(ENOUGH), backend(ENOUGH)] == ["numpy", "numpy"]
    assert look(ROOM)[0] == 3.0
    (record,) = caplog.records
    assert record.levelno == logging.WARNING
    assert "NumPy 2.5 or less" in record.getMessage()


@pytest.mark.skipif(not HAS_NUMBA, reason="numba is not installed")
def test_numba_is_used_after_enough_rays(fresh, monkeypatch):
    monkeypatch.delenv(module.VARIABLE, raising=False)
    assert backend(0) == "numpy"
    assert [backend(ENOUGH), backend(0)] == ["numba", "numba"]


@pytest.mark.skipif(not HAS_NUMBA, reason="numba is not installed")
def test_in_wall_time_numba_is_used_from_the_start_or_not_at_all(fresh, monkeypatch):
    monkeypatch.delenv(module.VARIABLE, raising=False)
    module.expect(1_800)
    assert backend(ENOUGH) == "numpy"
    module.expect(100_000)
    assert backend(0) == "numba"


def test_the_environment_overrides_the_default_and_the_argument_both(monkeypatch):
    monkeypatch.setenv(module.VARIABLE, "numpy")
    assert backend(0) == "numpy"
    monkeypatch.setenv(module.VARIABLE, "nunpy")
    with pytest.raises(GeometryError, match=r"'nunpy' \(from .* ROSMINI_RAYCAST\).* did you mean numpy\?"):
        backend(0)
    with pytest.raises(GeometryError, match="'cuda'; there are numba and numpy"):
        look(ROOM, backend="cuda")
    assert look(ROOM, backend="numpy")[0] == 3.0


@pytest.mark.skipif(not HAS_NUMBA, reason="numba is not installed")
def test_a_cache_that_cannot_be_written_is_done_without(monkeypatch):
    import numba

    compile_it = numba.njit

    def njit(*arguments, cache=False):
        if cache:
            raise RuntimeError("cannot cache function 'cast': no locator available")
        return compile_it(*arguments)

    monkeypatch.setattr(numba, "njit", njit)
    kernel = raycast_numba.compiled.__wrapped__()
    ranges = np.full(1, np.inf)
    here = np.zeros(1)
    origins = (here, here, 0.0, 0.0, module.EVERY, module.EVERY)
    kernel(ROOM, NO_DISCS, 0.0, 0.0, np.ones(1), np.zeros(1), 0.0, 0.1, 9.0, ranges, *origins)
    assert ranges[0] == 3.0


# -- rays that each start somewhere ------------------------------------------------------------------------------------


@st.composite
def sweeps(draw):
    """A world, the way of a laser through it, and which rays see which thing."""
    near = st.floats(-3.0, 3.0)
    walls = draw(st.lists(st.tuples(near, near, near, near), max_size=6))
    pillars = draw(st.lists(st.tuples(near, near, st.floats(0.0, 0.5)), max_size=4))
    count = draw(st.integers(1, 40))
    steps = draw(st.lists(st.tuples(*[st.floats(-0.02, 0.02)] * 3), min_size=count, max_size=count))
    way = np.cumsum(np.array(steps), axis=0)
    step = draw(st.sampled_from([TURN / 40, -TURN / 40, 0.3, 0.0]))
    angles = draw(st.floats(-7.0, 7.0)) + step * np.arange(count) + way[:, 2]
    which = st.tuples(st.integers(0, count), st.integers(0, count)).map(sorted)
    rays = [draw(st.lists(which, min_size=len(each), max_size=len(each))) for each in (walls, pillars)]
    return (
        np.array(walls, dtype=float).reshape(-1, 4),
        np.array(pillars, dtype=float).reshape(-1, 3),
        way[:, :2] + draw(st.tuples(near, near)),
        angles,
        rays,
    )


@both
@given(sweep=sweeps())
def test_each_ray_sees_what_it_would_see_alone(name, sweep):
    walls, pillars, origins, angles, rays = sweep
    ranges = raycast_each(walls, pillars, origins, angles, 4.0, segment_rays=rays[0], disc_rays=rays[1], backend=name)
    spans = [np.array(each, dtype=int).reshape(-1, 2) for each in rays]
    for i, ((x, y), angle) in enumerate(zip(origins.tolist(), angles.tolist(), strict=True)):
        there = [(span[:, 0] <= i) & (i < span[:, 1]) for span in spans]
        alone = raycast(walls[there[0]], pillars[there[1]], x, y, angle, 0.1, 1, 4.0, backend=name)[0]
        if ranges[i] != alone:
            nudged = [
                raycast(walls[there[0]], pillars[there[1]], x, y, angle + off, 0.1, 1, 4.0 + 1e-8, backend=name)[0]
                for off in (-1e-7, 0.0, 1e-7)
            ]  # at an edge a hair's breadth changes a range by metres
            assert min(nudged) - 1e-5 <= ranges[i] <= max(*nudged, alone) + 1e-5


@pytest.mark.parametrize(
    ("change", "words"),
    [
        ({"angles": [0.0, math.nan]}, "finite angles"),
        ({"angles": [0.0]}, "finite angles"),
        ({"origins": [(0.0, math.inf), (0.0, 0.0)]}, "origins is not finite"),
        ({"max_range": -1.0}, "max_range"),
        ({"segment_rays": [(0, 3)]}, "which rays"),
    ],
)
def test_what_is_wrong_with_rays_is_said(change, words):
    given = {"origins": [(0.0, 0.0)] * 2, "angles": [0.0, 1.0], "max_range": 9.0, **change}
    with pytest.raises(GeometryError, match=words):
        raycast_each([(1.0, -1.0, 1.0, 1.0)], NO_DISCS, **given)
