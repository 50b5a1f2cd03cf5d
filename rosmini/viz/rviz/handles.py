"""Interactive markers on the screen: the positions of their controls, and how they follow the mouse."""

from __future__ import annotations

import math
from collections.abc import Iterator
from typing import Any

import numpy as np

from rosmini.core.geometry.products import inverse_matrix, matrix_product, norm, scalar_product
from rosmini.core.tf.rigid import matrix, rigid
from rosmini.core.tf.transformations import quaternion_from_matrix
from rosmini.msgs import message_class
from rosmini.ros.interactive_markers import auto_complete, title_control

from .context import Context
from .display import Level
from .marker_checks import Marker, check
from .marker_shapes import marker_primitives
from .primitives import DisplayError, Floats, Mesh, Primitive
from .rays import Ray, depths, on_axis, on_plane
from .shapes import axes
from .topic_display import Received

Control = message_class("visualization_msgs/InteractiveMarkerControl")

FACING_UP = np.array([[0.0, -1, 0, 0], [0, 0, -1, 0], [1, 0, 0, 0], [0, 0, 0, 1]])
"""The orientation of a control that faces the viewer, who looks down: x up, z along the fixed frame's y."""
_EDGE = 0.05
"""Tolerance around a face for the mouse, as a share of the face."""


class Handle:
    """An interactive marker of a display: the message, completed, and its pose in its frame.

    Raises `DisplayError` for an invalid pose.
    """

    def __init__(self, message: Any, arrived_ns: int, *, transparent: bool = True) -> None:
        auto_complete(message, transparent=transparent)
        self.message = message
        self.received = Received(message, arrived_ns)
        self.pose: Floats = matrix(self.received.local(message.pose))
        """The marker's pose (4, 4) in its frame."""
        self.is_locked = self.received.stamp_ns == 0
        """True if it moves with its frame."""
        self.is_placed = False
        """True if its frame's pose is known."""

    @property
    def frame(self) -> Floats:
        """The pose (4, 4) of the marker's frame in the fixed frame."""
        return matrix(self.received.place)

    def control(self, name: str) -> Any:
        """Return the control with this name; for an empty name, the first that reacts. Raises `DisplayError`."""
        for control in self.message.controls:
            if control.name == name or (not name and control.interaction_mode != Control.NONE):
                return control
        names = ", ".join(repr(control.name) for control in self.message.controls)
        raise DisplayError(f"the marker {self.message.name!r} has no control {name!r:.60}; it has {names or 'none'}")

    def control_frame(self, control: Any) -> Floats:
        """Return the frame (4, 4) of a control in that of the marker's header."""
        found: Floats = self.pose.copy()
        if control.orientation_mode == Control.FIXED:
            found[:3, :3] = np.eye(3)
        elif control.orientation_mode == Control.VIEW_FACING:
            found[:3, :3] = matrix_product(self.frame[:3, :3].T, FACING_UP[:3, :3])
        return found

    def axis(self, control: Any) -> Floats:
        """Return the direction (3,) of a control's x axis in the frame of the marker's header."""
        q = control.orientation
        turned: Floats = matrix(rigid((0, 0, 0), (q.x, q.y, q.z, q.w)))[:3, 0]
        found: Floats = matrix_product(self.control_frame(control)[:3, :3], turned)
        return found

    # -- seen ----------------------------------------------------------------------------------------------------

    def shapes(self, control: Any, context: Context) -> Iterator[Primitive]:
        """Yield the shapes of a control; invalid markers in it are left out, with a note. Raises `DisplayError`."""
        placed = matrix_product(self.frame, self.control_frame(control))
        faces = control.orientation_mode == Control.VIEW_FACING
        for shape in control.markers:
            level, text = check(shape)
            if level is Level.ERROR:
                self.received.note(f"{control.name or 'a control'}: {text}")
                continue
            base = placed
            if shape.header.frame_id:
                base = matrix(context.place(shape.header.frame_id))
            elif faces and control.independent_marker_orientation:
                base = matrix_product(self.frame, self.pose)
            elif faces and shape.type == Marker.TEXT_VIEW_FACING:
                base = matrix_product(self.frame, self._upright())
            yield from marker_primitives(shape, matrix_product(base, matrix(self.received.local(shape.pose))))

    def _upright(self) -> Floats:
        found: Floats = np.eye(4)
        found[:3, 3] = self.pose[:3, 3]
        return found

    def title(self) -> Iterator[Primitive]:
        """Yield the marker's description, above it."""
        if self.message.description.strip():
            (text,) = title_control(self.message).markers
            yield from marker_primitives(
                text,
                matrix_product(matrix_product(self.frame, self._upright()), matrix(self.received.local(text.pose))),
            )

    def axes(self) -> Iterator[Primitive]:
        """Yield the axes of the marker."""
        size = abs(self.message.scale)
        yield from axes(matrix_product(self.frame, self.pose), size, 0.05 * size)

    def under(self, ray: Ray, context: Context) -> list[tuple[float, Any]]:
        """Return the controls that a line of sight in the fixed frame meets, each with its distance [m]."""
        found = []
        for control in self.message.controls:
            if control.interaction_mode == Control.NONE:
                continue
            away = [
                depth
                for shape in self.shapes(control, context)
                if isinstance(shape, Mesh)
                for depth in depths(shape, ray, _EDGE)
            ]
            if away:
                found.append((min(away), control))
        return found


class Drag:
    """The mouse holding a control: it moves the marker from the point (3,) of the fixed frame where it was pressed.

    With a line of sight, the mouse is where that meets the control's axis or plane, as in RViz.
    """

    def __init__(self, handle: Handle, control: Any, at: Floats, ray: Ray | None = None) -> None:
        self.handle = handle
        self.control = control
        self._start = handle.pose.copy()
        self._axis = handle.axis(control)
        self._grab = self._local(self.cursor(at, ray))
        self._last = self._grab

    def cursor(self, at: Floats, ray: Ray | None) -> Floats:
        """Return the position of the mouse in space (3,), in the fixed frame; `at` if the line of sight gives none."""
        if ray is None:
            return at
        origin = matrix_product(self.handle.frame, self._start)[:3, 3]
        axis = matrix_product(self.handle.frame[:3, :3], self._axis)
        mode = self.control.interaction_mode
        if mode == Control.MOVE_AXIS:
            found = on_axis(ray, origin, axis)
        else:
            is_free = mode in (Control.MOVE_3D, Control.MOVE_ROTATE_3D)
            found = on_plane(ray, origin, ray[1] if is_free else axis)
        return at if found is None else found

    def _local(self, at: Floats) -> Floats:
        found: Floats = matrix_product(inverse_matrix(self.handle.frame)[:3], np.append(at, 1.0))
        return found

    def move(self, at: Floats, ray: Ray | None = None) -> bool:
        """Follow the mouse to a point (3,) of the fixed frame, or along a line of sight; True if the marker moved.

        As in RViz, the marker moves along the axis, in the plane across it, around it, or both.
        """
        to, pose = self._local(self.cursor(at, ray)), self._start.copy()
        mode = self.control.interaction_mode
        shift = to - self._grab
        if mode == Control.MOVE_AXIS:
            pose[:3, 3] += scalar_product(shift, self._axis) * self._axis
        elif mode == Control.MOVE_PLANE:
            pose[:3, 3] += shift - scalar_product(shift, self._axis) * self._axis
        elif mode in (Control.MOVE_3D, Control.MOVE_ROTATE_3D):
            pose[:3, 3] += shift
        elif mode == Control.ROTATE_AXIS:
            pose[:3, :3] = matrix_product(self._turn(self._start[:3, 3], self._grab, to), self._start[:3, :3])
        elif mode == Control.MOVE_ROTATE:
            pose = self._towed(to)
        else:
            return False
        moved = not np.allclose(pose, self.handle.pose, rtol=0, atol=1e-12)
        self.handle.pose = pose
        return moved

    def _turn(self, centre: Floats, start: Floats, end: Floats) -> Floats:
        """Return the rotation (3, 3) about the axis through `centre` that takes `start` towards `end`."""
        first, second = (self._across(each - centre) for each in (start, end))
        if min(norm(first), norm(second)) < 1e-9:
            return np.eye(3)
        angle = math.atan2(scalar_product(np.cross(first, second), self._axis), scalar_product(first, second))
        half = math.sin(angle / 2)
        found: Floats = matrix(rigid((0, 0, 0), (*(self._axis * half), math.cos(angle / 2))))[:3, :3]
        return found

    def _across(self, vector: Floats) -> Floats:
        found: Floats = vector - scalar_product(vector, self._axis) * self._axis
        return found

    def _towed(self, to: Floats) -> Floats:
        """Rotate the marker so that the point held faces the mouse, and then move it there."""
        pose = self.handle.pose.copy()
        centre = pose[:3, 3].copy()
        turn = self._turn(centre, self._last, to)
        pose[:3, :3] = matrix_product(turn, pose[:3, :3])
        pose[:3, 3] += self._across(to - centre - matrix_product(turn, self._last - centre))
        self._last = to
        return pose


def pose_message(pose: Floats) -> Any:
    """Return a transform (4, 4) as a `geometry_msgs/Pose`."""
    made = message_class("geometry_msgs/Pose")()
    at, turned = made.position, made.orientation
    at.x, at.y, at.z = (float(each) for each in pose[:3, 3])
    turned.x, turned.y, turned.z, turned.w = (float(each) for each in quaternion_from_matrix(pose))
    return made
