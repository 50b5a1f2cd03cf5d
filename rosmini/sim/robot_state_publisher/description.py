"""Reading the robot from `robot_description` on the Parameter Server."""

from __future__ import annotations

from rosmini.core.errors import ParameterNotSet
from rosmini.core.graph import Node
from rosmini.sim.urdf import Robot, load

NAME = "robot_description"


def read_description(node: Node) -> Robot:
    """Return the robot in the nearest parameter `robot_description`, searched from the node's namespace upwards.

    Raises `ParameterNotSet`, and `UrdfError` with the parameter's name and the line.
    """
    found = node.search_param(NAME)
    if found is None:
        raise ParameterNotSet(
            f"{node.name} needs the parameter {NAME}, a URDF, which is not set; for example: "
            f'<param name="{NAME}" command="$(find xacro)/xacro FILE"/> in a launch file, or '
            f'node.set_param("/{NAME}", rosmini.sim.urdf.xacro.expand(FILE))'
        )
    # bytes are never mistaken for a file name
    text = str(node.get_param(found, expect=str)).strip().encode()
    return load(text, meshes=False, path=found)
