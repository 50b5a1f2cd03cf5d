"""Both local planners drive a simulated burger by its laser, from its plan to its goal, on a costmap of its own."""

from __future__ import annotations

import math

import numpy as np
import pytest

from rosmini.core.geometry.angles import shortest_angular_distance
from rosmini.core.graph import Graph
from rosmini.core.tf import Buffer, StaticTransformBroadcaster, TransformListener
from rosmini.core.time import Time
from rosmini.msgs import message_class
from rosmini.navigation.costmap_2d.costmap_ros import Costmap2DROS
from rosmini.navigation.nav_core import BaseLocalPlanner, pose_stamped
from rosmini.sim.simulator import Simulator

COSTMAP = {
    "global_frame": "odom",
    "robot_base_frame": "base_footprint",
    "rolling_window": True,
    "width": 3,
    "height": 3,
    "resolution": 0.05,
    "update_frequency": 10.0,
    "publish_frequency": 0.0,
    "footprint": [[-0.105, -0.105], [-0.105, 0.105], [0.041, 0.105], [0.041, -0.105]],
    "plugins": [
        {"name": "obstacles", "type": "costmap_2d::ObstacleLayer"},
        {"name": "inflation", "type": "costmap_2d::InflationLayer"},
    ],
    "obstacles": {
        "observation_sources": "scan",
        "scan": {"data_type": "LaserScan", "topic": "/scan", "marking": True, "clearing": True},
    },
    "inflation": {"inflation_radius": 0.3, "cost_scaling_factor": 5.0},
}
PLANNERS = {
    "dwa_local_planner/DWAPlannerROS": {
        "max_vel_x": 0.22, "min_vel_x": 0.0, "max_vel_y": 0.0, "min_vel_y": 0.0, "max_vel_trans": 0.22,
        "min_vel_trans": 0.05, "max_vel_theta": 1.5, "min_vel_theta": 0.3, "acc_lim_x": 1.0, "acc_lim_y": 0.0,
        "acc_lim_theta": 5.0, "vx_samples": 10, "vy_samples": 1, "vth_samples": 20, "controller_frequency": 10.0,
    },
    "base_local_planner/TrajectoryPlannerROS": {
        "max_vel_x": 0.22, "min_vel_x": 0.05, "max_vel_theta": 1.5, "min_vel_theta": -1.5, "acc_lim_x": 1.0,
        "acc_lim_theta": 5.0, "min_in_place_vel_theta": 0.4, "holonomic_robot": False, "meter_scoring": True,
        "path_distance_bias": 0.6, "goal_distance_bias": 0.8, "controller_frequency": 10.0, "yaw_goal_tolerance": 0.1,
    },
}  # fmt: skip


@pytest.mark.parametrize("plugin", sorted(PLANNERS))
def test_it_follows_a_bent_plan_and_turns_at_its_end(plugin):
    with Graph(seed=7) as graph:
        driven = Driven(graph, plugin)
        xs = np.arange(0.0, 1.6, 0.025)
        driven.follow(np.column_stack([xs, -0.25 * np.sin(3 * xs)]), heading=1.2)
        driven.run(40.0)
        assert driven.arrived
        x, y, theta = driven.simulator.odometry
        assert math.hypot(x - xs[-1], y + 0.25 * math.sin(3 * xs[-1])) < 0.12
        assert abs(shortest_angular_distance(theta, 1.2)) < 0.15


class Driven:
    """A burger in the room, a local costmap and a planner, which is asked ten times a second."""

    def __init__(self, graph, plugin):
        self.graph = graph
        self.simulator = Simulator(graph.node("simulator"), world="room", model="burger")
        node = graph.node("move_base")
        buffer = Buffer(node)
        TransformListener(node, buffer)
        StaticTransformBroadcaster(graph.node("robot")).send("base_footprint", "base_scan", (-0.032, 0.0, 0.182))
        graph.run(1.0)
        node.set_param("~local_costmap", COSTMAP)
        self.costmap = Costmap2DROS("local_costmap", buffer, node)
        name = plugin.partition("/")[2]
        node.set_param(f"~{name}", PLANNERS[plugin])
        self.planner = BaseLocalPlanner.create(plugin)
        self.planner.initialize(name, buffer, self.costmap)
        self.commands = node.publisher("/cmd_vel", message_class("geometry_msgs/Twist"), queue_size=1)
        self.arrived = False
        graph.run(1.0)

    def follow(self, points, heading):
        """Follow points (n, 2) from where the robot is, in its odometry's frame."""
        angles = np.arctan2(*np.diff(points, axis=0).T[::-1])
        poses = np.column_stack([points, [*angles, heading]])
        self.planner.set_plan([pose_stamped("odom", Time(0), tuple(map(float, pose))) for pose in poses])

    def run(self, seconds):
        for _ in range(int(seconds * 10)):
            if self.planner.is_goal_reached():
                self.arrived = True
                self.commands.publish(message_class("geometry_msgs/Twist")())
                return
            self.commands.publish(self.planner.compute_velocity_commands())
            self.graph.run(0.1)
