"""Reads SDF: worlds, models and actors, with their includes."""

from __future__ import annotations

import os
from collections.abc import Iterable
from dataclasses import replace

from rosmini.core.errors import shown
from rosmini.core.markup import Element, parse

from .document import Pose6, Sdf, SdfActor, SdfModel, SdfPhysics, SdfWorld
from .errors import MissingError, SdfError
from .frames import Given, Scope, given
from .parts import Reading, flag, joint, link, name_of, number, plugins, unique
from .poses import compose, inverse
from .resources import Resources, read_file

MAX_DEPTH = 20
"""Maximum nesting of models."""

MODEL_TAGS = (
    "static", "self_collide", "allow_auto_disable", "include", "model", "enable_wind", "frame", "pose", "link", "joint",
    "plugin", "gripper", "name", "description", "author",
)  # fmt: skip
WORLD_TAGS = (
    "audio", "wind", "include", "gravity", "magnetic_field", "atmosphere", "gui", "physics", "scene", "light", "frame",
    "model", "actor", "plugin", "joint", "road", "spherical_coordinates", "state", "population",
)  # fmt: skip


def load(source: str | os.PathLike[str], *, models: Iterable[str | os.PathLike[str]] = ()) -> Sdf:
    """Return worlds, models and actors of an SDF file: a path, a `package://` address, or a text that begins with `<`.

    `models` are folders in which `model://` addresses are looked up first; after them GAZEBO_MODEL_PATH,
    `~/.gazebo/models`, rosmini's own models and those exported by ROS packages. `notes` lists what Gazebo would use and
    this reader leaves out. Raises `SdfError`, with file and line.
    """
    reading = Reading(Resources(models))
    if isinstance(source, str) and source.lstrip().startswith("<"):
        root = parse(source, failure=SdfError, late_declaration=True)
    elif isinstance(source, str) and source.startswith("package://"):
        from rosmini.core.packages import PackageIndex

        root = read_file(PackageIndex().resolve(source))
    else:
        root = read_file(source)
    return _document(root, reading)


def _document(root: Element, reading: Reading) -> Sdf:
    if root.tag not in ("sdf", "gazebo"):
        hint = "; this is a URDF, read it with rosmini.sim.urdf.load" if root.tag == "robot" else ""
        raise root.error(f"an SDF file begins with <sdf version=...>, not with <{root.tag}>{hint}")
    reading.cut(root)
    reading.unknown(root, ("world", "model", "actor", "light", "include"))
    for light in root.all("light"):
        reading.note(light, "a light: left out, the light is the same everywhere", left_out="a light")
    scope = Scope("world", what="the file")
    worlds = tuple(_world(each, reading) for each in unique(root.all("world"), "world"))
    models = tuple(_model(each, given(each).pose, reading, 0) for each in unique(root.all("model"), "model"))
    actors = tuple(_actor(each, scope, reading) for each in unique(root.all("actor"), "actor"))
    return Sdf(root.attribute("version"), worlds, models, actors, root.path, tuple(reading.notes))


# ---- worlds ----


def _world(element: Element, reading: Reading) -> SdfWorld:
    reading.unknown(element, WORLD_TAGS)
    for left_out in element.all("light", "road", "population", "joint"):
        why = "the light is the same everywhere" if left_out.tag == "light" else "rosmini has none in a world"
        reading.note(left_out, f"a {left_out.tag}: left out, {why}", left_out=f"a {left_out.tag}")
    name = name_of(element)
    scope = Scope("world", what=f"the world {name!r}")
    included = _included(element, reading, 0)
    _frames(element, scope, [(_include_name(*pair), pair[0]) for pair in included])
    models = [
        *(_model(each, scope.place(name_of(each), each), reading, 0) for each in element.all("model")),
        *(
            _include(each, inner, scope.place(_include_name(each, inner)), reading, 0)
            for each, inner in included
            if inner.tag == "model"
        ),
    ]
    actors = [
        *(_actor(each, scope, reading) for each in element.all("actor")),
        *(
            replace(_actor(inner, scope, reading), name=_include_name(each, inner))
            for each, inner in included
            if inner.tag == "actor"
        ),
    ]
    placed = _state(element, _sorted([*models, *actors], element))
    return SdfWorld(
        name,
        tuple(each for each in placed if isinstance(each, SdfModel)),
        tuple(each for each in placed if isinstance(each, SdfActor)),
        _physics(element),
        _gravity(element),
        plugins(element),
        tuple((name_of(each), scope.place(name_of(each), each)) for each in unique(element.all("frame"), "frame")),
        path=element.path,
        line=element.line,
        warnings=tuple(note for note in reading.notes if note.warning),
    )


def _sorted(things: list[SdfModel | SdfActor], element: Element) -> list[SdfModel | SdfActor]:
    """Return models and actors in the order of the file. Raises `SdfError` if two have the same name."""
    order = {child.line: i for i, child in reversed(list(enumerate(element)))}
    things.sort(key=lambda thing: order.get(thing.line, len(order)))
    seen: dict[str, SdfModel | SdfActor] = {}
    for each in things:
        if each.name in seen:
            where = Element("model", line=each.line, path=element.path, failure=SdfError)
            raise where.error(
                f"the world has another model {each.name!r} in line {seen[each.name].line}; give each its own name "
                "(<name> in an <include>)"
            )
        seen[each.name] = each
    return things


def _frames(element: Element, scope: Scope, included: list[tuple[str, Element]]) -> None:
    """Add models, includes and frames with their poses to a scope."""
    for each in element.all("model"):
        scope.add(name_of(each), given(each))
    for name, each in included:
        scope.add(name, given(each))
    for each in element.all("frame"):
        pose = given(each)
        scope.add(name_of(each), Given(pose.pose, pose.frame or each.get("attached_to").strip(), each))


def _physics(element: Element) -> SdfPhysics:
    every = element.all("physics")
    if not every:
        return SdfPhysics()
    chosen = next((each for each in every if each.get("default") in ("true", "1")), every[0])
    step = number(chosen, "max_step_size", 0.001)
    rate = number(chosen, "real_time_update_rate", 1000.0)
    factor = number(chosen, "real_time_factor", 1.0)
    if step <= 0:
        raise chosen.need("max_step_size").error(f"a step takes more than 0 s, not {step:g}")
    for tag, value in (("real_time_update_rate", rate), ("real_time_factor", factor)):
        if value < 0:
            raise chosen.need(tag).error(f"{tag} is 0 or more, not {value:g}")
    return SdfPhysics(chosen.get("type", "ode"), step, factor, rate, chosen)


def _gravity(element: Element) -> tuple[float, float, float]:
    found = element.find("gravity") or element.find("physics/gravity")
    if found is None:
        return SdfWorld.gravity
    x, y, z = found.floats(found.text, 3)
    return (x, y, z)


def _state(element: Element, things: list[SdfModel | SdfActor]) -> list[SdfModel | SdfActor]:
    """Move models to their poses in the `<state>` of a saved world."""
    places = {
        name_of(each): given(each).pose
        for state in element.all("state")
        for each in state.all("model")
        if each.find("pose") is not None
    }
    return [
        replace(each, pose=places[each.name]) if isinstance(each, SdfModel) and each.name in places else each
        for each in things
    ]


# ---- models ----


def _model(element: Element, pose: Pose6, reading: Reading, depth: int) -> SdfModel:
    """Return a model at a pose that is already resolved."""
    if depth > MAX_DEPTH:
        raise element.error(f"models stand inside one another deeper than {MAX_DEPTH}: does one include itself?")
    reading.unknown(element, MODEL_TAGS)
    name = name_of(element)
    scope = Scope("__model__", what=f"the model {name!r}")
    for each in unique(element.all("link"), "link"):
        scope.add(name_of(each), given(each))
    included = _included(element, reading, depth + 1)
    _frames(element, scope, [(_include_name(*pair), pair[0]) for pair in included])
    nested = [
        _model(each, scope.place(name_of(each), each), reading, depth + 1)
        for each in unique(element.all("model"), "model")
    ]
    nested += [
        _include(each, inner, scope.place(_include_name(each, inner)), reading, depth + 1) for each, inner in included
    ]
    for model in nested:
        for inner, place in _inside(model):
            scope.put(f"{model.name}::{inner}", compose(model.pose, place))
    for each in element.all("joint"):
        at = given(each)
        child = each.need("child")
        scope.add(name_of(each), Given(at.pose, at.frame or child.text or child.word("link"), each))
    links = tuple(link(each, scope, reading) for each in element.all("link"))
    frame = element.get("placement_frame")
    if frame:
        pose = compose(pose, inverse(scope.place(frame, element)))
    return SdfModel(
        name,
        pose,
        flag(element, "static", default=False),
        links,
        tuple(joint(each, scope) for each in unique(element.all("joint"), "joint")),
        plugins(element),
        tuple(nested),
        element.path,
        element.line,
    )


def _inside(model: SdfModel) -> list[tuple[str, Pose6]]:
    """Return the links of a model and of its nested models, by name, with their poses in it."""
    found = [(each.name, each.pose) for each in model.links]
    for inner in model.models:
        found.append((inner.name, inner.pose))
        found += [(f"{inner.name}::{name}", compose(inner.pose, place)) for name, place in _inside(inner)]
    return found


def _included(element: Element, reading: Reading, depth: int) -> list[tuple[Element, Element]]:
    """Return each `<include>` with the model or actor it names. Missing ones are left out, as in Gazebo."""
    found = []
    for each in element.all("include"):
        try:
            found.append((each, _inner(each, reading, depth)))
        except MissingError as error:
            reading.note(each.need("uri"), f"this model is left out: {error.message}", warning=True, left_out="a model")
    return found


def _inner(element: Element, reading: Reading, depth: int) -> Element:
    """Return the model or actor in the file that an `<include>` names."""
    uri = element.need("uri")
    if depth > MAX_DEPTH:
        raise uri.error(f"files include one another deeper than {MAX_DEPTH}: does {shown(uri.text)} include itself?")
    path = reading.resources.model_file(uri.text, uri)
    root = reading.include(uri, path)
    if root.tag not in ("sdf", "gazebo"):
        raise root.error(f"a model's file begins with <sdf version=...>, not with <{root.tag}>")
    inside = root.all("model", "actor", "light")
    if not inside:
        raise root.error("there is no <model> to include in this file")
    return inside[0]


def _include_name(element: Element, inner: Element) -> str:
    return element.word("name") or name_of(inner)


def _include(element: Element, inner: Element, pose: Pose6, reading: Reading, depth: int) -> SdfModel:
    """Return a model from another file: the `<include>` may rename it, move it, fix it, and add plugins."""
    if inner.tag != "model":
        raise element.error(f"a <{inner.tag}> cannot stand in a model")
    if element.find("pose") is None:
        pose = given(inner).pose
    frame = element.get("placement_frame") or element.word("placement_frame")
    model = _model(_with_frame(inner, frame), pose, reading, depth)
    reading.unknown(element, ("uri", "name", "pose", "static", "plugin", "placement_frame"))
    return replace(
        model,
        name=_include_name(element, inner),
        static=flag(element, "static", default=model.static),
        plugins=(*model.plugins, *plugins(element)),
        path=element.path,
        line=element.line,
    )


def _with_frame(inner: Element, frame: str) -> Element:
    return replace(inner, attributes={**inner.attributes, "placement_frame": frame}) if frame else inner


# ---- actors ----


def _actor(element: Element, scope: Scope, reading: Reading) -> SdfActor:
    if element.find("static") is not None or element.find("link") is not None:
        reading.note(element, "links of an actor: left out", left_out="the links of an actor")
    script = element.find("script")
    ways = script.all("trajectory") if script is not None else []
    if len(ways) > 1:
        reading.note(ways[1], "an actor follows its first trajectory alone: left out", left_out="a trajectory")
    waypoints = []
    for each in ways[0].all("waypoint") if ways else []:
        moment = number(each, "time", 0.0)
        if moment < 0:
            raise each.need("time").error(f"a waypoint's time is 0 s or more, not {moment:g}")
        waypoints.append((moment, scope.seen(given(each))))
    if not waypoints:
        waypoints = [(0.0, scope.seen(given(element)))]
    delay = number(script, "delay_start", 0.0) if script is not None else 0.0
    return SdfActor(
        name_of(element),
        tuple(sorted(waypoints, key=lambda pair: pair[0])),
        flag(script, "loop", default=True) if script is not None else True,
        delay,
        plugins(element),
        element.path,
        element.line,
    )
