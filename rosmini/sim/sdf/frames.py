"""The frames of poses, resolved once, when a file is read.

http://sdformat.org/tutorials?tut=pose_frame_semantics
"""

from __future__ import annotations

import math
from dataclasses import dataclass

from rosmini.core.errors import nearest
from rosmini.core.markup import MAX_LENGTH_M, Element

from .document import ORIGIN, Pose6
from .poses import compose, from_quaternion, inverse

MAX_CHAIN_LENGTH = 200
"""Maximum length of a chain of frames in which the pose of each is relative to the next."""


@dataclass
class Given:
    """A pose as it is written in a file."""

    pose: Pose6 = ORIGIN
    frame: str = ""
    """The frame of the pose; empty: the default of its place."""
    element: Element | None = None


def given(parent: Element) -> Given:
    """Return the pose of an element: its `<pose>`, or the origin. Raises `SdfError`."""
    found = parent.find("pose")
    if found is None:
        return Given(element=parent)
    return Given(_pose(found), found.get("relative_to").strip(), found)


def _pose(element: Element) -> Pose6:
    if element.get("rotation_format") == "quat_xyzw":
        x, y, z, *quaternion = element.floats(
            element.text or "0 0 0 0 0 0 1", 7, "<pose> of a quaternion", most=MAX_LENGTH_M
        )
        if not any(quaternion):
            raise element.error("a quaternion of four zeros is not a rotation; the identity is 0 0 0 1")
        return (x, y, z, *from_quaternion(*quaternion))
    x, y, z, roll, pitch, yaw = element.floats(element.text or "0 0 0 0 0 0", 6, most=MAX_LENGTH_M)
    if element.get("degrees", "false").strip().lower() in ("true", "1"):
        roll, pitch, yaw = (math.radians(angle) for angle in (roll, pitch, yaw))
    return (x, y, z, roll, pitch, yaw)


class Scope:
    """The frames of a model or of a world, by name."""

    def __init__(self, root: str, *, what: str) -> None:
        self.root = root
        self.what = what
        self._given: dict[str, Given] = {root: Given()}
        self._known: dict[str, Pose6] = {root: ORIGIN}
        self._open: list[str] = []

    def add(self, name: str, pose: Given) -> None:
        """Add a frame with a pose; the first one of a name is used."""
        self._given.setdefault(name, pose)

    def put(self, name: str, pose: Pose6) -> None:
        """Add a frame with a known pose in the root."""
        self._given.setdefault(name, Given(pose))
        self._known.setdefault(name, pose)

    def __contains__(self, name: str) -> bool:
        return name in self._given

    def place(self, name: str, asked: Element | None = None) -> Pose6:
        """Return the pose of a frame in the root. Raises `SdfError` if it does not exist, or if frames form a cycle."""
        if name in self._known:
            return self._known[name]
        pose = self._given.get(name)
        if pose is None:
            assert asked is not None  # noqa: S101 (only files name frames that do not exist)
            hint = nearest(name, self._given) or f"it has {', '.join(sorted(self._given))}"
            raise asked.error(f"there is no frame {name!r} in {self.what}; {hint}")
        if name in self._open:
            circle = " -> ".join([*self._open[self._open.index(name) :], name])
            raise (asked or pose.element or Element("pose")).error(f"poses hang on one another in a circle: {circle}")
        if len(self._open) == MAX_CHAIN_LENGTH:
            raise (asked or pose.element or Element("pose")).error(
                f"poses are relative to one another in a chain of more than {MAX_CHAIN_LENGTH}"
            )
        self._open.append(name)
        try:
            self._known[name] = self.seen(pose)
        finally:
            self._open.pop()
        return self._known[name]

    def seen(self, pose: Given, default: str = "") -> Pose6:
        """Return a given pose in the root; `default` is its frame if it names none. Raises the errors of `place`."""
        frame = pose.frame or default or self.root
        return pose.pose if frame == self.root else compose(self.place(frame, pose.element), pose.pose)

    def seen_from(self, here: Pose6, pose: Given) -> Pose6:
        """Return a given pose relative to `here`, which is also its frame if it names none."""
        return compose(inverse(here), self.seen(pose)) if pose.frame else pose.pose
