"""The chapter Teleoperation: its script prints what the page shows, and it is right about the pad."""

from __future__ import annotations

import re
import shlex
import sys

from ...processes import run


def test_the_listed_script_answers_the_typed_keys_as_shown(prose, tmp_path):
    scripts = dict(re.findall(r"^`(\w+\.py)`:\n\n```python\n(.*?)^```", prose, re.DOTALL | re.MULTILINE))
    assert set(scripts) == {"keys.py"}
    (tmp_path / "keys.py").write_text(scripts["keys.py"], encoding="utf-8")
    command, shown = re.search(
        r"^```console\n\$ uv run rosmini (run .*?)\n(.*?)^```", prose, re.DOTALL | re.MULTILINE
    ).groups()
    typed = re.findall(r"keys: ?(.*\n)", shown)
    assert len(typed) == 3
    done = run([sys.executable, "-m", "rosmini", *shlex.split(command)], cwd=tmp_path, stdin="".join(typed))
    # What is typed into a terminal stands there too; in a pipe it does not.
    printed = re.sub(r"keys: ?.*\n", "keys: ", shown)
    assert (done.returncode, done.stdout.strip(), done.stderr) == (0, printed.strip(), "")


def test_the_table_of_keys_is_that_of_the_pad(prose):
    from rosmini.viz.live import teleop

    keys = teleop.key_map()
    assert f"| `w`, `x` | {keys.linear} m/s more ahead, or more back |" in prose
    assert f"| `a`, `d` | {keys.angular} rad/s more to the left, or to the right |" in prose
    assert f"of {teleop.SLOPE * keys.linear} m/s at most" in prose
    assert f"and every {teleop.PERIOD} s while no key comes" in prose
    limits = teleop.Limits()
    assert f"{limits.linear} m/s and {limits.angular} rad/s" in prose


def test_the_dead_man_s_second_is_that_of_the_pad(prose):
    from rosmini.viz.live.live import DEAD_MAN_S

    assert "If that stops for a second" in prose
    assert DEAD_MAN_S == 1.0


def test_the_reader_is_told_the_timeout_of_the_simulator(chapter, prose):
    from rosmini.sim.simulator import COMMAND_TIMEOUT, SimulatorParameters

    everything = "\n".join(cell.source for cell in chapter.cells)
    named = set(re.findall(r"[\s`\"](_\w+):=", everything))
    assert {"_world", "_noise", "_cmd_vel_timeout"} <= named
    assert named <= {row[0].replace("~", "_") for row in SimulatorParameters.table()}
    assert "a command holds for half a second" in prose
    assert COMMAND_TIMEOUT == 0.5
