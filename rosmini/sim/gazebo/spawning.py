"""Reading a model from a text: URDF or SDF."""

from __future__ import annotations

from rosmini.core.markup import MarkupError, parse
from rosmini.sim import sdf, urdf
from rosmini.sim.sdf.document import Pose6

from .from_urdf import Converted, from_urdf
from .model import GazeboWorld, Model


def model_of_text(text: str, path: str = "model_xml") -> Converted:
    """Return the model described by a URDF or an SDF. Raises `UrdfError`, `SdfError` or `MarkupError`."""
    root = parse(text, path)
    if root.tag == "robot":
        return from_urdf(urdf.load(text, path=path))
    return _of_sdf(text)


def _of_sdf(xml: str) -> Converted:
    document = sdf.load(xml)
    for model in (*document.models, *(each for world in document.worlds for each in world.models)):
        return Converted(model, warnings=tuple(str(note) for note in document.notes if note.warning))
    raise MarkupError("there is no <model> in the SDF, and no <include> of one", "model_xml", 1)


def spawn_text(world: GazeboWorld, text: str, name: str, pose: Pose6 | None, *, namespace: str = "") -> Model:
    """Insert the model described by a text. Raises `SpawnError` and the readers' errors."""
    converted = model_of_text(text)
    if converted.warnings:
        world.node.logwarn("\n".join([f"the model {name!r} is incomplete:", *converted.warnings]))
    return world.spawn(converted.model, name, pose, namespace=namespace, frames=converted.frames)
