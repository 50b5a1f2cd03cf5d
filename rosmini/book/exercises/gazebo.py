"""Checks of the exercises in the chapter Gazebo."""

from __future__ import annotations

import math
from typing import TYPE_CHECKING, Any

from rosmini.book.checks import Wrong, exercise, expect, expect_number, expect_type
from rosmini.core.errors import RosminiError
from rosmini.core.graph import Graph
from rosmini.msgs.sensor_msgs.msg import LaserScan
from rosmini.ros.scripts import rosrun
from rosmini.sim import sdf
from rosmini.sim.gazebo import GazeboServer, ModelPlugin
from rosmini.sim.gazebo.spawning import spawn_text
from rosmini.sim.urdf import xacro

if TYPE_CHECKING:
    from collections.abc import Callable

BURGER = "package://turtlebot3_description/urdf/turtlebot3_burger.urdf.xacro"


def _server(graph: Graph) -> GazeboServer:
    found: GazeboServer = rosrun("gazebo_ros", "gzserver", graph=graph).instance()
    return found


# ---- barrel: a barrel ----


@exercise("barrel", praise="The barrel was spawned, stood on the floor, and could be pushed.")
def barrel(answer: Any) -> None:
    """The SDF of a solid cylinder on the floor."""
    for name, radius, height, mass in (("barrel", 0.3, 0.8, 20.0), ("tin", 0.05, 0.1, 0.5)):
        text = answer(name, radius, height, mass)
        expect_type(text, str, "It returned", "a text", 'f"""<sdf ..."""')
        try:
            models = sdf.load(text).models
        except RosminiError as error:
            raise Wrong(f"This is not valid SDF: {error}", "compare it with the chapter's crate") from error
        expect(len(models) == 1, f"It contains {len(models)} models, not one.")
        _check_barrel(models[0], name, radius, height, mass)
        with Graph() as graph:
            server = _server(graph)
            spawn_text(server.world, text, name, (0.0,) * 6)
            server.world.model(name).set_velocity((1.0, 0.0, 0.0))
            graph.run(2.0)
            expect(server.truth(name)[0] > 0.05, "It cannot be pushed.", "a static model never moves")


def _check_barrel(model: sdf.SdfModel, name: str, radius: float, height: float, mass: float) -> None:
    expect(model.name == name, f"Its name is {model.name!r}, not {name!r}.", "use the first argument")
    expect(not model.static, "It is static, so it cannot be pushed.", "remove <static>")
    expect(len(model.links) == 1, f"It has {len(model.links)} links, not one.")
    link = model.links[0]
    expect(len(link.collisions) == 1, f"It has {len(link.collisions)} collisions, not one.", "add one <collision>")
    collision = link.collisions[0]
    shape = collision.geometry
    expect(shape.kind == "cylinder", f"Its collision is a {shape.kind}, not a cylinder.")
    expect(
        math.isclose(shape.radius, radius) and math.isclose(shape.length, height),
        f"Its cylinder has the radius {shape.radius:g} m and the length {shape.length:g} m, "
        f"not {radius} m and {height} m.",
    )
    bottom = model.pose[2] + link.pose[2] + collision.pose[2] - height / 2
    expect(
        abs(bottom) < 1e-9,
        f"With its origin on the floor, its bottom is at a height of {bottom:.2f} m.",
        "the pose of a cylinder is that of its centre",
    )
    inertial = link.inertial
    expect(math.isclose(inertial.mass, mass), f"Its mass is {inertial.mass:g} kg, not {mass:g} kg.")
    across, along = mass * (3 * radius**2 + height**2) / 12, mass * radius**2 / 2
    for axis, found, right in zip(("ixx", "iyy", "izz"), inertial.inertia, (across, across, along), strict=False):
        expect(
            math.isclose(found, right, rel_tol=1e-4),
            f"{axis} is {found:.4g} kg m2, not {right:.4g}.",
            "izz is about the cylinder's own axis, which is vertical",
        )


# ---- friction: friction ----


def _slide(mu: float, gravity: float) -> Callable[[float], float]:
    """Return a function that pushes a crate at a speed in a separate world and returns the distance that it slid."""

    def push(speed: float) -> float:
        surface = f"<surface><friction><ode><mu>{mu}</mu></ode></friction></surface>"
        box = f'<collision name="c"><geometry><box><size>0.4 0.4 0.4</size></box></geometry>{surface}</collision>'
        text = f'<sdf version="1.6"><model name="m"><link name="l"><pose>0 0 0.2 0 0 0</pose>{box}</link></model></sdf>'
        with Graph() as graph:
            server = _server(graph)
            server.engine.set_surface(gravity=gravity)
            model = spawn_text(server.world, text, "m", (0.0,) * 6)
            model.set_velocity((speed, 0.0, 0.0))
            graph.run(abs(speed) / (mu * gravity) + 1.0)
            return server.truth("m")[0]

    return push


@exercise("friction", praise="You found 0.15, 0.4 and 0.9; the last one was on the Moon.")
def friction(answer: Any) -> None:
    """The coefficient of friction of a pushed object, within 2 %."""
    for mu, gravity in ((0.15, 9.8), (0.4, 9.8), (0.9, 1.6)):
        found = expect_number(answer(_slide(mu, gravity), gravity), "coefficient")
        expect(
            abs(found - mu) <= 0.02 * mu,
            f"You found {found:.3f}, but mu is {mu}, with a gravity of {gravity} m/s2.",
            "solve d = v * v / (2 * mu * g) for mu",
        )


# ---- look_ahead: a laser that looks ahead ----


@exercise(
    "look_ahead",
    praise="Beam 0 points to the right, beam 90 straight ahead, beam 180 to the left.")  # fmt: skip
def look_ahead(answer: Any) -> None:
    """A TurtleBot3 whose laser has 181 beams over the front half."""
    original = xacro.expand(BURGER)
    text = answer(original)
    expect_type(text, str, "It returned", "a string", "return the changed text")
    with Graph() as graph:
        server = _server(graph)
        try:
            spawn_text(server.world, text, "robot", (0.0,) * 6)
        except RosminiError as error:
            raise Wrong(f"The robot cannot be spawned: {error}") from error
        types = dict(graph.master.getTopicTypes("/check")[2])
        expect("/front_scan" in types, "There is no topic /front_scan.", "change <topicName> of the laser plugin")
        expect("/scan" not in types, "The topic /scan is still there.")
        heard: list[Any] = []
        graph.node("check").subscriber("/front_scan", LaserScan, heard.append)
        graph.run(1.0)
    _check_scan(heard[-1])
    expect(_rest(text) == _rest(original), "Another part of the robot has changed.", "change only those four tags")


def _check_scan(scan: Any) -> None:
    count = len(scan.ranges)
    expect(count == 181, f"A scan has {count} beams, not 181.", "change <samples>")
    degrees = [math.degrees(angle) for angle in (scan.angle_min, scan.angle_max)]
    expect(
        max(abs(degrees[0] + 90), abs(degrees[1] - 90)) < 0.1,
        f"The beams go from {degrees[0]:.0f} to {degrees[1]:.0f} degrees, not from -90 to 90.",
        "angles in SDF are in radians",
    )


TAGS = ("samples", "min_angle", "max_angle")


def _rest(text: str) -> list[str]:
    """Return all lines that the exercise does not change."""
    lines = (line.strip() for line in text.splitlines())
    return [
        line.replace("front_scan", "scan") for line in lines if line and not any(f"<{tag}>" in line for tag in TAGS)
    ]


# ---- leash: a leash ----


@exercise("leash", praise="Two crates on leashes of different lengths were pushed, and both came back.")
def leash(answer: Any) -> None:
    """A plugin that returns its model to its start when it is too far away."""
    expect(
        isinstance(answer, type) and issubclass(answer, ModelPlugin),
        "It is not a model plugin.",
        'begin with class Leash(ModelPlugin, filename="libleash.so")',
    )
    library = "libleash_on_trial.so"
    type("OnTrial", (answer,), {}, filename=library)  # the latest class with the reader's library
    for length, x, y, speed in ((0.5, 2.0, -1.0, (3.0, 0.0)), (1.2, -1.0, 3.0, (0.0, -4.0))):
        text = _on_leash(library, length)
        with Graph() as graph:
            server = _server(graph)
            model = spawn_text(server.world, text, "dog", (x, y, 0.0, 0.0, 0.0, 0.5))
            _short(graph, server, model, length)
            way = []
            model.set_velocity((*speed, 0.0))
            for _ in range(60):
                graph.run(0.05)
                way.append(math.dist(server.truth("dog")[:2], (x, y)))
            there = server.truth("dog")
        what = f"With a leash of {length} m"
        expect(
            max(way) < length + 0.45,
            f"{what} the model came {max(way):.2f} m away.",
            "compare ten times a second or more; read the length from the tag <length>",
        )
        expect(
            way[-1] < 0.02 and abs(there[2] - 0.5) < 0.02,
            f"{what} it ended {way[-1]:.2f} m from its start.",
            "store model.pose in load, and move the model back there, with zero velocity",
        )


def _short(graph: Graph, server: GazeboServer, model: Any, length: float) -> None:
    """Expect that a model within its leash is not moved."""
    x, y, _ = server.truth("dog")
    model.set_velocity((1.0, 0.0, 0.0))
    graph.run(1.0)
    way = math.dist(server.truth("dog")[:2], (x, y))
    expect(
        0.05 < way < length,
        f"A model that slid within its leash of {length} m is {way:.2f} m from home.",
        "do not move it while it is near enough",
    )


def _on_leash(library: str, length: float) -> str:
    box = '<collision name="c"><geometry><box><size>0.3 0.3 0.3</size></box></geometry></collision>'
    plugin = f'<plugin name="leash" filename="{library}"><length>{length}</length></plugin>'
    link = f'<link name="l"><pose>0 0 0.15 0 0 0</pose>{box}</link>'
    return f'<sdf version="1.6"><model name="dog">{link}{plugin}</model></sdf>'
