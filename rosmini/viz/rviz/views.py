"""Views: positions from which a scene is seen (http://wiki.ros.org/rviz/UserGuide). Each becomes a camera.

In a file, the view is under `Visualization Manager/Views/Current`.
"""

from __future__ import annotations

import math
from collections.abc import Mapping
from contextlib import suppress
from dataclasses import dataclass
from typing import Any, ClassVar

import numpy as np

from rosmini.core.plugins import Plugin, PluginError
from rosmini.core.tf import TransformException

from .context import FIXED_FRAME, Context
from .primitives import Floats
from .properties import Properties, Property, Vector

STEEPEST = math.pi / 2 - 0.001
PIXELS = 900.0
"""Approximate width of the 3D view in RViz's window [px], to which a scale in pixels per metre refers."""
ASPECT = 1.6
"""Approximate aspect ratio of the 3D view in RViz's window."""
FIELD_OF_VIEW = 45.0
"""Vertical field of view of RViz's cameras [deg]."""

_TARGET = Property("Target Frame", FIXED_FRAME, "the frame that the camera goes with")
_FOCUS = (
    Property("Distance", 10.0, "distance of the camera from the focal point", unit="m", minimum=0.01, maximum=1e6),
    Property("Focal Point", Vector(0.0, 0.0, 0.0), "target of the camera, in the target frame", unit="m"),
    Property("Yaw", math.pi / 4, "direction of the camera", unit="rad"),
    Property("Pitch", math.pi / 4, "elevation of the camera", unit="rad", minimum=-STEEPEST, maximum=STEEPEST),
    Property(
        "Field of View", math.radians(FIELD_OF_VIEW), "vertical field of view", unit="rad", minimum=0.01, maximum=3.0
    ),
)


@dataclass(frozen=True)
class Viewpoint:
    """A viewpoint: looks at `target` (3,) [m], from the direction `yaw` and the elevation `pitch` [rad]."""

    target: Floats
    yaw: float
    pitch: float
    width: float
    """Visible width at the target [m]; 0 to fit the contents."""
    is_flat: bool = True
    """True for a view without perspective."""
    field_of_view: float = FIELD_OF_VIEW
    """Vertical field of view [deg]."""

    @property
    def distance(self) -> float:
        """Distance at which a camera sees this width [m]."""
        return self.width / (2.0 * ASPECT * math.tan(math.radians(self.field_of_view) / 2))


class ViewController(Plugin):
    """The base of views."""

    properties: ClassVar[tuple[Property, ...]] = (_TARGET,)

    def __init__(self, tree: Mapping[str, Any] | None = None) -> None:
        self._values = Properties(self.properties, tree)

    def __getitem__(self, name: str) -> Any:
        return self._values[name]

    def __setitem__(self, name: str, value: Any) -> None:
        self._values[name] = value

    def tree(self) -> dict[str, Any]:
        """Return its part of a file."""
        name = self.plugin_name.rpartition("/")[2]
        return {**self._values.tree(), "Class": self.plugin_name, "Name": "Current View", "Value": f"{name} (rviz)"}

    def viewpoint(self, context: Context) -> Viewpoint:
        """Return the current viewpoint. An unknown target frame is replaced by the fixed frame."""
        raise NotImplementedError

    def centre_on(self, at: Floats, context: Context) -> None:
        """Move a point (3,) of the fixed frame to the middle."""
        self.pan(at - self.viewpoint(context).target, context)

    def pan(self, offset: Floats, context: Context) -> None:
        """Move the middle of the view by `offset` (3,) of the fixed frame [m]."""
        raise NotImplementedError

    def zoom(self, factor: float) -> None:
        """Zoom in by a factor."""
        raise NotImplementedError

    def target(self, context: Context) -> Floats:
        """Return the origin (3,) of the target frame in the fixed frame."""
        with suppress(TransformException):
            return np.array(context.place(self["Target Frame"] or FIXED_FRAME)[:3])
        return np.zeros(3)


class Orbit(ViewController, plugin="rviz/Orbit"):
    """Orbits a focal point, which moves with the target frame."""

    properties = (_TARGET, *_FOCUS)

    def viewpoint(self, context: Context) -> Viewpoint:
        """Return the viewpoint; the focal point moves with the target frame, but does not rotate with it."""
        angle = self["Field of View"]
        width = 2.0 * self["Distance"] * math.tan(angle / 2) * ASPECT
        return Viewpoint(
            self.target(context) + np.array(self["Focal Point"]),
            self["Yaw"],
            self["Pitch"],
            width,
            is_flat=False,
            field_of_view=math.degrees(angle),
        )

    def pan(self, offset: Floats, context: Context) -> None:
        """Move the focal point."""
        del context
        self["Focal Point"] = Vector(*(float(each) for each in np.array(self["Focal Point"]) + offset))

    def zoom(self, factor: float) -> None:
        """Move closer to the focal point."""
        self["Distance"] = self["Distance"] / factor

    def turn(self, yaw: float, pitch: float, distance: float) -> None:
        """Look from the direction `yaw` of the fixed frame, at the elevation `pitch` [rad], from this distance [m]."""
        self["Yaw"] = float(yaw) % (2 * math.pi)
        self["Pitch"] = min(max(float(pitch), -STEEPEST), STEEPEST)
        self["Distance"] = float(distance)


class TopDownOrtho(ViewController, plugin="rviz/TopDownOrtho"):
    """A view from above without perspective; `Scale` is in pixels per metre."""

    properties = (
        _TARGET,
        Property("Scale", 10.0, "size of a metre", unit="px", minimum=1e-3, maximum=1e6),
        Property("X", 0.0, "middle of the view, in the target frame", unit="m"),
        Property("Y", 0.0, "middle of the view, in the target frame", unit="m"),
        Property("Angle", 0.0, "rotation of the view about the vertical", unit="rad"),
    )

    def viewpoint(self, context: Context) -> Viewpoint:
        """Return the viewpoint; at angle 0, x is to the right and y is up."""
        middle = self.target(context) + np.array([self["X"], self["Y"], 0.0])
        return Viewpoint(middle, self["Angle"] - math.pi / 2, math.pi / 2, PIXELS / self["Scale"])

    def pan(self, offset: Floats, context: Context) -> None:
        """Move the middle of the view."""
        del context
        self["X"], self["Y"] = self["X"] + float(offset[0]), self["Y"] + float(offset[1])

    def zoom(self, factor: float) -> None:
        """Enlarge the drawing."""
        self["Scale"] = self["Scale"] * factor


def view_like(kind: str, before: Viewpoint, frame: str, context: Context) -> ViewController:
    """Return a view of another kind that shows the same place from the same distance; an orbit looks from the side.

    Raises `PluginError` for an unknown kind.
    """
    made = ViewController.named(kind)()
    made["Target Frame"] = frame
    if isinstance(made, Orbit):
        pitch = math.pi / 4 if before.is_flat else before.pitch
        made.turn(before.yaw, pitch, before.distance or made["Distance"])
    elif before.width:
        made["Scale"] = PIXELS / before.width
    made.centre_on(before.target, context)
    return made


def view_controller(tree: Mapping[str, Any]) -> ViewController | None:
    """Return the view in a file; None if there is none or its class is unknown."""
    kind = str(tree.get("Class", ""))
    try:
        return ViewController.named(kind)(tree) if kind else None
    except PluginError:
        return None
