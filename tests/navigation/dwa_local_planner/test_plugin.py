"""`dwa_local_planner/DWAPlannerROS` on a graph: parameters, topics, goals."""

from __future__ import annotations

import re

import numpy as np
import pytest

from rosmini.core.dynamic_reconfigure import Client
from rosmini.core.errors import ParameterError
from rosmini.msgs import message_class
from rosmini.navigation.nav_core import ControlFailure, NoValidCommand, TransformMissing
from tests.navigation.local_bench import LocalBench

BURGER = {
    "max_vel_x": 0.22, "min_vel_x": -0.22, "max_vel_y": 0.0, "min_vel_y": 0.0, "max_vel_trans": 0.22,
    "min_vel_trans": 0.11, "max_vel_theta": 2.75, "min_vel_theta": 1.37, "acc_lim_x": 2.5, "acc_lim_y": 0.0,
    "acc_lim_theta": 3.2, "xy_goal_tolerance": 0.05, "yaw_goal_tolerance": 0.17, "latch_xy_goal_tolerance": False,
    "sim_time": 1.5, "vx_samples": 20, "vy_samples": 0, "vth_samples": 40, "controller_frequency": 10.0,
    "path_distance_bias": 32.0, "goal_distance_bias": 20.0, "occdist_scale": 0.02, "forward_point_distance": 0.325,
    "stop_time_buffer": 0.2, "scaling_speed": 0.25, "max_scaling_factor": 0.2, "oscillation_reset_dist": 0.05,
    "publish_traj_pc": True, "publish_cost_grid_pc": True,
}  # fmt: skip
"""What a robot of ROBOTIS's size needs, under the names that its file has."""


@pytest.fixture
def made():
    benches = []

    def make(parameters=BURGER):
        benches.append(LocalBench("dwa_local_planner/DWAPlannerROS", parameters))
        return benches[-1]

    yield make
    for each in benches:
        each.graph.shutdown()


def test_robotis_file_loads_and_says_what_it_limits(made, capsys):
    bench = made()
    assert bench.planner.parameters.vy_samples == 1
    told = capsys.readouterr()
    assert "/move_base/DWAPlannerROS/vy_samples is 0: 1 is used, as its range is 1 ..." in told.err
    assert "Sim period is set to 0.10" in told.out
    assert bench.planner.planner.sim_period == pytest.approx(0.1)


def test_it_drives_along_its_plan_and_publishes_it(made):
    bench = made()
    local = bench.heard("local_plan", "nav_msgs/Path")
    bench.plan(*((x, 0.0) for x in np.arange(0, 3, 0.05)))
    assert bench.command() == (pytest.approx(0.22), 0.0)
    bench.graph.run(0.1)
    assert local[0].header.frame_id == "odom"
    assert len(local[0].poses) == len(bench.planner.samples.trajectory(bench.planner.samples.best))


def test_clouds_have_the_originals_fields(made):
    bench = made()
    costs = bench.heard("cost_cloud", "sensor_msgs/PointCloud2")
    bench.costmap.grid.costs[0, :10] = 254
    samples = bench.heard("trajectory_cloud", "sensor_msgs/PointCloud2")
    bench.plan((0.0, 0.0), (1.0, 0.0))
    bench.command()
    bench.graph.run(0.1)
    names = ["x", "y", "z", "path_cost", "goal_cost", "occ_cost", "total_cost"]
    assert [field.name for field in costs[0].fields] == names
    assert (costs[0].width, costs[0].point_step) == (3590, 28)
    assert [field.name for field in samples[0].fields] == ["x", "y", "z", "theta", "cost"]
    assert samples[0].width == int(bench.planner.samples.lengths.sum())


def test_a_plan_in_another_frame_is_transformed(made):
    bench = made()
    bench.plan((0.0, 0.0), (1.0, 0.0), frame="map")
    with pytest.raises(TransformMissing, match="Could not transform the global plan"):
        bench.command()
    transform = message_class("geometry_msgs/TransformStamped")()
    transform.header.frame_id, transform.child_frame_id = "odom", "map"
    transform.transform.rotation.w = 1.0
    transform.transform.translation.y = 1.0
    bench.costmap.buffer.set_transform_static(transform)
    assert bench.planner.following.local((0.0, 1.0, 0.0), prune=False)[:, 1].tolist() == [1.0, 1.0]


def test_at_the_goal_it_turns_and_then_it_has_arrived(made, capsys):
    bench = made()
    bench.plan((0.0, 0.0), (0.5, 0.0), heading=1.5)
    bench.costmap.pose = (0.48, 0.0, 0.0)
    assert not bench.planner.is_goal_reached()
    assert bench.command() == (0.0, pytest.approx(1.37))
    bench.costmap.pose = (0.48, 0.0, 1.4)
    bench.drive(theta=0.5)
    assert bench.command() == (0.0, 0.0)
    assert not bench.planner.is_goal_reached()
    bench.drive()
    assert bench.planner.is_goal_reached()
    assert "Goal reached" in capsys.readouterr().out


def test_who_cannot_drive_is_told_why(made):
    bench = made()
    bench.plan((0.0, 0.0), (1.0, 0.0))
    bench.costmap.grid.costs[28:33, 28:33] = 254
    says = r"DWA planner failed to produce path: of (\d+) .* obstacle rejected (\d+), (\d+) are slower than"
    with pytest.raises(NoValidCommand, match=says) as caught:
        bench.command()
    tried, *refused = (int(number) for number in re.search(says, str(caught.value)).groups())
    assert min(refused) > 0
    assert sum(refused) == tried
    bench.plan((9.0, 0.0), (10.0, 0.0))
    with pytest.raises(ControlFailure, match=r"its nearest pose is 9\.00 m from the robot"):
        bench.command()
    bench.plan()
    with pytest.raises(ControlFailure, match="Received plan with zero length"):
        bench.command()


def test_parameters_are_changed_while_it_runs_and_restored(made):
    bench = made()
    client = Client(bench.graph.node("rqt"), "/move_base/DWAPlannerROS")
    client.update_configuration({"max_vel_x": 0.15})
    bench.plan((0.0, 0.0), (1.0, 0.0))
    assert bench.command() == (pytest.approx(0.15), 0.0)
    client.update_configuration({"restore_defaults": True})
    assert bench.planner.parameters.max_vel_x == 0.22
    assert not bench.planner.parameters.restore_defaults


def test_a_name_that_nobody_knows_is_warned_of_as_files_for_several_releases_have_some(made, capsys):
    made({"max_vel_xx": 0.2})
    assert "did you mean ~DWAPlannerROS/max_vel_x" in capsys.readouterr().err


@pytest.mark.parametrize(
    ("parameters", "message"),
    [
        ({"sim_time": "long"}, "sim_time"),
        ({"sim_granularity": 0.0}, "sim_granularity is 0"),
        ({"controller_frequency": "fast"}, "controller_frequency"),
    ],
)
def test_parameters_that_make_no_planner_are_refused(made, parameters, message):
    with pytest.raises(ParameterError, match=message):
        made(parameters)
