"""The chapter TurtleBot3: the numbers of its text are those of the simulated robot."""

from __future__ import annotations

from rosmini.sim.models import BURGER
from rosmini.sim.turtlebot import COMMAND_TIMEOUT


def test_the_text_states_the_limits_of_the_simulated_robot(prose):
    assert f"limits $v$ to {BURGER.max_linear} m/s and $\\omega$ to {BURGER.max_angular} rad/s" in prose
    assert "A command lasts for half a second" in prose
    assert COMMAND_TIMEOUT == 0.5
