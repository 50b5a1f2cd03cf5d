"""A running Gazebo world in three dimensions: its models by their visuals."""

from __future__ import annotations

from dataclasses import replace

from rosmini.core.geometry.products import matrix_product
from rosmini.sim.gazebo.snapshot import ShownModel, Snapshot
from rosmini.sim.sdf.poses import matrix
from rosmini.viz.gazebo_pictures import pose_lines, time_text
from rosmini.viz.world_pictures import pose_text

from .links import link_parts
from .scene3d import OMITTED_COLOURS, Scene3D
from .view import HEIGHT, MeshcatView, camera_for
from .visuals import is_plain, surfaces

WORLD_ELEVATION = 58.0
"""Elevation of the camera for a world with robots [deg]: they are small, and walls surround them."""


def gazebo_3d(snapshot: Snapshot, *, title: str | None = None, height: int = HEIGHT) -> MeshcatView:
    """Show a Gazebo world in three dimensions, as Gazebo's window shows it.

    Args:
        snapshot: the snapshot of a server or a client.
        title: a caption under the picture, and the first line of its text form.
        height: height of the viewer [CSS px].

    Raises:
        MeshError: a mesh cannot be read.

    """
    world = snapshot.world()
    elevation = WORLD_ELEVATION if snapshot.robots else None
    scene = Scene3D(camera_for(world, None, focus="world", distance=None, azimuth=None, elevation=elevation))
    plain = [model for model in snapshot.models if is_plain(model)]
    obstacles = tuple(each for model in plain for each in model.placed_solids())
    scene.add_world(replace(world, obstacles=obstacles), bounds=world.bounds)
    for model in snapshot.models:
        if model not in plain:
            _add(scene, model)
    count = f"{len(snapshot.models)} model{'s' * (len(snapshot.models) != 1)}"
    lines = [f"3D: {snapshot.name} with {count}, at {time_text(snapshot)}"]
    lines += [f"{robot.name}: pose {pose_text(robot.pose)}" for robot in snapshot.robots]
    lines += pose_lines(snapshot)
    said = [f"{robot.name} at {pose_text(robot.pose)}" for robot in snapshot.robots]
    said += [f"{m.name} at {pose_text(m.place)}" for m in snapshot.things]
    there = f": {', '.join(said[:6])}{' and more' if len(said) > 6 else ''}" if said else ""
    alt = f"{snapshot.title} in three dimensions, {count}, at {time_text(snapshot)}{there}."
    return MeshcatView(
        scene, label=f"{snapshot.title} in 3D", text="\n".join(lines), alt=alt, title=title, height=height
    )


def _add(scene: Scene3D, model: ShownModel) -> None:
    """Add a model; the surfaces of equal models are stored once."""
    node = "models/" + model.name.replace("/", " ")
    there = matrix(model.pose)
    for link in model.links:
        parts = surfaces(link, matrix_product(there, matrix(link.pose)), without=OMITTED_COLOURS)
        if parts:
            scene.place(node, there)
            below = f"{node}/{link.name.replace('/', ' ')}"
            scene.place(below, matrix(link.pose))
            for part in link_parts(below, parts):
                scene.add_surface(part, shared=True)
