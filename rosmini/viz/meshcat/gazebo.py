"""A running Gazebo world in three dimensions: its models by their visuals or by their collision shapes."""

from __future__ import annotations

from dataclasses import replace

import numpy as np

from rosmini.core.errors import nearest
from rosmini.core.geometry.products import matrix_product, norm
from rosmini.sim.gazebo.snapshot import ShownModel, Snapshot
from rosmini.sim.sdf.poses import matrix
from rosmini.sim.shapes import Box, Cylinder, Polygon, Sphere, outline_at
from rosmini.viz.gazebo_pictures import pose_lines, time_text
from rosmini.viz.rounding import snap
from rosmini.viz.view import ViewError
from rosmini.viz.world_pictures import pose_text

from .links import link_parts
from .scene3d import OMITTED_COLOURS, Camera, Scene3D
from .solids import Floats
from .view import HEIGHT, MeshcatView, camera_for, check_distance, free_sight
from .visuals import SOLID, is_plain, surfaces

MODEL_DISTANCE = 1.7
"""Distance of the camera from a model, as a multiple of the model's size."""
WORLD_ELEVATION = 58.0
"""Elevation of the camera for a world with robots [deg]: they are small, and walls surround them."""


def gazebo_3d(
    snapshot: Snapshot, *, focus: str = "world", collisions: bool = False, distance: float | None = None,
    azimuth: float | None = None, elevation: float | None = None, title: str | None = None, height: int = HEIGHT,
) -> MeshcatView:  # fmt: skip
    """Show a Gazebo world in three dimensions, as Gazebo's window shows it.

    Args:
        snapshot: the snapshot of a server or a client.
        focus: the target of the camera: "world", or the name of a model.
        collisions: show collision shapes instead of visuals, like the menu entry View, Collisions.
        distance: distance of the camera from its target [m].
        azimuth: direction of the camera as seen from its target [deg]: 0 is the side of x, 90 the side of y.
        elevation: angle of the camera above the horizon [deg].
        title: a caption under the picture, and the first line of its text form.
        height: height of the viewer [CSS px].

    Raises:
        ViewError: the model does not exist, or the distance is not positive.
        MeshError: a mesh cannot be read.

    """
    world = snapshot.world()
    if elevation is None and focus == "world" and snapshot.robots:
        elevation = WORLD_ELEVATION
    camera = camera_for(world, None, focus="world", distance=distance, azimuth=azimuth, elevation=elevation)
    plain = [model for model in snapshot.models if is_plain(model)]
    drawn = [model for model in snapshot.models if not is_plain(model)]
    if focus != "world":
        camera = _camera_on(snapshot, focus, distance=distance, azimuth=azimuth, elevation=elevation)
    scene = Scene3D(camera)
    obstacles = [each for model in plain for each in model.placed_solids()]
    if collisions:
        obstacles = [replace(each, colour=SOLID) for each in obstacles]
    scene.add_world(replace(world, obstacles=tuple(obstacles)), bounds=world.bounds)
    for model in drawn:
        _add(scene, model, collisions=collisions)
    kind = ", what is solid of them" if collisions else ""
    count = f"{len(snapshot.models)} model{'s' * (len(snapshot.models) != 1)}"
    lines = [f"3D: {snapshot.name} with {count}{kind}, at {time_text(snapshot)}"]
    lines += [f"{robot.name}: pose {pose_text(robot.pose)}" for robot in snapshot.robots]
    lines += pose_lines(snapshot)
    said = [f"{robot.name} at {pose_text(robot.pose)}" for robot in snapshot.robots]
    said += [f"{m.name} at {pose_text(m.place)}" for m in snapshot.things]
    there = f": {', '.join(said[:6])}{' and more' if len(said) > 6 else ''}" if said else ""
    alt = f"{snapshot.title} in three dimensions, {count}{kind}, at {time_text(snapshot)}{there}."
    return MeshcatView(
        scene, label=f"{snapshot.title} in 3D", text="\n".join(lines), alt=alt, title=title, height=height
    )


def _add(scene: Scene3D, model: ShownModel, *, collisions: bool) -> None:
    """Add a model; the surfaces of equal models are stored once."""
    node = "models/" + model.name.replace("/", " ")
    there = matrix(model.pose)
    for link in model.links:
        parts = surfaces(link, matrix_product(there, matrix(link.pose)), collisions=collisions, without=OMITTED_COLOURS)
        if parts:
            scene.place(node, there)
            below = f"{node}/{link.name.replace('/', ' ')}"
            scene.place(below, matrix(link.pose))
            for part in link_parts(below, parts):
                scene.add_surface(part, shared=True)


def _camera_on(
    snapshot: Snapshot, name: str, *, distance: float | None, azimuth: float | None, elevation: float | None
) -> Camera:
    """Return a camera aimed at one model."""
    models = {model.name: model for model in snapshot.models}
    if name not in models:
        hint = nearest(name, models) or f"the models are: {', '.join(models) or 'none'}"
        raise ViewError(
            f"the focus of a 3D picture of Gazebo must be 'world' or the name of a model, not {name!r}; {hint}"
        )
    check_distance(distance)
    points = _corners(models[name])
    low, high = points.min(axis=0), points.max(axis=0)
    size = float(snap(norm(high - low), 0.01))
    away = round(MODEL_DISTANCE * size + 0.1, 2) if distance is None else distance
    there = replace(snapshot, models=tuple(model for model in snapshot.models if model.name != name)).world()
    x, y, z = (round(c, 3) for c in snap((low + high) / 2).tolist())
    sight = free_sight(there, (x, y, models[name].place[2]), away)
    return Camera(
        (x, y, z), away, sight[0] if azimuth is None else azimuth, sight[1] if elevation is None else elevation
    )


def _corners(model: ShownModel) -> Floats:
    """Return the corners (n, 3) of the visible parts of a model, in the world."""
    there = matrix(model.pose)
    placed = ((link, matrix_product(there, matrix(link.pose))) for link in model.links)
    found = [surface.moved(at).vertices for link, at in placed for surface in surfaces(link, at)]
    for solid in model.placed_solids() if not found else ():
        for shape, pose in solid.parts():
            reach = shape.radius if isinstance(shape, (Cylinder, Sphere)) else 0.0
            flat = np.add(pose[:2], [(-reach, -reach), (reach, reach)])
            if isinstance(shape, (Box, Polygon)):
                flat = outline_at(shape, pose)
            found += [np.column_stack([flat, np.full(len(flat), z)]) for z in (solid.bottom, solid.height)]
    return np.vstack(found) if found else there[None, :3, 3]
