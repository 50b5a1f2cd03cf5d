"""The node on a graph: topics, services, frames, parameters, and what it makes of bad input."""

from __future__ import annotations

import io
import math

import numpy as np
import pytest

from rosmini import rosrun
from rosmini.core.actionlib import SimpleActionClient
from rosmini.core.dynamic_reconfigure import Client
from rosmini.core.errors import ParameterError
from rosmini.core.geometry.poses import compose
from rosmini.core.graph import Graph
from rosmini.core.maps.grid_map import GridMap
from rosmini.core.tf import StaticTransformBroadcaster, TransformBroadcaster, TransformListener
from rosmini.core.tf.rigid import from_yaw
from rosmini.core.time import Time
from rosmini.msgs import message_class, service_class
from rosmini.navigation.amcl.field import LikelihoodField
from rosmini.navigation.nav_core import pose_stamped
from rosmini.ros.launch import roslaunch

Posed = message_class("geometry_msgs/PoseWithCovarianceStamped")
BEAMS = 90


def hall(free=0, resolution=0.05, origin=(0.0, 0.0, 0.0)):
    cells = np.full((80, 120), free, dtype=np.int8)
    cells[[0, -1], :] = cells[:, [0, -1]] = 100
    cells[30:45, 70:80] = 100
    cells[60:64, 20:50] = 100
    return GridMap(cells, resolution, origin)


class Robot:
    """Stands in for a robot in the hall: odometry, scans, and the ears of whoever uses amcl."""

    def __init__(self, graph, start=(1.0, 1.0, 0.0), *, tf=True):
        self.graph, self.pose, self.odometry = graph, start, (0.0, 0.0, 0.0)
        self.node = graph.node("robot")
        self.said, self.poses, self.clouds = [], [], []
        self.field = LikelihoodField(hall().occupied, 0.05, (0.0, 0.0))
        self.scans = self.node.publisher("scan", message_class("sensor_msgs/LaserScan"), queue_size=5)
        self.initial = self.node.publisher("initialpose", Posed, queue_size=5)
        self.maps = self.node.publisher("map", message_class("nav_msgs/OccupancyGrid"), latch=True)
        self.node.subscriber("amcl_pose", Posed, self.poses.append)
        self.node.subscriber("particlecloud", message_class("geometry_msgs/PoseArray"), self.clouds.append)
        self.node.subscriber("/rosout", message_class("rosgraph_msgs/Log"), lambda log: self.said.append(log.msg))
        self.tf = TransformBroadcaster(self.node)
        if tf:
            StaticTransformBroadcaster(self.node).send("base_link", "laser", (0.0, 0.0, 0.2))
        self.buffer = TransformListener(self.node).buffer
        graph.run(0.1)

    def scan(self, ranges=None, frame="laser", **changes):
        message = message_class("sensor_msgs/LaserScan")()
        message.header.frame_id, message.header.stamp = frame, self.node.now()
        message.angle_increment, message.range_min, message.range_max = math.tau / BEAMS, 0.1, 3.5
        bearings = np.arange(BEAMS) * math.tau / BEAMS
        found = self.field.ranges(np.array([self.pose]), bearings, 3.5)[0]
        message.ranges = found if ranges is None else ranges
        for name, value in changes.items():
            setattr(message, name, value)
        self.scans.publish(message)

    def tell(self):
        self.tf.send_rigid("odom", "base_link", from_yaw(*self.odometry))

    def step(self, motion=(0.25, 0.0, 0.0), **scan):
        self.pose, self.odometry = compose(self.pose, motion), compose(self.odometry, motion)
        self.tell()
        self.scan(**scan)
        self.graph.run(0.2)

    def drive(self, count=8):
        for _ in range(count):
            self.step((0.25, 0.0, 0.05))

    def say(self, x, y, yaw=0.0, frame="map", stamp=None, variance=0.01):
        message = Posed()
        message.header.frame_id, message.header.stamp = frame, stamp or Time()
        message.pose.pose = pose_stamped(frame, Time(), (x, y, yaw)).pose
        covariance = np.zeros((6, 6))
        covariance[[0, 1, 5], [0, 1, 5]] = variance
        message.pose.covariance = covariance.ravel().tolist()
        self.initial.publish(message)
        self.graph.run(0.1)

    def off(self):
        """How far amcl is from the truth, by tf [m]."""
        found = self.buffer.tree.lookup("map", "base_link").transform
        return math.dist(found[:2], self.pose[:2])

    def heard(self, text):
        return [line for line in self.said if text in line]


@pytest.fixture
def graph():
    with Graph(seed=2) as graph:
        yield graph


def start(graph, *arguments, node="amcl"):
    given = ("_use_map_topic:=true", "_max_particles:=800", "_initial_pose_x:=1.0", "_initial_pose_y:=1.0")
    found = rosrun("amcl", "amcl", *given, *arguments, graph=graph).instance()
    graph.run(0.1)
    return found


def ready(graph, *arguments):
    robot = Robot(graph)
    robot.maps.publish(hall().to_message("map", robot.node.now()))
    amcl = start(graph, *arguments)
    robot.tell()
    graph.run(0.1)
    return robot, amcl


def call(graph, name, kind, **request):
    return graph.nodes["/robot"].service_client(name, service_class(kind))(**request)


def test_its_topics_and_services_are_those_of_the_real_one(graph):
    """As the Master lists them with a real amcl 1.17.3, whose map comes by service."""
    Robot(graph)
    rosrun("amcl", "amcl", graph=graph).instance()
    graph.run(0.1)
    node = graph.nodes["/amcl"]
    own = ("/amcl/parameter_descriptions", "/amcl/parameter_updates", "/amcl_pose", "/diagnostics")
    assert set(node.publications) == {*own, "/particlecloud", "/rosout", "/tf"}
    assert set(node.subscriptions) == {"/initialpose", "/scan", "/tf", "/tf_static"}
    assert set(node.services) == {
        "/amcl/get_loggers",
        "/amcl/set_logger_level",
        "/amcl/set_parameters",
        "/global_localization",
        "/request_nomotion_update",
        "/set_map",
    }


def test_it_follows_a_robot_and_says_where_it_is(graph):
    robot, amcl = ready(graph)
    robot.drive()
    assert robot.off() < 0.1
    last = robot.poses[-1]
    assert last.header.frame_id == robot.clouds[-1].header.frame_id == "map"
    assert len(robot.clouds[-1].poses) == len(amcl.localizer.filter.particles)
    covariance = np.array(last.pose.covariance).reshape(6, 6)
    assert covariance[0, 0] > 0
    assert covariance[5, 5] > 0
    assert (covariance[2:5] == 0).all()
    stamp = amcl.buffer.tree.edges["odom"].newest_ns - robot.node.clock.now_ns()
    assert stamp == pytest.approx(0.1e9 - 0.2e9, abs=2e6), "transform_tolerance after the scan, 0.2 s ago"


def test_a_robot_that_stands_is_not_updated_but_its_transform_is(graph):
    robot, amcl = ready(graph)
    robot.step((0.0, 0.0, 0.0))
    clouds, poses = len(robot.clouds), len(robot.poses)
    before = amcl.buffer.tree.edges["odom"].newest_ns
    robot.step((0.0, 0.0, 0.0))
    assert (len(robot.clouds), len(robot.poses)) == (clouds, poses)
    assert amcl.buffer.tree.edges["odom"].newest_ns > before
    call(graph, "/request_nomotion_update", "std_srvs/Empty")
    robot.step((0.0, 0.0, 0.0))
    assert len(robot.clouds) == clouds + 1


def test_an_initial_pose_with_its_covariance(graph):
    robot, amcl = ready(graph)
    robot.say(4.0, 3.0, 1.0, variance=0.04)
    found = amcl.localizer.filter.mean()
    assert found.mean == pytest.approx((4.0, 3.0, 1.0), abs=0.05)
    assert np.diag(found.covariance) == pytest.approx([0.04] * 3, rel=0.2)


def test_an_initial_pose_of_the_past_is_moved_on_by_the_odometry(graph):
    robot, amcl = ready(graph)
    robot.drive(3)
    past = robot.node.now()
    robot.tell()
    graph.run(0.05)
    before = robot.pose
    robot.drive(2)
    robot.tell()
    robot.say(*before, stamp=past, variance=1e-4)
    assert not robot.heard("Failed to transform")
    assert amcl.localizer.filter.mean().mean == pytest.approx(robot.pose, abs=0.03)


def test_initial_poses_that_are_of_no_use(graph):
    robot, amcl = ready(graph)
    before = amcl.localizer.filter.particles
    robot.say(2.0, 2.0, frame="odom")
    assert robot.heard('Ignoring initial pose in frame "odom"')
    robot.say(math.nan, 2.0)
    assert robot.heard("not finite")
    assert amcl.localizer.filter.particles is before
    robot.say(-7.0, 2.0)
    assert robot.heard("(-7.00, 2.00) is not in the free space of the map")
    robot.say(2.0, 2.0, frame="")
    assert robot.heard("empty frame_id")
    assert amcl.localizer.filter.mean().mean[:2] == pytest.approx((2.0, 2.0), abs=0.05)


def test_initial_poses_that_are_no_poses(graph):
    """What `rostopic pub` sends with only a position has the quaternion (0, 0, 0, 0)."""
    robot, amcl = ready(graph)
    before = amcl.localizer.filter.mean().mean
    message = Posed()
    message.header.frame_id, message.pose.pose.position.x = "map", 3.0
    robot.initial.publish(message)
    robot.say(3.0, 1.0, variance=-1.0)
    assert robot.heard("ignoring an initial pose: x=0.0, y=0.0, z=0.0, w=0.0 is not a rotation")
    assert robot.heard("ignoring an initial pose: it has a variance below 0: -1, -1, -1")
    assert amcl.localizer.filter.mean().mean == before
    request = {"map": hall(resolution=0.1).to_message("map", robot.node.now()), "initial_pose": Posed()}
    assert call(graph, "/set_map", "nav_msgs/SetMap", **request).success
    assert amcl.localizer.filter.mean().mean == pytest.approx(before, abs=0.1)


def test_an_odometry_that_leaps(graph):
    robot, _ = ready(graph)
    robot.drive(2)
    assert not robot.heard("the odometry jumps")
    robot.odometry = compose(robot.odometry, (30.0, 0.0, 0.0))
    robot.tell()
    robot.scan()
    graph.run(0.2)
    assert robot.heard("more than 5 m between two scans")


def test_a_map_whose_origin_is_turned(graph):
    robot, _ = ready(graph)
    assert not robot.heard("the map's origin is turned")
    robot.maps.publish(hall(origin=(0.0, 0.0, 0.5)).to_message("map", robot.node.now()))
    graph.run(0.1)
    assert robot.heard("the map's origin is rotated by 28.6 degrees")


def test_the_map_by_service(graph):
    robot = Robot(graph)
    amcl = rosrun("amcl", "amcl", graph=graph).instance()
    graph.run(1.2)
    assert robot.heard("Request for map failed; trying again...")
    assert amcl.localizer.field is None
    robot.step()
    grid = hall().to_message("map", robot.node.now())
    robot.node.service("static_map", service_class("nav_msgs/GetMap"), lambda _: {"map": grid})
    graph.run(1.0)
    assert robot.heard("Received a 120 X 80 map @ 0.050 m/pix")
    assert amcl.localizer.field is not None


def test_maps_that_change_while_it_runs(graph):
    robot, amcl = ready(graph)
    robot.drive(3)
    believed = amcl.localizer.estimate().pose
    robot.maps.publish(hall(resolution=0.1, origin=(-1.0, 0.0, 0.0)).to_message("map", robot.node.now()))
    graph.run(0.1)
    assert amcl.localizer.field.resolution == pytest.approx(0.1)
    assert amcl.localizer.filter.mean().mean == pytest.approx(believed, abs=0.1)
    broken = hall().to_message("elsewhere", robot.node.now())
    broken.data = broken.data[:7]
    robot.maps.publish(broken)
    graph.run(0.1)
    assert robot.heard("Frame_id of map received:'elsewhere'")
    assert robot.heard("the map cannot be used, keeping the previous one: a map of 120 x 80 cells")
    robot.maps.publish(hall(free=-1).to_message("map", robot.node.now()))
    graph.run(0.1)
    assert robot.heard("no free cell")
    assert amcl.localizer.field.resolution == pytest.approx(0.1)


def test_set_map(graph):
    robot, amcl = ready(graph, "_force_update_after_set_map:=true")
    request = {"map": hall(resolution=0.1).to_message("map", robot.node.now()), "initial_pose": Posed()}
    request["initial_pose"].header.frame_id = "map"
    request["initial_pose"].pose.pose = pose_stamped("map", Time(), (5.0, 6.0, 0.0)).pose
    assert call(graph, "/set_map", "nav_msgs/SetMap", **request).success
    assert amcl.localizer.force
    assert amcl.localizer.filter.mean().mean[:2] == pytest.approx((5.0, 6.0), abs=0.01)
    request["map"].info.resolution = 0.0
    assert not call(graph, "/set_map", "nav_msgs/SetMap", **request).success


def test_the_pose_is_kept_in_the_parameters(graph):
    robot, _ = ready(graph, "_save_pose_rate:=5.0")
    robot.drive(8)
    kept = [robot.node.get_param(f"/amcl/initial_{name}") for name in ("pose_x", "pose_y", "pose_a")]
    assert math.dist(kept[:2], robot.pose[:2]) < 0.4
    assert 0 < robot.node.get_param("/amcl/initial_cov_xx") < 0.25


def test_parameters_that_change(graph):
    robot, amcl = ready(graph)
    robot.drive(3)
    believed = amcl.localizer.estimate().pose
    Client(robot.node, "amcl").update_configuration(
        {"max_particles": 200, "min_particles": 300, "laser_likelihood_max_dist": 1.0}
    )
    assert robot.node.get_param("/amcl/max_particles") == 300
    assert amcl.localizer.filter.most == 300
    assert amcl.localizer.field.farthest == 1.0
    assert amcl.localizer.filter.mean().mean == pytest.approx(believed, abs=0.1)
    graph.run(0.1)
    assert robot.heard("min_particles (300) is above max_particles (200)")


def test_parameters_that_are_restored(graph):
    robot, amcl = ready(graph, "_max_particles:=700", "_odom_alpha1:=0.3")
    client = Client(robot.node, "amcl")
    client.update_configuration({"max_particles": 200, "odom_alpha1": 0.1})
    found = client.update_configuration({"restore_defaults": True})
    assert (found["max_particles"], found["odom_alpha1"], found["restore_defaults"]) == (700, 0.3, False)
    assert (amcl.parameters.odom_alpha1, amcl.localizer.filter.most) == (0.3, 700)


@pytest.mark.parametrize(
    "given", ["_max_particles:=many", "_odom_alpha1:=.nan", "_initial_pose_a:=.nan", "_initial_pose_x:=.inf"]
)
def test_parameters_that_cannot_be(graph, given):
    with pytest.raises(ParameterError, match=given[1:].partition(":")[0]):
        rosrun("amcl", "amcl", given, graph=graph).instance()


def test_parameters_of_other_kinds_and_out_of_range_are_taken_as_amcl_takes_them(graph, capsys):
    amcl = start(graph, "_odom_alpha1:=-0.5", "_max_particles:=700.0", "_min_particles:=99.5", "_kld_err:=3",
                 "_laser_model_type:=sonar", "_odom_model_type:=car")  # fmt: skip
    p, said = amcl.parameters, capsys.readouterr().err
    assert (p.odom_alpha1, p.max_particles, p.min_particles, p.kld_err) == (0.0, 700, 100, 1.0)
    assert (p.laser_model_type, p.odom_model_type) == ("likelihood_field", "diff")
    assert said.count("/amcl/odom_alpha1 is -0.5") == 1
    assert "0.0 ... 10.0" in said
    assert 'Unknown laser model type "sonar"; defaulting to likelihood_field model' in said
    assert 'Unknown odom model type "car"; defaulting to diff model' in said
    assert amcl.node.get_param("~odom_alpha1") == 0.0


@pytest.mark.parametrize("value", [math.nan, math.inf, 0.0, 3.5])
def test_scans_that_see_nothing_do_no_harm(graph, value):
    robot, amcl = ready(graph)
    robot.drive(4)
    for _ in range(3):
        robot.step(ranges=np.full(BEAMS, value))
    assert np.isfinite(amcl.localizer.filter.particles).all()
    assert robot.off() < 0.15


def test_scans_that_are_none(graph):
    robot, amcl = ready(graph)
    robot.step(ranges=[])
    assert robot.heard("has 0 ranges")
    for name in ("range_max", "range_min", "angle_min", "angle_increment"):
        robot.step(**{name: math.nan})
        assert amcl.localizer.odometry is None, name
    robot.step(ranges=np.full(45, 2.0), angle_increment=math.tau / 45)
    assert amcl.localizer.odometry is not None


def test_transforms_that_are_missing(graph):
    robot = Robot(graph)
    robot.maps.publish(hall().to_message("map", robot.node.now()))
    start(graph)
    robot.scan()
    graph.run(1.0)
    assert robot.heard("a scan of laser is ignored")
    graph.run(5.0)
    robot.scan(frame="sonar")
    graph.run(1.0)
    assert robot.heard("sonar")


def test_a_transform_that_comes_late(graph):
    robot, amcl = ready(graph)
    robot.scan()
    graph.run(0.3)
    assert amcl.localizer.odometry is None
    robot.tell()
    graph.run(0.1)
    assert amcl.localizer.odometry == pytest.approx((0.0, 0.0, 0.0))


def test_a_bag_that_loops(graph):
    """Scans whose stamps jump back: it begins at the initial pose again, and says so."""
    robot, amcl = ready(graph)
    first = robot.node.now()
    graph.run(1.5)
    robot.drive(4)
    robot.scan(header=message_class("std_msgs/Header")(frame_id="laser", stamp=first))
    graph.run(0.2)
    assert robot.heard("scans jump back in time")
    assert amcl.localizer.filter.mean().mean[:2] == pytest.approx((1.0, 1.0), abs=0.2)


def test_silence(graph):
    robot, _ = ready(graph)
    graph.run(31.0)
    assert robot.heard("No laser scan received")
    assert robot.heard("/scan topic")


def test_diagnostics(graph):
    robot, _ = ready(graph)
    heard = []
    robot.node.subscriber("/diagnostics", message_class("diagnostic_msgs/DiagnosticArray"), heard.append)
    robot.step()
    graph.run(1.5)
    (status,) = heard[-1].status
    assert status.name == "amcl: Standard deviation"
    assert status.message == "Too large"
    robot.say(*robot.pose, variance=1e-3)
    robot.drive(2)
    graph.run(1.0)
    assert heard[-1].status[0].message == "OK"
    values = {pair.key: float(pair.value) for pair in heard[-1].status[0].values}
    assert values["std_warn_level_yaw"] == 0.1
    assert 0 < values["std_x"] < 0.2


@pytest.mark.nightly  # chapters do it at each commit
def test_a_goal_is_reached_with_amcl():
    """The launch file of the simulator with `localization:=amcl`: no truth helps the robot any more."""
    with Graph(seed=3) as graph:
        said = io.StringIO()
        roslaunch(
            "rosmini_sim",
            "navigation.launch",
            graph=graph,
            console={"stdout": said, "stderr": said},
            model="burger",
            world="house",
            localization="amcl",
        )
        graph.run(3.0)
        client = SimpleActionClient(graph.node("client"), "move_base", message_class("move_base_msgs/MoveBaseAction"))
        graph.run(0.5)
        goal = message_class("move_base_msgs/MoveBaseGoal")()
        goal.target_pose = pose_stamped("map", Time(), (-1.5, 1.0, 0.5))
        client.send_goal(goal)
        for _ in range(60):
            graph.run(1.0)
            if client.get_state() == 3:
                break
        assert client.get_goal_status_text() == "Goal reached."
        truth = graph.nodes["/simulator"].program.truth()
        assert math.dist(truth[:2], (-1.5, 1.0)) < 0.2
        assert "/fake_localization" not in graph.nodes
