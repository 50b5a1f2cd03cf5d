"""What is commanded at the goal."""

from __future__ import annotations

import numpy as np
import pytest

from rosmini.navigation.base_local_planner.latched_stop_rotate import LatchedStopRotate
from rosmini.navigation.base_local_planner.limits import LocalPlannerLimits
from rosmini.navigation.nav_core import ControlFailure

LIMITS = LocalPlannerLimits()
GOAL = (1.0, 0.0, 1.0)
STILL = np.zeros(3)


def command(control, pose, velocity=STILL, free=True, limits=LIMITS):
    return control.command(
        pose,
        np.asarray(velocity, dtype=float),
        GOAL,
        limits,
        0.1,
        lambda _: "" if free else "obstacle: it is in the way",
    ).tolist()


def test_it_brakes_then_turns_then_stands():
    control = LatchedStopRotate()
    assert control.is_position_reached((0.95, 0, 0), GOAL, LIMITS)
    assert command(control, (0.95, 0, 0), [0.5, 0, -0.5]) == pytest.approx([0.25, 0, -0.18])
    # from a standstill no faster than it can accelerate, but never slower than min_vel_theta
    assert command(control, (0.95, 0, 0)) == pytest.approx([0, 0, 0.4])
    assert command(control, (0.95, 0, 0), [0, 0, 0.9]) == pytest.approx([0, 0, 1.0])
    assert command(control, (0.95, 0, 1.2), [0, 0, 0.9]) == pytest.approx([0, 0, -0.58])
    assert command(control, (0.95, 0, 0.95), [0, 0, 0.9]) == [0, 0, 0]


def test_a_fast_slowest_turn_is_kept_too():
    """ROBOTIS's burger: 1.37 rad/s at least, so it overshoots a small tolerance."""
    limits = LocalPlannerLimits(min_vel_theta=1.37, max_vel_theta=2.75)
    assert command(LatchedStopRotate(), (1, 0, 0.8), limits=limits) == pytest.approx([0, 0, 1.37])


@pytest.mark.parametrize("latch", [False, True])
def test_a_latched_goal_stays_reached(latch):
    control = LatchedStopRotate(latch)
    assert control.is_position_reached((0.95, 0, 0), GOAL, LIMITS)
    assert control.is_position_reached((0.8, 0, 0), GOAL, LIMITS) == latch
    assert control.is_goal_reached((0.8, 0, 1.0), STILL, GOAL, LIMITS) == latch
    control.reset()
    assert not control.is_goal_reached((0.8, 0, 1.0), STILL, GOAL, LIMITS)


def test_the_goal_is_reached_only_at_a_standstill():
    control = LatchedStopRotate()
    assert control.is_goal_reached((1, 0, 1), STILL, GOAL, LIMITS)
    assert not control.is_goal_reached((1, 0, 1), np.array([0.2, 0, 0]), GOAL, LIMITS)
    assert not control.is_goal_reached((1, 0, 1.2), STILL, GOAL, LIMITS)


def test_what_would_touch_something_is_not_commanded():
    with pytest.raises(ControlFailure, match=r"Rotation cmd in collision: .* turn by 0\.4 rad/s, but obstacle: it"):
        command(LatchedStopRotate(), (1, 0, 0), free=False)
    with pytest.raises(ControlFailure, match="Stopping cmd in collision"):
        command(LatchedStopRotate(), (1, 0, 0), [0.5, 0, 0], free=False)
