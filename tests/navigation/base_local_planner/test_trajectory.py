"""What one can ask the samples of a cycle."""

from __future__ import annotations

import numpy as np
import pytest

from rosmini.navigation.base_local_planner.trajectory import Samples


@pytest.fixture
def samples():
    """Three: one driven, a dearer one, and one that meets an obstacle at its second point."""
    raw = np.array([[0.0, 10.0, 2.0], [0.0, 20.0, 4.0], [0.0, -1.0, 1.0]])
    where = np.array([[-1, -1, -1], [-1, -1, -1], [-1, 1, -1]])
    return Samples(
        critics=("oscillation", "obstacle", "path"), scales=np.array([1.0, 0.0, 1.5]) + np.array([0, 0.1, 0]),
        velocities=np.array([[0.2, 0, 0], [0.2, 0, -0.5], [0.2, 0, 0.5]]),
        commands=np.array([[0.2, 0, 0], [0.2, 0, -0.5], [0.2, 0, 0.5]]), points=np.zeros((3, 4, 3)),
        lengths=np.array([4, 3, 4]), raw=raw, where=where, totals=np.array([4.0, 8.0, -1.0]),
        rejected_by=np.array([-1, -1, 1]), best=0, refused=2,
    )  # fmt: skip


def test_counts_are_by_critic(samples):
    assert samples.counts() == {"obstacle": 1, "generator": 2}
    assert samples.reason(0) == ""
    assert samples.reason(2).startswith("obstacle: ") and samples.reason(2).endswith("point 2 of 4")
    assert len(samples.trajectory(1)) == 3
