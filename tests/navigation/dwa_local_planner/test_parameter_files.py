"""The parameter files that rosmini brings, for each robot."""

from __future__ import annotations

import pytest
import yaml

from rosmini.core.packages import assets_dir
from tests.navigation.local_bench import LocalBench


@pytest.mark.parametrize("robot", ["burger", "waffle", "waffle_pi"])
def test_a_planner_takes_them_without_a_word_and_drives(robot, capsys):
    path = assets_dir() / f"ros/turtlebot3_navigation/param/dwa_local_planner_params_{robot}.yaml"
    parameters = yaml.safe_load(path.read_text(encoding="utf-8"))["DWAPlannerROS"]
    bench = LocalBench("dwa_local_planner/DWAPlannerROS", parameters)
    with bench.graph:
        bench.plan(*((0.05 * i, 0.0) for i in range(40)))
        assert bench.command() == (pytest.approx(min(parameters["max_vel_x"], parameters["acc_lim_x"] / 20)), 0.0)
        assert capsys.readouterr().err == ""
