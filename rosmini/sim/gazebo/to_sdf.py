"""Writing a model as SDF text, for `gz sdf -p`."""

from __future__ import annotations

from collections.abc import Sequence

from rosmini.core.markup import Element
from rosmini.sim.sdf.document import ORIGIN, Pose6, SdfGeometry, SdfJoint, SdfLink, SdfModel

VERSION = "1.7"


def to_sdf(model: SdfModel) -> str:
    """Return the SDF text of a model."""
    root = Element("sdf", {"version": VERSION}, children=[_model(model)])
    return root.source()


def _element(tag: str, *children: Element, text: str = "", **attributes: str) -> Element:
    return Element(tag, attributes, text, list(children))


def _numbers(values: Sequence[float]) -> str:
    return " ".join(f"{round(value, 9) + 0.0:.9g}" for value in values)


def _value(tag: str, *values: float) -> Element:
    return _element(tag, text=_numbers(values))


def _pose(pose: Pose6) -> list[Element]:
    return [] if pose == ORIGIN else [_value("pose", *pose)]


def _model(model: SdfModel) -> Element:
    static = [_element("static", text="1")] if model.static else []
    return _element(
        "model",
        *_pose(model.pose),
        *static,
        *(_link(link) for link in model.links),
        *(_joint(joint) for joint in model.joints),
        *(_model(each) for each in model.models),
        *(plugin.element for plugin in model.plugins),
        name=model.name,
    )


def _link(link: SdfLink) -> Element:
    own = link.inertial
    names = ("ixx", "iyy", "izz", "ixy", "ixz", "iyz")
    inertia = _element("inertia", *(_value(name, each) for name, each in zip(names, own.inertia, strict=True)))
    inertial = _element("inertial", *_pose(own.pose), _value("mass", own.mass), inertia)
    shapes = [
        _element("collision", *_pose(each.pose), _geometry(each.geometry), name=each.name) for each in link.collisions
    ]
    for visual in link.visuals:
        colour = visual.colour
        material = []
        if colour is not None:
            parts = [int(colour[i : i + 2], 16) / 255 for i in (1, 3, 5)]
            material = [_element("material", _value("diffuse", *(round(part, 4) for part in parts), 1.0))]
        shapes.append(_element("visual", *_pose(visual.pose), _geometry(visual.geometry), *material, name=visual.name))
    sensors = []
    for sensor in link.sensors:
        inside = [each for each in sensor.element if each.tag != "pose"]
        sensors.append(Element("sensor", dict(sensor.element.attributes), "", [*_pose(sensor.pose), *inside]))
    return _element("link", *_pose(link.pose), inertial, *shapes, *sensors, name=link.name)


def _joint(joint: SdfJoint) -> Element:
    ends = [_element("parent", text=joint.parent), _element("child", text=joint.child)]
    axis = [] if joint.type == "fixed" else [_element("axis", _value("xyz", *joint.axis))]
    return _element("joint", *_pose(joint.pose), *ends, *axis, name=joint.name, type=joint.type)


def _geometry(geometry: SdfGeometry) -> Element:
    inside: list[Element] = []
    if geometry.kind in ("box", "plane"):
        inside.append(_value("size", *geometry.size))
    if geometry.kind == "plane":
        inside.insert(0, _value("normal", *geometry.normal))
    if geometry.kind in ("cylinder", "sphere"):
        inside.append(_value("radius", geometry.radius))
    if geometry.kind == "cylinder":
        inside.append(_value("length", geometry.length))
    if geometry.kind == "polyline":
        inside += [_value("point", *corner) for corner in geometry.outlines[0]]
        inside.append(_value("height", geometry.length))
    if geometry.kind == "mesh":
        inside.append(_value("scale", *geometry.scale))
        if geometry.mesh is not None:
            path = geometry.mesh.as_posix()
            inside.append(_element("uri", text=f"file://{'' if path.startswith('/') else '/'}{path}"))
    return _element("geometry", _element(geometry.kind, *inside))
