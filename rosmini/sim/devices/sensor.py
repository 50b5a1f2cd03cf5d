"""Common parts of all sensors. A new sensor is one class in one file, see `Sensor`."""

from __future__ import annotations

from abc import abstractmethod
from collections.abc import Sequence
from functools import partial
from typing import Any, ClassVar

from rosmini.core.graph import MessageFactory, Node
from rosmini.msgs import message_class
from rosmini.msgs.template import template
from rosmini.sim.host import Device, Host, Stamp

STAMP = ("header.stamp.secs", "header.stamp.nsecs")


class Outlet:
    """A topic of a device.

    Each message is a copy of `message`, as it was on creation, with other values of the fields `varying` and, if it has
    a header, another stamp.
    """

    def __init__(
        self, node: Node, topic: str, message: Any, varying: Sequence[str] = (), *, queue_size: int = 10
    ) -> None:
        self.publisher = node.publisher(topic, type(message), queue_size=queue_size)
        self.num_connections = self.publisher.num_connections
        """Returns the number of subscribers."""
        self._stamped = bool(message._has_header)
        self.make = template(message, *(STAMP if self._stamped else ()), *varying)
        """Makes a message from the seconds and nanoseconds of its stamp and the values of the varying fields."""

    def publish(self, stamp: Stamp, values: Sequence[Any] = ()) -> None:
        """Publish a message with the values of the varying fields."""
        varying = (*stamp, *values) if self._stamped else values
        self.publisher.publish(MessageFactory(partial(self.make, *varying), is_frozen=True))

    def close(self) -> None:
        """Close the topic."""
        self.publisher.unregister()


class Sensor(Device):
    """A device that measures and publishes its samples. Derive from it to make a new one.

    The class declares the message, the topic, the rate, and its order among devices that are due at the same instant;
    `describe` fills in the fields that never change, and `sample` returns those that do. Add it to a simulated robot
    with `simulator.robot().add(Odometer)`.

    >>> class Odometer(Sensor):
    ...     message_type = "std_msgs/Float64"
    ...     default_topic = "odometer"
    ...     default_rate = 2.0
    ...     varying = ("data",)
    ...
    ...     def sample(self, number):
    ...         return [abs(self.robot.left_distance + self.robot.right_distance) / 2]

    Args:
        host: the simulated world.
        robot: the engine's name of the robot; None for a sensor that does not measure a robot.
        topic: where it is published; `default_topic` if not given.
        frame: the frame of the header; `default_frame` if not given.
        rate: samples a second [Hz]; `default_rate` if not given.
        name: the name for saved states and for the random generator; robot/`label` if not given.

    """

    always = False
    message_type: ClassVar[str]
    default_topic: ClassVar[str]
    default_rate: ClassVar[float]
    default_frame: ClassVar[str] = ""
    label: ClassVar[str] = ""
    """End of its name; the default topic if empty."""
    varying: ClassVar[tuple[str, ...]] = ()
    """The fields whose values `sample` returns."""
    queue_size: ClassVar[int] = 10

    def __init__(
        self,
        host: Host,
        robot: str | None,
        *,
        topic: str | None = None,
        frame: str | None = None,
        rate: float | None = None,
        name: str | None = None,
    ) -> None:
        super().__init__(host, name or f"{robot}/{self.label or self.default_topic}", rate or self.default_rate)
        if robot is not None:
            self.robot = host.engine.robot(robot)
        message: Any = message_class(self.message_type)()
        if message._has_header:
            message.header.frame_id = self.default_frame if frame is None else frame
        self.describe(message)
        topic = self.default_topic if topic is None else topic
        self.outlet = Outlet(host.node, topic, message, self.varying, queue_size=self.queue_size)

    def describe(self, message: Any) -> None:
        """Fill in the fields that are the same in all messages; called once, on creation."""

    @abstractmethod
    def sample(self, number: int) -> Sequence[Any] | None:
        """Return the values of the `varying` fields in the sample of this number, counted from 1.

        Return None for no sample.
        """

    def wanted(self) -> bool:
        """Return True if the topic has a subscriber; otherwise no sample is taken."""
        return self.outlet.num_connections() > 0

    def due(self, stamp: Stamp, number: int, /) -> None:
        """Publish a sample."""
        values = self.sample(number)
        if values is not None:
            self.outlet.publish(stamp, values)

    def close(self) -> None:
        """Close the topic."""
        self.outlet.close()
