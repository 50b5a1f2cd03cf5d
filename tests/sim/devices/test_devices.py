"""Devices one by one: cameras, bumpers, clocks, holonomic drives, and their topics, frames and rates as arguments."""

import math
from collections import defaultdict
from dataclasses import replace

import numpy as np
import pytest

from rosmini.core.graph import Graph
from rosmini.msgs import message_class
from rosmini.sim.devices.board import bumper_bits
from rosmini.sim.devices.bumper import Bumper
from rosmini.sim.devices.camera import CameraDevice
from rosmini.sim.devices.drive import DifferentialDrive, GroundTruth, JointStates, PlanarMove
from rosmini.sim.devices.imu import ImuDevice
from rosmini.sim.devices.laser import Laser
from rosmini.sim.engine import Engine
from rosmini.sim.host import Host
from rosmini.sim.models import BURGER, CameraModel
from rosmini.sim.world import Box, Obstacle, World

OMNI = replace(BURGER, name="omni", drive="holonomic")
CAMERA = CameraModel(name="eye", mount=(0.0, 0.0, 0.2), width=64, height=48, horizontal_fov=1.0, rate=10.0, depth=True)
WALL = World("wall", obstacles=(Obstacle("barrier", Box(0.2, 4.0), (2.1, 0.0, 0.0), height=1.0, colour="blue"),))


class Stand:
    """A host with one robot, and ears for what its devices tell."""

    def __init__(self, graph, world=None, model=BURGER, **options):
        self.graph = graph
        self.engine = Engine(world or World("empty"), graph.rng, noise=0.0)
        self.engine.add("r", model, (0.0, 0.0, 0.0))
        self.host = Host(graph.node("host"), self.engine, **options)
        self.node = graph.node("ears")
        self.heard = defaultdict(list)

    def hear(self, topic, kind):
        self.node.subscriber(topic, message_class(kind), self.heard[topic].append)
        return self.heard[topic]

    def command(self, topic, v=0.0, vy=0.0, w=0.0):
        twist = message_class("geometry_msgs/Twist")
        publisher = self.node.publisher(topic, twist)
        publisher.wait_for_subscribers(timeout=1.0)
        message = twist()
        message.linear.x, message.linear.y, message.angular.z = v, vy, w
        publisher.publish(message)


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


def test_a_laser_that_nobody_hears_does_not_measure_but_its_noise_goes_on(graph):
    def scans(late):
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


def test_a_cameras_noise_does_not_depend_on_who_watches(graph):
    def last(late):
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
    assert warned.count("1920 x 1080 pixels 30 times") == warned.count(" 62 million ") == dear
    assert ("9.6 Hz" in warned) == dear


@pytest.mark.parametrize(
    ("pose", "points", "bits"),
    [
        ((0, 0, 0), [(0.1, 0.0)], 1),
        ((0, 0, 0), [(-0.1, 0.01), (0.1, 0.05)], 3),
        ((5.0, 3.0, math.pi / 2), [(5.0, 2.8)], 2),
        ((0, 0, 0), [], 0),
    ],
)
def test_a_bumper_tells_front_from_back(pose, points, bits):
    assert bumper_bits(pose, points) == bits
