"""Conversion of parameters from before the introduction of layers (ROS Hydro).

The files of ROBOTIS and navigation_stage have this form: `static_map`, `map_type` and flat parameters, no `plugins`.
"""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

if TYPE_CHECKING:
    from rosmini.core.graph import Node

STATIC = ("map_topic", "unknown_cost_value", "lethal_cost_threshold")
VOXEL = ("origin_z", "z_resolution", "z_voxels", "mark_threshold", "unknown_threshold")
OBSTACLE = ("max_obstacle_height", "raytrace_range", "obstacle_range")
INFLATION = ("cost_scaling_factor", "inflation_radius")

INHERITED = {
    "costmap_2d::StaticLayer": (*STATIC, "track_unknown_space"),
    "costmap_2d::VoxelLayer": VOXEL,
    "costmap_2d::ObstacleLayer": (*OBSTACLE, "track_unknown_space"),
    "costmap_2d::InflationLayer": INFLATION,
}
"""Parameters that a layer inherits from the costmap's namespace if they are set there."""

OLD = ("static_map", "map_type")
"""Parameters that are ignored once `plugins` is set."""


def migrate(node: Node, namespace: str, name: str) -> None:
    """Move old parameters in `namespace` (`~global_costmap/`) to layers; if `plugins` is set, only warn about them.

    `name` is the costmap's name in warnings.
    """
    if node.has_param(namespace + "plugins"):
        for old in OLD:
            if node.has_param(namespace + old):
                node.logwarn(f'{name}: Pre-Hydro parameter "{old}" unused since "plugins" is provided')
        return
    node.logwarn(f'{name}: Parameter "plugins" not provided, loading pre-Hydro parameters')
    plugins = []
    if node.get_param(namespace + "static_map", False) is True:
        plugins.append(_entry("static_layer", "StaticLayer"))
        move(node, namespace, "static_layer", STATIC)
        move(node, namespace, "static_layer", ("track_unknown_space",), delete=False)
    is_voxel = node.get_param(namespace + "map_type", "") == "voxel"
    plugins.append(_entry("obstacle_layer", "VoxelLayer" if is_voxel else "ObstacleLayer"))
    if is_voxel:
        move(node, namespace, "obstacle_layer", VOXEL)
    sources = str(node.get_param(namespace + "observation_sources", "")).split()
    move(
        node,
        namespace,
        "obstacle_layer",
        (*OBSTACLE, "track_unknown_space", *dict.fromkeys(sources), "observation_sources"),
    )
    plugins.append(_entry("inflation_layer", "InflationLayer"))
    move(node, namespace, "inflation_layer", INFLATION)
    node.set_param(namespace + "plugins", plugins)


def inherit(node: Node, namespace: str, layer: str, kind: str) -> None:
    """Copy the parameters that a layer of the type `kind` inherits from the costmap's `namespace`."""
    move(node, namespace, layer, INHERITED.get(kind.replace("/", "::"), ()), delete=False)


def move(node: Node, namespace: str, layer: str, names: tuple[str, ...], *, delete: bool = True) -> None:
    """Move (or without `delete` copy) those of the named parameters that are set into the namespace of a layer."""
    for name in names:
        if node.has_param(namespace + name):
            node.set_param(f"{namespace}{layer}/{name}", node.get_param(namespace + name))
            if delete:
                node.delete_param(namespace + name)


def _entry(name: str, kind: str) -> Any:
    return {"name": name, "type": f"costmap_2d::{kind}"}
