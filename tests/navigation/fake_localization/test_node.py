import pytest

from rosmini import rosrun
from rosmini.core.tf import TransformBroadcaster, TransformListener
from rosmini.core.tf.rigid import from_yaw
from rosmini.msgs.geometry_msgs.msg import PoseArray, PoseWithCovarianceStamped
from rosmini.msgs.nav_msgs.msg import Odometry


@pytest.fixture
def buffer(graph):
    return TransformListener(graph.node("looker")).buffer


class Robot:
    """Publishes where it is, and where its odometry believes it to be."""

    def __init__(self, graph, base="base_link", odom="odom"):
        self.node = graph.node("robot")
        self.frames = odom, base
        self.truth = self.node.publisher("base_pose_ground_truth", Odometry, queue_size=1)
        self.tf = TransformBroadcaster(self.node)

    def tell_truth(self, x, y):
        message = Odometry()
        message.header.stamp, message.header.frame_id = self.node.now(), "map"
        message.pose.pose.position.x, message.pose.pose.position.y = x, y
        message.pose.pose.orientation.w = 1.0
        self.truth.publish(message)

    def tell_odometry(self, x, y):
        self.tf.send_rigid(*self.frames, from_yaw(x, y, 0.0))


def start(graph, *arguments):
    return rosrun("fake_localization", "fake_localization", *arguments, graph=graph).instance()


def place(buffer, frame, base):
    found = buffer.tree.lookup(frame, base).transform
    return tuple(round(value, 6) for value in found[:2])


def test_it_closes_the_tree(graph, buffer):
    start(graph)
    robot = Robot(graph)
    graph.run(0.1)
    robot.tell_truth(3.0, 1.0)
    graph.run(0.1)
    robot.tell_odometry(1.0, 1.5)
    graph.run(0.1)
    robot.tell_truth(3.5, 1.0)
    robot.tell_odometry(1.5, 1.5)
    graph.run(0.1)
    assert place(buffer, "map", "odom") == (2.0, -0.5)
    assert buffer.tree.edges["odom"].newest_ns == robot.node.clock.now_ns(), "it was dated 0.1 s ahead"


def test_topics_of_amcl(graph):
    heard = []
    graph.node("ear").subscriber("amcl_pose", PoseWithCovarianceStamped, heard.append)
    graph.nodes["/ear"].subscriber("particlecloud", PoseArray, heard.append)
    start(graph, "_delta_x:=1.0", "_global_frame_id:=floor")
    robot = Robot(graph)
    graph.run(0.1)
    robot.tell_odometry(0.0, 0.0)
    robot.tell_truth(3.0, 1.0)
    graph.run(0.1)
    posed, cloud = heard
    assert posed.header.frame_id == cloud.header.frame_id == "floor"
    assert (posed.pose.pose.position.x, cloud.poses[0].position.x) == (2.0, 2.0)


def test_initialpose_moves_the_map(graph, buffer, capsys):
    start(graph)
    robot = Robot(graph)
    publisher = robot.node.publisher("initialpose", PoseWithCovarianceStamped, queue_size=1)
    graph.run(0.1)
    wanted = PoseWithCovarianceStamped()
    wanted.header.frame_id = "map"
    wanted.pose.pose.position.x, wanted.pose.pose.orientation.w = 7.0, 1.0
    publisher.publish(wanted)
    graph.run(0.1)
    assert "Failed to lookup transform!" in capsys.readouterr().err
    for step in range(6):
        robot.tell_odometry(0.0, 0.0)
        robot.tell_truth(3.0, 1.0)
        graph.run(0.1)
        if step == 2:
            publisher.publish(wanted)
    assert place(buffer, "map", "base_link") == (7.0, 0.0)


def test_a_prefix(graph, buffer):
    graph.node("setter").set_param("/tf_prefix", "tb3_0")
    start(graph, "_base_frame_id:=base_footprint")
    robot = Robot(graph, "tb3_0/base_footprint", "tb3_0/odom")
    graph.run(0.1)
    for _ in range(3):
        robot.tell_odometry(1.0, 0.0)
        robot.tell_truth(3.0, 1.0)
        graph.run(0.1)
    assert place(buffer, "tb3_0/map", "tb3_0/base_footprint") == (3.0, 1.0)
