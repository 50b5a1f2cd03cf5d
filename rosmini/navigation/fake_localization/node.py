"""`fake_localization/fake_localization` (http://wiki.ros.org/fake_localization).

It replaces amcl in a simulator, where the true pose is known: from `base_pose_ground_truth` it computes the pose of
odom in the map, on `/tf`, and the robot's pose, on `amcl_pose` and `particlecloud`. A pose on `initialpose` (RViz's
*2D Pose Estimate*) moves the map so that the robot is there.
"""

from __future__ import annotations

from collections import deque
from dataclasses import dataclass
from typing import Any

from rosmini.core.graph import MessageFactory, Node
from rosmini.core.parameters import Parameters, parameter
from rosmini.core.tf import TransformBroadcaster, TransformException, TransformListener
from rosmini.core.tf.broadcaster import resolve, tf_prefix
from rosmini.core.tf.messages import from_pose, set_pose
from rosmini.core.tf.rigid import Rigid, compose, from_yaw, inverse
from rosmini.core.time import Duration
from rosmini.msgs import message_class

MAX_WAITING = 100
"""Maximum number of true poses that wait for the odometry's transform."""


@dataclass(frozen=True)
class FakeLocalizationParameters(Parameters):
    """The private parameters of `fake_localization/fake_localization`."""

    odom_frame_id: str = parameter("odom", "the frame of the odometry")
    base_frame_id: str = parameter("base_link", "the frame of the robot's base")
    global_frame_id: str = parameter("map", "the frame of the map")
    delta_x: float = parameter(0.0, "x of the map's origin in the frame of the true poses", unit="m")
    delta_y: float = parameter(0.0, "y of the map's origin in the frame of the true poses", unit="m")
    delta_yaw: float = parameter(0.0, "heading of the map's origin in the frame of the true poses", unit="rad")
    transform_tolerance: float = parameter(
        0.1, "how far the transform from map to odom is dated in the future", unit="s"
    )


class FakeLocalization:
    """The node `fake_localization`: publishes the robot's true pose on the topics of amcl."""

    def __init__(self, node: Node) -> None:
        self.node = node
        own = FakeLocalizationParameters.read(node)
        prefix = tf_prefix(node)
        self.map_frame, self.odom_frame, self.base_frame = (
            resolve(prefix, frame) for frame in (own.global_frame_id, own.odom_frame_id, own.base_frame_id)
        )
        self._tolerance = Duration.from_sec(own.transform_tolerance)
        self._offset = from_yaw(-own.delta_x, -own.delta_y, -own.delta_yaw)
        """The transform applied to true poses. As in the original, each delta is subtracted separately."""
        self._waiting: deque[Any] = deque(maxlen=MAX_WAITING)
        self.buffer = TransformListener(node).buffer
        self._broadcaster = TransformBroadcaster(node)
        posed = message_class("geometry_msgs/PoseWithCovarianceStamped")
        self._pose = node.publisher("amcl_pose", posed, queue_size=1, latch=True)
        self._cloud_type = message_class("geometry_msgs/PoseArray")
        self._cloud = node.publisher("particlecloud", self._cloud_type, queue_size=1, latch=True)
        self._pose_type = posed
        odometry = message_class("nav_msgs/Odometry")
        self.buffer.watch(self._catch_up)
        node.subscriber("base_pose_ground_truth", odometry, self._on_truth, queue_size=MAX_WAITING)
        node.subscriber("initialpose", posed, self._on_initial_pose, queue_size=1)

    def _on_truth(self, message: Any) -> None:
        """Queue a true pose, which may have to wait for the odometry's transform at its time."""
        self._waiting.append(message)
        self._catch_up()

    def _catch_up(self) -> None:
        """Publish the newest pose whose transform is known, and drop older ones."""
        for index in reversed(range(len(self._waiting))):
            message = self._waiting[index]
            stamp = message.header.stamp.to_nsec()
            if self.buffer.tree.knows(self.odom_frame, self.base_frame, stamp):
                for _ in range(index + 1):
                    self._waiting.popleft()
                self._localize(message, stamp)
                return

    def _localize(self, message: Any, stamp: int) -> None:
        base = compose(self._offset, from_pose(message.pose.pose))
        odom = self.buffer.tree.lookup(self.odom_frame, self.base_frame, stamp).transform
        odom_in_map = compose(base, inverse(odom))
        self._broadcaster.send_rigid(
            self.map_frame, self.odom_frame, odom_in_map, message.header.stamp + self._tolerance
        )
        self._publish(message, base)

    def _publish(self, message: Any, base: Rigid) -> None:
        stamp, frame = message.header.stamp, self.map_frame

        def posed() -> Any:
            found = self._pose_type()
            found.header.stamp, found.header.frame_id = stamp, frame
            set_pose(found.pose.pose, base)
            return found

        def cloud() -> Any:
            found = self._cloud_type(poses=[posed().pose.pose])
            found.header.stamp, found.header.frame_id = stamp, frame
            return found

        self._pose.publish(MessageFactory(posed))
        self._cloud.publish(MessageFactory(cloud))

    def _on_initial_pose(self, message: Any) -> None:
        frame = message.header.frame_id.lstrip("/")
        if frame != self.map_frame:
            self.node.logwarn(
                f'Frame ID of "initialpose" ({frame}) is different from the global frame {self.map_frame}'
            )
        try:
            # Use the latest transform: the one at the time of the message may no longer be available.
            base = self.buffer.tree.lookup(self.map_frame, self.base_frame, 0).transform
        except TransformException as error:
            self.node.logwarn(f"Failed to lookup transform! {error}")
            return
        self._offset = compose(compose(from_pose(message.pose.pose), inverse(base)), self._offset)
