"""Doors: models with a plugin of rosmini that opens them. Real Gazebo lacks the plugin; there the doors swing freely.

    <model name="door">
      <link name="leaf">...</link>
      <joint name="hinge" type="revolute">
        <parent>world</parent><child>leaf</child><pose>-0.45 0 0 0 0 0</pose>...
      </joint>
      <plugin name="door" filename="librosmini_door.so">
        <opening>1.5708</opening><moving>2</moving><open>5</open><closed>5</closed>
      </plugin>
    </model>

With a joint of type `prismatic` it slides along the joint's axis.
"""

from __future__ import annotations

import math

from rosmini.core.errors import nearest
from rosmini.sim.motion import Door
from rosmini.sim.shapes import WorldError

from .document import SdfModel
from .errors import SdfError
from .poses import compose

PLUGIN = "librosmini_door.so"
NUMBERS = ("opening", "moving", "open", "closed", "phase")


def door_of(model: SdfModel) -> Door | None:
    """Return the motion of a model that is a door, else None. Raises `SdfError`."""
    plugin = next((each for each in model.plugins if each.filename == PLUGIN), None)
    if plugin is None:
        return None
    element = plugin.element
    for child in element:
        if child.tag not in NUMBERS:
            hint = nearest(child.tag, NUMBERS) or f"it has {', '.join(NUMBERS)}"
            raise child.error(f"a door has no <{child.tag}>; {hint}")
    numbers = {child.tag: child.floats(child.text, 1)[0] for child in element}
    opening, moving, stays_open, closed, phase = (numbers.get(tag, getattr(Door, tag)) for tag in NUMBERS)
    joint = next((each for each in model.joints if each.type in ("revolute", "prismatic")), None)
    leaf = next((each for each in model.links if joint is not None and each.name == joint.child), None)
    if joint is None or leaf is None:
        raise element.error(
            "a door hangs in a joint of the type revolute, or prismatic if it slides, whose child is its leaf"
        )
    x, y, *_ = compose(leaf.pose, joint.pose)
    try:
        return Door(
            opening,
            (x, y) if joint.type == "revolute" else (0.0, 0.0),
            None if joint.type == "revolute" else math.atan2(joint.axis[1], joint.axis[0]),
            moving,
            stays_open,
            closed,
            phase,
        )
    except WorldError as error:
        raise SdfError(f"the door {model.name!r}: {error}", element.path, element.line) from error
