"""RobotModel: the robot from its URDF, each link at its pose in tf."""

from __future__ import annotations

from collections.abc import Iterable, Mapping
from typing import Any

import numpy as np

from rosmini.core.errors import RosminiError
from rosmini.core.tf import TransformException
from rosmini.core.tf.rigid import matrix
from rosmini.sim.urdf import Robot, load
from rosmini.sim.urdf.meshes import Surface
from rosmini.viz.meshcat.links import link_surfaces
from rosmini.viz.rviz.context import Context
from rosmini.viz.rviz.display import Display, Level
from rosmini.viz.rviz.primitives import Mesh, Primitive
from rosmini.viz.rviz.properties import Property, Tree

GREY = (0.6, 0.6, 0.6, 1.0)


class RobotModel(Display, plugin="rviz/RobotModel"):
    """The links of the robot in a parameter; it is loaded again when the parameter changes."""

    properties = (
        Property("Robot Description", "robot_description", "the parameter with the URDF"),
        Property("TF Prefix", "", "prefix of the names of all links"),
        Property("Update Interval", 0.0, "not used: links move with each picture", unit="s", minimum=0.0),
        Property("Alpha", 1.0, "opacity", minimum=0.0, maximum=1.0),
        Property("Visual Enabled", True, "show the visual shapes"),
        Property("Collision Enabled", False, "show the collision shapes"),
        Property("Links", Tree(), "which links are shown"),
    )

    def __init__(self, name: str = "", tree: Mapping[str, Any] | None = None) -> None:
        super().__init__(name, tree)
        self._read: tuple[str, bool] | None = None
        self._surfaces: dict[str, list[Surface]] = {}

    def reset(self) -> None:
        """Load the robot again before the next drawing."""
        self._read = None

    def primitives(self, context: Context) -> Iterable[Primitive]:
        """Return a mesh for each colour of each link."""
        if not self._load(context):
            return []
        found: list[Primitive] = []
        links = self["Links"]
        for link, surfaces in self._surfaces.items():
            told = links.get(link)
            one = told if isinstance(told, dict) else {}
            if not (one.get("Value", True) if surfaces else False):
                continue
            frame = "/".join(filter(None, (self["TF Prefix"].strip("/"), link)))
            try:
                pose = matrix(context.place(frame))
            except TransformException:
                text = f"No transform from [{frame}] to [{context.fixed_frame}]"
                self.set_status(Level.ERROR, link, text)
                continue
            self.set_status(Level.OK, link, "Transform OK")
            alpha = self["Alpha"] * float(one.get("Alpha", 1.0))
            for surface in surfaces:
                colour = np.array(surface.colour or GREY)
                colour[3] *= alpha
                found.append(Mesh(surface.vertices, surface.faces, colour, pose))
        return found

    def _load(self, context: Context) -> bool:
        """Load the robot if its description changed; return True if there is something to draw."""
        name = self["Robot Description"]
        key = context.node.search_param(name)
        text = "" if key is None else str(context.node.get_param(key))
        wanted = (text, self["Collision Enabled"])
        if self._read == wanted:
            return bool(self._surfaces)
        for each in self.statuses:
            self.clear_status(each.name)
        self._read, self._surfaces = wanted, {}
        if key is None:
            said = f"Parameter [{name}] does not exist, and was not found by searchParam()"
            self.set_status(Level.ERROR, "URDF", said)
            return False
        try:
            robot = load(text.strip().encode(), path=key)
        except RosminiError as error:
            self.set_status(Level.ERROR, "URDF", str(error).partition("\n")[0])
            return False
        errors = [note for notes in robot.left_out.values() for note in notes]
        if errors:
            self.set_status(Level.ERROR, "URDF", errors[0])
        else:
            self.set_status(Level.OK, "URDF", "URDF parsed OK")
        for link in robot.links:
            self._surfaces[link] = self._seen(robot, link)
        return True

    def _seen(self, robot: Robot, link: str) -> list[Surface]:
        try:
            found = link_surfaces(robot, link) if self["Visual Enabled"] else []
            return found + (link_surfaces(robot, link, collisions=True) if self["Collision Enabled"] else [])
        except RosminiError as error:
            self.set_status(Level.ERROR, link, str(error).partition("\n")[0])
            return []
