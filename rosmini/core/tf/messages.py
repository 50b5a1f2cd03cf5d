"""Conversion of transforms to and from messages, and of messages (points, poses, clouds ...) between frames."""

from __future__ import annotations

import copy
from collections.abc import Callable
from functools import cache
from typing import TYPE_CHECKING, Any

from rosmini.core.geometry.products import matrix_product
from rosmini.core.lazy import np
from rosmini.msgs import message_class
from rosmini.msgs.template import template

from .errors import TransformException
from .rigid import Floats, Rigid, compose, matrix, rigid, rotate, transform_points
from .transformations.matrices import EPS

if TYPE_CHECKING:
    from numpy.typing import NDArray

FLOAT_TYPES = {7: "f4", 8: "f8"}
"""The floating-point types of `sensor_msgs/PointField`."""


def from_transform(message: Any) -> Rigid:
    """Return a `geometry_msgs/Transform` as seven floats, unchecked: its quaternion may be invalid."""
    move, turn = message.translation, message.rotation
    return (float(move.x), float(move.y), float(move.z), float(turn.x), float(turn.y), float(turn.z), float(turn.w))


def to_stamped(parent: str, child: str, transform: Rigid, stamp_ns: int) -> Any:
    """Return a `geometry_msgs/TransformStamped` with the pose of `child` in `parent` at a time [ns]."""
    cls: Any = message_class("geometry_msgs/TransformStamped")
    return _maker(cls)(parent, *divmod(stamp_ns, 1_000_000_000), child, *transform)


@cache
def _maker(cls: type[Any]) -> Callable[..., Any]:
    """Return a factory of `TransformStamped` messages, three times as fast as setting field by field."""
    varying = ["header.frame_id", "header.stamp.secs", "header.stamp.nsecs", "child_frame_id"]
    varying += [f"transform.translation.{axis}" for axis in "xyz"] + [f"transform.rotation.{axis}" for axis in "xyzw"]
    return template(cls(), *varying)


def transform_of(stamped: Any) -> Rigid:
    """Return the transform of a `geometry_msgs/TransformStamped`.

    Raises `InvalidArgumentException` if its quaternion has length 0.
    """
    found = from_transform(stamped.transform)
    return rigid(found[:3], found[3:])


def from_pose(pose: Any) -> Rigid:
    """Return a `geometry_msgs/Pose` as a transform. Raises `InvalidArgumentException` for a quaternion of length 0."""
    where, turn = pose.position, pose.orientation
    return rigid((where.x, where.y, where.z), (turn.x, turn.y, turn.z, turn.w))


def _set(vector: Any, values: Any) -> None:
    vector.x, vector.y, vector.z = (float(value) for value in values)


def _point(message: Any, transform: Rigid) -> None:
    _set(message.point, transform_points(transform, (message.point.x, message.point.y, message.point.z)))


def _vector(message: Any, transform: Rigid) -> None:
    _set(message.vector, rotate(transform, (message.vector.x, message.vector.y, message.vector.z)))


def set_pose(pose: Any, transform: Rigid) -> None:
    """Write a transform into a `geometry_msgs/Pose`."""
    _set(pose.position, transform[:3])
    turn = pose.orientation
    turn.x, turn.y, turn.z, turn.w = transform[3:]


def _move_pose(pose: Any, transform: Rigid) -> None:
    set_pose(pose, compose(transform, from_pose(pose)))


def _quaternion(message: Any, transform: Rigid) -> None:
    turn = message.quaternion
    given = rigid((0.0, 0.0, 0.0), (turn.x, turn.y, turn.z, turn.w))
    turn.x, turn.y, turn.z, turn.w = compose(transform, given)[3:]


def _covariant_pose(message: Any, transform: Rigid) -> None:
    _move_pose(message.pose.pose, transform)
    turned = np.zeros((6, 6))
    turned[:3, :3] = turned[3:, 3:] = matrix(transform)[:3, :3]
    spread = np.asarray(message.pose.covariance, dtype=np.float64).reshape(6, 6)
    message.pose.covariance = matrix_product(matrix_product(turned, spread), turned.T).ravel().tolist()


def _wrench(message: Any, transform: Rigid) -> None:
    force, torque = message.wrench.force, message.wrench.torque
    _set(force, rotate(transform, (force.x, force.y, force.z)))
    _set(torque, rotate(transform, (torque.x, torque.y, torque.z)))


def _cloud(message: Any, transform: Rigid) -> None:
    points = np.array([(point.x, point.y, point.z) for point in message.points]).reshape(-1, 3)
    for point, values in zip(message.points, transform_points(transform, points), strict=True):
        _set(point, values)


def cloud_view(message: Any, data: bytearray) -> list[NDArray[Any]]:
    """Return x, y and z of a `sensor_msgs/PointCloud2` as views (height, width) of `data`, a copy of its data.

    Raises `TransformException` if it lacks floating-point fields of these names.
    """
    columns = []
    fields = {field.name: field for field in message.fields}
    for name in "xyz":
        field = fields.get(name)
        if field is None or field.datatype not in FLOAT_TYPES:
            raise TransformException(
                f"a cloud with the fields {', '.join(fields) or '(none)'} cannot be transformed: it needs x, y, z as "
                "FLOAT32 or FLOAT64"
            )
        kind = (">" if message.is_bigendian else "<") + FLOAT_TYPES[field.datatype]
        shape = (message.height, message.width)
        view: NDArray[Any] = np.ndarray(
            shape, dtype=kind, buffer=data, offset=field.offset, strides=(message.row_step, message.point_step)
        )
        columns.append(view)
    return columns


def _cloud2(message: Any, transform: Rigid) -> None:
    data = bytearray(message.data)
    columns = cloud_view(message, data)
    moved = transform_points(transform, np.stack(columns, axis=-1))
    for number, column in enumerate(columns):
        column[...] = moved[..., number]
    message.data = bytes(data)


MOVERS = {
    "geometry_msgs/PointStamped": _point,
    "geometry_msgs/Vector3Stamped": _vector,
    "geometry_msgs/PoseStamped": lambda message, transform: _move_pose(message.pose, transform),
    "geometry_msgs/PoseWithCovarianceStamped": _covariant_pose,
    "geometry_msgs/QuaternionStamped": _quaternion,
    "geometry_msgs/WrenchStamped": _wrench,
    "sensor_msgs/PointCloud": _cloud,
    "sensor_msgs/PointCloud2": _cloud2,
}
"""Functions that transform a message in place, by type."""


ROTATIONS: dict[str, Callable[[Any], Any]] = {
    "geometry_msgs/PoseStamped": lambda message: message.pose.orientation,
    "geometry_msgs/PoseWithCovarianceStamped": lambda message: message.pose.pose.orientation,
    "geometry_msgs/QuaternionStamped": lambda message: message.quaternion,
}
"""Functions that return the quaternion of a message, by type."""


def transformed(message: Any, stamped: Any, warn: Callable[[str], object] = lambda _text: None) -> Any:
    """Return a copy of a message in another frame; `stamped` is the `TransformStamped` of its frame in that frame.

    The copy has the frame and stamp of `stamped`. A quaternion of length 0, as in a new `PoseStamped`, is replaced by
    no rotation, as in `tf.TransformerROS`, and `warn` is called with a warning.

    Raises `TransformException` for a type that cannot be transformed.
    """
    kind = getattr(message, "_type", type(message).__name__)
    if kind not in MOVERS:
        raise TransformException(f"a {kind} cannot be transformed; these types can: {', '.join(MOVERS)}")
    result = copy.deepcopy(message)
    if kind in ROTATIONS:
        turn = ROTATIONS[kind](result)
        if turn.x * turn.x + turn.y * turn.y + turn.z * turn.z + turn.w * turn.w < EPS:
            turn.x, turn.y, turn.z, turn.w = 0.0, 0.0, 0.0, 1.0
            warn(
                f'A {kind} in frame "{message.header.frame_id}" has the quaternion x=0, y=0, z=0, w=0, as every new '
                "message has. It is transformed as if there were no rotation. Set orientation.w = 1 for no rotation: "
                "move_base refuses a goal with such a quaternion."
            )
    MOVERS[kind](result, transform_of(stamped))
    result.header.frame_id = stamped.header.frame_id
    result.header.stamp = stamped.header.stamp
    return result


def scan_points(scan: Any) -> Floats:
    """Return the end points of the beams of a `sensor_msgs/LaserScan` (n, 3) [m], in the laser's frame.

    Beams whose range is not finite, or not between `range_min` and `range_max`, are omitted.
    """
    ranges = np.asarray(scan.ranges, dtype=np.float64)
    angles = scan.angle_min + scan.angle_increment * np.arange(len(ranges))
    with np.errstate(invalid="ignore"):
        hit = np.isfinite(ranges) & (ranges >= scan.range_min) & (ranges <= scan.range_max)
    reach, at = ranges[hit], angles[hit]
    return np.stack([reach * np.cos(at), reach * np.sin(at), np.zeros(len(reach))], axis=-1)
