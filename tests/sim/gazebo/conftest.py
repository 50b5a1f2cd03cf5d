"""Robots and worlds for the tests of Gazebo's part."""

import pytest

from rosmini.msgs import message_class, service_class
from rosmini.sim.gazebo.server import GazeboServer

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


def urdf(extensions=DIFF_DRIVE + LASER, axle=0.0):
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


HUSKY_WHEEL = """
<link name="{name}"><inertial><mass value="2"/>
  <inertia ixx="0.02" iyy="0.02" izz="0.02" ixy="0" ixz="0" iyz="0"/></inertial>
  <collision><geometry><cylinder radius="0.165" length="0.11"/></geometry></collision></link>
<joint name="{name}_joint" type="continuous"><parent link="base_link"/><child link="{name}"/>
  <origin xyz="{x} {y} 0.165" rpy="-1.5707963267948966 0 0"/><axis xyz="0 0 1"/></joint>"""


def husky(extra=""):
    """A box on four wheels, as a Husky has them; the middle of the wheels is 0.1 m ahead of its origin."""
    wheels = "".join(
        HUSKY_WHEEL.format(name=f"{end}_{side}", x=0.1 + x, y=y)
        for end, x in (("front", 0.256), ("rear", -0.256))
        for side, y in (("left", 0.2854), ("right", -0.2854))
    )
    joints = "".join(
        f"<{side}{end.title()}Joint>{end}_{side}_joint</{side}{end.title()}Joint>"
        for side in ("left", "right")
        for end in ("front", "rear")
    )
    return f"""<robot name="husky"><link name="base_link"><inertial><mass value="33"/>
      <inertia ixx="0.6" iyy="1.5" izz="1.6" ixy="0" ixz="0" iyz="0"/></inertial>
      <collision><origin xyz="0.1 0 0.3"/><geometry><box size="0.98 0.57 0.25"/></geometry></collision></link>{wheels}
      <gazebo><plugin name="skid_steer" filename="libgazebo_ros_skid_steer_drive.so">{joints}
        <wheelSeparation>0.5708</wheelSeparation><wheelDiameter>0.33</wheelDiameter><updateRate>50</updateRate>
        <robotBaseFrame>base_link</robotBaseFrame>{extra}</plugin></gazebo></robot>"""


def box(name="box", *, static=False, extra="", size=0.4, mass=2.0):
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

    def __init__(self, graph, *args, **options):
        self.graph = graph
        self.server = GazeboServer(graph.node("gazebo"), *args, **options)
        self.node = graph.node("tester")

    def call(self, service, kind, **fields):
        """What a service of /gazebo answers."""
        return self.node.service_client(f"/gazebo/{service}", service_class(kind))(**fields)

    def spawn(self, xml, name, x=0.0, y=0.0, yaw=0.0, **fields):
        """Spawn what a URDF or an SDF describes."""
        import math

        pose = message_class("geometry_msgs/Pose")()
        pose.position.x, pose.position.y = x, y
        pose.orientation.z, pose.orientation.w = math.sin(yaw / 2), math.cos(yaw / 2)
        kind = "urdf" if "<robot" in xml else "sdf"
        return self.call(
            f"spawn_{kind}_model", "gazebo_msgs/SpawnModel", model_name=name, model_xml=xml, initial_pose=pose, **fields
        )

    def drive(self, topic, v, w=0.0, vy=0.0):
        """Publish a velocity once."""
        twist = message_class("geometry_msgs/Twist")
        publisher = self.node.publisher(topic, twist)
        publisher.wait_for_subscribers()
        message = twist()
        message.linear.x, message.linear.y, message.angular.z = v, vy, w
        publisher.publish(message)

    def hear(self, topic, kind):
        """The messages of a topic, as they come."""
        heard = []
        self.node.subscriber(topic, message_class(kind), heard.append)
        return heard

    def pose(self, name):
        """Where a model is."""
        return self.server.truth(name)


@pytest.fixture
def bench(graph):
    """Start a server with these arguments; without any in an empty world."""

    def start(*args, **options):
        return Bench(graph, *(args or ("empty",) if not options else args), **options)

    return start
