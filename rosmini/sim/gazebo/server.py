"""The nodes `gazebo_ros/gzserver` and `gazebo_ros/gazebo`: Gazebo's server, with its ROS side (gazebo_ros_api_plugin), and with a client.

    rosmini run gazebo_ros/gzserver worlds/empty.world -u + ...

The node is called /gazebo, as there. It publishes /clock (and sets /use_sim_time, so that nodes that come later live on it), ~model_states and
~link_states, takes ~set_model_state and ~set_link_state, offers the services of `rosmini.sim.gazebo.services`, and its physics can be turned while it
runs (dynamic_reconfigure). /clock and the states are told 100 times a second of the world's time, which the parameter ~pub_clock_frequency changes;
Gazebo without that parameter does so in each step of its physics, 1000 times, which `_pub_clock_frequency:=1000` gives.
"""

from __future__ import annotations

import argparse
import math
from typing import Any, NoReturn

from rosmini.dynamic_reconfigure import Server as ReconfigureServer
from rosmini.errors import ParameterError, ScriptError
from rosmini.geometry.poses import Pose
from rosmini.graph import Node
from rosmini.graph.show import show
from rosmini.sim.devices import ClockDevice
from rosmini.sim.gazebo.errors import GazeboError
from rosmini.sim.host import Host
from rosmini.sim.sdf import SdfModel, SdfWorld
from rosmini.sim.world import World

from .client import GazeboClient
from .gz import Gz
from .master import start_master
from .model import Model
from .physics import PhysicsConfig, PhysicsProperties
from .services import Services
from .sources import EMPTY, load_world
from .spawning import spawn_text
from .states import StateTopics
from .topics import ServerTopics
from .world import GazeboWorld
from .world_state import WorldState

CLOCK_RATE = 100.0
"""How often /clock ticks if the parameter ~pub_clock_frequency does not say [Hz]."""

BUILT_IN = ("libgazebo_ros_api_plugin.so", "libgazebo_ros_paths_plugin.so")
"""The plugins that gazebo_ros's gzserver always loads: they are what this node is."""

ENGINES = ("ode", "bullet", "dart", "simbody")


class _Parser(argparse.ArgumentParser):
    def error(self, message: str) -> NoReturn:
        raise ScriptError(f"{self.prog}: {message}. {self.format_usage().strip()}")


def server_parser(prog: str = "gzserver") -> argparse.ArgumentParser:
    """The arguments of gzserver, as far as they mean something here."""
    parser = _Parser(prog=prog, add_help=False, description="Gazebo's server.")
    parser.add_argument(
        "world", nargs="?", default=EMPTY, help="an SDF world file, or one of rosmini's worlds"
    )
    parser.add_argument("-u", "--pause", action="store_true", help="begin with time that stands")
    parser.add_argument("--verbose", action="store_true", help="say more")
    parser.add_argument("-e", "--physics", default="ode", help="the physics engine; all are rosmini's here")
    parser.add_argument("-s", "--server-plugin", action="append", default=[], help="load a plugin")
    parser.add_argument("--iters", type=int, default=0, help="end after so many steps of the physics")
    parser.add_argument("--seed", type=int, default=0, help="goes with the graph here: Graph(seed=...)")
    parser.add_argument("-r", "--record", action="store_true", help="record a log: `rosbag record` does here")
    parser.add_argument("-g", "--gui-plugin", action="append", default=[], help="there are none here")
    return parser


class GazeboServer:
    """Gazebo's server.

    Args:
        node: the started node.
        args: those of gzserver: a world file, -u, --verbose, -e ENGINE, -s PLUGIN...
        world: the world itself, before the argument.
        noise: scales the noise of all sensors; 0: none.

    Raises:
        ScriptError: the arguments make no sense.
        GazeboError: there is no such world, or another server runs at the same address.
        SdfError: the world's file is broken.

    """

    node_name = "gazebo"

    def __init__(
        self, node: Node, *args: str, world: World | SdfWorld | str | None = None, noise: float = 1.0
    ) -> None:
        options = server_parser().parse_args(args)
        self.node = node
        source = options.world if world is None else world
        found = source if isinstance(source, (World, SdfWorld)) else load_world(source)
        if options.physics not in ENGINES:
            raise ScriptError(
                f"gzserver: there is no physics engine {options.physics!r}; Gazebo has {', '.join(ENGINES)}, all rosmini's here"
            )
        if options.record:
            node.logwarn(
                "gzserver -r records a log of Gazebo's own; here `rosbag record` records what happens"
            )
        self.world = GazeboWorld(node, found, paused=options.pause, noise=noise)
        self.started_ns = self.world.host.clock.now_ns()
        """When the server came [ns]."""
        self.master = start_master(node.graph, self, self.world.name)
        self.clock = self.world.host.add(ClockDevice(self.world.host, rate=_rate(node)))
        node.set_param("/use_sim_time", True)
        self.services = Services(self.world, self.set_physics)
        self.states = StateTopics(self.world, self.services, self.clock.rate)
        self.topics = ServerTopics(self, self.master.namespace)
        self.reconfigure = ReconfigureServer(node, PhysicsConfig, self._reconfigured)
        for name in options.server_plugin:
            if name.rsplit("/", 1)[-1] not in BUILT_IN:
                self.world.load_plugin(name)
        if options.iters:
            host = self.world.host
            host.clock.call_at(
                host.clock.now_ns() + round(options.iters * self.world.physics.time_step * 1e9), self._end
            )
        if options.verbose:
            node.loginfo(f"{self.world!r}: {', '.join(self.world.models) or 'no models'}")
        node.on_shutdown(self._close)

    def __repr__(self) -> str:
        return f"<GazeboServer {self.node.name}: {self.world!r}>"

    # -- for who started it --------------------------------------------------------------------------------------

    @property
    def engine(self) -> Any:
        """The engine of the world."""
        return self.world.engine

    @property
    def host(self) -> Host:
        """The time of the world."""
        return self.world.host

    def truth(self, model: str) -> tuple[float, float, float]:
        """Where a model is now: x [m], y [m], heading [rad]. Raises `UnknownEntity`."""

        def look() -> tuple[float, float, float]:
            self.world.host.catch_up()
            return self.world.model(model).flat

        return self.node.scheduler.on_hub(look)

    def spawn(
        self, model: str | SdfModel, name: str = "", pose: Pose = (0.0, 0.0, 0.0), *, namespace: str = ""
    ) -> Model:
        """Let a model come into the world: the text of a URDF or an SDF, or an `SdfModel`; `pose` is x [m], y [m], heading [rad].

        Raises `SpawnError`, and what the readers raise.
        """
        where = (pose[0], pose[1], 0.0, 0.0, 0.0, pose[2])

        def bring() -> Model:
            if isinstance(model, SdfModel):
                return self.world.spawn(model, name, where, namespace=namespace)
            return spawn_text(self.world, model, name, where, namespace=namespace)

        return self.node.scheduler.on_hub(bring)

    def delete(self, name: str) -> None:
        """Take a model out of the world. Raises `UnknownEntity`."""
        self.node.scheduler.on_hub(lambda: self.world.delete(name))

    def drag(self, name: str, pose: Pose) -> None:
        """Put a model elsewhere on the ground, at rest, as one does with the mouse in Gazebo's window: x [m], y [m], heading [rad].

        Raises `UnknownEntity`, and `WorldError` if something stands there.
        """

        def put() -> None:
            model = self.world.model(name)
            _, _, z, roll, pitch, _ = model.pose
            model.set_pose((pose[0], pose[1], z, roll, pitch, pose[2]))

        self.node.scheduler.on_hub(put)

    def axle(self, name: str) -> Pose:
        """Where the engine has the middle of a model's wheels, seen from the model: x [m], y [m], heading [rad]. Raises `UnknownEntity`."""
        body = self.world.model(name).body
        return (0.0, 0.0, 0.0) if body is None else body.axle

    def pause(self) -> None:
        """Let the world's time stand. Harmless when repeated."""
        self.node.scheduler.on_hub(self.world.pause)

    def unpause(self) -> None:
        """Let the world's time go on. Harmless when repeated."""
        self.node.scheduler.on_hub(self.world.unpause)

    def step(self, seconds: float) -> None:
        """Let so much of the world's time pass, in whole steps of the physics, and stand then. Raises `GazeboError` for less than one."""
        count = round(seconds / self.world.physics.time_step) if math.isfinite(seconds) else 0
        self.node.scheduler.on_hub(lambda: self.world.step(count))

    def reset(self) -> None:
        """Put every model back to where it came into the world; time goes on."""
        self.node.scheduler.on_hub(self.world.reset_models)

    def save(self) -> WorldState:
        """Everything that the world will go on from: models, odometry, noise, forces, physics, time. It can be pickled.

        Messages that are on their way are no part of it, nor is what a plugin remembers elsewhere than in a device.
        """
        return self.node.scheduler.on_hub(self.world.save)

    def restore(self, state: WorldState) -> None:
        """Go on from there, to the last bit as it went on then: models that have come since go, those that have gone come back.

        Time goes back too, and with it /clock. Raises `GazeboError` for what is no state of this world.
        """

        def become() -> None:
            self.world.restore(state)
            self.reconfigure.update_configuration(PhysicsConfig.values(self.world.physics))

        self.node.scheduler.on_hub(become)

    @property
    def gz(self) -> Gz:
        """The `gz` command line for this server: `server.gz("topic", "-l")`."""
        return Gz(self.node.graph)

    def client(self) -> GazeboClient:
        """A client that shows this server, as a node `gazebo_gui` of the same graph."""
        return GazeboClient(self.node.graph.node("gazebo_gui", anonymous=True))

    def set_physics(self, physics: PhysicsProperties) -> None:
        """Change how the world is stepped; the parameters follow."""
        self.world.set_physics(physics)
        self.reconfigure.update_configuration(PhysicsConfig.values(physics))

    def _reconfigured(self, config: Any, level: int) -> Any:
        if level == -1:
            config.update(PhysicsConfig.values(self.world.physics))
        elif any(config[name] != value for name, value in PhysicsConfig.values(self.world.physics).items()):
            self.world.set_physics(PhysicsConfig.applied(self.world.physics, config))
        return config

    def show(self, **options: Any) -> Any:
        """A picture of the world as it is now.

        Options, with what they are unless given:
            robot=None: where the robot is that `scan`, `trail` and `odom` belong to: x [m], y [m], heading [rad]; None: where that of `name` is
            model=None: what robot it is; None: as Gazebo has it
            scan=None: what its laser measured: a `sensor_msgs/LaserScan`, or ranges [m]
            scan_from=None: where it was then; None: where it is
            trail=None: where it was, (n, 2) or (n, 3)
            odom=None: where its odometry believes that it was, likewise
            others=(): more robots, each an `Other`
            name='': of the model that is drawn as the first robot; '': the first that drives
            title=None: a caption under the picture, and the first words of its text form
            size=(660.0, 540.0): the largest width and height [CSS px]
        """
        return self.topics.snapshot().show(**options)

    def show3d(self, **options: Any) -> Any:
        """The world as it is now in three dimensions.

        Options, with what they are unless given:
            focus='world': what the camera looks at: 'world', or the name of a model
            collisions=False: show what is solid in place of what one sees
            distance=None: of the camera from what it looks at [m]; None: what shows it well
            azimuth=None: from where it looks [deg]: at 0 from the side of x, at 90 from the side of y; None: what shows it well
            elevation=None: how high from [deg]; None: what shows it well
            title=None: a caption under the picture, and the first words of its text form
            height=420: of the viewer [CSS px]
        """
        return self.topics.snapshot().show3d(**options)

    def pad(self, model: str = "", **options: Any) -> Any:
        """A pad to drive a model with, the first that can be driven if none is named.

        Options, with what they are unless given:
            topic='cmd_vel': where to publish, as the simulation's node calls it: in its namespace, remapped as it is there
            name='teleop_pad': the name of the pad's node
            limits=None: how fast at most; None: as fast as the robot may
            title=None: a caption under the pad, and the first line of its text form
        """
        return show("teleop_pad", self, robot=model, **options)

    def view(self, **options: Any) -> Any:
        """The running world, in which models are dragged.

        Options, with what they are unless given:
            title=None: a caption under the view, and the first line of its text form
        """
        return show("simulation_view", self, **options)

    def _end(self) -> None:
        self.node.shutdown("so many steps as --iters said have passed")

    def _close(self) -> None:
        self.world.close()
        self.topics.close()
        self.master.close()


class Gazebo(GazeboServer):
    """The node `gazebo_ros/gazebo`: a server, and a client that shows it (`.gui`)."""

    def __init__(self, node: Node, *args: str, **options: Any) -> None:
        super().__init__(node, *args, **options)
        self.gui = GazeboClient(node.graph.node("gazebo_gui", namespace=node.namespace))
        node.on_shutdown(lambda: self.gui.node.shutdown("the server ended"))

    def show(self, **options: Any) -> Any:
        """What the client shows; the options are those of `GazeboServer.show`."""
        return self.gui.show(**options)


def _rate(node: Node) -> float:
    name = "~pub_clock_frequency"
    rate = node.get_param(name, CLOCK_RATE, expect=float)
    if not rate > 0:
        raise ParameterError(
            f"parameter {node.resolve_parameter(name)} is {rate}; it has to be more than 0 Hz"
        )
    return float(rate)


__all__ = ["Gazebo", "GazeboError", "GazeboServer", "server_parser"]
