"""The node: a room mapped while a robot drives, without its odometry; services, commands, and what it refuses."""

from __future__ import annotations

import math

import numpy as np
import pytest

from rosmini import rosrun
from rosmini.core.errors import ServiceException
from rosmini.core.graph import Graph
from rosmini.core.tf import StaticTransformBroadcaster, TransformBroadcaster
from rosmini.core.tf.rigid import from_rpy, from_yaw
from rosmini.msgs import message_class, service_class
from rosmini.ros.launch import roslaunch
from rosmini.sim.simulator import Simulator

from ...conftest import nightly
from .test_matching import BEARINGS, room

TOPICS = {
    "map": "nav_msgs/OccupancyGrid",
    "map_metadata": "nav_msgs/MapMetaData",
    "slam_out_pose": "geometry_msgs/PoseStamped",
    "poseupdate": "geometry_msgs/PoseWithCovarianceStamped",
    "scanmatch_odom": "nav_msgs/Odometry",
    "slam_cloud": "sensor_msgs/PointCloud",
    "/rosout": "rosgraph_msgs/Log",
}


@pytest.fixture
def graph():
    with Graph(seed=4) as graph:
        yield graph


def listen(graph):
    node, heard = graph.node("ear"), {topic: [] for topic in TOPICS}
    for topic, kind in TOPICS.items():
        node.subscriber(topic, message_class(kind), heard[topic].append)
    return node, heard


@pytest.mark.nightly
def test_a_room_is_mapped_live(graph):
    """Turned slowly, since a scan of this laser takes 0.2 s; the odometry is not looked at."""
    world = graph.node("simulator")
    world.set_param("~cmd_vel_timeout", 0.0)
    simulator = Simulator(world, world="room", model="burger")
    node, heard = listen(graph)
    roslaunch("turtlebot3_bringup", "turtlebot3_remote.launch", graph=graph, model="burger")
    roslaunch("turtlebot3_slam", "turtlebot3_hector.launch", "map_size:=400", graph=graph, model="burger")
    driver = node.publisher("cmd_vel", message_class("geometry_msgs/Twist"), queue_size=1)
    graph.run(1.0)
    command = message_class("geometry_msgs/Twist")()
    for v, w, seconds in ((0.0, 0.3, 6), (0.15, 0.0, 6), (0.1, -0.3, 6)):
        command.linear.x, command.angular.z = v, w
        driver.publish(command)
        graph.run(seconds)
    driver.publish(message_class("geometry_msgs/Twist")())
    graph.run(2.5)

    grid = heard["map"][-1]
    assert (grid.header.frame_id, grid.info.width, grid.info.resolution) == ("map", 400, pytest.approx(0.05))
    assert grid.info.origin.position.x == pytest.approx(-10.025)
    assert heard["map_metadata"][-1].height == 400
    assert (np.asarray(grid.data) == 100).sum() > 100
    answer = node.service_client("dynamic_map", service_class("nav_msgs/GetMap"))()
    assert (np.asarray(answer.map.data) == np.asarray(grid.data)).all()
    truth = simulator.truth()
    assert math.hypot(*truth[:2]) > 1.0
    mapper = graph.nodes["/hector_mapping"].program
    found = mapper.buffer.tree.lookup("map", "base_footprint").transform
    named = mapper.buffer.tree.lookup("map", "scanmatcher_frame").transform
    assert math.dist(found[:2], truth[:2]) < 0.12
    assert math.dist(named[:2], truth[:2]) < 0.12
    covariance = np.reshape(heard["poseupdate"][-1].pose.covariance, (6, 6))
    assert (np.diag(covariance)[[0, 1, 5]] > 0).all()
    assert (np.diag(covariance)[[0, 1, 5]] < 0.01).all()
    said = [log.msg for log in heard["/rosout"]]
    assert "HectorSM map lvl 1: cellLength: 0.1 res x:200 res y: 200" in said


def test_parameter_files_of_robotis(graph):
    """turtlebot3_slam's, as its launch file gives them."""
    roslaunch(
        "turtlebot3_slam",
        "turtlebot3_slam.launch",
        "slam_methods:=hector",
        graph=graph,
        model="burger",
        open_rviz=False,
    )
    graph.run(0.1)
    mapper = graph.nodes["/hector_mapping"].program
    assert mapper.slam.settings.map_size == 2048
    assert mapper.parameters.limits() == pytest.approx((0.12, 3.5, -0.1, 0.1))
    assert mapper.parameters.base_frame == "base_footprint"


class Laser:
    """Scans by hand: a box around a robot that is put where one likes."""

    def __init__(self, graph, mount=(0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 1.0), **given):
        self.graph, (self.node, self.heard) = graph, listen(graph)
        self.scans = self.node.publisher("scan", message_class("sensor_msgs/LaserScan"), queue_size=5)
        self.tf = TransformBroadcaster(self.node)
        StaticTransformBroadcaster(self.node).send_rigid("base_link", "laser", mount)
        given = {"odom_frame": "base_link", "map_size": 256, "map_pub_period": 0.5, **given}
        arguments = [f"_{name}:={value}" for name, value in given.items()]
        self.mapper = rosrun(
            "hector_mapping", "hector_mapping", "__name:=hector_mapping", *arguments, graph=graph
        ).instance()
        graph.run(0.2)

    def see(self, x, y, heading=0.0, **changes):
        ends = room((x, y, heading))
        self.scan(np.hypot(*ends.T), **changes)

    def scan(self, ranges, **changes):
        message = message_class("sensor_msgs/LaserScan")()
        message.header.frame_id, message.header.stamp = "laser", self.node.now()
        message.angle_increment, message.range_min, message.range_max = float(BEARINGS[1]), 0.1, 10.0
        message.ranges = np.asarray(ranges, dtype=np.float32)
        for name, value in changes.items():
            setattr(message, name, value)
        self.scans.publish(message)
        self.graph.run(0.7)

    def call(self, service, kind, *arguments):
        return self.node.service_client(service, service_class(kind))(*arguments)

    @property
    def pose(self):
        position = self.heard["slam_out_pose"][-1].pose.position
        return position.x, position.y

    @property
    def occupied(self):
        return int((np.asarray(self.heard["map"][-1].data) == 100).sum())

    def said(self, text):
        return [log for log in self.heard["/rosout"] if text in log.msg]


def test_its_topics_and_services(graph):
    laser = Laser(graph, pub_odometry="true", output_timing="true")
    node = graph.nodes["/hector_mapping"]
    topics = {
        "map", "map_metadata", "poseupdate", "rosout", "scanmatch_odom", "slam_cloud", "slam_out_pose", "tf",
    }  # fmt: skip
    assert set(node.publications) == {f"/{name}" for name in topics}
    assert set(node.subscriptions) == {"/initialpose", "/scan", "/syscommand", "/tf", "/tf_static"}
    services = {"dynamic_map", "pause_mapping", "reset_map", "restart_mapping_with_new_pose"}
    assert {f"/{name}" for name in services} <= set(node.services)
    laser.see(0.0, 0.0)
    assert laser.heard["scanmatch_odom"][-1].child_frame_id == "base_link"
    assert len(laser.heard["slam_cloud"][-1].points) == len(BEARINGS)
    assert laser.said("HectorSLAM Iter took: ")


def test_reset_by_topic_and_by_service(graph):
    laser = Laser(graph)
    command = laser.node.publisher("syscommand", message_class("std_msgs/String"), queue_size=1)
    for reset in (
        lambda: command.publish(message_class("std_msgs/String")(data="reset")),
        lambda: laser.call("reset_map", "std_srvs/Trigger"),
    ):
        laser.see(0.0, 0.0)
        laser.see(0.06, 0.03)
        assert laser.pose == pytest.approx((0.06, 0.03), abs=0.02)
        reset()
        graph.run(1.0)
        assert laser.occupied == 0
        laser.see(0.06, 0.03)
        assert laser.pose == (0.0, 0.0), "the map begins where the robot is"
        assert laser.occupied > 100
        laser.call("reset_map", "std_srvs/Trigger")
    assert laser.said("HectorSM reset")


def test_pause_and_restart(graph):
    laser = Laser(graph)
    laser.see(0.0, 0.0)
    assert laser.call("pause_mapping", "std_srvs/SetBool", True).success
    count = len(laser.heard["slam_out_pose"])
    laser.see(0.5, 0.0)
    assert len(laser.heard["slam_out_pose"]) == count
    pose = message_class("geometry_msgs/Pose")()
    pose.position.x, pose.orientation.w = 1.0, 1.0
    laser.call("restart_mapping_with_new_pose", "hector_mapping/ResetMapping", pose)
    laser.see(0.5, 0.0)
    assert laser.pose == (1.0, 0.0)
    assert laser.said("[HectorSM]: Mapping no longer paused")
    pose.position.x = 50.0
    with pytest.raises(ServiceException, match="outside the map"):
        laser.call("restart_mapping_with_new_pose", "hector_mapping/ResetMapping", pose)


def test_an_initial_pose(graph):
    laser = Laser(graph)
    laser.see(0.0, 0.0)
    start = laser.node.publisher("initialpose", message_class("geometry_msgs/PoseWithCovarianceStamped"), queue_size=1)
    graph.run(0.2)
    message = message_class("geometry_msgs/PoseWithCovarianceStamped")()
    for frame, x, text in (("map", 50.0, "outside the map"), ("odom", 0.5, "must be"), ("map", math.nan, "finite")):
        message.header.frame_id, message.pose.pose.position.x, message.pose.pose.orientation.w = frame, x, 1.0
        start.publish(message)
        graph.run(0.2)
        assert laser.said(text)
    message.header.frame_id, message.pose.pose.position.x = "map", 0.55
    start.publish(message)
    laser.see(0.5, 0.0)
    assert laser.pose == pytest.approx((0.5, 0.0), abs=0.03), "half a metre is too far to be found without"


def test_scans_that_cannot_be(graph):
    laser = Laser(graph)
    laser.scan([])
    assert laser.said("has 0 ranges")
    graph.run(6.0)  # until it may complain again
    laser.scan([1.0] * 4, angle_increment=math.nan)
    assert laser.said("angle_increment nan")
    graph.run(6.0)
    laser.scan([1.0] * 4, header=message_class("std_msgs/Header")(frame_id="nowhere", stamp=laser.node.now()))
    assert laser.said("a scan of nowhere is ignored")
    graph.run(6.0)
    laser.scan([math.inf, math.nan, 0.0, -1.0])
    assert laser.said("no beam of laser ended within the limits")
    assert laser.mapper.slam.updates == 0
    laser.see(0.0, 0.0)
    half = np.hypot(*room((0.05, 0.0, 0.0)).T)[::2]
    laser.scan(half, angle_increment=2 * float(BEARINGS[1]))
    assert laser.pose == pytest.approx((0.05, 0.0), abs=0.02), "scans may have other lengths"


def test_time_that_jumps_back(graph):
    """A bag that loops: the robot is where it began, and not where the map has it."""
    laser = Laser(graph)
    first = laser.node.now()
    laser.see(0.0, 0.0)
    laser.see(0.07, 0.05)
    graph.run(2.0)
    laser.see(0.08, 0.05)
    laser.see(0.3, 0.3, header=message_class("std_msgs/Header")(frame_id="laser", stamp=first))
    assert laser.said("scans jump back in time")
    assert laser.pose == (0.0, 0.0)
    assert laser.mapper.slam.updates == 1


def test_a_robot_that_leans(graph):
    """With a level frame under it, the laser's beams end where the walls are."""
    laser = Laser(
        graph, base_frame="base_stabilized", odom_frame="base_stabilized", laser_z_min_value=-0.2, laser_z_max_value=0.2
    )
    laser.tf.send_rigid("base_stabilized", "base_link", from_rpy((0, 0, 0), 0.0, 0.15, 0.0))
    laser.see(0.0, 0.0)
    rows = np.nonzero(laser.mapper.slam.maps[0].odds > 0)
    columns = rows[1] * 0.025 + laser.mapper.slam.maps[0].origin[0]
    assert columns.max() < 1.4, "the wall ahead at 2 m is met 30 cm too low: it is the floor"
    assert len(columns) > 50, "the walls at the sides are not"


@pytest.mark.parametrize("own", [True, *nightly(False)])
def test_a_start_by_tf(graph, own):
    """A quarter of a turn between two scans: only with the odometry as start is it found."""
    laser = Laser(graph, use_tf_pose_start_estimate="true", odom_frame="odom", pub_map_odom_transform=str(own).lower())
    if not own:
        StaticTransformBroadcaster(laser.node).send_rigid("map", "odom", from_yaw(0.0, 0.0, 0.0))
    for turn in (0.0, math.pi / 2):
        laser.tf.send_rigid("odom", "base_link", from_yaw(0.0, 0.0, turn))
        laser.see(0.0, 0.0, turn)
    assert laser.mapper.slam.pose[2] == pytest.approx(math.pi / 2, abs=0.03)
    assert not laser.said("failed")


def test_odometry_that_is_not_there(graph):
    laser = Laser(graph, odom_frame="odom")
    laser.see(0.0, 0.0)
    assert laser.said("without odometry, set ~odom_frame to base_link")
    laser.see(0.05, 0.0)
    assert laser.pose == pytest.approx((0.05, 0.0), abs=0.02)
    assert not laser.mapper.buffer.can_transform("map", "odom")


def test_a_robot_that_is_its_laser(graph):
    laser = Laser(graph, use_tf_scan_transformation="false", map_resolution=0.05, map_size=20)
    laser.scan([0.3] * 180, header=message_class("std_msgs/Header")(frame_id="unknown", stamp=laser.node.now()))
    assert laser.occupied > 20
    laser.mapper.slam.pose = (5.0, 0.0, 0.0)
    laser.scan([0.3] * 180)
    assert laser.said("outside the map, which reaches from (-0.5, -0.5) to (0.5, 0.5)")


def test_known_poses(graph):
    laser = Laser(graph, map_with_known_poses="true")
    StaticTransformBroadcaster(laser.node).send_rigid("map", "base_link", from_yaw(0.4, 0.0, 0.0))
    laser.see(0.4, 0.0)
    assert laser.mapper.slam.pose == pytest.approx((0.4, 0.0, 0.0))
    assert laser.heard["slam_out_pose"] == []
    assert laser.occupied > 100
