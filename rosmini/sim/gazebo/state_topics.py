"""States as ROS topics: ~model_states and ~link_states are published, ~set_model_state and ~set_link_state received."""

from __future__ import annotations

from collections.abc import Callable, Iterable
from types import SimpleNamespace
from typing import Any

from rosmini.core.graph import Node
from rosmini.msgs import message_class
from rosmini.sim.host import Device, Host, Stamp
from rosmini.sim.sdf import Pose6

from .model import GazeboWorld, Velocity
from .services import Services, pose_message, twist_message

Entry = tuple[str, Pose6, Velocity]


class _States(Device):
    """One of the two topics; published only while it has a subscriber, as in gazebo_ros."""

    always = False

    def __init__(self, host: Host, world: GazeboWorld, topic: str, kind: str, rate: float) -> None:
        super().__init__(host, topic, rate)
        self._world = world
        self._class: Any = message_class(kind)
        self._publisher = host.node.publisher(topic, self._class, queue_size=10)

    def wanted(self) -> bool:
        return bool(self._publisher.num_connections())

    def entries(self) -> Iterable[Entry]:
        return [(model.name, model.pose, model.velocity) for model in self._world.models.values()]

    def due(self, _: Stamp, __: int, /) -> None:
        message = self._class()
        for name, pose, velocity in self.entries():
            message.name.append(name)
            message.pose.append(pose_message(pose))
            message.twist.append(twist_message(velocity))
        self._publisher.publish(message)

    def close(self) -> None:
        self._publisher.unregister()


class _LinkStates(_States):
    def entries(self) -> Iterable[Entry]:
        for model in self._world.models.values():
            for link in model.links:
                yield f"{model.name}::{link}", model.link_pose(link), model.link_velocity(link)


class StateTopics:
    """The two topics of states, published `rate` times a second, and the two that set states."""

    def __init__(self, world: GazeboWorld, services: Services, rate: float) -> None:
        host, node = world.host, world.node
        for name, kind, handler in (
            ("~set_model_state", "ModelState", services.set_model_state),
            ("~set_link_state", "LinkState", services.set_link_state),
        ):
            node.subscriber(name, message_class(f"gazebo_msgs/{kind}"), _callback(node, kind, handler))
        host.add(_States(host, world, "~model_states", "gazebo_msgs/ModelStates", rate))
        host.add(_LinkStates(host, world, "~link_states", "gazebo_msgs/LinkStates", rate))


def _callback(node: Node, kind: str, handler: Callable[[Any], dict[str, Any]]) -> Callable[[Any], None]:
    """Return a callback that handles a message like the service's request and logs a refusal."""
    field = {"ModelState": "model_state", "LinkState": "link_state"}[kind]

    def take(message: Any) -> None:
        answer = handler(SimpleNamespace(**{field: message}))
        if not answer["success"]:
            node.logerr(answer["status_message"])

    return take
