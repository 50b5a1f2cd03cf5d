"""Devices one by one: cameras, bumpers, clocks, holonomic drives, and their topics, frames and rates as arguments."""

from __future__ import annotations

import math
from collections import defaultdict
from dataclasses import replace
from typing import Any

import numpy as np
import pytest

from rosmini.core.errors import RosminiError
from rosmini.core.graph import Graph
from rosmini.msgs import message_class
from rosmini.sim.devices import (
    Bumper,
    CameraDevice,
    ClockDevice,
    DifferentialDrive,
    GroundTruth,
    ImuDevice,
    JointStates,
    Laser,
    PlanarMove,
)
from rosmini.sim.engine import Engine
from rosmini.sim.host import Host
from rosmini.sim.models import BURGER, WAFFLE_PI, CameraModel, LidarModel
from rosmini.sim.world import Box, Obstacle, World

OMNI = replace(BURGER, name="omni", drive="holonomic")
CAMERA = CameraModel(name="eye", mount=(0.0, 0.0, 0.2), width=64, height=48, horizontal_fov=1.0, rate=10.0, depth=True)
WALL = World("wall", obstacles=(Obstacle("barrier", Box(0.2, 4.0), (2.1, 0.0, 0.0), height=1.0, colour="blue"),))


class Stand:
    """A host with one robot, and ears for what its devices tell."""

    def __init__(self, graph: Graph, world: World | None = None, model: Any = BURGER, **options: Any) -> None:
        self.graph = graph
        self.engine = Engine(world or World("empty"), graph.rng, noise=0.0)
        self.engine.add("r", model, (0.0, 0.0, 0.0))
        self.host = Host(graph.node("host"), self.engine, **options)
        self.node = graph.node("ears")
        self.heard: dict[str, list[Any]] = defaultdict(list)

    def hear(self, topic: str, kind: str) -> list[Any]:
        self.node.subscriber(topic, message_class(kind), self.heard[topic].append)
        return self.heard[topic]

    def command(self, topic: str, v: float = 0.0, vy: float = 0.0, w: float = 0.0) -> None:
        twist = message_class("geometry_msgs/Twist")
        publisher = self.node.publisher(topic, twist)
        publisher.wait_for_subscribers(timeout=1.0)
        message = twist()
        message.linear.x, message.linear.y, message.angular.z = v, vy, w
        publisher.publish(message)


# -- drives ----------------------------------------------------------------------------------------------------------


def test_topics_frames_and_rates_are_arguments(graph):
    stand = Stand(graph)
    host = stand.host
    drive = host.add(
        DifferentialDrive(
            host, "r", cmd_vel="go", odom="where", odom_frame="o", base_frame="b", tf="/tf_of_r", rate=50.0
        )
    )
    host.add(JointStates(host, drive, topic="wheels", joints=("l", "r"), frame="", rate=10.0))
    host.add(GroundTruth(host, "r", topic="truth", frame="world", child="b", rate=20.0))
    host.add(Laser(host, "r", topic="laser", frame="nose", rate=2.0, noise=0.0))
    host.add(ImuDevice(host, "r", topic="unit", frame="ear", rate=25.0, noise=0.0))
    heard = [
        stand.hear("where", "nav_msgs/Odometry"),
        stand.hear("/tf_of_r", "tf2_msgs/TFMessage"),
        stand.hear("wheels", "sensor_msgs/JointState"),
        stand.hear("truth", "nav_msgs/Odometry"),
        stand.hear("laser", "sensor_msgs/LaserScan"),
        stand.hear("unit", "sensor_msgs/Imu"),
    ]
    stand.command("go", 0.1)
    graph.run(2.01)
    assert [len(messages) for messages in heard] == [pytest.approx(n, abs=1) for n in (100, 100, 20, 40, 4, 50)]
    odom, tf, joints, truth, scan, imu = (messages[-1] for messages in heard)
    assert (odom.header.frame_id, odom.child_frame_id) == ("o", "b")
    assert (tf.transforms[0].header.frame_id, tf.transforms[0].child_frame_id) == ("o", "b")
    assert (joints.header.frame_id, list(joints.name)) == ("", ["l", "r"])
    assert (truth.header.frame_id, truth.child_frame_id) == ("world", "b")
    assert (scan.header.frame_id, scan.scan_time) == ("nose", 0.5)
    assert imu.header.frame_id == "ear"
    assert odom.twist.twist.linear.x == pytest.approx(0.1, abs=0.01)


@pytest.mark.parametrize(("source", "begin"), [("encoder", (0.0, 0.0)), ("start", (0.0, 0.0)), ("world", (1.0, 2.0))])
def test_odometry_is_counted_from_the_start_or_from_the_world(graph, source, begin):
    stand = Stand(graph)
    stand.engine.add("s", BURGER, (1.0, 2.0, math.pi / 2))
    drive = stand.host.add(DifferentialDrive(stand.host, "s", source=source))
    drive.command(0.2, 0.0)
    graph.run(1.01)
    x, y, theta = drive.reckoned.pose
    way = (0.0, 0.18) if source == "world" else (0.18, 0.0)
    assert (x, y) == (pytest.approx(begin[0] + way[0], abs=2e-3), pytest.approx(begin[1] + way[1], abs=2e-3))
    assert theta == pytest.approx(math.pi / 2 if source == "world" else 0.0, abs=1e-9)


def test_unknown_sources_are_named(graph):
    stand = Stand(graph)
    with pytest.raises(RosminiError, match="no odometry source 'encodre'; did you mean encoder"):
        DifferentialDrive(stand.host, "r", source="encodre")


@pytest.mark.parametrize("source", ["encoder", "start", "world"])
def test_a_planar_move_goes_to_the_side(graph, source):
    stand = Stand(graph, model=OMNI)
    host = stand.host
    host.add(PlanarMove(host, "r", source=source))
    host.add(GroundTruth(host, "r"))
    odom, truth = (stand.hear("odom", "nav_msgs/Odometry"), stand.hear("base_pose_ground_truth", "nav_msgs/Odometry"))
    stand.command("cmd_vel", 0.1, 0.2)
    graph.run(2.0)
    x, y, _ = stand.engine.robot("r").pose
    assert y > 0.3
    assert y == pytest.approx(2 * x, rel=0.1)
    for message in (odom[-1], truth[-1]):
        place, twist = message.pose.pose.position, message.twist.twist
        assert (place.x, place.y) == (pytest.approx(x, abs=0.01), pytest.approx(y, abs=0.01))
        assert (twist.linear.x, twist.linear.y) == (pytest.approx(0.1), pytest.approx(0.2))


def test_a_planar_move_starts_to_count_anew(graph):
    stand = Stand(graph, model=OMNI)
    drive = stand.host.add(PlanarMove(stand.host, "r", source="encoder"))
    drive.command(0.1, 0.5, 0.2)
    graph.run(1.0)
    drive.reset_odometry()
    graph.run(0.001)
    drive.command(0.0, 0.0, 0.0)
    graph.run(1.0)
    drive.reset_odometry()
    graph.run(0.1)
    assert drive.reckoned.pose == pytest.approx((0.0, 0.0, 0.0), abs=1e-12)


@pytest.mark.parametrize("field", ["v", "vy", "w"])
def test_no_planar_move_follows_what_is_no_number(graph, capsys, field):
    stand = Stand(graph, model=OMNI)
    stand.host.add(PlanarMove(stand.host, "r"))
    stand.command("cmd_vel", 0.2)
    graph.run(1.0)
    stand.command("cmd_vel", **{field: math.inf})
    graph.run(1.0)
    stood = stand.engine.robot("r").pose
    graph.run(1.0)
    assert stand.engine.robot("r").pose == stood
    assert "must be a finite number" in capsys.readouterr().err


def test_two_wheels_do_not_mind_a_wish_to_go_aside(graph, capsys):
    stand = Stand(graph)
    stand.host.add(DifferentialDrive(stand.host, "r"))
    stand.command("cmd_vel", 0.1, math.nan)
    graph.run(1.0)
    assert stand.engine.robot("r").pose[0] > 0.08
    assert capsys.readouterr().err == ""


def test_a_unit_on_a_planar_move_feels_the_centre(graph):
    stand = Stand(graph, model=replace(OMNI, imu=replace(BURGER.unit, mount=(0.0, 0.0, 0.0))))
    drive = stand.host.add(PlanarMove(stand.host, "r"))
    stand.host.add(ImuDevice(stand.host, "r", noise=0.0))
    heard = stand.hear("imu", "sensor_msgs/Imu")
    drive.command(0.0, 0.5, 0.2)  # aside and turning: on a circle, whose centre lies behind it
    graph.run(2.0)
    accel = heard[-1].linear_acceleration
    assert (accel.x, accel.y) == (pytest.approx(-0.2 * 0.5), pytest.approx(0.0, abs=1e-9))


# -- what is measured ------------------------------------------------------------------------------------------------


def test_a_laser_may_be_any_and_more_than_one(graph):
    narrow = LidarModel(
        name="hokuyo", mount=(0.1, 0.0, 0.2), beams=3, rate=10.0, range_min=0.1, range_max=5.0, noise=0.0,
        angle_min=-0.5, angle_max=0.5,
    )  # fmt: skip
    stand = Stand(graph, WALL)
    stand.host.add(Laser(stand.host, "r"))
    stand.host.add(Laser(stand.host, "r", narrow, topic="front", frame="front", name="r/front"))
    scans = stand.hear("front", "sensor_msgs/LaserScan")
    graph.run(0.5)
    scan = scans[-1]
    assert (scan.angle_min, scan.angle_max) == (pytest.approx(-0.5), pytest.approx(0.5))
    assert scan.angle_increment == pytest.approx(0.5)
    assert scan.ranges.tolist() == pytest.approx([1.9 / math.cos(0.5), 1.9, 1.9 / math.cos(0.5)], rel=1e-6)


def test_a_laser_that_nobody_hears_does_not_measure_but_its_noise_goes_on(graph):
    def scans(late: bool) -> list[Any]:
        with Graph() as own:
            stand = Stand(own, WALL)
            laser = stand.host.add(Laser(stand.host, "r"))
            if late:
                own.run(1.1)
                assert laser.ranges is None
                assert laser.message is None
            heard = stand.hear("scan", "sensor_msgs/LaserScan")
            own.run(1.0 if late else 2.1)
            return [scan.ranges.tolist() for scan in heard]

    always, late = scans(late=False), scans(late=True)
    assert len(late) >= 4
    assert late == always[-len(late) :]


def test_what_a_camera_sees(graph):
    stand = Stand(graph, WALL)
    host = stand.host
    host.add(
        CameraDevice(host, "r", CAMERA, depth="depth/image_raw", depth_info="depth/camera_info", points="depth/points")
    )
    image, info = (stand.hear("image_raw", "sensor_msgs/Image"), stand.hear("camera_info", "sensor_msgs/CameraInfo"))
    depth = stand.hear("depth/image_raw", "sensor_msgs/Image")
    points = stand.hear("depth/points", "sensor_msgs/PointCloud2")
    graph.run(0.55)
    assert [len(each) for each in (image, info, depth, points)] == [pytest.approx(5, abs=1)] * 4
    picture = image[-1]
    assert (picture.width, picture.height, picture.encoding, picture.step) == (64, 48, "rgb8", 192)
    assert picture.header.frame_id == "camera_rgb_optical_frame"
    pixels = np.frombuffer(bytes(picture.data), dtype=np.uint8).reshape(48, 64, 3)
    red, _, blue = pixels[24, 32].tolist()
    assert blue > red + 50  # the barrier is blue
    depths = np.frombuffer(bytes(depth[-1].data), dtype=np.float32).reshape(48, 64)
    assert depth[-1].encoding == "32FC1"
    assert depths[24, 32] == pytest.approx(2.0, abs=1e-5)
    assert depths[0, 32] == pytest.approx(2.0, abs=1e-5) or math.isinf(depths[0, 32])
    focal = 64 / (2 * math.tan(0.5))
    assert (info[-1].K[0], info[-1].K[4], info[-1].K[8]) == (pytest.approx(focal), pytest.approx(focal), 1.0)
    assert info[-1].distortion_model == "plumb_bob"
    assert info[-1].header.stamp == picture.header.stamp
    cloud = points[-1]
    assert [(field.name, field.offset) for field in cloud.fields] == [("x", 0), ("y", 4), ("z", 8), ("rgb", 12)]
    middle = np.frombuffer(bytes(cloud.data), dtype="<f4").reshape(48, 64, 4)[24, 32]
    k = info[-1].K
    assert middle[:3].tolist() == pytest.approx([(32 - k[2]) / focal * 2, (24 - k[5]) / focal * 2, 2.0], abs=1e-4)


def test_a_camera_that_nobody_watches_does_not_render(graph, monkeypatch):
    stand = Stand(graph)
    camera = stand.host.add(CameraDevice(stand.host, "r", CAMERA))
    looked: list[int] = []
    monkeypatch.setattr(camera, "look", looked.append)
    graph.run(1.0)
    info = stand.hear("camera_info", "sensor_msgs/CameraInfo")
    graph.run(1.0)
    assert len(info) >= 8
    assert looked == []


def test_a_cameras_noise_does_not_depend_on_who_watches(graph):
    def last(late: bool) -> bytes:
        with Graph() as own:
            stand = Stand(own, WALL)
            noisy = replace(CAMERA, noise=0.1)
            stand.host.add(CameraDevice(stand.host, "r", noisy))
            if late:
                own.run(0.7)
            heard = stand.hear("image_raw", "sensor_msgs/Image")
            own.run(0.35 if late else 1.05)
            return bytes(heard[-1].data)

    assert last(late=True) == last(late=False)


def test_a_camera_sees_other_robots_and_what_comes(graph):
    stand = Stand(graph)
    camera = stand.host.add(CameraDevice(stand.host, "r", CAMERA))
    before = camera.look()[1]
    stand.engine.insert(Obstacle("new", Box(0.2, 2.0), (1.6, 0.0, 0.0), height=1.0))
    there = camera.look()[1]
    stand.engine.remove_obstacle("new")
    stand.engine.add("other", WAFFLE_PI, (0.8, 0.0, 0.0))
    assert before[24, 32] != pytest.approx(1.5, abs=0.01)
    assert there[24, 32] == pytest.approx(1.5, abs=1e-4)
    assert camera.look()[1][40, 32] < 0.8


def test_a_waffle_pi_has_a_camera_on_gazebos_topics(graph):
    from rosmini.sim.simulator import Simulator

    node = graph.node("simulator")
    node.set_param("~model", "waffle_pi")
    simulator = Simulator(node, world="empty")
    topics = {name for name, _ in graph.master.getTopicTypes("/test")[2]}
    assert {"/camera/rgb/image_raw", "/camera/rgb/camera_info"} <= topics
    assert not [name for name in topics if "depth" in name]
    simulator.spawn("w", "waffle", (3.0, 0.0, 0.0))
    topics = {name for name, _ in graph.master.getTopicTypes("/test")[2]}
    assert {"/w/camera/rgb/image_raw", "/w/camera/depth/image_raw", "/w/camera/depth/points"} <= topics
    graph.run(1.0)


def test_a_bumper_tells_what_it_touches(graph):
    stand = Stand(graph, WALL)
    stand.engine.place("r", (1.9, 0.0, 0.0))
    drive = stand.host.add(DifferentialDrive(stand.host, "r"))
    stand.host.add(Bumper(stand.host, "r", collision="r::base_link::collision"))
    heard = stand.hear("bumper_states", "gazebo_msgs/ContactsState")
    graph.run(0.5)
    assert heard[-1].header.frame_id == "world"
    drive.command(0.2, 0.0)
    graph.run(1.5)
    (state,) = heard[-1].states
    assert (state.collision1_name, state.collision2_name) == ("r::base_link::collision", "barrier")
    assert len(state.contact_positions) == len(state.contact_normals) == len(state.wrenches) == len(state.depths)
    assert {round(place.x, 2) for place in state.contact_positions} == {2.0}
    assert {round(normal.x) for normal in state.contact_normals} == {-1}
    assert state.total_wrench.force.x == pytest.approx(sum(w.force.x for w in state.wrenches))
    assert state.total_wrench.force.x < 0
    drive.command(-0.2, 0.0)
    graph.run(1.0)
    assert heard[-1].states == []


# -- time and names --------------------------------------------------------------------------------------------------


def test_the_clock_tells_the_worlds_time(graph):
    stand = Stand(graph, from_zero=True)
    clock = stand.host.add(ClockDevice(stand.host, rate=10.0))
    heard = stand.hear("/clock", "rosgraph_msgs/Clock")
    graph.run(0.55)
    assert [message.clock.to_sec() for message in heard] == pytest.approx([0.1, 0.2, 0.3, 0.4, 0.5], abs=0.11)
    stand.host.pause()
    stand.host.step(0.25)
    clock.publish_now()
    graph.run(0.01)
    assert heard[-1].clock.to_sec() == pytest.approx(0.8)


@pytest.mark.parametrize(("width", "height", "rate", "dear"), [(1920, 1080, 30.0, True), (640, 480, 30.0, False)])
def test_a_camera_that_is_dear_says_so_once_and_only_if_somebody_hears_it(graph, capsys, width, height, rate, dear):
    stand = Stand(graph, WALL)
    camera = replace(CAMERA, width=width, height=height, rate=rate)
    stand.host.add(CameraDevice(stand.host, "r", camera, image="image", depth="depth"))
    graph.run(0.1)
    assert "the camera" not in capsys.readouterr().err
    stand.hear("image", "sensor_msgs/Image")
    graph.run(0.1)
    warned = capsys.readouterr().err
    assert warned.count("renders 1920 x 1080 pixels 30 times a second: 62 million pixels") == dear
    assert ("a lower rate (for example 9.6 Hz)" in warned) == dear
