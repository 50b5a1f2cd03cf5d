"""A robot in three dimensions from its URDF: any robot, with joint positions of your choice."""

from __future__ import annotations

from collections.abc import Mapping

import numpy as np

from rosmini.core.geometry.products import norm
from rosmini.sim.urdf import Robot
from rosmini.viz.rounding import fixed, snap
from rosmini.viz.view import ViewError
from rosmini.viz.words import plural

from .links import link_parts, link_surfaces
from .scene3d import ROBOT, Camera, Scene3D
from .view import HEIGHT, MeshcatView, check_distance


def urdf_3d(
    robot: Robot, *, joints: Mapping[str, float] | None = None, collisions: bool = False, distance: float | None = None,
    azimuth: float | None = None, elevation: float | None = None, title: str | None = None, height: int = HEIGHT,
) -> MeshcatView:  # fmt: skip
    """Show a robot with its joints at these positions [rad or m]; the others have the defaults of `Robot.positions`.

    With `collisions` it shows the collision shapes instead of the visual ones.

    Raises:
        UnknownJoint: it has no such joint, or the joint cannot be set.
        MeshError: a mesh cannot be read.
        ViewError: there is nothing to see, or the distance is not positive.

    """
    check_distance(distance)
    shapes = {name: link_surfaces(robot, name, collisions=collisions) for name in robot.links}
    places = robot.transforms(joints)
    corners = [surface.moved(places[name]).vertices for name, surfaces in shapes.items() for surface in surfaces]
    if not corners:
        what = "collision shapes" if collisions else "visual shapes"
        raise ViewError(f"the robot {robot.name!r} has no {what}: there is nothing to see")
    points = np.vstack(corners)
    low, high = points.min(axis=0), points.max(axis=0)
    size = norm(high - low)
    camera = Camera(
        tuple(round(c, 3) for c in snap((low + high) / 2).tolist()),
        round(1.45 * size + 0.02, 3) if distance is None else distance,
        -38.0 if azimuth is None else azimuth,
        20.0 if elevation is None else elevation,
    )
    scene = Scene3D(camera)
    lift = np.eye(4)
    lift[2, 3] = min(0.0, float(snap(low[2]))) * -1.0
    scene.add_ground((float(low[0]), float(low[1]), float(high[0]), float(high[1])))
    scene.place(ROBOT, lift)
    for name, surfaces in shapes.items():
        if surfaces:
            scene.place(f"{ROBOT}/{name}", places[name])
            for part in link_parts(f"{ROBOT}/{name}", surfaces):
                scene.add_surface(part)
    shown = [name for name in robot.links if shapes[name]]
    span = " x ".join(fixed(side, 3) for side in (high - low).tolist())
    at = {name: position for name, position in robot.positions(joints).items() if joints and name in joints}
    said = "".join(f"; {name} at {fixed(position, 2)}" for name, position in at.items())
    kind = "collision shapes of " if collisions else ""
    text = f"3D: {kind}{robot.name}, {span} m, {plural(len(shown), 'link')} to see of {len(robot.links)}{said}"
    alt = (
        f"{robot.name} in three dimensions: {kind and 'its collision shapes, '}{span} metres, "
        f"with {', '.join(shown)}{said}."
    )
    return MeshcatView(scene, label=f"{robot.name} in 3D", text=text, alt=alt, title=title, height=height)
