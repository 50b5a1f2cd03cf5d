"""What a robot touches, as Gazebo's bumper tells it."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

from rosmini.msgs import message_class
from rosmini.sim.host import Device, Host, Stamp
from rosmini.sim.messages import Headed

from .names import order

if TYPE_CHECKING:
    from rosmini.sim.engine.robot import Robot


class Bumper(Device):
    """`gazebo_msgs/ContactsState`: one state for each thing that is touched, with places, normals and forces.

    Args:
        host: where it happens.
        robot: the engine's name of what carries it.
        topic: where it is published.
        frame: what the header says, and in which all is told: the world's.
        rate: how often [Hz].
        collision: how its own collision is called in the messages; without it the robot's name.
        height: how high above the ground it is touched [m].
        name: the device's; without it robot/bumper.

    """

    order = order("bumper")
    always = False

    def __init__(
        self,
        host: Host,
        robot: str,
        *,
        topic: str = "bumper_states",
        frame: str = "world",
        rate: float = 50.0,
        collision: str | None = None,
        height: float = 0.0,
        name: str | None = None,
    ) -> None:
        super().__init__(host, name or f"{robot}/bumper", rate)
        self.robot: Robot = host.engine.robot(robot)
        self._collision = collision or robot
        self._height = height
        self._told = Headed("gazebo_msgs/ContactsState", frame)
        self._publisher = host.node.publisher(topic, type(self._told.message), queue_size=10)

    def wanted(self) -> bool:
        """Tell whether anybody listens."""
        return self._publisher.num_connections() > 0

    def due(self, stamp: Stamp, _: int, /) -> None:
        """Tell what it touches."""
        self._told.message.states = self.states()
        self._told.stamp(*stamp)
        self._publisher.publish(self._told.message)

    def states(self) -> list[Any]:
        """What is touched now: `gazebo_msgs/ContactState`s, in the sequence in which the engine finds them."""
        state, wrench, vector = (
            message_class(kind)
            for kind in ("gazebo_msgs/ContactState", "geometry_msgs/Wrench", "geometry_msgs/Vector3")
        )
        found: dict[str, Any] = {}
        x, y, _ = self.robot.pose
        for touch in self.host.engine.touching(self.robot.name):
            one = found.setdefault(
                touch.other,
                state(
                    info=f"{self._collision} touches {touch.other}",
                    collision1_name=self._collision,
                    collision2_name=touch.other,
                ),
            )
            fx, fy = touch.force * touch.nx, touch.force * touch.ny
            push = wrench()
            push.force.x, push.force.y = fx, fy
            push.torque.z = (touch.x - x) * fy - (touch.y - y) * fx
            total = one.total_wrench
            total.force.x, total.force.y = total.force.x + fx, total.force.y + fy
            total.torque.z += push.torque.z
            one.wrenches.append(push)
            one.contact_positions.append(vector(x=touch.x, y=touch.y, z=self._height))
            one.contact_normals.append(vector(x=touch.nx, y=touch.ny, z=0.0))
            one.depths.append(0.0)
        for one in found.values():
            one.info += f" at {len(one.depths)} point{'s' * (len(one.depths) != 1)}"
        return list(found.values())

    def close(self) -> None:
        """End the topic."""
        self._publisher.unregister()
