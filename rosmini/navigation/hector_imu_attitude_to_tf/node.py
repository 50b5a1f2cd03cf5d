"""`hector_imu_attitude_to_tf/imu_attitude_to_tf_node`: the roll and pitch of an IMU, on tf.

A tilted laser sees the floor and the ceiling. A frame that stays level under the robot (`base_stabilized`) allows
`hector_mapping`, which does not use an IMU, to determine the true beam ends.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any

from rosmini.core.graph import Node
from rosmini.core.parameters import Parameters, parameter
from rosmini.core.tf import TransformBroadcaster, TransformException
from rosmini.core.tf.rigid import Rigid, from_rpy, rigid, rpy
from rosmini.msgs import message_class


@dataclass(frozen=True)
class AttitudeParameters(Parameters):
    """The private parameters of `imu_attitude_to_tf_node`."""

    base_stabilized_frame: str = parameter("base_stabilized_frame", "the frame that stays level")
    base_frame: str = parameter("base_frame", "the robot's frame, which tilts")


def tilt_of(x: float, y: float, z: float, w: float) -> Rigid:
    """Return the rotation with the roll and pitch, but not the yaw, of a quaternion x, y, z, w.

    Raises `InvalidArgumentException` for an invalid quaternion.
    """
    roll, pitch, _ = rpy(rigid((0.0, 0.0, 0.0), (x, y, z, w)))
    return from_rpy((0.0, 0.0, 0.0), roll, pitch, 0.0)


class ImuAttitudeToTf:
    """Publishes, for each message on `imu_topic`, the tilt of the robot's frame relative to the level frame."""

    def __init__(self, node: Node) -> None:
        self.node = node
        self.parameters = AttitudeParameters.read(node)
        self.broadcaster = TransformBroadcaster(node)
        node.subscriber("imu_topic", message_class("sensor_msgs/Imu"), self._on_imu, queue_size=10)

    def _on_imu(self, message: Any) -> None:
        p, q = self.parameters, message.orientation
        try:
            found = tilt_of(q.x, q.y, q.z, q.w)
        except TransformException as error:
            self.node.logwarn(f"an attitude of {message.header.frame_id} is ignored: {error}", throttle=5.0)
            return
        self.broadcaster.send_rigid(p.base_stabilized_frame, p.base_frame, found, message.header.stamp)
