"""Reads the parts of a model: links, shapes, joints, sensors, plugins."""

from __future__ import annotations

import math
from dataclasses import dataclass, field
from pathlib import Path
from typing import get_args

from rosmini.core.errors import Hints, nearest
from rosmini.core.markup import MAX_LENGTH_M, MAX_MASS_KG, Element
from rosmini.sim.urdf import meshes

from .document import (
    GeometryKind,
    Note,
    Pose6,
    SdfCollision,
    SdfGeometry,
    SdfInertial,
    SdfJoint,
    SdfLink,
    SdfPlugin,
    SdfSensor,
    SdfVisual,
)
from .errors import MissingError
from .frames import Scope, given
from .material_colours import colour_of
from .resources import Resources

MAX_INCLUDED_ELEMENTS = 200_000
"""Maximum number of XML elements in the includes of a file; a file counts each time it is included."""

OF_AN_INCLUDE = 20
"""Cost of an include, in elements, in addition to those of its file."""

MAX_POINTS = 2_000
"""Maximum number of corners of a polyline."""


NUMBERS = {
    "pose": 6, "xyz": 3, "gravity": 3, "normal": 3, "scale": 3, "point": 2, "radius": 1, "length": 1, "height": 1,
    "mass": 1, "ambient": 4, "diffuse": 4, "specular": 4, "emissive": 4,
}  # fmt: skip
"""The count of numbers in elements of these tags."""
SIZES = {"box": 3, "plane": 2}
"""The count of numbers in the `<size>` of these shapes."""


@dataclass
class Reading:
    """The state of reading a document."""

    resources: Resources
    notes: list[Note] = field(default_factory=list)
    included: int = 0
    hint: Hints = field(default_factory=Hints)

    def note(self, element: Element, text: str, *, warning: bool = False, left_out: str = "") -> None:
        """Note that something was left out or read differently; the same note about the same line is added once."""
        note = Note(element.path, element.line, text, warning, left_out)
        if note not in self.notes[-50:]:
            self.notes.append(note)

    def cut(self, element: Element) -> None:
        """Remove the words that sdformat ignores, which reads as many numbers as it needs, and note each such place."""
        if element.tag == "plugin":  # its parameters are its own
            return
        for child in element:
            count = SIZES.get(element.tag, 0) if child.tag == "size" else NUMBERS.get(child.tag, 0)
            if child.get("rotation_format") == "quat_xyzw":
                count = 7
            words = child.text.split(None, count) if count else []
            if len(words) > count:
                child.text = " ".join(words[:count])
                what = f"<{child.tag}> takes {count} number{'s' * (count > 1)}"
                self.note(child, f"{what}; the rest of its text is ignored, as in Gazebo", warning=True)
            self.cut(child)

    def include(self, element: Element, file: Path) -> Element:
        """Return the root of an included file, and count it. Raises `SdfError` at `element` if there are too many."""
        root, size = self.resources.parsed(file)
        self.included += OF_AN_INCLUDE + size
        if self.included > MAX_INCLUDED_ELEMENTS:
            raise element.error(f"the includes of this world have more than {MAX_INCLUDED_ELEMENTS} elements")
        self.cut(root)
        return root

    def unknown(self, element: Element, known: tuple[str, ...]) -> None:
        """Note each child that SDF does not define there, except those with a prefix (`other:tag`)."""
        for child in element:
            if child.tag not in known and ":" not in child.tag:
                hint = self.hint(child.tag, known)
                self.note(
                    child,
                    f"<{child.tag}> is nothing that <{element.tag}> has{'; ' + hint if hint else ''}: left out",
                    left_out=f"<{child.tag}>",
                )


def name_of(element: Element) -> str:
    """Return the required name of an element. Raises `SdfError`."""
    return element.attribute("name")


def flag(element: Element, way: str, *, default: bool) -> bool:
    """Return the value of a true-or-false child. Raises `SdfError`."""
    found = element.find(way)
    return default if found is None or not found.text else found.flag(found.text)


def number(element: Element, way: str, default: float, *, most: float = math.inf) -> float:
    """Return the value of a numeric child. Raises `SdfError`."""
    found = element.find(way)
    return default if found is None or not found.text else found.floats(found.text, 1, most=most)[0]


def unique(elements: list[Element], what: str) -> list[Element]:
    """Return the same elements. Raises `SdfError` if two have the same name."""
    seen: dict[str, Element] = {}
    for each in elements:
        name = name_of(each)
        if name in seen:
            raise each.error(f"there is another {what} {name!r} in line {seen[name].line}; give each its own name")
        seen[name] = each
    return elements


def plugins(element: Element) -> tuple[SdfPlugin, ...]:
    """Return the plugins of an element, in order. Raises `SdfError` if one has no filename."""
    return tuple(SdfPlugin(tag.get("name"), tag.attribute("filename"), tag) for tag in element.all("plugin"))


LINK_TAGS = (
    "pose", "inertial", "collision", "visual", "sensor", "gravity", "self_collide", "kinematic", "enable_wind",
    "must_be_base_link", "velocity_decay", "projector", "audio_source", "audio_sink", "battery", "light",
    "particle_emitter", "frame", "material",
)  # fmt: skip


def link(element: Element, scope: Scope, reading: Reading) -> SdfLink:
    """Return a link. Raises `SdfError`."""
    here = scope.place(name_of(element), element)
    reading.unknown(element, LINK_TAGS)
    for light in element.all("light"):
        reading.note(light, "a light: left out, the light is the same everywhere", left_out="a light")
    return SdfLink(
        name_of(element),
        here,
        _inertial(element.find("inertial"), scope, here, reading),
        tuple(_collision(each, scope, here, reading) for each in unique(element.all("collision"), "collision")),
        tuple(_visual(each, scope, here, reading) for each in unique(element.all("visual"), "visual")),
        tuple(sensor(each, scope, here) for each in unique(element.all("sensor"), "sensor")),
        element.line,
    )


def joint(element: Element, scope: Scope) -> SdfJoint:
    """Return a joint. Raises `SdfError` if one of its links does not exist."""
    parent, child = _end(element.need("parent")), _end(element.need("child"))
    for tag, name in (("parent", parent), ("child", child)):
        if name not in scope and name != "world":
            element.need(tag)  # reports the error at the name's line
            scope.place(name, element.need(tag))
    axis = element.find("axis/xyz")
    xyz = axis.floats(axis.text, 3, most=MAX_LENGTH_M) if axis is not None else (0.0, 0.0, 1.0)
    at = given(element)
    pose = scope.seen_from(scope.place(child), at) if child in scope else at.pose
    kind = element.attribute("type")
    return SdfJoint(name_of(element), kind, parent, child, pose, (xyz[0], xyz[1], xyz[2]), element, element.line)


def _end(element: Element) -> str:
    return element.text or element.word("link") or element.attribute("link")


def _inertial(element: Element | None, scope: Scope, here: Pose6, reading: Reading) -> SdfInertial:
    if element is None:
        return SdfInertial()
    mass = number(element, "mass", 1.0, most=MAX_MASS_KG)
    if mass <= 0:
        reading.note(element.need("mass"), f"a mass is more than 0 kg, not {mass:g}: taken for 1 kg", warning=True)
        mass = 1.0
    names = ("ixx", "iyy", "izz", "ixy", "ixz", "iyz")
    defaults = (1.0, 1.0, 1.0, 0.0, 0.0, 0.0)
    ixx, iyy, izz, ixy, ixz, iyz = (
        number(element, f"inertia/{name}", default, most=MAX_MASS_KG)
        for name, default in zip(names, defaults, strict=True)
    )
    for name, value in (("ixx", ixx), ("iyy", iyy), ("izz", izz)):
        if value <= 0:
            wrong = element.need("inertia").need(name)
            reading.note(wrong, f"{name} is more than 0 kg m2, not {value:g}: all are taken for 1 kg m2", warning=True)
            ixx, iyy, izz, ixy, ixz, iyz = defaults
            break
    return SdfInertial(mass, scope.seen_from(here, given(element)), (ixx, iyy, izz, ixy, ixz, iyz))


def _collision(element: Element, scope: Scope, here: Pose6, reading: Reading) -> SdfCollision:
    friction = element.find("surface/friction/ode/mu")
    bounce = element.find("surface/bounce/restitution_coefficient")
    restitution = bounce.floats(bounce.text, 1)[0] if bounce is not None and bounce.text else 0.0
    if bounce is not None and not 0 <= restitution <= 1:
        nearest_valid = min(max(restitution, 0.0), 1.0)
        reading.note(
            bounce,
            f"a restitution coefficient is from 0 to 1, not {restitution:g}: {nearest_valid:g} is taken",
            warning=True,
        )
        restitution = nearest_valid
    return SdfCollision(
        name_of(element),
        scope.seen_from(here, given(element)),
        _solid(element.need("geometry"), reading),
        friction.floats(friction.text, 1)[0] if friction is not None and friction.text else None,
        element.line,
        restitution,
    )


def _solid(element: Element, reading: Reading) -> SdfGeometry:
    """Return the shape of a collision. A mesh that cannot be read is left out."""
    found = geometry(element, reading)
    if found.mesh is None:
        return found
    try:
        meshes.read(found.mesh, found.submesh)
    except meshes.MeshError as error:
        reading.note(element.need("mesh"), f"this mesh is left out: {error}", warning=True, left_out="a mesh")
        return SdfGeometry("other", line=found.line)
    return found


def _visual(element: Element, scope: Scope, here: Pose6, reading: Reading) -> SdfVisual:
    return SdfVisual(
        name_of(element),
        scope.seen_from(here, given(element)),
        geometry(element.need("geometry"), reading),
        colour_of(element.find("material")),
        element.line,
    )


def sensor(element: Element, scope: Scope, here: Pose6) -> SdfSensor:
    """Return a sensor on a link at `here`. Raises `SdfError`."""
    rate = number(element, "update_rate", 0.0)
    if rate < 0:
        raise element.need("update_rate").error(f"a rate is 0 (always) or more, not {rate:g}")
    pose = scope.seen_from(here, given(element))
    return SdfSensor(name_of(element), element.attribute("type"), pose, rate, element, plugins(element))


# ---- shapes ----

KINDS = tuple(kind for kind in get_args(GeometryKind) if kind != "other")
OTHER = ("heightmap", "image", "capsule", "ellipsoid")


def geometry(element: Element, reading: Reading) -> SdfGeometry:
    """Return a shape. Raises `SdfError` for an impossible one; one that rosmini lacks is noted."""
    shapes = [child for child in element if child.tag in KINDS]
    if not shapes:
        others = [child for child in element if ":" not in child.tag]
        for other in others:
            hint = nearest(other.tag, KINDS) or f"rosmini has {', '.join(KINDS)}"
            reading.note(
                other,
                f"the shape <{other.tag}> is left out; {hint}",
                warning=other.tag not in OTHER,
                left_out=f"<{other.tag}>",
            )
        return SdfGeometry("other" if others else "empty", line=element.line)
    shape = shapes[0]
    if shape.tag == "polyline":
        drawn = [_polyline(each, reading) for each in element.all("polyline")]
        return SdfGeometry("polyline", length=drawn[0][1], outlines=tuple(each[0] for each in drawn), line=shape.line)
    return _READERS[shape.tag](shape, reading)


THINNEST = 1e-4
"""Replacement for a size of 0, as in Gazebo [m]."""


def _sizes(element: Element, tag: str, reading: Reading, count: int = 1) -> tuple[float, ...]:
    """Return sizes of a shape. Raises `SdfError` for a negative one; 0 becomes a very small size, as in Gazebo."""
    child = element.need(tag)
    values = child.floats(child.text, count, most=MAX_LENGTH_M)
    if min(values) < 0:
        raise child.error(f"the {tag} of a {element.tag} is more than 0 m, not {child.text}")
    if min(values) == 0:
        reading.note(child, f"the {tag} of a {element.tag} is 0 m: {THINNEST * 1000:g} mm is taken", warning=True)
    return tuple(value or THINNEST for value in values)


def _box(element: Element, reading: Reading) -> SdfGeometry:
    return SdfGeometry("box", size=_sizes(element, "size", reading, 3), line=element.line)


def _cylinder(element: Element, reading: Reading) -> SdfGeometry:
    (radius,), (length,) = (_sizes(element, tag, reading) for tag in ("radius", "length"))
    return SdfGeometry("cylinder", radius=radius, length=length, line=element.line)


def _sphere(element: Element, reading: Reading) -> SdfGeometry:
    return SdfGeometry("sphere", radius=_sizes(element, "radius", reading)[0], line=element.line)


def _plane(element: Element, reading: Reading) -> SdfGeometry:  # noqa: ARG001
    normal, size = element.find("normal"), element.find("size")
    x, y, z = normal.floats(normal.text, 3, most=MAX_LENGTH_M) if normal is not None else (0.0, 0.0, 1.0)
    if normal is not None and not (x or y or z):
        raise normal.error("the normal of a plane points somewhere; 0 0 0 does not")
    sides = size.floats(size.text, 2) if size is not None else (1.0, 1.0)
    return SdfGeometry("plane", size=sides, normal=(x, y, z), line=element.line)


def _polyline(element: Element, reading: Reading) -> tuple[tuple[tuple[float, float], ...], float]:
    points = []
    for point in element.all("point"):
        x, y = point.floats(point.text, 2, most=MAX_LENGTH_M)
        points.append((x, y))
    if len(points) > 1 and points[0] == points[-1]:
        points.pop()
    if len(points) > MAX_POINTS:
        raise element.error(f"a polyline has {MAX_POINTS} points or less, not {len(points)}")
    if len(points) < 3:
        raise element.error(f"a polyline has 3 points or more, not {len(points)}")
    height = _sizes(element, "height", reading)[0] if element.find("height") is not None else 1.0
    return tuple(points), height


def _mesh(element: Element, reading: Reading) -> SdfGeometry:
    uri, scale = element.need("uri"), element.find("scale")
    x, y, z = scale.floats(scale.text, 3, most=MAX_LENGTH_M) if scale is not None else (1.0, 1.0, 1.0)
    if scale is not None and not (x and y and z):
        raise scale.error("a mesh is scaled by numbers other than 0")
    try:
        path = reading.resources.find(uri.text, uri)
    except MissingError as error:
        reading.note(uri, f"this mesh is left out: {error.message}", warning=True, left_out="a mesh")
        return SdfGeometry("other", line=element.line)
    part = element.word("submesh/name")
    return SdfGeometry("mesh", mesh=path, scale=(x, y, z), submesh=part, line=element.line)


def _empty(element: Element, reading: Reading) -> SdfGeometry:  # noqa: ARG001
    return SdfGeometry("empty", line=element.line)


_READERS = {
    "box": _box, "cylinder": _cylinder, "sphere": _sphere, "plane": _plane, "mesh": _mesh, "empty": _empty,
}  # fmt: skip
