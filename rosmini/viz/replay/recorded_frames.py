"""Poses of frames in the fixed frame of a run, from recorded transforms."""

from __future__ import annotations

import math
from collections.abc import Iterable
from typing import Any

import numpy as np
from numpy.typing import NDArray

from rosmini.core.geometry.angles import yaw_from_quaternion
from rosmini.core.geometry.poses import Pose, compose
from rosmini.core.tf.errors import TransformException
from rosmini.core.tf.messages import from_transform
from rosmini.core.tf.tree import FrameTree
from rosmini.viz.view import ViewError

Floats = NDArray[np.float64]

ALL_TIME = 2**62
"""Time that recorded transforms are stored [ns]."""
FIXED_FRAMES = ("map", "odom", "world")
"""Fixed frames to draw a run in, in order of preference."""
BASE_FRAMES = ("base_footprint", "base_link")
"""Names of a robot's base frame (REP 105 and 120)."""
ORIGIN: Pose = (0.0, 0.0, 0.0)


class RecordedFrames:
    """Recorded transforms, seen from above.

    `fixed` is the fixed frame; `offset` is its pose in the drawing.
    """

    def __init__(self) -> None:
        self.tree = FrameTree(ALL_TIME)
        self.fixed = ""
        self.offset: Pose = ORIGIN
        self._late: list[float] = []

    def take(self, message: Any, time: float, *, static: bool) -> None:
        """Store the transforms of a `tf2_msgs/TFMessage` that was recorded at `time` [s]."""
        for each in message.transforms:
            stamp = each.header.stamp.to_nsec()
            self.tree.set(
                each.header.frame_id.lstrip("/"), each.child_frame_id.lstrip("/"), from_transform(each.transform),
                stamp, static=static,
            )  # fmt: skip
            if not static:
                self._late.append(time - stamp / 1e9)

    def choose_fixed_frame(self, frame: str | None, others: Iterable[str]) -> None:
        """Choose the fixed frame: `frame` if given, otherwise map, odom or world, otherwise a root or one of `others`.

        Raises:
            ViewError: no message contains the requested frame.

        """
        there = [*self.tree, *(name.lstrip("/") for name in others if name)]
        if frame is not None and frame.lstrip("/") not in there:
            names = ", ".join(sorted(set(there))) or "none at all"
            raise ViewError(f"no message contains the frame {frame!r} to draw the run in; the frames are {names}")
        usual = [name for name in FIXED_FRAMES if name in there]
        self.fixed = frame.lstrip("/") if frame is not None else next(iter([*usual, *there]), "")

    @property
    def lag(self) -> float:
        """Typical delay between stamps of transforms and their recording [s]; 0 if both come from the same clock."""
        typical = float(np.median(self._late)) if self._late else 0.0
        return typical if abs(typical) > 1.0 else 0.0

    def pose(self, frame: str, stamp_ns: int) -> Pose | None:
        """Return the pose of a frame at a time in the drawing; None if it is unknown."""
        name = frame.lstrip("/")
        if name in ("", self.fixed):
            return self.offset
        try:
            x, y, _, qx, qy, qz, qw = self.tree.lookup(self.fixed, name, stamp_ns).transform
        except TransformException:
            return None
        return compose(self.offset, (x, y, yaw_from_quaternion(qx, qy, qz, qw)))

    def bases(self) -> list[str]:
        """Return the base frames of robots: one for each prefix."""
        chosen: dict[str, str] = {}
        for base in BASE_FRAMES:
            for frame in sorted(self.tree):
                prefix, _, last = frame.rpartition("/")
                if last == base:
                    chosen.setdefault(prefix, frame)
        return [chosen[prefix] for prefix in sorted(chosen)]

    def track(self, frame: str, times: Floats) -> tuple[Floats, Floats]:
        """Return the trajectory of a frame at those of `times` (n,) [s] where it is known: times (m,), poses (m, 3)."""
        lag = self.lag
        found = [(time, self.pose(frame, max(1, round((time - lag) * 1e9)))) for time in times.tolist()]
        known = [(time, *pose) for time, pose in found if pose is not None]
        rows = np.array(known, dtype=float).reshape(-1, 4)
        rows[:, 3] = np.unwrap(rows[:, 3])
        return rows[:, 0], rows[:, 1:]


def planar_pose(pose: Any) -> Pose:
    """Return a `geometry_msgs/Pose` seen from above; with a quaternion of zeros it points along x, as in RViz.

    Raises `ViewError` if it is not finite.
    """
    q = pose.orientation
    turn = (float(q.x), float(q.y), float(q.z), float(q.w))
    if not all(math.isfinite(part) for part in turn):
        raise ViewError("a quaternion is not finite (nan or infinite)")
    found = (float(pose.position.x), float(pose.position.y), yaw_from_quaternion(*turn) if any(turn) else 0.0)
    if not all(math.isfinite(part) for part in found):
        raise ViewError("a pose is not finite (nan or infinite)")
    return found
