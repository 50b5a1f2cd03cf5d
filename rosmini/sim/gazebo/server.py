"""The nodes `gazebo_ros/gzserver` and `gazebo_ros/gazebo`: Gazebo's server with its ROS interface, and with a client.

    rosmini run gazebo_ros/gzserver worlds/empty.world -u + ...

As in ROS the node is called /gazebo. It publishes /clock (and sets /use_sim_time, so that nodes that start later use
it), ~model_states and ~link_states; subscribes to ~set_model_state and ~set_link_state; offers the services of
`rosmini.sim.gazebo.services`; and its physics settings can be changed at run time (dynamic_reconfigure). /clock and the
states are published 100 times per second of the world's time, or at the rate in the parameter ~pub_clock_frequency;
Gazebo without that parameter publishes them in each physics step, as `_pub_clock_frequency:=1000` does here.
"""

from __future__ import annotations

import argparse
import math
import os
from dataclasses import asdict, replace
from pathlib import Path
from typing import Any, NoReturn

from rosmini.core.dynamic_reconfigure import Server as ReconfigureServer
from rosmini.core.errors import ParameterError, ScriptError, nearest
from rosmini.core.geometry.poses import Pose
from rosmini.core.graph import Node
from rosmini.core.packages import SCHEME, PackageIndex, assets_dir
from rosmini.sim import sdf, worlds
from rosmini.sim.devices.clock import ClockDevice
from rosmini.sim.recording import Subject, SubjectRobot
from rosmini.sim.sdf.document import SdfModel, SdfWorld
from rosmini.sim.sdf.resources import RESOURCE_PATH
from rosmini.sim.simulation import Simulation
from rosmini.sim.world import World

from .client import GazeboClient
from .errors import GazeboError, UnknownEntity
from .model import Model
from .physics_properties import PhysicsProperties
from .running_world import RunningWorld
from .services import Services, StateTopics
from .snapshot import Pictured, Snapshot
from .spawning import spawn_text
from .topics import GazeboMaster

EMPTY = "worlds/empty.world"
"""The default world of gzserver."""

CLOCK_RATE = 100.0
"""Default rate of /clock and the states [Hz]; see ~pub_clock_frequency."""

BUILT_IN = ("libgazebo_ros_api_plugin.so", "libgazebo_ros_paths_plugin.so")
"""The plugins that gazebo_ros's gzserver always loads; this node contains their function."""

ENGINES = ("ode", "bullet", "dart", "simbody")


class _Parser(argparse.ArgumentParser):
    def error(self, message: str) -> NoReturn:
        raise ScriptError(f"{self.prog}: {message}. {self.format_usage().strip()}")


def server_parser(prog: str = "gzserver") -> argparse.ArgumentParser:
    """Return the parser of gzserver's arguments."""
    parser = _Parser(prog=prog, add_help=False, description="Gazebo's server.")
    parser.add_argument("world", nargs="?", default=EMPTY, help="an SDF world file, or one of rosmini's worlds")
    parser.add_argument("-u", "--pause", action="store_true", help="start paused")
    parser.add_argument("--verbose", action="store_true", help="say more")
    parser.add_argument("-e", "--physics", default="ode", help="the physics engine; all are rosmini's here")
    parser.add_argument("-s", "--server-plugin", action="append", default=[], help="load a plugin")
    parser.add_argument("--iters", type=int, default=0, help="end after so many steps")
    parser.add_argument("--seed", type=int, default=0, help="the graph has the seed here: Graph(seed=...)")
    parser.add_argument("-r", "--record", action="store_true", help="record a log: `rosbag record` does here")
    parser.add_argument("-g", "--gui-plugin", action="append", default=[], help="there are none here")
    return parser


class GazeboServer(Pictured, Simulation):
    """Gazebo's server.

    Args:
        node: the started node.
        args: arguments of gzserver: a world file, -u, --verbose, -e ENGINE, -s PLUGIN...
        world: the world itself, which takes precedence over the argument.
        noise: scales the noise of all sensors; 0: no noise.

    Raises:
        ScriptError: the arguments are invalid.
        GazeboError: there is no such world, or another server runs at the same address.
        SdfError: the world file is invalid.

    """

    node_name = "gazebo"
    program = "gazebo_ros/gzserver"

    def __init__(self, node: Node, *args: str, world: World | SdfWorld | str | None = None, noise: float = 1.0) -> None:
        options = server_parser().parse_args(args)
        source = options.world if world is None else world
        found = source if isinstance(source, (World, SdfWorld)) else load_world(source)
        if options.physics not in ENGINES:
            raise ScriptError(
                f"gzserver: there is no physics engine {options.physics!r}; Gazebo has {', '.join(ENGINES)}, "
                "all of which are rosmini's here"
            )
        if options.record:
            node.logwarn("gzserver -r records a log in Gazebo's format; here `rosbag record` records what happens")
        self.world = RunningWorld(node, found, paused=options.pause, noise=noise)
        self.clock = ClockDevice(self.world.host, rate=_rate(node))
        self.master = GazeboMaster(self.world, self.clock.publish_now)
        super().__init__(node, self.world.host)
        self.world.host.add(self.clock)
        node.set_param("/use_sim_time", True)
        self.services = Services(self.world, self.set_physics)
        self.states = StateTopics(self.world, self.services, self.clock.rate)
        self.reconfigure = ReconfigureServer(node, PhysicsProperties, self._reconfigured)
        for name in options.server_plugin:
            if name.rsplit("/", 1)[-1] not in BUILT_IN:
                self.world.load_plugin(name)
        if options.iters:
            host = self.world.host
            host.clock.call_at(
                host.clock.now_ns() + round(options.iters * self.world.physics.time_step * 1e9), self._finish
            )
        if options.verbose:
            node.loginfo(f"{self.world!r}: {', '.join(self.world.models) or 'no models'}")

    # -- from Python ---------------------------------------------------------------------------------------------

    def spawn(
        self, model: str | SdfModel, name: str = "", pose: Pose = (0.0, 0.0, 0.0), *, namespace: str = ""
    ) -> Model:
        """Insert a model from the text of a URDF or an SDF, or an `SdfModel`; `pose` is x [m], y [m], heading [rad].

        Raises `SpawnError`, and the readers' errors.
        """
        where = (pose[0], pose[1], 0.0, 0.0, 0.0, pose[2])

        def bring() -> Model:
            if isinstance(model, SdfModel):
                return self.world.spawn(model, name, where, namespace=namespace)
            return spawn_text(self.world, model, name, where, namespace=namespace)

        return self._do(bring)

    def _entity(self, name: str) -> str:
        if name:
            return self.world.model(name).name
        for model in self.world.models.values():
            if model.body is not None and model.body.drive is not None:
                return model.name
        raise UnknownEntity(f"no model in the world {self.world.name!r} has a drive: say which one is meant")

    def _truth(self, name: str) -> Pose:
        self.host.catch_up()
        return self.world.model(self._entity(name)).flat

    def _drag(self, name: str, pose: Pose) -> None:
        model = self.world.model(self._entity(name))
        _, _, z, roll, pitch, _ = model.pose
        model.set_pose((pose[0], pose[1], z, roll, pitch, pose[2]))

    def _delete(self, name: str) -> None:
        self.world.delete(name)

    def axle(self, name: str) -> Pose:
        """Return the middle of the wheels' axle in the model's frame, as used by the engine. Raises `UnknownEntity`."""
        body = self.world.model(name).body
        return (0.0, 0.0, 0.0) if body is None else body.axle

    def _step(self, seconds: float) -> None:
        self.world.step(round(seconds / self.world.physics.time_step) if math.isfinite(seconds) else 0)

    def _set_speed(self, speed: float) -> None:
        physics = self.world.physics
        self.set_physics(replace(physics, max_update_rate=speed / physics.time_step))

    def _reset(self) -> None:
        self.world.reset_models()

    def client(self) -> GazeboClient:
        """Return a client that shows this server, as a node `gazebo_gui` of the same graph."""
        return GazeboClient(self.node.graph.node("gazebo_gui", anonymous=True))

    def set_physics(self, physics: PhysicsProperties) -> None:
        """Change the physics settings and the parameters with them."""
        self.world.set_physics(physics)
        self.reconfigure.update_configuration(asdict(physics))

    def _reconfigured(self, config: Any, level: int) -> Any:
        there = asdict(self.world.physics)
        if level == -1:
            config.update(there)
        elif any(config[name] != value for name, value in there.items()):
            self.world.set_physics(PhysicsProperties(**{name: config[name] for name in there}))
        return config

    def snapshot(self) -> Snapshot:
        """Return the world as it is now."""
        return self._do(lambda: Snapshot.of(self.world))

    def subject(self) -> Subject:
        """Return what a recorder needs to know of the world as it is now."""

        def look() -> Subject:
            seen = self.snapshot()
            fixed = tuple(each for each in seen.world(robots=False).obstacles if each.name not in movable)
            world = replace(seen.flat, name=seen.name, title=seen.title, obstacles=(*fixed, *movable.values()))
            robots = {
                each.name: SubjectRobot(each.model, self.world.model(each.name).namespace, self.axle(each.name))
                for each in seen.robots
            }
            return Subject(world, robots, self.node.resolve("~model_states"))

        movable = {each.name: each for each in self.engine.obstacles()}
        return self._do(look)

    def _finish(self) -> None:
        self.node.shutdown("so many steps as --iters said have passed")

    def _end(self) -> None:
        super()._end()
        self.world.close()
        self.master.close()


class Gazebo(GazeboServer):
    """The node `gazebo_ros/gazebo`: a server, and a client that shows it (`.gui`)."""

    def __init__(self, node: Node, *args: str, **options: Any) -> None:
        super().__init__(node, *args, **options)
        self.gui = GazeboClient(node.graph.node("gazebo_gui", namespace=node.namespace))
        node.on_shutdown(lambda: self.gui.node.shutdown("the server ended"))

    def snapshot(self) -> Snapshot:
        """Return the client's view of the world."""
        return self.gui.snapshot()


def _rate(node: Node) -> float:
    name = "~pub_clock_frequency"
    rate = node.get_param(name, CLOCK_RATE, expect=float)
    if not rate > 0:
        raise ParameterError(f"parameter {node.resolve_parameter(name)} is {rate}; it must be more than 0 Hz")
    return float(rate)


def load_world(name: str | os.PathLike[str]) -> World | SdfWorld:
    """Load a world from a file that gzserver would find, or by one of rosmini's names ("house", or a map's YAML file).

    A relative path is searched for in the working directory, in the folders of GAZEBO_RESOURCE_PATH, and in rosmini's
    package gazebo_ros. Raises `GazeboError` if there is no such world, and the readers' errors for an invalid file.
    """
    text = os.fspath(name)
    if text in worlds.names():
        return worlds.world(text)
    path = PackageIndex().resolve(text) if text.startswith(SCHEME) else _found(text)
    if worlds.kind_of(path) in ("map", "stage"):
        return worlds.world(path)
    document = sdf.load(path)
    if not document.worlds:
        command = f"rosrun gazebo_ros spawn_model -sdf -file {path} -model NAME"
        raise GazeboError(f"{path} has no <world>; add its model to a world with `{command}`")
    return document.worlds[0]


def _found(text: str) -> Path:
    listed = [Path(part) for part in os.environ.get(RESOURCE_PATH, "").split(os.pathsep) if part]
    folders = [Path(), *listed, assets_dir() / "ros" / "gazebo_ros"]
    for folder in folders:
        path = folder / text
        if path.is_file():
            return path
    if "/" not in text and not Path(text).suffix:
        hint = nearest(text, worlds.names()) or f"there are {', '.join(worlds.names())}, and any file"
    else:
        hint = "searched in " + ", ".join(str(folder.resolve()) for folder in folders)
    msg = f"there is no world {text!r}; {hint}"
    raise GazeboError(msg)
