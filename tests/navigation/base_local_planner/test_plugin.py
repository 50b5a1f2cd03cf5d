"""`base_local_planner/TrajectoryPlannerROS` on a graph: parameters, topics, goals."""

from __future__ import annotations

import numpy as np
import pytest
import yaml

from rosmini.core.dynamic_reconfigure import Client
from rosmini.core.errors import ParameterError
from rosmini.core.packages import assets_dir
from rosmini.navigation.nav_core import NoValidCommand
from tests.navigation.local_bench import LocalBench

ROBOT = {
    "max_vel_x": 0.18, "min_vel_x": 0.08, "max_vel_theta": 1.0, "min_vel_theta": -1.0, "min_in_place_vel_theta": 1.0,
    "acc_lim_x": 1.0, "acc_lim_y": 0.0, "acc_lim_theta": 0.6, "xy_goal_tolerance": 0.10, "yaw_goal_tolerance": 0.05,
    "holonomic_robot": False, "meter_scoring": True, "vx_samples": 18, "vtheta_samples": 20, "sim_time": 0.8,
    "sim_granularity": 0.05, "controller_frequency": 10.0,
}  # fmt: skip


@pytest.fixture
def made():
    benches = []

    def make(parameters=ROBOT):
        benches.append(LocalBench("base_local_planner/TrajectoryPlannerROS", parameters))
        return benches[-1]

    yield make
    for each in benches:
        each.graph.shutdown()


def test_it_drives_along_its_plan_and_publishes_it(made):
    bench = made()
    plans = [bench.heard(topic, "nav_msgs/Path") for topic in ("local_plan", "global_plan")]
    bench.plan(*((x, 0.0) for x in np.arange(0, 1, 0.05)))
    x, theta = bench.command()
    assert 0.1 < x <= 0.18
    assert abs(theta) < 0.5
    bench.graph.run(0.1)
    assert len(plans[0][0].poses) == len(bench.planner.samples.trajectory(bench.planner.samples.best))
    assert len(plans[1][0].poses) == 20


def test_with_the_file_for_a_turtlebot_it_turns_to_a_plan_behind_it_and_never_steps_aside(capsys):
    """Without it the planner took a TurtleBot3 for one that can step aside: told to, it stood still for good."""
    path = assets_dir() / "ros/turtlebot3_navigation/param/base_local_planner_params.yaml"
    parameters = yaml.safe_load(path.read_text(encoding="utf-8"))["TrajectoryPlannerROS"]
    made = LocalBench("base_local_planner/TrajectoryPlannerROS", parameters)
    with made.graph:
        made.plan(*((-0.05 * i, 0.01 * i) for i in range(40)))
        ahead, turn = made.command()
        assert abs(turn) >= parameters["min_in_place_vel_theta"] or ahead > 0
        assert not made.planner.samples.commands[:, 1].any()
    assert "not read by this planner" not in capsys.readouterr().err


def test_at_the_goal_it_brakes_turns_and_has_arrived(made):
    bench = made()
    bench.plan((0.0, 0.0), (0.5, 0.0), heading=1.5)
    bench.costmap.pose = (0.45, 0.0, 0.0)
    bench.drive(x=0.3)
    assert bench.command() == (pytest.approx(0.2), 0.0)
    bench.drive()
    assert bench.command() == (0.0, pytest.approx(1.0))
    assert not bench.planner.is_goal_reached()
    bench.costmap.pose = (0.45, 0.0, 1.48)
    assert bench.command() == (0.0, 0.0)
    assert bench.planner.is_goal_reached()
    bench.plan((0.0, 0.0), (0.5, 0.0))
    assert not bench.planner.is_goal_reached()


def test_a_blocked_robot_backs_up(made):
    bench = made()
    bench.costmap.grid.costs[26:35, 32:36] = 254
    bench.costmap.grid.costs[33:36, 20:32] = 254
    bench.costmap.grid.costs[25:28, 20:32] = 254
    bench.plan((0.0, 0.0), (1.0, 0.0))
    assert bench.command() == (pytest.approx(-0.1), 0.0)
    assert bench.planner.planner.escaping


def test_where_no_way_leads_it_does_not_back_up_either(made):
    bench = made()
    bench.costmap.grid.costs[:, 36:40] = 254
    bench.plan((0.6, 0.0), (1.2, 0.0))
    with pytest.raises(NoValidCommand, match="rollout planner failed to find a valid plan: of") as caught:
        bench.command()
    assert caught.value.numbers["rejected"]["path"] > 0


def test_names_of_earlier_releases_count(made, capsys):
    bench = made({"max_rotational_vel": 0.7, "acc_lim_th": 2.0, "pdist_scale": 0.3, "y_vels": "-0.2, 0.2"})
    p = bench.planner.parameters
    assert (p.max_vel_theta, p.acc_lim_theta, p.path_distance_bias) == (0.7, 2.0, 0.3)
    assert p.sideways() == [-0.2, 0.2]
    told = capsys.readouterr().err
    assert "Parameter max_rotational_vel is deprecated. Please use the name max_vel_theta instead." in told


def test_parameters_are_changed_while_it_runs(made):
    bench = made()
    client = Client(bench.graph.node("rqt"), "/move_base/TrajectoryPlannerROS")
    client.update_configuration({"max_vel_x": 0.12})
    bench.plan((0.0, 0.0), (1.0, 0.0))
    bench.command()
    assert bench.planner.samples.velocities[:, 0].max() == pytest.approx(0.12)
    client.update_configuration({"restore_defaults": True})
    assert bench.planner.parameters.max_vel_x == 0.18


@pytest.mark.parametrize(
    ("parameters", "message"),
    [
        ({"world_model": "voxel"}, "world_model"),
        ({"y_vels": "a,b"}, "y_vels is 'a,b'"),
        ({"sim_time": 0.0}, "sim_time is 0"),
    ],
)
def test_parameters_that_make_no_planner_are_refused(made, parameters, message):
    with pytest.raises(ParameterError, match=message):
        made(parameters)
