import pytest

from rosmini import rosrun
from rosmini.core.errors import ParameterError, ParameterNotSet
from rosmini.core.graph import Graph
from rosmini.core.tf import TransformListener
from rosmini.msgs.sensor_msgs.msg import JointState
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


def test_zeros(graph):
    graph.node("setter").set_param("/joint_state_publisher/zeros", {"wheel_left_joint": 1.5})
    _, heard = start(graph, "_rate:=20")
    graph.run(0.11)
    assert list(heard[-1].position) == [1.5, 0]
    assert len(heard) == 2


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


def test_without_a_description():
    with Graph() as graph, pytest.raises(ParameterNotSet, match="robot_description"):
        start(graph)
