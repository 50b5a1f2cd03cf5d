"""The chapter Teleoperation: what it says about keys and times is true of the programs."""

from __future__ import annotations


def test_the_table_of_keys_is_that_of_the_program(prose):
    from rosmini.viz.live import teleop

    keys, limits = teleop.key_map(), teleop.Limits()
    for start, speed, limit in (
        ("| `w`, `x` |", f"{keys.linear} m/s", f"{limits.linear} m/s"),
        ("| `a`, `d` |", f"{keys.angular} rad/s", f"{limits.angular} rad/s"),
    ):
        row = next(line for line in prose.splitlines() if line.startswith(start))
        assert speed in row
        assert limit in row
    assert f"follows in steps of {teleop.SLOPE * keys.linear} m/s, every {teleop.PERIOD} s" in prose


def test_the_reader_is_told_the_timeout_of_the_simulator(prose):
    from rosmini.sim.simulator import COMMAND_TIMEOUT
    from rosmini.sim.stage.node import WATCHDOG

    assert "stops half a second after its last command" in prose
    assert f"Stage stops its robots after {WATCHDOG} s" in prose
    assert COMMAND_TIMEOUT == 0.5
