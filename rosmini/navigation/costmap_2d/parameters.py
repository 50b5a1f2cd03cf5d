"""The parameters of costmaps and their layers, with the names, types, defaults and ranges of costmap_2d.

Classes whose name ends in `Config` hold the parameters that dynamic_reconfigure can change at run time.
"""

from __future__ import annotations

from collections.abc import Iterable
from dataclasses import dataclass
from typing import TYPE_CHECKING, Any, ClassVar

from rosmini.core.parameters import Parameters, parameter

from .migration import INHERITED, OLD

if TYPE_CHECKING:
    from rosmini.core.graph import Node

OVERWRITE, MAXIMUM = 0, 1
"""Values of `combination_method`; with any other value the layer writes nothing."""


@dataclass(frozen=True)
class CostmapConfig(Parameters):
    """Parameters of a costmap (`~global_costmap/`) that can change at run time."""

    dynamic = True

    transform_tolerance: float = parameter(
        0.3, "how old the robot's pose may be", unit="s", minimum=0.0, maximum=10.0
    )
    update_frequency: float = parameter(
        5.0, "how often the costs are computed; 0 for never", unit="Hz", minimum=0.0, maximum=100.0
    )
    publish_frequency: float = parameter(
        0.0, "how often they are published; 0 for never", unit="Hz", minimum=0.0, maximum=100.0
    )
    width: int = parameter(10, "of the window", unit="m", minimum=0)
    height: int = parameter(10, "of the window", unit="m", minimum=0)
    resolution: float = parameter(0.05, "the side of a cell", unit="m", minimum=0.0, maximum=50.0)
    origin_x: float = parameter(0.0, "the left edge of the window, in the global frame", unit="m")
    origin_y: float = parameter(0.0, "its lower edge", unit="m")
    footprint: str = parameter("[]", "the robot's outline in its base frame, as a list of points", unit="m")
    robot_radius: float = parameter(
        0.46, "of a round robot, where there is no footprint", unit="m", minimum=0.0, maximum=10.0
    )
    footprint_padding: float = parameter(0.01, "by how much the outline is widened", unit="m")


@dataclass(frozen=True)
class PluginEntry(Parameters):
    """One layer in the `plugins` list."""

    name: str = parameter("", "what the layer is called")
    type: str = parameter("", "its type, such as costmap_2d::StaticLayer")


@dataclass(frozen=True)
class CostmapParameters(CostmapConfig):
    """All parameters of a costmap."""

    allowed: ClassVar[tuple[str, ...]] = (*OLD, *(name for names in INHERITED.values() for name in names))

    plugins: tuple[PluginEntry, ...] = parameter((), "the layers, from below")
    global_frame: str = parameter("map", "the frame of the costs")
    robot_base_frame: str = parameter("base_link", "the robot's frame")
    rolling_window: bool = parameter(False, "whether the window moves with the robot")
    track_unknown_space: bool = parameter(False, "whether a cell nobody knows is unknown (255), not free")
    always_send_full_costmap: bool = parameter(False, "publish all costs each time, not what changed")
    footprint_topic: str = parameter("footprint", "where another footprint may come from")
    published_footprint_topic: str = parameter("footprint", "where the robot's footprint is published")

    def others(self) -> Iterable[str]:
        """The namespaces of the layers."""
        return [plugin.name for plugin in self.plugins]


@dataclass(frozen=True)
class LayerConfig(Parameters):
    """Parameters of every layer that can change at run time."""

    dynamic = True

    enabled: bool = parameter(True, "whether the layer takes part")


@dataclass(frozen=True)
class StaticParameters(LayerConfig):
    """Parameters of `costmap_2d::StaticLayer`."""

    map_topic: str = parameter("map", "where the map comes from")
    first_map_only: bool = parameter(False, "take the first map and no other")
    subscribe_to_updates: bool = parameter(False, "listen to the map's topic with _updates, too")
    track_unknown_space: bool = parameter(
        True, "whether an unknown cell of the map is unknown (255), not free"
    )
    use_maximum: bool = parameter(False, "let a greater cost of the layers below stand")
    lethal_cost_threshold: int = parameter(100, "from this value on a cell is an obstacle")
    unknown_cost_value: int = parameter(-1, "the value of an unknown cell")
    trinary_costmap: bool = parameter(True, "take values below the threshold as free, not as costs between")


@dataclass(frozen=True)
class InflationConfig(LayerConfig):
    """Parameters of `costmap_2d::InflationLayer`, all of which can change at run time."""

    dynamic = True

    cost_scaling_factor: float = parameter(
        10.0, "how steeply the costs fall with the distance", unit="1/m", minimum=0.0, maximum=100.0
    )
    inflation_radius: float = parameter(
        0.55, "up to which distance an obstacle has costs", unit="m", minimum=0.0, maximum=50.0
    )
    inflate_unknown: bool = parameter(False, "whether unknown cells get costs, too")


@dataclass(frozen=True)
class ObstacleConfig(LayerConfig):
    """Parameters of `costmap_2d::ObstacleLayer` that can change at run time."""

    dynamic = True

    footprint_clearing_enabled: bool = parameter(True, "take the ground under the robot for free")
    max_obstacle_height: float = parameter(
        2.0, "what is higher is no obstacle", unit="m", minimum=0.0, maximum=50.0
    )
    combination_method: int = parameter(
        MAXIMUM,
        "0 overwrites what is below, 1 takes the greater cost, 99 does nothing",
        minimum=0,
        maximum=99,
    )


@dataclass(frozen=True)
class ObstacleStatics(Parameters):
    """Parameters of `costmap_2d::ObstacleLayer` that are read only once."""

    observation_sources: str = parameter("", "the names of the sources, separated by spaces")
    transform_tolerance: float = parameter(0.2, "how long a transform may take to come", unit="s")
    track_unknown_space: bool | None = parameter(
        None, "whether a cell that nobody saw is unknown; as the costmap has it, by default"
    )
    obstacle_range: float = parameter(2.5, "for sources that set none", unit="m")
    raytrace_range: float = parameter(3.0, "for sources that set none", unit="m")

    def others(self) -> Iterable[str]:
        """The namespaces of the sources."""
        return self.observation_sources.split()


@dataclass(frozen=True)
class ObstacleParameters(ObstacleStatics, ObstacleConfig):
    """All parameters of `costmap_2d::ObstacleLayer`."""


@dataclass(frozen=True)
class VoxelConfig(ObstacleConfig):
    """Parameters of `costmap_2d::VoxelLayer` that can change at run time."""

    dynamic = True

    origin_z: float = parameter(0.0, "the floor of the voxels", unit="m", minimum=0.0)
    z_resolution: float = parameter(0.2, "the height of a voxel", unit="m", minimum=0.0, maximum=50.0)
    z_voxels: int = parameter(10, "voxels of a column", minimum=0, maximum=16)
    unknown_threshold: int = parameter(
        15, "up to so many unknown voxels a column is known", minimum=0, maximum=16
    )
    mark_threshold: int = parameter(0, "up to so many marked voxels a column is free", minimum=0, maximum=16)


@dataclass(frozen=True)
class VoxelParameters(ObstacleParameters, VoxelConfig):
    """All parameters of `costmap_2d::VoxelLayer`."""

    publish_voxel_map: bool = parameter(False, "publish the voxels on voxel_grid")


@dataclass(frozen=True)
class SourceParameters(Parameters):
    """Parameters of one observation source of an obstacle layer (`~global_costmap/obstacle_layer/scan/`)."""

    topic: str | None = parameter(None, "where it comes from; by default the name of the source")
    sensor_frame: str = parameter("", "where the sensor is; by default the frame that its messages name")
    observation_persistence: float = parameter(
        0.0, "how long an observation is kept; 0 keeps the newest", unit="s"
    )
    expected_update_rate: float = parameter(
        0.0, "after how long without a message the costmap is out of date; 0 for never", unit="s"
    )
    data_type: str = parameter(
        "PointCloud", "what its messages are", choices=("PointCloud", "PointCloud2", "LaserScan")
    )
    min_obstacle_height: float = parameter(0.0, "points below are left out", unit="m")
    max_obstacle_height: float = parameter(2.0, "points above are left out", unit="m")
    inf_is_valid: bool = parameter(False, "whether a beam of a scan that met nothing clears")
    clearing: bool = parameter(False, "whether its rays clear")
    marking: bool = parameter(True, "whether its points are obstacles")
    obstacle_range: float | None = parameter(
        None,
        "up to this distance points are obstacles; by default that of a namespace above, or 2.5",
        unit="m",
    )
    raytrace_range: float | None = parameter(
        None, "up to this distance rays clear; by default that of a namespace above, or 3.0", unit="m"
    )


def set_above(node: Node, namespace: str, name: str) -> str | None:
    """Return the full name of a parameter in this namespace or the nearest parent (`searchParam`), or None."""
    place = node.resolve_parameter(namespace).rstrip("/")
    while True:
        if node.has_param(f"{place}/{name}"):
            return f"{place}/{name}"
        if not place:
            return None
        place = place.rpartition("/")[0]


def found_above(node: Node, namespace: str, name: str, kind: type, default: Any) -> Any:
    """Return the value of a parameter found this way, or the default. Raises `ParameterError` for a wrong type."""
    found = set_above(node, namespace, name)
    return default if found is None else node.get_param(found, expect=kind)
