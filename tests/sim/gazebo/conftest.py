"""Robots and worlds for the tests of Gazebo's part."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

import pytest

from rosmini import Graph
from rosmini.core.graph import Node
from rosmini.msgs import message_class, service_class
from rosmini.sim.gazebo import GazeboServer

DIFF_DRIVE = """
<gazebo><plugin name="drive" filename="libgazebo_ros_diff_drive.so">
  <commandTopic>cmd_vel</commandTopic><odometryTopic>odom</odometryTopic><odometryFrame>odom</odometryFrame>
  <robotBaseFrame>base_footprint</robotBaseFrame><odometrySource>world</odometrySource>
    <legacyMode>false</legacyMode><publishWheelJointState>true</publishWheelJointState>
  <wheelSeparation>0.3</wheelSeparation><wheelDiameter>0.1</wheelDiameter><wheelAcceleration>1.0</wheelAcceleration>
  <updateRate>20</updateRate><leftJoint>left_wheel</leftJoint><rightJoint>right_wheel</rightJoint>
</plugin></gazebo>
"""
LASER = """
<gazebo reference="laser"><sensor type="ray" name="lidar">
  <update_rate>10</update_rate>
  <ray><scan><horizontal><samples>181</samples><resolution>1</resolution><min_angle>-1.5707963267948966</min_angle>
  <max_angle>1.5707963267948966</max_angle></horizontal></scan><range><min>0.1</min><max>8.0</max></range></ray>
  <plugin name="laser" filename="libgazebo_ros_laser.so"><topicName>scan</topicName><frameName>laser</frameName>
    </plugin>
</sensor></gazebo>
"""


def urdf(extensions: str = DIFF_DRIVE + LASER, axle: float = 0.0) -> str:
    """A box on two wheels, with a laser 0.2 m above the ground; its axle is `axle` metres ahead of its origin."""
    wheel = """
    <link name="{side}"><inertial><mass value="0.1"/>
      <inertia ixx="1e-4" iyy="1e-4" izz="1e-4" ixy="0" ixz="0" iyz="0"/></inertial>
      <collision><geometry><cylinder radius="0.05" length="0.02"/></geometry></collision></link>
    <joint name="{side}_wheel" type="continuous"><parent link="base_footprint"/><child link="{side}"/>
      <origin xyz="{axle} {y} 0.05" rpy="-1.5707963267948966 0 0"/><axis xyz="0 0 1"/></joint>"""
    return f"""<?xml version="1.0"?>
    <robot name="box_on_wheels">
      <link name="base_footprint"/>
      <link name="base_link"><inertial><mass value="2.0"/>
        <inertia ixx="0.01" iyy="0.01" izz="0.02" ixy="0" ixz="0" iyz="0"/></inertial>
        <collision><origin xyz="0 0 0.1"/><geometry><box size="0.3 0.26 0.1"/></geometry></collision></link>
      <joint name="base_joint" type="fixed"><parent link="base_footprint"/><child link="base_link"/></joint>
      <link name="laser"/>
      <joint name="laser_joint" type="fixed"><parent link="base_link"/>
        <child link="laser"/><origin xyz="0 0 0.2"/></joint>
      {wheel.format(side="left", y=0.15, axle=axle)}
      {wheel.format(side="right", y=-0.15, axle=axle)}
      {extensions}
    </robot>"""


def box(name: str = "box", *, static: bool = False, extra: str = "", size: float = 0.4, mass: float = 2.0) -> str:
    """The SDF of a cube."""
    inertia = mass * size * size / 6
    return f"""<?xml version="1.0"?><sdf version="1.6"><model name="{name}"><static>{int(static)}</static>
      <link name="link"><pose>0 0 {size / 2} 0 0 0</pose>
        <inertial><mass>{mass}</mass><inertia><ixx>{inertia}</ixx><iyy>{inertia}</iyy><izz>{inertia}</izz>
          </inertia></inertial>
        <collision name="collision"><geometry><box><size>{size} {size} {size}</size></box></geometry></collision>
      </link>{extra}</model></sdf>"""


class Bench:
    """A server, and a node that talks to it."""

    def __init__(self, graph: Graph, *args: str, **options: Any) -> None:
        self.graph = graph
        self.server = GazeboServer(graph.node("gazebo"), *args, **options)
        self.node: Node = graph.node("tester")

    def call(self, service: str, kind: str, **fields: Any) -> Any:
        """What a service of /gazebo answers."""
        return self.node.service_client(f"/gazebo/{service}", service_class(kind))(**fields)

    def spawn(self, xml: str, name: str, x: float = 0.0, y: float = 0.0, yaw: float = 0.0, **fields: Any) -> Any:
        """Spawn what a URDF or an SDF describes."""
        import math

        pose = message_class("geometry_msgs/Pose")()
        pose.position.x, pose.position.y = x, y
        pose.orientation.z, pose.orientation.w = math.sin(yaw / 2), math.cos(yaw / 2)
        kind = "urdf" if "<robot" in xml else "sdf"
        return self.call(
            f"spawn_{kind}_model", "gazebo_msgs/SpawnModel", model_name=name, model_xml=xml, initial_pose=pose, **fields
        )

    def drive(self, topic: str, v: float, w: float = 0.0, vy: float = 0.0) -> None:
        """Publish a velocity once."""
        twist = message_class("geometry_msgs/Twist")
        publisher = self.node.publisher(topic, twist)
        publisher.wait_for_subscribers()
        message = twist()
        message.linear.x, message.linear.y, message.angular.z = v, vy, w
        publisher.publish(message)

    def hear(self, topic: str, kind: str) -> list[Any]:
        """The messages of a topic, as they come."""
        heard: list[Any] = []
        self.node.subscriber(topic, message_class(kind), heard.append)
        return heard

    def pose(self, name: str) -> tuple[float, float, float]:
        """Where a model is."""
        return self.server.truth(name)


@pytest.fixture
def bench(graph: Graph) -> Callable[..., Bench]:
    """Start a server with these arguments; without any in an empty world."""

    def start(*args: str, **options: Any) -> Bench:
        return Bench(graph, *(args or ("empty",) if not options else args), **options)

    return start
