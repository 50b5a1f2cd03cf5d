"""The axes of recorded frames in a scene: x red, y green and z blue, as in RViz; they move with their transforms."""

from __future__ import annotations

from collections.abc import Iterator
from itertools import pairwise

import numpy as np
from numpy.typing import NDArray

from rosmini.core.tf import TransformException
from rosmini.core.tf.rigid import IDENTITY, Rigid, compose, from_yaw, inverse, matrix
from rosmini.sim.recording import Recording
from rosmini.viz.replay.collectors import TRANSFORMS
from rosmini.viz.replay.recorded_frames import RecordedFrames

from .scene3d import Scene3D
from .solids import Part, Prism

Floats = NDArray[np.float64]

LENGTH, HALF_WIDTH = 0.12, 0.005
"""Dimensions of an axis [m]."""
COLOURS = ("#e0201b", "#22a02c", "#2456d8")
"""Colours of the axes x, y and z."""
RATE = 10.0
"""Sampling rate of the transforms [Hz]."""


class MovingFrames:
    """The frames of a recording at the times (n,) of its samples [s]."""

    def __init__(self, recording: Recording) -> None:
        begin, end = float(recording.times[0]), float(recording.times[-1])
        self.times = np.linspace(begin, end, 2 + int(RATE * (end - begin)))
        self._frames = RecordedFrames()
        for time, topic, message in recording.messages:
            if type(message)._type in TRANSFORMS:
                self._frames.take(message, time, static=topic.endswith("tf_static"))
        self._frames.choose_fixed_frame(None, ())
        self._offset: Rigid = IDENTITY
        self._offset = self._start(recording)
        self.poses = dict(self._known())
        """The poses (n, 7) of each frame in the world at `times`."""

    def add_to(self, scene: Scene3D) -> None:
        """Add the axes of all frames to a scene, and their motion."""
        for name, poses in self.poses.items():
            node = "frames/" + name.replace("/", " ")
            scene.place(node, matrix(tuple(poses[0].tolist())))
            for axis, colour in zip("xyz", COLOURS, strict=True):
                scene.add(Part(node, axis, colour, (_axis(axis),), shine=0.1))
            if np.ptp(poses, axis=0).max() > 1e-4:
                scene.animate(self.times - self.times[0], _tracks(node, poses))

    def _known(self) -> Iterator[tuple[str, Floats]]:
        """Yield each frame with its poses (n, 7) at all times; where a pose is unknown, the last known one holds."""
        for name in sorted(self._frames.tree):
            found = [self._pose(name, time) for time in self.times.tolist()]
            known = [i for i, pose in enumerate(found) if pose is not None]
            if known:
                nearest = np.clip(np.searchsorted(known, np.arange(len(found)), side="right") - 1, 0, None)
                yield name, np.array([found[known[i]] for i in nearest], dtype=float)

    def _start(self, recording: Recording) -> Rigid:
        """Return the fixed frame's pose in the world: the robot's frame begins at the robot's true pose."""
        bases = self._frames.bases()
        base = self._pose(bases[0], float(self.times[0])) if bases else None
        true = from_yaw(*recording.truth[0].tolist())
        return compose(true, inverse(base)) if base is not None else IDENTITY

    def _pose(self, frame: str, time: float) -> Rigid | None:
        """Return a frame's pose in the world at a time of the run [s]; None if it is unknown then."""
        stamp = max(1, round((time - self._frames.lag) * 1e9))
        try:
            found = self._frames.tree.lookup(self._frames.fixed, frame, stamp).transform
        except TransformException:
            return None
        return compose(self._offset, found)


def _axis(name: str) -> Prism:
    """Return an axis: a bar from the origin."""
    low, high = np.full(3, -HALF_WIDTH), np.full(3, HALF_WIDTH)
    high["xyz".index(name)] = LENGTH
    corners = np.array([(low[0], low[1]), (high[0], low[1]), (high[0], high[1]), (low[0], high[1])])
    return Prism(corners, float(low[2]), float(high[2]))


def _tracks(node: str, poses: Floats) -> Iterator[tuple[str, str, Floats]]:
    """Yield the tracks of a frame's position and quaternion, without changes of the quaternion's sign."""
    turns = poses[:, 3:].copy()
    for before, after in pairwise(turns):
        if float((before * after).sum()) < 0:
            after *= -1
    yield node, "position", poses[:, :3]
    yield node, "quaternion", turns
