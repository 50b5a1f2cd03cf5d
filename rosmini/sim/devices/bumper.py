"""Contacts of a robot, as Gazebo's bumper plugin reports them."""

from __future__ import annotations

from typing import Any

from rosmini.msgs import message_class
from rosmini.sim.host import Host

from .sensor import Sensor


class Bumper(Sensor):
    """`gazebo_msgs/ContactsState`: one state for each object touched, with positions, normals and forces.

    Args:
        host: the simulated world.
        robot: the engine's name of the robot that carries it.
        topic: where it is published.
        frame: the world's frame, in which everything is published.
        rate: messages per second [Hz].
        collision: the name of its own collision in the messages; the robot's name if not given.
        height: height of the contacts above the ground [m].
        name: the device's name; robot/bumper if not given.

    """

    message_type = "gazebo_msgs/ContactsState"
    default_topic, default_frame, label = "bumper_states", "world", "bumper"
    default_rate = 50.0
    order = 75.0
    varying = ("states",)

    def __init__(
        self,
        host: Host,
        robot: str,
        *,
        topic: str | None = None,
        frame: str | None = None,
        rate: float | None = None,
        collision: str | None = None,
        height: float = 0.0,
        name: str | None = None,
    ) -> None:
        super().__init__(host, robot, topic=topic, frame=frame, rate=rate, name=name)
        self._collision = collision or robot
        self._height = height

    def sample(self, _: int) -> tuple[list[Any]]:
        """Return the contact states as the value of the message's only varying field."""
        return (self.states(),)

    def states(self) -> list[Any]:
        """Return the current contacts: `gazebo_msgs/ContactState`s, in the engine's order."""
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
