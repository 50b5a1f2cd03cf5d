import numpy as np
import pytest

from rosmini import rosrun
from rosmini.core.errors import ParameterNotSet
from rosmini.core.graph import Graph
from rosmini.core.tf import TransformListener
from rosmini.core.tf.rigid import matrix
from rosmini.core.time import Duration, Time
from rosmini.msgs.rosgraph_msgs.msg import Clock
from rosmini.msgs.sensor_msgs.msg import JointState
from rosmini.msgs.tf2_msgs.msg import TFMessage
from rosmini.sim.robot_state_publisher.node import RobotStatePublisher
from rosmini.sim.urdf import UrdfError, load
from rosmini.sim.urdf.xacro import expand

BURGER = "package://turtlebot3_description/urdf/turtlebot3_burger.urdf.xacro"


@pytest.fixture
def graph():
    with Graph() as graph:
        graph.node("setter").set_param("/robot_description", expand(BURGER))
        yield graph


def joints(graph, topic="joint_states"):
    node = graph.node("joints")
    publisher = node.publisher(topic, JointState, queue_size=5)

    def tell(left, right, age=0.0):
        message = JointState(name=["wheel_right_joint", "wheel_left_joint"], position=[right, left])
        message.header.stamp = node.now() - Duration.from_sec(age)
        publisher.publish(message)

    return tell


def test_the_frames_of_the_burger(graph):
    buffer = TransformListener(graph.node("looker")).buffer
    made = rosrun("robot_state_publisher", "robot_state_publisher", graph=graph).instance()
    assert isinstance(made, RobotStatePublisher)
    tell = joints(graph)
    graph.run(0.1)
    tell(0.5, -2.0)
    graph.run(0.1)
    robot = load(BURGER)
    for frame, place in robot.transforms({"wheel_left_joint": 0.5, "wheel_right_joint": -2.0}).items():
        if frame != robot.root:
            found = buffer.tree.lookup("base_footprint", frame).transform
            assert np.allclose(matrix(found), place, atol=1e-12), frame
    static = {name for name, edge in buffer.tree.edges.items() if edge.static}
    assert static == {"base_link", "base_scan", "imu_link", "caster_back_link"}


def count(graph, topic):
    heard = []
    graph.node("counter", anonymous=True).subscriber(topic, TFMessage, heard.append)
    return heard


def test_a_joint_is_told_at_most_so_often(graph):
    heard = count(graph, "/tf")
    rosrun("robot_state_publisher", "robot_state_publisher", "_publish_frequency:=10.0", graph=graph).instance()
    tell = joints(graph)
    graph.node("t").timer(0.02, lambda _: tell(0, 0))
    graph.run(1.01)
    assert len(heard) in {10, 11}
    assert {each.child_frame_id for each in heard[-1].transforms} == {"wheel_left_link", "wheel_right_link"}


def test_or_as_often_as_it_is_heard_of(graph):
    heard = count(graph, "/tf")
    rosrun("robot_state_publisher", "robot_state_publisher", "_ignore_timestamp:=true", graph=graph).instance()
    tell = joints(graph)
    graph.node("t").timer(0.005, lambda _: tell(0, 0))
    graph.run(0.501)
    assert len(heard) == 100
    stamps = [each.transforms[0].header.stamp.to_nsec() for each in heard]
    assert stamps == sorted(stamps)


def test_fixed_joints_on_tf_are_half_a_second_ahead(graph):
    heard, static = count(graph, "/tf"), count(graph, "/tf_static")
    rosrun("robot_state_publisher", "robot_state_publisher", "_use_tf_static:=false", graph=graph).instance()
    graph.run(0.101)
    assert static == []
    assert len(heard) == 5
    assert (heard[-1].transforms[0].header.stamp - graph.now()).to_sec() == pytest.approx(0.5, abs=0.01)


def test_two_robots_with_prefixes(graph):
    buffer = TransformListener(graph.node("looker")).buffer
    for name in ("one", "two"):
        graph.node("setter2").set_param(f"/{name}/tf_prefix", f"{name}_tf")
        rosrun("robot_state_publisher", "robot_state_publisher", f"__ns:=/{name}", graph=graph).instance()
    tell = joints(graph, "/two/joint_states")
    graph.run(0.1)
    tell(1, 1)
    graph.run(0.1)
    frames = set(buffer.tree)
    assert {"one_tf/base_link", "two_tf/base_link", "two_tf/wheel_left_link"} <= frames
    assert "one_tf/wheel_left_link" not in frames


def test_messages_that_say_too_little_or_too_much(graph, capsys):
    heard = count(graph, "/tf")
    rosrun("robot_state_publisher", "robot_state_publisher", graph=graph).instance()
    publisher = graph.node("j").publisher("joint_states", JointState)
    graph.run(0.1)
    for message in (
        JointState(name=["wheel_left_joint"]),
        JointState(name=["wheel_left_joint"], position=[1.0, 2.0]),
        JointState(name=["elbow"], position=[1.0]),
    ):
        message.header.stamp = graph.now()
        publisher.publish(message)
        graph.run(0.1)
    told = capsys.readouterr()
    said = told.out + told.err
    assert "ignored a JointState of 'wheel_left_joint' and others without positions" in said
    assert "ignored a JointState with 1 names and 2 positions" in said
    assert "joint_states contains elbow, which 'turtlebot3_burger' does not have" in said
    assert heard == []


def test_old_joint_states_are_told_of_and_warned_about(graph, capsys):
    heard = count(graph, "/tf")
    rosrun("robot_state_publisher", "robot_state_publisher", graph=graph).instance()
    tell = joints(graph)
    graph.run(50)
    tell(0, 0, age=40.0)
    graph.run(0.1)
    assert len(heard) == 1
    told = capsys.readouterr()
    assert "a JointState is 40.0 seconds old" in told.out + told.err


def test_without_a_description_it_says_what_to_do():
    with Graph() as graph:
        with pytest.raises(ParameterNotSet, match="needs the parameter robot_description, a URDF, which is not set"):
            rosrun("robot_state_publisher", "robot_state_publisher", graph=graph).instance()
        graph.node("setter").set_param("/robot_description", "<robot name='r'>\n<link/></robot>")
        with pytest.raises(UrdfError, match=r"^/robot_description:2: name"):
            rosrun("robot_state_publisher", "robot_state_publisher", graph=graph).instance()


@pytest.mark.parametrize(("text", "message"), [("", "this is empty"), ("robot.urdf", "this is not XML")])
def test_what_is_no_description_is_not_taken_for_a_file(text, message):
    with Graph() as graph:
        graph.node("setter").set_param("/robot_description", text)
        with pytest.raises(UrdfError, match=message):
            rosrun("robot_state_publisher", "robot_state_publisher", graph=graph).instance()


def test_what_is_doubtful_in_the_description_is_said(capsys):
    inertial = '<inertial><mass value="1"/><inertia ixx="1" ixy="0" ixz="0" iyy="1" iyz="0" izz="1"/></inertial>'
    with Graph() as graph:
        graph.node("setter").set_param(
            "/robot_description", f'<robot name="r"><link name="a">{inertial}</link></robot>'
        )
        rosrun("robot_state_publisher", "robot_state_publisher", graph=graph).instance()
        told = capsys.readouterr()
        assert "the root link 'a' has an inertia, which KDL" in told.out + told.err


def test_a_wrong_parameter_is_told(graph, capsys):
    rosrun("robot_state_publisher", "robot_state_publisher", "_publish_freqency:=5", graph=graph).instance()
    assert "did you mean ~publish_frequency" in capsys.readouterr().err


def test_time_that_goes_back_makes_it_tell_all_anew(graph):
    graph.master.setParam("/test", "/use_sim_time", True)
    clock = graph.node("bag").publisher("/clock", Clock, queue_size=1)
    rosrun("robot_state_publisher", "robot_state_publisher", graph=graph).instance()
    heard, tell = count(graph, "/tf"), joints(graph)
    graph.run(0.1)
    for seconds in (100, 10):
        clock.publish(Time(seconds))
        graph.run(0.1)
        tell(0, 0)
        graph.run(0.1)
    assert len(heard) == 2
