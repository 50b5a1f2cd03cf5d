"""Where all is, as ROS topics: ~model_states and ~link_states out, ~set_model_state and ~set_link_state in."""

from __future__ import annotations

from collections.abc import Iterable
from typing import Any

from rosmini.msgs import message_class
from rosmini.sim.host import Device, Host, Stamp
from rosmini.sim.sdf import Pose6

from .model import Velocity
from .msgs import quaternion
from .world import GazeboWorld

Entry = tuple[str, Pose6, Velocity]


class _States(Device):
    """One of the two topics; told only while somebody hears it, as in gazebo_ros."""

    always = False

    def __init__(self, host: Host, world: GazeboWorld, topic: str, kind: str, rate: float) -> None:
        super().__init__(host, topic, rate)
        self._world = world
        self._class: Any = message_class(kind)
        self._pose: Any = message_class("geometry_msgs/Pose")
        self._twist: Any = message_class("geometry_msgs/Twist")
        self._publisher = host.node.publisher(topic, self._class, queue_size=10)

    def wanted(self) -> bool:
        return bool(self._publisher.num_connections())

    def entries(self) -> Iterable[Entry]:
        return [(model.name, model.pose, model.velocity) for model in self._world.models.values()]

    def due(self, _: Stamp, __: int, /) -> None:
        message = self._class()
        for name, pose, velocity in self.entries():
            message.name.append(name)
            message.pose.append(self._pose_message(pose))
            twist = self._twist()
            twist.linear.x, twist.linear.y, twist.angular.z = velocity
            message.twist.append(twist)
        self._publisher.publish(message)

    def _pose_message(self, pose: Pose6) -> Any:
        message = self._pose()
        at, to = message.position, message.orientation
        at.x, at.y, at.z, *turn = pose
        to.x, to.y, to.z, to.w = quaternion(turn[0], turn[1], turn[2])
        return message

    def close(self) -> None:
        self._publisher.unregister()


class _LinkStates(_States):
    def entries(self) -> Iterable[Entry]:
        for model in self._world.models.values():
            for link in model.links:
                yield f"{model.name}::{link}", model.link_pose(link), model.link_velocity(link)


class StateTopics:
    """The two topics of states of a world, `rate` times a second."""

    def __init__(self, world: GazeboWorld, rate: float) -> None:
        host = world.host
        host.add(_States(host, world, "~model_states", "gazebo_msgs/ModelStates", rate))
        host.add(_LinkStates(host, world, "~link_states", "gazebo_msgs/LinkStates", rate))
