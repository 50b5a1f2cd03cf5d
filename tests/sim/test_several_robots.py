"""Several robots in one simulator: names, spawning, deleting, saving and restoring; and TurtleBot3's board."""

import math
from collections import defaultdict
from dataclasses import replace

import pytest
import yaml
from defusedxml import ElementTree

from rosmini.core.errors import IllegalName, ParameterError, RosminiError
from rosmini.core.graph import Graph
from rosmini.core.packages import assets_dir
from rosmini.msgs import message_class
from rosmini.sim.engine import RobotGone
from rosmini.sim.models import BURGER, WAFFLE, UnknownModel
from rosmini.sim.simulator import Simulator
from rosmini.sim.world import Cylinder, Obstacle, World, WorldError

Twist = message_class("geometry_msgs/Twist")
TOPICS = {
    "scan": "sensor_msgs/LaserScan",
    "odom": "nav_msgs/Odometry",
    "joint_states": "sensor_msgs/JointState",
    "imu": "sensor_msgs/Imu",
    "base_pose_ground_truth": "nav_msgs/Odometry",
}


def start(graph, world="empty", **parameters):
    node = graph.node("simulator")
    for name, value in {"noise": 0.0, "cmd_vel_timeout": 0.0, **parameters}.items():
        node.set_param("~" + name, value)
    return Simulator(node, world=world)


class Ears:
    """Hears robots, and commands them."""

    def __init__(self, graph, *robots, name="ears", tf=True, topics=TOPICS):
        self.graph = graph
        self.node = graph.node(name)
        self.heard = defaultdict(list)
        for robot in robots:
            for topic in topics:
                full = f"{robot}/{topic}" if robot else topic
                self.node.subscriber(full, message_class(TOPICS[topic]), self.heard[full].append)
        if tf:
            self.node.subscriber("/tf", message_class("tf2_msgs/TFMessage"), self.heard["tf"].append)
        self.publishers = {}

    def command(self, robot, v, w=0.0):
        topic = f"{robot}/cmd_vel" if robot else "cmd_vel"
        if topic not in self.publishers:
            self.publishers[topic] = self.node.publisher(topic, Twist, queue_size=1)
            self.publishers[topic].wait_for_subscribers(timeout=1.0)
        message = Twist()
        message.linear.x, message.angular.z = v, w
        self.publishers[topic].publish(message)

    def bytes(self):
        return {topic: [type(m)._encode(m) for m in messages] for topic, messages in self.heard.items()}


# -- names -----------------------------------------------------------------------------------------------------------


def test_a_number_of_robots_has_a_namespace_and_a_prefix_each(graph):
    simulator = start(graph, robots=3)
    ears = Ears(graph, "tb3_0", "tb3_1", "tb3_2")
    graph.run(1.05)
    assert list(simulator.robots) == ["tb3_0", "tb3_1", "tb3_2"]
    for i in range(3):
        assert {topic: len(ears.heard[f"tb3_{i}/{topic}"]) for topic in TOPICS} == {
            "scan": 5,
            "odom": 31,
            "joint_states": 31,
            "imu": 209,
            "base_pose_ground_truth": 31,
        }
        assert ears.heard[f"tb3_{i}/scan"][-1].header.frame_id == f"tb3_{i}/base_scan"
        odom = ears.heard[f"tb3_{i}/odom"][-1]
        assert (odom.header.frame_id, odom.child_frame_id) == (f"tb3_{i}/odom", f"tb3_{i}/base_footprint")
        truth = ears.heard[f"tb3_{i}/base_pose_ground_truth"][-1]
        assert (truth.header.frame_id, truth.child_frame_id) == ("map", f"tb3_{i}/base_footprint")
        assert ears.heard[f"tb3_{i}/imu"][-1].header.frame_id == f"tb3_{i}/imu_link"
    places = [simulator.truth(f"tb3_{i}")[:2] for i in range(3)]
    assert min(math.dist(a, b) for a in places for b in places if a != b) > 0.2


def test_robots_are_told_one_by_one(graph):
    simulator = start(
        graph,
        robots=[
            "red",
            {"name": "blue", "model": "waffle", "x": 2.0, "y": 1.0, "yaw": 0.5},
            {"name": "plain", "namespace": "", "tf_prefix": "p", "x": -2.0},
        ],
    )
    assert simulator.truth("blue") == (2.0, 1.0, 0.5)
    assert simulator.robot("blue").model is WAFFLE
    plain = simulator.robot("plain")
    assert (plain.topic("odom"), plain.frame("odom")) == ("odom", "p/odom")
    assert simulator.name == "red"
    assert simulator.truth() == simulator.truth("red")


@pytest.mark.parametrize(
    ("robots", "message"),
    [
        (0, "number of robots"),
        (True, "number of robots"),
        ("many", "number of robots"),
        ([], "number of robots"),
        ([{"x": 1.0}], "the name of a robot"),
        ([{"name": "a", "modle": "burger"}], "did you mean model"),
        ([{"name": "a", "x": "far"}], "must be a number"),
        ([{"name": "a", "namespace": 3}], "must be a string"),
        (["a", "a"], "two robots are called 'a'"),
    ],
)
def test_what_is_wrong_with_the_robots_is_named(graph, robots, message):
    with pytest.raises(ParameterError, match=message):
        start(graph, robots=robots)


def test_one_robot_may_have_a_prefix(graph):
    start(graph, tf_prefix="tb3")
    ears = Ears(graph, "")
    graph.run(0.5)
    assert ears.heard["odom"][-1].header.frame_id == "tb3/odom"
    (transform,) = ears.heard["tf"][-1].transforms
    assert transform.child_frame_id == "tb3/base_footprint"


# -- coming and going ------------------------------------------------------------------------------------------------


def test_a_robot_comes_while_the_others_drive(graph):
    simulator = start(graph)
    ears = Ears(graph, "", "late")
    ears.command("", 0.1)
    graph.run(1.0)
    simulator.spawn("late", pose=(3.0, 0.0, 1.0))
    assert repr(simulator).endswith("and 1 more in empty>")
    graph.run(1.0)
    assert len(ears.heard["late/odom"]) >= 29
    assert ears.heard["late/odom"][-1].header.stamp == ears.heard["odom"][-1].header.stamp
    assert [t.child_frame_id for t in ears.heard["tf"][-1].transforms] == ["base_footprint", "late/base_footprint"]
    ears.command("late", 0.2)
    graph.run(1.0)
    assert simulator.truth("late")[0] == pytest.approx(3.0 + 0.18 * math.cos(1.0), abs=2e-3)
    assert simulator.truth()[0] > 0.25


def test_without_a_place_it_finds_one(graph):
    simulator = start(graph, world="arena")
    names = [f"r{i}" for i in range(12)]
    for name in names:
        simulator.spawn(name)
    places = [simulator.truth(name)[:2] for name in ("burger", *names)]
    assert min(math.dist(a, b) for i, a in enumerate(places) for b in places[:i]) > 0.2


def test_a_deleted_robot_leaves_while_it_moves(graph):
    simulator = start(graph)
    simulator.spawn("gone", pose=(1.0, 0.0, 0.0))
    ears = Ears(graph, "", "gone")
    ears.command("gone", 0.2)
    ears.command("", 0.1)
    graph.run(1.0)
    simulator.delete("gone")
    graph.run(0.001)
    count = len(ears.heard["gone/odom"])
    graph.run(1.0)
    assert len(ears.heard["gone/odom"]) == count
    assert [t.child_frame_id for t in ears.heard["tf"][-1].transforms] == ["base_footprint"]
    published = [topic for topic, _ in graph.master.getSystemState("/test")[2][0]]
    assert [topic for topic in published if topic.startswith("/gone/")] == ["/gone/cmd_vel"]  # the driver's own
    assert simulator.truth()[0] > 0.15
    with pytest.raises(RobotGone, match="no robot 'gone'"):
        simulator.truth("gone")
    simulator.spawn("gone", pose=(1.0, 0.0, 0.0))
    graph.run(1.0)
    assert simulator.truth("gone") == (1.0, 0.0, 0.0)
    assert len(ears.heard["gone/odom"]) > count + 20


def test_when_the_first_has_gone_it_is_said(graph):
    simulator = start(graph)
    simulator.spawn("other", pose=(1.0, 0.0, 0.0))
    simulator.delete("burger")
    with pytest.raises(RobotGone, match=r"no robot 'burger' .*robots: other"):
        simulator.truth()
    assert simulator.truth("other") == (1.0, 0.0, 0.0)
    simulator.delete("other")
    simulator.spawn("third", pose=(0.0, 0.0, 0.0))
    graph.run(0.5)
    simulator.remove()
    with pytest.raises(RobotGone, match="it was removed"):
        simulator.spawn("fourth")


def test_errors_of_spawning_say_what_to_do_and_change_nothing(graph):
    simulator = start(graph, world="arena")
    ears = Ears(graph, "")
    graph.run(0.5)
    with pytest.raises(RosminiError, match="a robot 'burger' in the world 'arena' already"):
        simulator.spawn("burger", pose=(1.0, 0.0, 0.0))
    with pytest.raises(UnknownModel, match="did you mean waffle"):
        simulator.spawn("other", "wafle")
    with pytest.raises(WorldError, match=r"'burger' is in its way.*room at \(") as told:
        simulator.spawn("other", pose=(0.05, 0.0, 0.0))
    x, y = (float(part) for part in str(told.value).rpartition("(")[2].rstrip(").").split(","))
    assert 0.1 < math.hypot(x, y) < 0.35
    simulator.spawn("other", pose=(x, y, 0.0))
    simulator.delete("other")
    with pytest.raises(WorldError, match=r"'east wall' is in its way.*room at \("):
        simulator.spawn("other", pose=(1.99, 0.0, 0.0))
    with pytest.raises(WorldError, match="finite"):
        simulator.spawn("other", pose=(math.nan, 0.0, 0.0))
    with pytest.raises(RosminiError, match="cannot be called"):
        simulator.spawn("a b")
    for name, space in (("9x", None), ("a-b", None), ("fine", "not fine")):
        with pytest.raises(IllegalName, match=f"illegal namespace of the robot '{name}'"):
            simulator.spawn(name, namespace=space)
        assert list(simulator.engine.robots) == ["burger"]
    with pytest.raises(RobotGone, match="did you mean burger"):
        simulator.delete("burgr")
    assert list(simulator.robots) == ["burger"]
    count = len(ears.heard["odom"])
    graph.run(0.5)
    assert len(ears.heard["odom"]) == count + 15


@pytest.mark.nightly
def test_two_runs_with_coming_and_going_are_equal_to_the_last_byte():
    def run():
        with Graph(seed=7) as graph:
            simulator = start(graph, world="room", noise=1.0, robots=3)
            ears = Ears(graph, "tb3_0", "tb3_1", "tb3_2", "late")
            drive(graph, ears, ("tb3_0", "tb3_1", "tb3_2"))
            simulator.delete("tb3_1")
            simulator.spawn("late", "waffle")
            drive(graph, ears, ("tb3_0", "late"))
            return ears.bytes()

    first = run()
    assert len(first["late/imu"]) > 300
    assert run() == first


def test_robots_without_sensors_or_with_other_drives(graph):
    bare = replace(BURGER, name="bare", lidar=None, imu=None, drive="holonomic")
    simulator = Simulator(graph.node("simulator"), world="empty", model=bare)
    topics = {name for name, _ in graph.master.getTopicTypes("/test")[2]}
    assert not topics & {"/scan", "/imu", "/joint_states"}
    ears = Ears(graph, "", topics=("odom",))
    graph.run(0.1)
    simulator.robot().drive.command(0.0, 0.0, 0.2)
    graph.run(0.5)
    assert ears.heard["odom"][-1].pose.pose.position.y > 0.05
    assert simulator.last_scan() is None
    with pytest.raises(RosminiError, match="has no drive"):
        simulator.spawn("rock", replace(BURGER, name="rock", drive=None), (2.0, 0.0, 0.0))


# -- saving and restoring --------------------------------------------------------------------------------------------


def drive(graph, ears, robots):
    for i, (v, w) in enumerate([(0.2, 0.3), (-0.1, 1.0), (0.22, 0.0), (0.1, -2.0)]):
        for k, robot in enumerate(robots):
            ears.command(robot, v, w + 0.1 * k)
        graph.run(0.4 + 0.1 * i)
    graph.run(0.001)  # what was sent arrives


def test_robots_come_and_go_with_the_state(graph):
    simulator = start(graph)
    simulator.spawn("old", pose=(1.0, 0.0, 0.0))
    graph.run(0.5)
    state = simulator.save()
    simulator.delete("old")
    simulator.spawn("new", "waffle", (3.0, 0.0, 0.0))
    simulator.place((0.0, 2.0, 0.0))
    graph.run(0.5)
    simulator.restore(state)
    assert list(simulator.robots) == ["burger", "old"]
    assert simulator.truth() == (0.0, 0.0, 0.0)
    assert simulator.truth("old") == (1.0, 0.0, 0.0)
    ears = Ears(graph, "old")
    graph.run(0.5)
    assert len(ears.heard["old/odom"]) >= 14


# -- the board -------------------------------------------------------------------------------------------------------


class Board(Ears):
    """Hears what the board tells."""

    def __init__(self, graph, **parameters):
        self.simulator = start(graph, board=True, **parameters)
        super().__init__(graph, "")
        for topic, kind in (
            ("sensor_state", "turtlebot3_msgs/SensorState"),
            ("battery_state", "sensor_msgs/BatteryState"),
        ):
            self.node.subscriber(topic, message_class(kind), self.heard[topic].append)
        self.power = self.node.publisher("motor_power", message_class("std_msgs/Bool"))
        self.zero = self.node.publisher("reset", message_class("std_msgs/Empty"))
        graph.run(0.1)


def test_the_board_tells_its_state_at_its_rate(graph):
    board = Board(graph)
    graph.run(2.0)
    assert len(board.heard["sensor_state"]) == pytest.approx(60, abs=3)
    assert len(board.heard["battery_state"]) == pytest.approx(60, abs=3)
    state = board.heard["sensor_state"][-1]
    assert (state.bumper, state.torque, state.left_encoder, state.right_encoder) == (0, True, 0, 0)
    assert state.battery == pytest.approx(board.heard["battery_state"][-1].voltage)
    battery = board.heard["battery_state"][-1]
    assert 12.0 < battery.voltage < 12.6
    assert battery.current < 0
    assert battery.design_capacity == pytest.approx(1.8)


def test_a_wall_presses_the_bumper(graph):
    board = Board(graph, world="arena", x=1.8, y=0.0, yaw=0.0)
    board.command("", 0.2)
    graph.run(2.0)
    assert board.heard["sensor_state"][-1].bumper == 1
    board.command("", -0.2)
    graph.run(1.0)
    assert board.heard["sensor_state"][-1].bumper == 0


def test_motors_without_current_do_not_turn(graph):
    board = Board(graph)
    board.command("", 0.2)
    graph.run(0.5)
    board.power.publish(data=False)
    graph.run(0.5)
    stood = board.simulator.truth()
    board.command("", 0.2)
    graph.run(0.5)
    assert board.simulator.truth() == stood
    assert not board.heard["sensor_state"][-1].torque
    board.power.publish(data=True)
    graph.run(0.1)
    board.command("", 0.2)
    graph.run(0.5)
    assert board.simulator.truth()[0] > stood[0] + 0.05


def test_an_empty_battery_stops_the_robot(graph, capsys):
    board = Board(graph)
    battery = board.simulator.robot().battery
    assert battery is not None
    battery.battery.level = 0.0
    board.command("", 0.1)
    graph.run(3.0)
    stood = board.simulator.truth()
    graph.run(1.0)
    assert board.simulator.truth() == stood
    assert "the battery of burger is empty" in capsys.readouterr().err
    assert not board.heard["battery_state"][-1].present


def test_a_battery_may_begin_half_empty(graph):
    board = Board(graph, battery=0.5)
    graph.run(2.0)
    state = board.heard["battery_state"][-1]
    assert state.charge == pytest.approx(0.9, abs=0.01)
    with Graph() as other, pytest.raises(ParameterError, match="battery"):
        start(other, battery=1.5)


def test_without_the_board_its_topics_are_not_there(graph):
    start(graph)
    names = {name for name, _ in graph.master.getTopicTypes("/test")[2]}
    assert not names & {"/sensor_state", "/battery_state", "/motor_power", "/reset"}


# -- launch files ----------------------------------------------------------------------------------------------------


@pytest.mark.parametrize("name", ["simulator", "robots"])
def test_the_launch_files_say_what_the_simulator_understands(graph, name):
    path = assets_dir() / "ros" / "rosmini_sim" / "launch" / f"{name}.launch"
    (tree,) = (each for each in ElementTree.parse(path).getroot() if each.tag == "node")
    defaults = {arg.get("name"): arg.get("default") for arg in ElementTree.parse(path).getroot().iter("arg")}
    node = graph.node("simulator")
    for element in tree:
        key = element.get("name") or element.get("param")
        text = element.text if element.tag == "rosparam" else defaults[key]
        if text and not text.startswith("$"):
            node.set_param(f"~{key}", yaml.safe_load(text))
    simulator = Simulator(node)
    assert simulator.world.name == "room"
    assert len(simulator.robots) == {"simulator": 1, "robots": 3}[name]


@pytest.mark.parametrize(
    ("parameters", "said"),
    [
        ({"x": 1000.0}, (r"the robot 'burger' cannot start there: \(1000, 0\) is outside of the world 'arena', which "
                        r"goes from \(-2\.08, -2\.08\) to \(2\.08, 2\.08\)")),
        ({"y": -3.0}, "outside of the world 'arena'"),
        ({"x": 1e308}, "outside of the world 'arena'"),
        ({"robots": [{"name": "a", "x": 50.0}]}, "the robot 'a' cannot start there"),
        ({"robots": 10**9}, r"/simulator/robots is 1000000000; it must be a number of robots, up to 1000"),
        ({"robots": ["a"] * 1001}, (r"/simulator/robots is \['a', 'a', .*\.\.\.; it must be a number of robots, up "
                                   r"to 1000")),
    ],
)  # fmt: skip
def test_a_start_outside_of_the_world_and_too_many_robots_are_errors(graph, parameters, said):
    node = graph.node("simulator")
    for name, value in {"world": "arena", **parameters}.items():
        node.set_param(f"~{name}", value)
    with pytest.raises(RosminiError, match=said):
        Simulator(node)


def test_an_open_world_has_no_outside(graph):
    pillar = Obstacle("pillar", Cylinder(0.1), (3.0, 0.0, 0.0))
    node = graph.node("simulator")
    node.set_param("~x", -20.0)
    assert Simulator(node, world=World("field", (pillar,))).robots["burger"].robot.pose[0] == -20.0
