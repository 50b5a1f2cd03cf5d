"""The chapter Teleoperation: what it says about keys and times is true of the programs."""

from __future__ import annotations


def test_the_table_of_keys_is_that_of_the_program(prose):
    from rosmini.viz.live import teleop

    keys, limits = teleop.key_map(), teleop.Limits()
    assert f"| `w`, `x` | {keys.linear} m/s more ahead, or more back; at most {limits.linear} m/s" in prose
    assert (
        f"| `a`, `d` | {keys.angular} rad/s more to the left, or to the right; at most {limits.angular} rad/s" in prose
    )
    assert f"every {teleop.PERIOD} s, follows in steps of {teleop.SLOPE * keys.linear} m/s" in prose


def test_the_reader_is_told_the_timeout_of_the_simulator(prose):
    from rosmini.sim.simulator import COMMAND_TIMEOUT
    from rosmini.sim.stage.node import WATCHDOG

    assert "stops half a second after its last command" in prose
    assert f"Stage stops after {WATCHDOG} s" in prose
    assert COMMAND_TIMEOUT == 0.5
