"""The module that scripts import as ``tf`` (http://wiki.ros.org/tf): the older API for transforms, with lists.

``tf.broadcaster`` and ``tf.listener`` are this module too. A leading ``/`` of a frame name is removed, as tf has done
since it uses tf2.
"""

from __future__ import annotations

import sys
from collections.abc import Iterable, Sequence
from typing import Any

from rosmini.core import tf
from rosmini.core.lazy import np
from rosmini.core.tf import transformations
from rosmini.core.tf.broadcaster import tf_prefix
from rosmini.core.tf.errors import ConnectivityException, ExtrapolationException, LookupException, TransformException
from rosmini.core.tf.messages import to_stamped
from rosmini.core.tf.rigid import Floats, compose, rotate, transform_points
from rosmini.core.time import Duration, Time
from rosmini.msgs.tf import msg, srv
from rosmini.ros.rospy.aliases.tf2_ros import Buffer
from rosmini.ros.rospy.aliases.tf2_ros.buffer_interface import moved
from rosmini.ros.rospy.rostime import Time as RospyTime
from rosmini.ros.rospy.session import require_node

__all__ = [
    "ConnectivityException",
    "Exception",
    "ExtrapolationException",
    "LookupException",
    "TransformBroadcaster",
    "TransformListener",
    "Transformer",
    "TransformerROS",
    "msg",
    "srv",
    "transformations",
]

Exception = TransformException
broadcaster = listener = sys.modules[__name__]

FIRST_NS = 100_000
"""Earliest start of the window of ``lookupTwist`` [ns]."""

Pair = tuple[list[float], list[float]]


def _bare(frame: str) -> str:
    return frame.removeprefix("/")


class Transformer:
    """A buffer of transforms that are set and looked up; quaternions are x, y, z, w."""

    def __init__(self, interpolate: bool = True, cache_time: Duration | None = None) -> None:
        del interpolate  # tf2 always does
        self._buffer = Buffer(cache_time)
        self._may_wait = False

    def setTransform(self, transform: Any, authority: str = "default_authority") -> None:
        """Add a ``geometry_msgs/TransformStamped``."""
        self._buffer.set_transform(transform, authority)

    def canTransform(self, target_frame: str, source_frame: str, time: Time) -> bool:
        """Return True if a lookup would succeed."""
        return self._buffer.can_transform_core(_bare(target_frame), _bare(source_frame), time)[0]

    def canTransformFull(
        self, target_frame: str, target_time: Time, source_frame: str, source_time: Time, fixed_frame: str
    ) -> bool:
        """Return True if a lookup with a fixed frame would succeed."""
        return self._buffer.can_transform_full_core(
            _bare(target_frame), target_time, _bare(source_frame), source_time, _bare(fixed_frame)
        )[0]

    def waitForTransform(
        self,
        target_frame: str,
        source_frame: str,
        time: Time,
        timeout: Duration,
        polling_sleep_duration: Duration | None = None,
    ) -> None:
        """Block until a lookup would succeed. Raises ``tf.Exception`` with the reason after ``timeout``.

        Only a listener may wait, or after ``setUsingDedicatedThread(True)``, as in tf.
        """
        del polling_sleep_duration  # each arriving transform is checked
        self._check_thread()
        verdict = self._buffer.can_transform(_bare(target_frame), _bare(source_frame), time, timeout, True)
        _require(verdict)

    def waitForTransformFull(
        self,
        target_frame: str,
        target_time: Time,
        source_frame: str,
        source_time: Time,
        fixed_frame: str,
        timeout: Duration,
        polling_sleep_duration: Duration | None = None,
    ) -> None:
        """Block until a lookup with a fixed frame would succeed. Raises ``tf.Exception``."""
        del polling_sleep_duration
        self._check_thread()
        names = _bare(target_frame), target_time, _bare(source_frame), source_time, _bare(fixed_frame)
        _require(self._buffer.can_transform_full(*names, timeout, True))

    def lookupTransform(self, target_frame: str, source_frame: str, time: Time) -> Pair:
        """Return the pose of ``source_frame`` in ``target_frame``: translation [m], quaternion. Raises as tf2 does."""
        return _pair(self._buffer.lookup_transform_core(_bare(target_frame), _bare(source_frame), time))

    def lookupTransformFull(
        self, target_frame: str, target_time: Time, source_frame: str, source_time: Time, fixed_frame: str
    ) -> Pair:
        """Look up a transform between two times through ``fixed_frame``."""
        names = _bare(target_frame), target_time, _bare(source_frame), source_time, _bare(fixed_frame)
        return _pair(self._buffer.lookup_transform_full_core(*names))

    def lookupTwist(
        self, tracking_frame: str, observation_frame: str, time: Time, averaging_interval: Duration
    ) -> Pair:
        """Return a frame's velocity in another: linear [m/s] and angular [rad/s], averaged around ``time``.

        As in tf, the window ends at the latest transform and does not begin before 0.1 ms. Raises the errors of
        ``lookupTransform``.
        """
        tree = self._buffer.tree
        tracked, observer = _bare(tracking_frame), _bare(observation_frame)
        latest = tree.latest_common_time(observer, tracked)
        interval, wanted = averaging_interval.to_nsec(), time.to_nsec() or latest
        tree.lookup(observer, tracked, wanted)  # outside the buffer there is no velocity
        end = min(wanted + interval // 2, latest)
        begin = max(end - interval, FIRST_NS)
        first, last = (tree.lookup(observer, tracked, when).transform for when in (begin, end))
        span = (end - begin) / 1e9
        turn = compose((0.0, 0.0, 0.0, *last[3:]), (0.0, 0.0, 0.0, -first[3], -first[4], -first[5], first[6]))
        angle, axis, _ = transformations.rotation_from_matrix(transformations.quaternion_matrix(turn[3:]))
        linear = [(b - a) / span for a, b in zip(first[:3], last[:3], strict=True)]
        return linear, [float(part) * angle / span for part in axis]

    def lookupTwistFull(
        self,
        tracking_frame: str,
        observation_frame: str,
        reference_frame: str,
        reference_point: Sequence[float],
        reference_point_frame: str,
        time: Time,
        averaging_interval: Duration,
    ) -> Pair:
        """Return the velocity of a point [m] on ``tracking_frame`` in ``observation_frame``, in ``reference_frame``.

        As http://wiki.ros.org/tf defines it; ROS's Python version ignores the point.
        """
        linear, angular = self.lookupTwist(tracking_frame, observation_frame, time, averaging_interval)
        tree, reference, tracked = self._buffer.tree, _bare(reference_frame), _bare(tracking_frame)
        when = time.to_nsec() or tree.latest_common_time(_bare(observation_frame), tracked)
        seen = tree.lookup(reference, _bare(observation_frame), when).transform
        turn = rotate(seen, angular)
        origin = tree.lookup(reference, tracked, when).transform[:3]
        placed = tree.lookup(reference, _bare(reference_point_frame), when).transform
        arm = transform_points(placed, reference_point) - origin
        return (rotate(seen, linear) + np.cross(turn, arm)).tolist(), turn.tolist()

    def getLatestCommonTime(self, source_frame: str, dest_frame: str) -> RospyTime:
        """Return the latest time for which the transform between two frames is known."""
        found = self._buffer.get_latest_common_time(_bare(source_frame), _bare(dest_frame))
        return RospyTime.from_nsec(found.to_nsec())

    def chain(
        self, target_frame: str, target_time: Time, source_frame: str, source_time: Time, fixed_frame: str
    ) -> list[str]:
        """Return the frames on the path from source to target through ``fixed_frame``."""
        names = _bare(target_frame), target_time.to_nsec(), _bare(source_frame), source_time.to_nsec()
        return self._buffer.tree.chain_full(*names, _bare(fixed_frame))

    def frameExists(self, frame_id: str) -> bool:
        """Return True if a frame is known and has a parent: for tf, a root frame does not exist."""
        return frame_id in self._buffer.tree.edges

    def getFrameStrings(self) -> list[str]:
        """Return the names of all frames that have a parent, as tf does."""
        return list(self._buffer.tree.edges)

    def allFramesAsString(self) -> str:
        """Return a sentence for each edge."""
        return self._buffer.all_frames_as_string()

    def allFramesAsDot(self, current_time: Any = None) -> str:
        """Return the tree in graphviz format."""
        del current_time
        return self._buffer.all_frames_as_dot()

    def clear(self) -> None:
        """Discard all transforms that are not static."""
        self._buffer.clear()

    def setUsingDedicatedThread(self, value: bool) -> None:
        """Set whether ``waitForTransform`` may wait: True says that transforms arrive meanwhile."""
        self._may_wait = value

    def _check_thread(self) -> None:
        if not self._may_wait:
            raise TransformException(
                "cannot wait for a transform without a dedicated thread that receives transforms: use a "
                "tf.TransformListener, or call setUsingDedicatedThread(True) if another thread sets them"
            )

    def getTFPrefix(self) -> str:
        """Return the parameter ``tf_prefix`` nearest upwards from the node; empty if it is not set."""
        return tf_prefix(self._buffer.node)


class TransformerROS(Transformer):
    """Transforms stamped messages from the frame in their header to another."""

    def asMatrix(self, target_frame: str, hdr: Any) -> Floats:
        """Return the matrix (4, 4) that transforms points from the header's frame to ``target_frame`` at its time."""
        return self.fromTranslationRotation(*self.lookupTransform(target_frame, hdr.frame_id, hdr.stamp))

    def fromTranslationRotation(self, translation: Any, rotation: Any) -> Floats:
        """Return the matrix (4, 4) of a translation and a quaternion."""
        return transformations.concatenate_matrices(
            transformations.translation_matrix(translation), transformations.quaternion_matrix(rotation)
        )

    def _moved(self, target_frame: str, message: Any) -> Any:
        header = message.header
        found = self._buffer.lookup_transform_core(_bare(target_frame), _bare(header.frame_id), header.stamp)
        result = moved(message, found)
        result.header.frame_id, result.header.stamp = target_frame, header.stamp
        return result

    def transformPoint(self, target_frame: str, ps: Any) -> Any:
        """Return a ``geometry_msgs/PointStamped`` in another frame."""
        return self._moved(target_frame, ps)

    def transformVector3(self, target_frame: str, v3s: Any) -> Any:
        """Return a ``geometry_msgs/Vector3Stamped`` in another frame: rotated, not translated."""
        return self._moved(target_frame, v3s)

    def transformQuaternion(self, target_frame: str, ps: Any) -> Any:
        """Return a ``geometry_msgs/QuaternionStamped`` in another frame."""
        return self._moved(target_frame, ps)

    def transformPose(self, target_frame: str, ps: Any) -> Any:
        """Return a ``geometry_msgs/PoseStamped`` in another frame."""
        return self._moved(target_frame, ps)

    def transformPointCloud(self, target_frame: str, point_cloud: Any) -> Any:
        """Return a ``sensor_msgs/PointCloud`` in another frame."""
        return self._moved(target_frame, point_cloud)


class TransformListener(TransformerROS):
    """Receives ``/tf`` and ``/tf_static`` with the script's node. Raises ``ROSInitException`` before ``init_node``."""

    def __init__(self, interpolate: bool = True, cache_time: Duration | None = None) -> None:
        super().__init__(interpolate, cache_time)
        self.setUsingDedicatedThread(True)
        self._listener = tf.TransformListener(require_node("tf.TransformListener"), self._buffer)

    def unregister(self) -> None:
        """Stop receiving transforms."""
        self._listener.unregister()


def _pair(stamped: Any) -> Pair:
    move, turn = stamped.transform.translation, stamped.transform.rotation
    return [move.x, move.y, move.z], [turn.x, turn.y, turn.z, turn.w]


def _require(verdict: Any) -> None:
    answers, reason = verdict
    if not answers:
        raise TransformException(reason)


class TransformBroadcaster:
    """Sends transforms on ``/tf``. Raises ``ROSInitException`` before ``init_node``."""

    def __init__(self, queue_size: int = 100) -> None:
        self._broadcaster = tf.TransformBroadcaster(require_node("tf.TransformBroadcaster"), queue_size=queue_size)

    def sendTransform(
        self, translation: Iterable[float], rotation: Iterable[float], time: Time, child: str, parent: str
    ) -> None:
        """Send the pose of ``child`` in ``parent``: translation [m] and quaternion (x, y, z, w), unchanged."""
        x, y, z = (float(value) for value in translation)
        qx, qy, qz, qw = (float(value) for value in rotation)
        self.sendTransformMessage(to_stamped(parent, child, (x, y, z, qx, qy, qz, qw), time.to_nsec()))

    def sendTransformMessage(self, transform: Any) -> None:
        """Send a ``geometry_msgs/TransformStamped``."""
        self._broadcaster.sendTransform(transform)
