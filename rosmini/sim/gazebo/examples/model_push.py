"""`libmodel_push.so`: pushes its model along, as the plugin of Gazebo's own tutorial does.

<plugin name="push" filename="libmodel_push.so">
  <velocity>0.3 0 0</velocity>
  <duration>2</duration>
</plugin>
"""

from __future__ import annotations

import math
from dataclasses import dataclass

from rosmini.core.markup import Element
from rosmini.sim.gazebo.model import Model
from rosmini.sim.gazebo.plugin_tags import Tags, tag
from rosmini.sim.gazebo.plugins import ModelPlugin


@dataclass(frozen=True, kw_only=True)
class PushTags(Tags):
    """The tags of the plugin."""

    velocity: str = tag("velocity", "0.3 0 0", "along x and y of the model, and its turning", unit="m/s, rad/s")
    duration: float = tag("duration", math.inf, "how long it pushes", unit="s")
    rate: float = tag("updateRate", 100.0, "how often it pushes", unit="Hz")


class ModelPush(ModelPlugin, filename="libmodel_push.so"):
    """Sets its model's velocity again and again; obstacles stop the model."""

    def load(self, model: Model, sdf: Element) -> None:
        """Start pushing. Raises `MarkupError` for an invalid velocity."""
        self.model = model
        tags = PushTags.read(sdf, self.world.node.logwarn)
        self.ahead, self.aside, self.turn = sdf.floats(tags.velocity, 3, "velocity")
        self.end = self.world.now + tags.duration
        self.every(tags.rate, self.push)

    def push(self, now: float) -> None:
        """Set the velocity."""
        if now <= self.end:
            heading = self.model.flat[2]
            c, s = math.cos(heading), math.sin(heading)
            vx, vy = c * self.ahead - s * self.aside, s * self.ahead + c * self.aside
            self.model.set_velocity((vx, vy, self.turn))
