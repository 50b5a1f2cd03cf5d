"""A match as a player: its steps, and what it refuses."""

from __future__ import annotations

import numpy as np
import pytest

from rosmini.navigation.hector_mapping import OccupancyGrid, match
from rosmini.viz.match_steps import match_steps
from rosmini.viz.view import ViewError


def test_a_match_is_played_step_by_step():
    grid = OccupancyGrid((80, 80), 0.05, (-2.0, -2.0))
    side = np.linspace(-1.2, 1.2, 40)
    walls = np.concatenate(
        [np.column_stack([side, np.full(40, 1.2)]), np.column_stack([np.full(40, 1.0), side])]
    )
    for _ in range(3):
        grid.update((0.0, 0.0), walls)
    view = match_steps(grid, walls, (0.06, 0.05, 0.03), steps=6, title="Figure 1")
    assert view.text.startswith("Figure 1")
    assert "probability" in view.text
    assert "ends of the beams" in view.text
    x, y, _ = match(grid, walls, (0.06, 0.05, 0.03), 5).pose
    assert abs(x) < 0.02
    assert abs(y) < 0.02
    assert "6.0 s" in view.text


def test_no_scan():
    with pytest.raises(ViewError, match="without ends"):
        match_steps(OccupancyGrid((8, 8), 0.05, (0.0, 0.0)), np.empty((0, 2)), (0.0, 0.0, 0.0))
