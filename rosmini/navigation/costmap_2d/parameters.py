"""The parameters of costmaps and their layers, with the names, types, defaults and ranges of costmap_2d.

Classes whose name ends in `Config` hold the parameters that dynamic_reconfigure can change at run time.
"""

from __future__ import annotations

from collections.abc import Iterable
from dataclasses import dataclass
from typing import Any, ClassVar

from rosmini.core.graph import Node
from rosmini.core.parameters import Parameters, parameter

from .migration import INHERITED, OLD

OVERWRITE, MAXIMUM = 0, 1
"""Values of `combination_method`; with any other value the layer writes nothing."""


@dataclass(frozen=True)
class CostmapConfig(Parameters):
    """Parameters of a costmap (`~global_costmap/`) that can change at run time."""

    dynamic = True

    transform_tolerance: float = parameter(0.3, "how old the robot's pose may be", unit="s", minimum=0.0, maximum=10.0)
    update_frequency: float = parameter(
        5.0, "rate at which the costs are computed; 0 for never", unit="Hz", minimum=0.0, maximum=100.0
    )
    publish_frequency: float = parameter(
        0.0, "publication rate of the costs; 0 for never", unit="Hz", minimum=0.0, maximum=100.0
    )
    width: int = parameter(10, "width of the window", unit="m", minimum=0)
    height: int = parameter(10, "height of the window", unit="m", minimum=0)
    resolution: float = parameter(0.05, "the side of a cell", unit="m", minimum=0.0, maximum=50.0)
    origin_x: float = parameter(0.0, "the left edge of the window, in the global frame", unit="m")
    origin_y: float = parameter(0.0, "the lower edge of the window, in the global frame", unit="m")
    footprint: str = parameter("[]", "the robot's outline in its base frame, as a list of points", unit="m")
    robot_radius: float = parameter(
        0.46, "radius of a round robot, used without a footprint", unit="m", minimum=0.0, maximum=10.0
    )
    footprint_padding: float = parameter(0.01, "the margin added to the outline", unit="m")


@dataclass(frozen=True)
class PluginEntry(Parameters):
    """One layer in the `plugins` list."""

    name: str = parameter("", "the name of the layer")
    type: str = parameter("", "the type of the layer, such as costmap_2d::StaticLayer")


@dataclass(frozen=True)
class CostmapParameters(CostmapConfig):
    """All parameters of a costmap."""

    allowed: ClassVar[tuple[str, ...]] = (*OLD, *(name for names in INHERITED.values() for name in names))

    plugins: tuple[PluginEntry, ...] = parameter((), "the layers, from below")
    global_frame: str = parameter("map", "the frame of the costs")
    robot_base_frame: str = parameter("base_link", "the robot's frame")
    rolling_window: bool = parameter(False, "whether the window moves with the robot")
    track_unknown_space: bool = parameter(False, "whether cells that no layer knows are unknown (255), not free")
    always_send_full_costmap: bool = parameter(False, "publish all costs each time, not only changes")
    footprint_topic: str = parameter("footprint", "the topic on which another footprint may arrive")
    published_footprint_topic: str = parameter("footprint", "the topic on which the robot's footprint is published")

    def others(self) -> Iterable[str]:
        """Return the names of the layers, which are namespaces of their parameters."""
        return [plugin.name for plugin in self.plugins]


@dataclass(frozen=True)
class LayerConfig(Parameters):
    """Parameters of every layer that can change at run time."""

    dynamic = True

    enabled: bool = parameter(True, "whether the layer is used")


@dataclass(frozen=True)
class StaticParameters(LayerConfig):
    """Parameters of `costmap_2d::StaticLayer`."""

    map_topic: str = parameter("map", "where the map comes from")
    first_map_only: bool = parameter(False, "use only the first map")
    subscribe_to_updates: bool = parameter(False, "also subscribe to the map's topic with _updates")
    track_unknown_space: bool = parameter(True, "whether an unknown cell of the map is unknown (255), not free")
    use_maximum: bool = parameter(False, "keep a greater cost of the layers below")
    lethal_cost_threshold: int = parameter(100, "a cell of at least this value is an obstacle")
    unknown_cost_value: int = parameter(-1, "the value of an unknown cell")
    trinary_costmap: bool = parameter(True, "treat values below the threshold as free instead of scaling them")


@dataclass(frozen=True)
class InflationConfig(LayerConfig):
    """Parameters of `costmap_2d::InflationLayer`, all of which can change at run time."""

    dynamic = True

    cost_scaling_factor: float = parameter(
        10.0, "how steeply the costs fall with distance", unit="1/m", minimum=0.0, maximum=100.0
    )
    inflation_radius: float = parameter(
        0.55, "the distance up to which an obstacle adds costs", unit="m", minimum=0.0, maximum=50.0
    )
    inflate_unknown: bool = parameter(False, "whether unknown cells also get costs")


@dataclass(frozen=True)
class ObstacleConfig(LayerConfig):
    """Parameters of `costmap_2d::ObstacleLayer` that can change at run time."""

    dynamic = True

    footprint_clearing_enabled: bool = parameter(True, "clear the cells under the robot")
    max_obstacle_height: float = parameter(
        2.0, "points above this height are not obstacles", unit="m", minimum=0.0, maximum=50.0
    )
    combination_method: int = parameter(
        MAXIMUM, "0 overwrites the layers below, 1 keeps the greater cost, 99 does nothing", minimum=0, maximum=99
    )


@dataclass(frozen=True)
class ObstacleStatics(Parameters):
    """Parameters of `costmap_2d::ObstacleLayer` that are read only once."""

    observation_sources: str = parameter("", "the names of the sources, separated by spaces")
    transform_tolerance: float = parameter(0.2, "maximum delay of a transform", unit="s")
    track_unknown_space: bool | None = parameter(
        None, "whether cells not yet seen are unknown; by default the costmap's setting"
    )
    obstacle_range: float = parameter(2.5, "for sources that do not set their own", unit="m")
    raytrace_range: float = parameter(3.0, "for sources that do not set their own", unit="m")

    def others(self) -> Iterable[str]:
        """Return the names of the sources, which are namespaces of their parameters."""
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
    z_voxels: int = parameter(10, "number of voxels in a column", minimum=0, maximum=16)
    unknown_threshold: int = parameter(
        15, "a column with at most this many unknown voxels is known", minimum=0, maximum=16
    )
    mark_threshold: int = parameter(0, "a column with at most this many marked voxels is free", minimum=0, maximum=16)


@dataclass(frozen=True)
class VoxelParameters(ObstacleParameters, VoxelConfig):
    """All parameters of `costmap_2d::VoxelLayer`."""


@dataclass(frozen=True)
class SourceParameters(Parameters):
    """Parameters of one observation source of an obstacle layer (`~global_costmap/obstacle_layer/scan/`)."""

    topic: str | None = parameter(None, "the topic of the source; by default its name")
    sensor_frame: str = parameter("", "the frame of the sensor; by default that of its messages")
    observation_persistence: float = parameter(0.0, "how long an observation is kept; 0 keeps the newest", unit="s")
    expected_update_rate: float = parameter(
        0.0, "time without a message after which the costmap is out of date; 0 for never", unit="s"
    )
    data_type: str = parameter(
        "PointCloud", "the type of its messages", choices=("PointCloud", "PointCloud2", "LaserScan")
    )
    min_obstacle_height: float = parameter(0.0, "points below are ignored", unit="m")
    max_obstacle_height: float = parameter(2.0, "points above are ignored", unit="m")
    inf_is_valid: bool = parameter(False, "whether a beam without a hit clears cells")
    clearing: bool = parameter(False, "whether cells along its rays are cleared")
    marking: bool = parameter(True, "whether its points are marked as obstacles")
    obstacle_range: float | None = parameter(
        None, "points up to this distance are obstacles; by default that of a parent namespace, or 2.5", unit="m"
    )
    raytrace_range: float | None = parameter(
        None, "rays clear up to this distance; by default that of a parent namespace, or 3.0", unit="m"
    )


def name_above(node: Node, namespace: str, name: str) -> str | None:
    """Return the full name of a parameter in this namespace or the nearest parent (`searchParam`), or None."""
    parent = node.resolve_parameter(namespace).rstrip("/")
    while True:
        if node.has_param(f"{parent}/{name}"):
            return f"{parent}/{name}"
        if not parent:
            return None
        parent = parent.rpartition("/")[0]


def parameter_above(node: Node, namespace: str, name: str, kind: type, default: Any) -> Any:
    """Return the value of a parameter that `name_above` finds, or `default`.

    Raises `ParameterError` if the value does not have the type `kind`.
    """
    found = name_above(node, namespace, name)
    return default if found is None else node.get_param(found, expect=kind)
