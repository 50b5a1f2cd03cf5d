"""`clear_costmap_recovery/ClearCostmapRecovery` (http://wiki.ros.org/clear_costmap_recovery).

In the layers listed in `layer_names`, all cells farther from the robot than half of `reset_distance` become unknown,
and the next update restores the static map and the sensors' data. `invert_area_to_clear` clears the near cells instead.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any

from rosmini.core.errors import nearest
from rosmini.core.parameters import Parameters, parameter
from rosmini.navigation.nav_core import RecoveryBehavior, TransformMissing, planar_pose

MAPS = ("local", "global", "both")


@dataclass(frozen=True)
class ClearCostmapParameters(Parameters):
    """The parameters of a `clear_costmap_recovery/ClearCostmapRecovery`, in `~NAME/`."""

    reset_distance: float = parameter(
        3.0, "side of the square around the robot; the area outside it is cleared", unit="m"
    )
    invert_area_to_clear: bool = parameter(False, "clear the inside of the square instead")
    force_updating: bool = parameter(False, "update the costmaps immediately, not at the next period")
    affected_maps: str = parameter("both", "the costmaps to clear: local, global or both")
    layer_names: tuple[str, ...] = parameter(("obstacles",), "the layers that are cleared")


class ClearCostmapRecovery(RecoveryBehavior, plugin="clear_costmap_recovery/ClearCostmapRecovery"):
    """Clears obstacles that may no longer be there."""

    def initialize(self, name: str, buffer: Any, global_costmap: Any, local_costmap: Any) -> None:
        """Read the parameters in `~name/`; warn of layers that do not exist."""
        super().initialize(name, buffer, global_costmap, local_costmap)
        self.node = local_costmap.node
        self.parameters = own = ClearCostmapParameters.read(self.node, f"~{name}")
        self._maps = own.affected_maps
        if self._maps not in MAPS:
            self.node.logwarn(
                f"Wrong value for affected_maps parameter: '{self._maps}'; valid values are 'local', 'global' or "
                "'both'; defaulting to 'both'"
            )
            self._maps = "both"
        for layer in own.layer_names:
            self.node.loginfo(f"Recovery behavior will clear layer '{layer}'")
        self._check_layers()

    def costmaps(self) -> list[Any]:
        """Return the costmaps that it clears, the global one first."""
        pairs = (("global", self.global_costmap), ("local", self.local_costmap))
        return [costmap for which, costmap in pairs if self._maps in (which, "both")]

    def _check_layers(self) -> None:
        """Warn if the behaviour will clear nothing; ROS gives no hint of this."""
        known = [layer.name for costmap in self.costmaps() for layer in costmap.layers]
        names = self.parameters.layer_names
        if known and not set(names) & set(known):
            hint = next((found for each in names if (found := nearest(each, known))), "")
            self.node.logwarn(
                f"{self.name} will clear nothing: ~{self.name}/layer_names is [{', '.join(names)}], but the layers of "
                f"the costmaps are {', '.join(dict.fromkeys(known))}. Set it to those that hold obstacles"
                f"{': ' + hint if hint else ''}"
            )

    def run_behavior(self) -> None:
        """Clear the costmaps, and update them if `force_updating` is set."""
        for costmap in self.costmaps():
            self._clear(costmap)
            if self.parameters.force_updating:
                costmap.update()

    def _clear(self, costmap: Any) -> None:
        try:
            x, y, _ = planar_pose(costmap.robot_pose())
        except TransformMissing as error:
            self.node.logerr(f"Cannot clear map because pose cannot be retrieved: {error}")
            return
        half = self.parameters.reset_distance / 2
        for layer in costmap.layers:
            if layer.name.rpartition("/")[2] not in self.parameters.layer_names:
                continue
            if not hasattr(layer, "clear_area"):
                self.node.logerr(f"Layer {layer.name} is not derived from costmap_2d::CostmapLayer")
                continue
            x0, y0 = layer.grid.world_to_map_no_bounds(x - half, y - half)
            x1, y1 = layer.grid.world_to_map_no_bounds(x + half, y + half)
            layer.clear_area(x0, y0, x1, y1, self.parameters.invert_area_to_clear)
