"""The node: a room mapped while a robot drives, what it publishes, and what it refuses."""

from __future__ import annotations

import math
import os
from pathlib import Path

import numpy as np
import pytest

from rosmini import rosrun
from rosmini.core.graph import Graph
from rosmini.core.maps import load_map
from rosmini.core.tf import StaticTransformBroadcaster, TransformBroadcaster
from rosmini.core.tf.rigid import from_yaw
from rosmini.core.time import Time
from rosmini.msgs import message_class, service_class
from rosmini.ros.launch import roslaunch
from rosmini.sim.simulator import Simulator

DEFAULT = Path(__file__).resolve().parents[4] / "shared" / "data"
BAG = Path(os.environ.get("ROSMINI_SHARED_DATA", DEFAULT)) / "real_robot.bag"
Twist = message_class("geometry_msgs/Twist")


@pytest.fixture
def graph():
    with Graph(seed=4) as graph:
        yield graph


def listen(graph):
    node = graph.node("ear")
    heard = {"map": [], "map_metadata": [], "/gmapping/entropy": [], "/rosout": []}
    kinds = "nav_msgs/OccupancyGrid", "nav_msgs/MapMetaData", "std_msgs/Float64", "rosgraph_msgs/Log"
    for (topic, found), kind in zip(heard.items(), kinds, strict=True):
        node.subscriber(topic, message_class(kind), found.append)
    return node, heard


@pytest.mark.nightly
def test_a_room_is_mapped_live_and_saved(graph, tmp_path):
    simulator = Simulator(graph.node("simulator"), world="room", model="burger")
    roslaunch("turtlebot3_bringup", "turtlebot3_remote.launch", graph=graph, model="burger")
    given = {"base_frame": "base_footprint", "particles": 10, "linearUpdate": 0.3, "angularUpdate": 0.3}
    bounds = {"xmin": -4.0, "ymin": -4.0, "xmax": 4.0, "ymax": 4.0, "map_update_interval": 1.0}
    node, heard = listen(graph)
    arguments = [f"_{name}:={value}" for name, value in {**given, **bounds}.items()]
    mapper = rosrun("gmapping", "slam_gmapping", "__name:=gmapping", *arguments, graph=graph).instance()
    driver = node.publisher("cmd_vel", Twist, queue_size=1)
    graph.run(1.0)
    command = Twist()
    for v, w, seconds in ((0.0, 0.6, 8), (0.2, 0.0, 5), (0.0, 0.6, 5), (0.2, 0.2, 5)):
        command.linear.x, command.angular.z = v, w
        for _ in range(seconds * 5):
            driver.publish(command)
            graph.run(0.2)
    driver.publish(Twist())
    graph.run(2.0)

    grid = heard["map"][-1]
    assert grid.header.frame_id == "map"
    assert min(grid.info.width, grid.info.height) >= 160, "8 m, or more where beams went farther"
    assert heard["map_metadata"][-1].resolution == pytest.approx(0.05)
    assert 0.0 <= heard["/gmapping/entropy"][-1].data <= math.log(10) + 1e-9
    answer = node.service_client("dynamic_map", service_class("nav_msgs/GetMap"))()
    assert (np.asarray(answer.map.data) == np.asarray(grid.data)).all()

    saver = rosrun("map_server", "map_saver", "-f", str(tmp_path / "mapped"), graph=graph)
    graph.run(3.0)
    assert saver is not None
    saved = load_map(tmp_path / "mapped.yaml")
    assert saved.occupied.sum() == (np.asarray(grid.data) == 100).sum() > 100

    truth, odometry = simulator.truth(), simulator.odometry
    assert math.dist(truth[:2], odometry[:2]) > 1.0, "its wheels have slipped, against a pillar"
    found = mapper.buffer.tree.lookup("map", "base_footprint").transform
    assert math.dist(found[:2], truth[:2]) < 0.35, "and yet it knows, up to linearUpdate, where it is"


def test_its_topics_and_services(graph):
    rosrun("gmapping", "slam_gmapping", "__name:=gmapping", graph=graph).instance()
    graph.run(0.1)
    node = graph.nodes["/gmapping"]
    assert set(node.publications) == {"/gmapping/entropy", "/map", "/map_metadata", "/rosout", "/tf"}
    assert set(node.subscriptions) == {"/scan", "/tf", "/tf_static"}
    assert "/dynamic_map" in node.services


class Laser:
    """Scans by hand."""

    def __init__(self, graph, mount=(0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 1.0), **given):
        self.graph, (self.node, self.heard) = graph, listen(graph)
        self.scans = self.node.publisher("scan", message_class("sensor_msgs/LaserScan"), queue_size=5)
        self.tf = TransformBroadcaster(self.node)
        StaticTransformBroadcaster(self.node).send_rigid("base_link", "laser", mount)
        given = {"particles": 3, "xmin": -2, "xmax": 2, "ymin": -2, "ymax": 2, **given}
        arguments = [f"_{name}:={value}" for name, value in given.items()]
        self.mapper = rosrun("gmapping", "slam_gmapping", "__name:=gmapping", *arguments, graph=graph).instance()
        graph.run(0.2)

    def scan(self, ranges, *, odom=True, **changes):
        message = message_class("sensor_msgs/LaserScan")()
        message.header.frame_id, message.header.stamp = "laser", self.node.now()
        message.angle_increment, message.range_min, message.range_max = 0.1, 0.1, 3.5
        message.ranges = ranges
        for name, value in changes.items():
            setattr(message, name, value)
        if odom:
            self.tf.send_rigid("odom", "base_link", from_yaw(0.0, 0.0, 0.0))
        self.scans.publish(message)
        self.graph.run(0.7)

    def said(self, text):
        return [log for log in self.heard["/rosout"] if text in log.msg]


def test_a_laser_that_is_upside_down(graph):
    laser = Laser(graph, mount=(0.0, 0.0, 0.1, 1.0, 0.0, 0.0, 0.0))
    laser.scan([1.0, 1.0, 1.0, 1.0, 1.0, 1.0, 1.0, 1.0])
    assert laser.said("upside down")
    cells, (_, low) = laser.mapper.slam.maps.occupancy(0)
    rows = np.nonzero(cells > 0)[0] * 0.05 + low
    assert (rows <= 0.0).all(), "bearings to the left are to the right"


def test_a_laser_that_looks_up(graph):
    laser = Laser(graph, mount=(0.0, 0.0, 0.1, 0.0, math.sin(0.4), 0.0, math.cos(0.4)))
    laser.scan([1.0] * 8)
    assert laser.said("Laser has to be mounted planar!")
    assert laser.mapper.slam is None


def test_scans_that_cannot_be(graph):
    laser = Laser(graph)
    laser.scan([1.0] * 8, odom=False)
    assert laser.said("a scan of laser is ignored")
    laser.graph.run(6.0)  # until it may complain again
    laser.scan([])
    assert laser.said("has 0 ranges")
    assert laser.mapper.slam is None
    laser.scan([1.0] * 8)
    assert laser.mapper.slam.processed == 1
    laser.graph.run(6.0)
    laser.scan([1.0] * 9)
    assert laser.said("has 9 ranges, but the first one had 8")
    first = laser.node.now()
    laser.graph.run(2.0)
    laser.scan([math.nan, math.inf, 0.0, -1.0, 1.0, 1.0, 1.0, 1.0])
    assert np.isfinite(laser.mapper.slam.poses).all()
    laser.scan([1.0] * 8, header=message_class("std_msgs/Header")(frame_id="laser", stamp=first))


def test_scans_whose_numbers_are_none(graph):
    """Machine code that counts cells to nowhere ended the whole process."""
    laser = Laser(graph)
    wrong = [
        {name: value}
        for name in ("angle_min", "angle_increment", "range_min", "range_max")
        for value in (math.nan, math.inf)
    ]
    for each in wrong:
        laser.scan([1.0] * 8, **each)
        assert laser.mapper.slam is None, each
    assert laser.said("it cannot be used for mapping")
    laser.scan([1.0] * 8)
    for each in wrong:
        laser.scan([1.0] * 8, **each)
    assert laser.mapper.slam.processed == 1


def test_a_laser_without_a_range_max(graph):
    """Some drivers say inf; then ~maxRange has to be set."""
    graph.master.setParam("/test", "/gmapping/maxRange", 3.0)
    laser = Laser(graph)
    laser.scan([1.0] * 7 + [9.0], range_max=math.inf)
    assert laser.mapper.slam.processed == 1


def test_an_odometry_that_jumps_beyond_all_maps(graph):
    laser = Laser(graph)
    laser.scan([1.0] * 8)
    laser.tf.send_rigid("odom", "base_link", from_yaw(1e8, 0.0, 0.0))
    laser.scan([1.0] * 8, odom=False)
    assert laser.said("maps would have to extend")


@pytest.mark.parametrize(
    ("name", "value"), [("xmin", 5.0), ("maxRange", -1.0), ("maxUrange", -5.0), ("transform_publish_period", -1.0)]
)
def test_a_value_that_is_accepted_with_a_warning(graph, name, value):
    """Machine code that follows beams of negative length ended the whole process."""
    laser = Laser(graph, **{name: value})
    laser.scan([1.0] * 8)
    assert laser.mapper.slam.processed == 1
    assert laser.heard["map"]
    assert laser.said(name)


@pytest.mark.skipif(not BAG.is_file(), reason="the bag of a real robot is not there")
def test_a_bag_of_a_real_robot(graph):
    """It stands still, and its laser hangs upside down: 381 beams, one map, and one word about the laser."""
    node, heard = listen(graph)
    node.set_param("/use_sim_time", True)
    mapper = rosrun("gmapping", "slam_gmapping", "__name:=gmapping", "_particles:=3", graph=graph).instance()
    rosrun("rosbag", "play", "--clock", str(BAG), graph=graph)
    graph.run(8.0)
    assert [log.msg for log in heard["/rosout"] if "Laser" in log.msg] == ["Laser is mounted upside down."]
    assert mapper.slam.processed == 1
    grid = heard["map"][-1]
    assert (grid.info.width, grid.info.height) == (4000, 4000)
    assert (np.asarray(grid.data) == 100).sum() > 100


def test_parameter_files_of_robotis(graph):
    """turtlebot3_slam's, as its launch file gives them."""
    roslaunch("turtlebot3_slam", "turtlebot3_slam.launch", graph=graph, model="burger", open_rviz=False)
    graph.run(0.5)
    mapper = graph.nodes["/turtlebot3_slam_gmapping"].program
    assert mapper.parameters.particles == 100
    assert mapper.parameters.minimumScore == 50.0
    settings = mapper.parameters.settings(3.5)
    assert (settings.max_range, settings.max_urange) == (pytest.approx(3.49), 3.0)


def test_a_transform_is_sent_once_for_each_time(graph):
    graph.master.setParam("/test", "/use_sim_time", True)
    node, sent = graph.node("time"), []
    clock = node.publisher("clock", message_class("rosgraph_msgs/Clock"), queue_size=1)
    node.subscriber("tf", message_class("tf2_msgs/TFMessage"), sent.append)
    rosrun("gmapping", "slam_gmapping", graph=graph)
    for tenths in range(20):
        clock.publish(message_class("rosgraph_msgs/Clock")(clock=Time(10 + tenths // 10, tenths % 10 * 100_000_000)))
        graph.run(0.1)
    stamps = [message.transforms[0].header.stamp for message in sent]
    assert len(stamps) > 10
    assert len(set(stamps)) == len(stamps)
