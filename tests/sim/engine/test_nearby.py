"""What is near to a place: the same as a look at everything finds."""

from __future__ import annotations

import numpy as np
from hypothesis import given
from hypothesis import strategies as st

from rosmini.sim.engine.laser_view import LaserView
from rosmini.sim.engine.nearby import Nearby, boxes_around
from rosmini.sim.models import BURGER
from rosmini.sim.world import World

places = st.floats(-60.0, 60.0)


@given(
    st.integers(0, 200), st.integers(0, 1000), st.sampled_from([0.1, 2.0, 30.0]), places, places, st.floats(0.0, 40.0)
)
def test_what_is_near_is_what_a_look_at_everything_finds(count, seed, length, x, y, reach):
    rng = np.random.default_rng(seed)
    ends = rng.uniform(-50.0, 50.0, (count, 2))
    segments = np.hstack([ends, ends + rng.uniform(-length, length, (count, 2))])
    expected = [
        i
        for i, (x1, y1, x2, y2) in enumerate(segments.tolist())
        if min(x1, x2) <= x + reach
        and max(x1, x2) >= x - reach
        and min(y1, y2) <= y + reach
        and max(y1, y2) >= y - reach
    ]
    assert Nearby(boxes_around(segments)).within(x, y, reach).tolist() == expected


def test_walls_on_the_edges_of_squares_are_found():
    points = np.array([(i * 2.0, j * 2.0) for i in range(-3, 4) for j in range(-3, 4)])
    nearby = Nearby(np.hstack([points, points]))
    for x, y in points.tolist():
        assert len(nearby.within(x, y, 0.0)) == 1
        assert len(nearby.within(x, y, 2.0)) == sum(abs(px - x) <= 2 and abs(py - y) <= 2 for px, py in points.tolist())


def test_a_laser_sees_the_same_walls_wherever_it_jumps_in_a_large_world():
    rng = np.random.default_rng(1)
    middles, half = rng.uniform(-30, 30, (3000, 2)), rng.uniform(-0.5, 0.5, (3000, 2))
    half[:5] *= 40.0
    world = World("large", walls=np.hstack([middles - half, middles + half]))
    view, radius = LaserView(world), BURGER.laser.range_max
    for x, y in rng.uniform(-35, 35, (20, 2)).tolist():
        found, _ = view.fixed_around("burger", x, y, 0.1, radius)
        begin, along = world.walls[:, :2], world.walls[:, 2:] - world.walls[:, :2]
        part = (((np.array([x, y]) - begin) * along).sum(axis=1) / (along * along).sum(axis=1)).clip(0, 1)
        away = np.linalg.norm(begin + part[:, None] * along - (x, y), axis=1)
        seen = {tuple(row) for row in found.tolist()}
        assert {tuple(row) for row in world.walls[away <= radius].tolist()} <= seen
        assert len(found) < 1500
