"""`libspawner.so`: spawns crates, one after another.

<plugin name="crates" filename="libspawner.so">
  <count>3</count>
  <period>1.0</period>
  <from>0 0</from>
  <to>2 0</to>
</plugin>
"""

from __future__ import annotations

from dataclasses import dataclass

from rosmini.core.errors import RosminiError
from rosmini.core.markup import Element
from rosmini.sim.gazebo.model import GazeboWorld
from rosmini.sim.gazebo.plugin_tags import Tags, tag
from rosmini.sim.gazebo.plugins import WorldPlugin
from rosmini.sim.sdf import SdfCollision, SdfGeometry, SdfInertial, SdfLink, SdfModel, SdfVisual


@dataclass(frozen=True, kw_only=True)
class SpawnerTags(Tags):
    """The tags of the plugin."""

    count: int = tag("count", 3, "how many crates")
    period: float = tag("period", 1.0, "how long from one to the next", unit="s")
    size: float = tag("size", 0.2, "the side of a crate", unit="m")
    mass: float = tag("mass", 0.5, "of a crate", unit="kg")
    first: str = tag("from", "0 0", "where the first one comes", unit="m")
    last: str = tag("to", "2 0", "where the last one comes", unit="m")


class Spawner(WorldPlugin, filename="libspawner.so"):
    """Spawns crates along a line; an occupied place is skipped, with a warning."""

    def load(self, world: GazeboWorld, sdf: Element) -> None:
        """Start spawning. Raises `MarkupError` for invalid positions."""
        self.tags = tags = SpawnerTags.read(sdf, world.node.logwarn)
        self.first, self.last = sdf.floats(tags.first, 2, "from"), sdf.floats(tags.last, 2, "to")
        self.made = 0
        self.every(1 / tags.period, self.bring)

    def bring(self, _: float) -> None:
        """Spawn the next crate."""
        count = self.tags.count
        if self.made < count:
            part = self.made / max(1, count - 1)
            x, y = (a + part * (b - a) for a, b in zip(self.first, self.last, strict=True))
            self.made += 1
            try:
                self.world.spawn(
                    crate(self.tags.size, self.tags.mass), f"crate_{self.made}", (x, y, 0.0, 0.0, 0.0, 0.0)
                )
            except RosminiError as error:
                self.world.node.logwarn(f"{self.name}: {error}")


def crate(size: float, mass: float) -> SdfModel:
    """Return the model of a wooden cube."""
    shape = SdfGeometry("box", size=(size, size, size))
    pose = (0.0, 0.0, size / 2, 0.0, 0.0, 0.0)
    inertia = mass * size * size / 6
    link = SdfLink(
        "link",
        inertial=SdfInertial(mass, pose, (inertia, inertia, inertia, 0.0, 0.0, 0.0)),
        collisions=(SdfCollision("collision", pose, shape),),
        visuals=(SdfVisual("visual", pose, shape, "#a9784a"),),
    )
    return SdfModel("crate", links=(link,))
