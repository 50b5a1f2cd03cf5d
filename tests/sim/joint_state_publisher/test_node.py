import pytest

from rosmini import rosrun
from rosmini.core.errors import ParameterError, ParameterNotSet
from rosmini.core.graph import Graph
from rosmini.core.tf import TransformListener
from rosmini.msgs.rosgraph_msgs.msg import Log
from rosmini.msgs.sensor_msgs.msg import JointState
from rosmini.sim.urdf import UnknownJoint
from rosmini.sim.urdf.xacro import expand

WAFFLE = "package://turtlebot3_description/urdf/turtlebot3_waffle.urdf.xacro"


@pytest.fixture
def graph():
    with Graph() as graph:
        graph.node("setter").set_param("/robot_description", expand(WAFFLE))
        yield graph


def start(graph, *arguments):
    heard = []
    graph.node("looker").subscriber("joint_states", JointState, heard.append)
    return rosrun("joint_state_publisher", "joint_state_publisher", *arguments, graph=graph).instance(), heard


def test_positions_ten_times_a_second(graph):
    _, heard = start(graph)
    graph.run(1.05)
    assert len(heard) == 10
    assert heard[0].name == ["wheel_left_joint", "wheel_right_joint"]
    assert list(heard[0].position) == [0, 0]
    assert len(heard[0].velocity) == len(heard[0].effort) == 0
    assert (heard[-1].header.stamp - heard[-2].header.stamp).to_sec() == pytest.approx(0.1)


def test_parameters(graph):
    graph.node("setter").set_param("/joint_state_publisher/zeros", {"wheel_left_joint": 1.5})
    graph.node("setter").set_param("/source_list", ["motors"])
    made, heard = start(graph, "_rate:=20", "_publish_default_velocities:=true")
    motors = graph.node("motors").publisher("motors", JointState)
    graph.run(0.11)
    assert list(heard[-1].position) == [1.5, 0]
    assert list(heard[-1].velocity) == [0, 0]
    motors.publish(JointState(name=["wheel_right_joint", "other"], position=[0.25, 9], velocity=[2, 9]))
    made.set(wheel_left_joint=0.5)
    graph.run(0.11)
    assert list(heard[-1].position) == [0.5, 0.25]
    assert list(heard[-1].velocity) == [0, 2]
    with pytest.raises(UnknownJoint, match="did you mean"):
        made.set(wheel_lef_joint=1)


def test_delta_moves_the_joints(graph):
    _, heard = start(graph, "_delta:=0.5")
    graph.run(0.31)
    assert [message.position[0] for message in heard] == pytest.approx([0.5, 1.0, 1.5])


def test_with_robot_state_publisher_all_frames_are_there(graph):
    buffer = TransformListener(graph.node("tf")).buffer
    start(graph)
    rosrun("robot_state_publisher", "robot_state_publisher", graph=graph).instance()
    graph.run(0.5)
    assert {"wheel_left_link", "camera_depth_optical_frame"} <= set(buffer.tree)
    assert buffer.tree.lookup("base_footprint", "wheel_left_link").transform[:3] == pytest.approx((0, 0.144, 0.033))


@pytest.mark.parametrize(
    ("arguments", "message"), [(["_rate:=0"], "rate is above 0 Hz"), (["_rate:=fast"], "is needed")]
)
def test_parameters_that_cannot_be(graph, arguments, message):
    with pytest.raises(ParameterError, match=message):
        start(graph, *arguments)


@pytest.mark.parametrize(("asked", "is_told"), [("true", True), ("false", False)])
def test_launch_files_that_speak_of_the_window_still_work(graph, asked, is_told):
    """ROBOTIS's turtlebot3_model.launch does; Noetic's node takes no notice of it."""
    told = []
    graph.node("reader").subscriber("/rosout", Log, lambda log: told.append(log.msg))
    _, heard = start(graph, f"_use_gui:={asked}")
    graph.run(0.55)
    assert len(heard) >= 4
    assert any("joint_state_publisher_gui" in text for text in told) is is_told


def test_without_a_description():
    with Graph() as graph, pytest.raises(ParameterNotSet, match="robot_description"):
        start(graph)
