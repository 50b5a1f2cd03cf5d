"""Reads URDF (http://wiki.ros.org/urdf/XML) from text or a file; errors contain file, line and element."""

from __future__ import annotations

import math
from collections.abc import Callable, Mapping
from dataclasses import replace
from os import PathLike, fspath
from pathlib import Path
from typing import TypeVar, get_args

from rosmini.core import files
from rosmini.core.errors import Hints, RosminiError, nearest
from rosmini.core.markup import MAX_LENGTH_M, MAX_MASS_KG, NO_PATH, Element, parse, parse_file
from rosmini.core.packages import SCHEME, PackageIndex

from .checks import check_tree, inertia_notes, mimic_problem
from .errors import UrdfError
from .model import (
    Box,
    Collision,
    Cylinder,
    Dynamics,
    Extension,
    Geometry,
    Inertial,
    Joint,
    JointType,
    Limit,
    Link,
    Material,
    Mesh,
    Mimic,
    Origin,
    Robot,
    Sphere,
    Vector,
    Visual,
)

T = TypeVar("T")

KNOWN = frozenset({"link", "joint", "material", "gazebo", "transmission", "sensor", "model_state", "contact"})
"""Known elements of a robot; other tags get a note, because extensions may add some."""

NEEDS_LIMIT = ("revolute", "prismatic")


def load(
    source: str | bytes | PathLike[str],
    *,
    packages: PackageIndex | None = None,
    mappings: Mapping[str, str] | None = None,
    meshes: bool = True,
    path: str | PathLike[str] | None = None,
    confined: bool = True,
) -> Robot:
    """Return the robot of a URDF text (which begins with ``<``), of a ``.urdf`` file, or of a ``.xacro`` file.

    Args:
        source: the text, or the path of the file; ``package://`` paths too.
        packages: the index of packages for ``package://`` addresses and ``$(find ...)``; by default `PackageIndex()`.
        mappings: arguments for a ``.xacro`` file.
        meshes: False skips the search for mesh files; `Mesh.path` is then None.
        path: the name of the file in errors about a text.
        confined: False lets expressions in a ``.xacro`` file do anything that Python can (see
        `rosmini.sim.urdf.xacro.expand`).

    Raises:
        UrdfError: the file cannot be read, is not XML, is not a tree of links, names what does not exist, or has
            invalid numbers.

    """
    index = packages if packages is not None else PackageIndex()
    if isinstance(source, bytes) or (isinstance(source, str) and source.lstrip().startswith("<")):
        root = parse(source, path or NO_PATH, UrdfError, late_declaration=True)
    else:
        file = _file(fspath(source), index)
        if file.suffix == ".xacro":
            from .xacro import expand

            text = expand(file, mappings, packages=index, confined=confined)
            root = parse(text, f"{file} (expanded)", UrdfError)
        else:
            root = parse_file(file, UrdfError, late_declaration=True)
    return _Reader(root, index if meshes else None).robot()


def _file(name: str, index: PackageIndex) -> Path:
    if not name.startswith(SCHEME):
        return Path(name)
    try:
        return index.resolve(name)
    except RosminiError as error:
        raise UrdfError(str(error)) from error


class _Reader:
    """Reads one file."""

    def __init__(self, root: Element, index: PackageIndex | None) -> None:
        self.root, self.index = root, index
        self.notes: list[str] = []
        self.left_out: dict[str, list[str]] = {}
        self.materials: dict[str, Material] = {}
        self.hint = Hints()

    def robot(self) -> Robot:
        root = self.root
        if root.tag != "robot":
            raise root.error(f"a URDF file begins with <robot>, this one with <{root.tag}>")
        name = root.attribute("name")
        for child in root:
            if child.tag.startswith("xacro:"):
                raise child.error(
                    f"<{child.tag}> is a macro of xacro: expand the file first (rosrun xacro xacro FILE), "
                    "or let its name end in .xacro"
                )
            if child.tag not in KNOWN:
                hint = self.hint(child.tag, KNOWN)
                self.note(child, f"<{child.tag}> means nothing in a robot{f'; {hint}' if hint else ''}")
        for each in root.all("material"):
            self.define(each)
        links = self.named("link", self.link)
        if not links:
            raise root.error(f"the robot {name!r} has no <link>: it needs one at least")
        joints = self.named("joint", self.joint)
        elements = {each.get("name"): each for each in root.all("joint")}
        for joint in list(joints.values()):
            if problem := mimic_problem(joint, joints):
                self.note(elements[joint.name], f"{problem}: it moves by itself")
                joints[joint.name] = replace(joint, mimic=None)
        top = check_tree(root, links, joints, elements)
        extensions = tuple(self.extension(each, links, joints) for each in root.all("gazebo"))
        if links[top].inertial is not None:
            self.note(
                root,
                f"the root link {top!r} has an inertia, which KDL (robot_state_publisher) does not take: "
                "add a link without one above it, as base_footprint",
            )
        return Robot(
            name,
            links,
            joints,
            top,
            self.materials,
            extensions,
            tuple(self.notes),
            path=root.path,
            left_out=self.left_out,
        )

    def note(self, element: Element, what: str) -> None:
        self.notes.append(str(element.error(what)))

    def spare(self, element: Element, kind: str, make: Callable[[Element], T]) -> T | None:
        """Make an optional part of a robot; return None, with a note, if it is invalid.

        ROS's parser does the same, but then ignores the rest of the link as well.
        """
        try:
            return make(element)
        except UrdfError as error:
            said = f"{str(error).partition(chr(10))[0]}: {kind} is left out"
            self.notes.append(said)
            self.left_out.setdefault(kind, []).append(said)
            return None

    def named(self, tag: str, make: Callable[[Element], T]) -> dict[str, T]:
        """Return all elements of a kind by their names, which must be unique."""
        found: dict[str, T] = {}
        lines: dict[str, int] = {}
        for each in self.root.all(tag):
            name = each.attribute("name")
            if name in found:
                raise each.error(f"there are two {tag}s {name!r}: the other one is in line {lines[name]}")
            found[name] = make(each)
            lines[name] = each.line
        return found

    # ---- links ----

    def link(self, element: Element) -> Link:
        inertials = element.all("inertial")
        if len(inertials) > 1:
            self.note(inertials[1], f"the link {element.get('name')!r} has more than one <inertial>: the first counts")
        weight = self.spare(inertials[0], "an inertial", self.inertial) if inertials else None
        visuals = [self.spare(each, "a visual", self.visual) for each in element.all("visual")]
        collisions = [self.spare(each, "a collision", self.collision) for each in element.all("collision")]
        return Link(
            element.attribute("name"),
            weight,
            tuple(each for each in visuals if each is not None),
            tuple(each for each in collisions if each is not None),
            element.line,
        )

    def inertial(self, element: Element) -> Inertial:
        mass = element.need("mass")
        value = mass.number("value", most=MAX_MASS_KG)
        if value < 0:
            raise mass.error(f"a mass is negative: {value:g} kg")
        tensor = element.need("inertia")
        ixx, ixy, ixz, iyy, iyz, izz = (
            tensor.number(name, most=MAX_MASS_KG) for name in ("ixx", "ixy", "ixz", "iyy", "iyz", "izz")
        )
        found = Inertial(value, ixx, ixy, ixz, iyy, iyz, izz, self.origin(element))
        for problem in inertia_notes(found):
            self.note(tensor, f"no body has this inertia: {problem}")
        return found

    def collision(self, element: Element) -> Collision:
        return Collision(self.geometry(element), self.origin(element), element.get("name"))

    def visual(self, element: Element) -> Visual:
        material = element.find("material")
        return Visual(
            self.geometry(element),
            self.origin(element),
            None if material is None else self.spare(material, "a material", self.material),
            element.get("name"),
        )

    def geometry(self, element: Element) -> Geometry:
        holder = element.need("geometry")
        if not holder.children:
            raise holder.error("<geometry> holds one shape: box, cylinder, sphere or mesh, not 0")
        shape = holder.children[0]
        if len(holder.children) > 1:
            self.note(shape, f"<geometry> holds one shape, not {len(holder.children)}: the first counts")
        if shape.tag == "box":
            return Box(self.vector(shape, "size", positive=True))
        if shape.tag == "cylinder":
            return Cylinder(self.positive(shape, "radius"), self.positive(shape, "length"))
        if shape.tag == "sphere":
            return Sphere(self.positive(shape, "radius"))
        if shape.tag == "mesh":
            return self.mesh(shape)
        hint = self.hint(shape.tag, ("box", "cylinder", "sphere", "mesh"))
        raise shape.error(
            f"<{shape.tag}> is not a shape: there are box, cylinder, sphere and mesh{f'; {hint}' if hint else ''}"
        )

    def mesh(self, element: Element) -> Mesh:
        filename = element.attribute("filename")
        words = element.get("scale", "1 1 1")
        scale = element.floats(words, None, "scale", most=MAX_LENGTH_M)
        if len(scale) == 1:
            scale *= 3
        if len(scale) != 3 or 0 in scale:
            raise element.error(f"scale takes 3 numbers other than 0, not {words!r}")
        path = None if self.index is None else self.mesh_file(element, filename, self.index)
        return Mesh(filename, (scale[0], scale[1], scale[2]), path)

    def mesh_file(self, element: Element, filename: str, index: PackageIndex) -> Path:
        """Return the file of a mesh. A plain path is relative to the URDF's folder."""
        if filename.startswith(SCHEME):
            try:
                return index.resolve(filename)
            except RosminiError as error:
                raise element.error(f"the mesh is missing: {error}") from error
        if "://" in filename and not filename.startswith("file://"):
            raise element.error(f"the mesh {filename!r} is neither in a package (package://) nor a file")
        plain = filename
        if filename.startswith("file://"):
            try:
                plain = files.path_of(filename)
            except OSError as error:
                raise element.error(f"the mesh {filename!r} is not the address of a file") from error
        path = Path(self.root.path).parent / plain
        if not files.is_file(path):
            raise element.error(f"the mesh is missing: there is no file {path}")
        return path

    # ---- materials ----

    def define(self, element: Element) -> None:
        """Define a material beside the links, which they can name."""
        name = element.attribute("name")
        if name in self.materials:
            raise element.error(f"there are two materials {name!r}")
        found = self.spare(element, "a material", self.material)
        if found is not None:
            self.materials[name] = found

    def material(self, element: Element) -> Material:
        name = element.get("name")
        colour, texture = element.find("color"), element.find("texture")
        if colour is None and texture is None:
            if name in self.materials:
                return self.materials[name]
            hint = self.hint(name, self.materials)
            raise element.error(
                f"the material {name!r} has neither <color> nor <texture>, and none of this name stands in the robot"
                f"{f'; {hint}' if hint else ''}"
            )
        rgba = None
        if colour is not None:
            r, g, b, a = colour.numbers("rgba", 4)
            if not all(0 <= part <= 1 for part in (r, g, b, a)):
                self.note(colour, f"the parts of a colour are from 0 to 1, not {colour.get('rgba')!r}: they are cut")
            r, g, b, a = (min(max(part, 0.0), 1.0) for part in (r, g, b, a))
            rgba = (r, g, b, a)
        made = Material(name, rgba, "" if texture is None else texture.attribute("filename"))
        if name:  # later visuals can use a material that is defined inside one
            self.materials.setdefault(name, made)
        return made

    # ---- joints ----

    def joint(self, element: Element) -> Joint:
        name, kind = element.attribute("name"), self.kind(element)
        ends = [element.need(tag).attribute("link") for tag in ("parent", "child")]
        axis = self.axis(element) if kind != "fixed" else (1.0, 0.0, 0.0)
        made = Joint(name, kind, ends[0], ends[1], self.origin(element), axis, line=element.line)
        limit, mimic, dynamics = (element.find(tag) for tag in ("limit", "mimic", "dynamics"))
        if limit is not None and kind in {*NEEDS_LIMIT, "continuous"}:
            made = replace(made, limit=self.limit(limit, name))
        elif kind in NEEDS_LIMIT:
            raise element.error(
                f'the {kind} joint {name!r} needs <limit lower="" upper="" effort="" velocity=""/>; '
                "a joint that turns without end is continuous"
            )
        if mimic is not None:
            numbers = (mimic.number("multiplier", 1.0), mimic.number("offset", 0.0))
            made = replace(made, mimic=Mimic(mimic.attribute("joint"), *numbers))
        if dynamics is not None:
            both = Dynamics(dynamics.number("damping", 0.0), dynamics.number("friction", 0.0))
            made = replace(made, dynamics=both)
        return made

    def kind(self, element: Element) -> JointType:
        word = element.attribute("type")
        for kind in get_args(JointType):
            if kind == word:
                return kind  # type: ignore[no-any-return]  # a JointType, as get_args says
        hint = nearest(word, get_args(JointType)) or f"there are {', '.join(get_args(JointType))}"
        raise element.error(f"the joint {element.get('name')!r} has an unknown type {word!r}; {hint}")

    def axis(self, element: Element) -> Vector:
        found = element.find("axis")
        if found is None:
            return (1.0, 0.0, 0.0)
        x, y, z = found.numbers("xyz", 3, (1.0, 0.0, 0.0), most=MAX_LENGTH_M)
        length = math.sqrt(x * x + y * y + z * z)
        if not 1e-9 < length < math.inf:
            what = f"the axis of the joint {element.get('name')!r} has no direction: {found.get('xyz')!r}"
            self.note(found, f"{what}; 1 0 0 is used")
            return (1.0, 0.0, 0.0)
        return (x / length, y / length, z / length)

    def limit(self, element: Element, name: str) -> Limit:
        made = Limit(
            element.number("lower", 0.0),
            element.number("upper", 0.0),
            element.number("effort"),
            element.number("velocity"),
        )
        if made.lower > made.upper:
            what = f"the lower limit of the joint {name!r} is above the upper one: {made.lower:g} > {made.upper:g}"
            self.note(element, f"{what}; they are exchanged")
            made = replace(made, lower=made.upper, upper=made.lower)
        return made

    def extension(self, element: Element, links: dict[str, Link], joints: dict[str, Joint]) -> Extension:
        reference = element.get("reference")
        if reference and reference not in links and reference not in joints:
            hint = self.hint(reference, {*links, *joints})
            self.note(
                element,
                f"<gazebo reference={reference!r}> is about nothing: there is no such link or joint"
                f"{f'; {hint}' if hint else ''}",
            )
        return Extension(reference, element)

    # ---- numbers ----

    def origin(self, element: Element) -> Origin:
        found = element.find("origin")
        if found is None:
            return Origin()
        nothing = (0.0, 0.0, 0.0)
        x, y, z = found.numbers("xyz", 3, nothing, most=MAX_LENGTH_M)
        roll, pitch, yaw = found.numbers("rpy", 3, nothing, most=MAX_LENGTH_M)
        return Origin((x, y, z), (roll, pitch, yaw))

    def vector(self, element: Element, name: str, *, positive: bool = False) -> Vector:
        x, y, z = element.numbers(name, 3, most=MAX_LENGTH_M)
        if positive and min(x, y, z) <= 0:
            raise element.error(f"{name} of <{element.tag}> takes numbers above 0, not {element.get(name)!r}")
        return (x, y, z)

    def positive(self, element: Element, name: str) -> float:
        value = element.number(name, most=MAX_LENGTH_M)
        if value <= 0:
            raise element.error(f"{name} of <{element.tag}> is above 0, not {element.get(name)!r}")
        return value
