"""`hector_imu_attitude_to_tf/imu_attitude_to_tf_node`: the roll and pitch of an IMU, on tf.

A laser that leans sees the floor and the ceiling. A frame that stays level under the robot (`base_stabilized`) lets
`hector_mapping`, which knows no IMU, see where its beams really ended.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING, Any

from rosmini.core.parameters import Parameters, parameter
from rosmini.core.tf import TransformBroadcaster, TransformException
from rosmini.core.tf.rigid import Rigid, from_rpy, rigid, rpy
from rosmini.msgs import message_class

if TYPE_CHECKING:
    from rosmini.core.graph import Node


@dataclass(frozen=True)
class AttitudeParameters(Parameters):
    """The private parameters."""

    base_stabilized_frame: str = parameter("base_stabilized_frame", "the frame that stays level")
    base_frame: str = parameter("base_frame", "the robot's frame, which leans")


def leaning(x: float, y: float, z: float, w: float) -> Rigid:
    """An orientation without its heading. Raises `InvalidArgumentException` for a quaternion that is none."""
    roll, pitch, _ = rpy(rigid((0.0, 0.0, 0.0), (x, y, z, w)))
    return from_rpy((0.0, 0.0, 0.0), roll, pitch, 0.0)


class ImuAttitudeToTf:
    """Says with each message of `imu_topic` how the robot's frame leans in the level one."""

    def __init__(self, node: Node) -> None:
        self.node = node
        self.parameters = AttitudeParameters.read(node)
        self.broadcaster = TransformBroadcaster(node)
        node.subscriber("imu_topic", message_class("sensor_msgs/Imu"), self._hear, queue_size=10)

    def _hear(self, message: Any) -> None:
        p, q = self.parameters, message.orientation
        try:
            found = leaning(q.x, q.y, q.z, q.w)
        except TransformException as error:
            self.node.logwarn(f"an attitude of {message.header.frame_id} is left out: {error}", throttle=5.0)
            return
        self.broadcaster.send_rigid(p.base_stabilized_frame, p.base_frame, found, message.header.stamp)
