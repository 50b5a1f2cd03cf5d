"""The node `rosmini_sim/simulator`: TurtleBot3s in a world, with the topics of the real ones.

Each subscribes to `cmd_vel` and publishes `scan`, `odom`, `/tf`, `joint_states` and `imu` at the rates of the robot's
firmware, a Waffle also its camera's images, and in addition `base_pose_ground_truth`, its true pose
(Stage's name; a real robot does not know it). With `_board:=true` there are also `sensor_state`, `battery_state`,
`motor_power` and `reset`. The node offers the service `reset_positions` (Stage's name too).

As on the real robot, the heading of `odom` comes from the IMU (`_odometry:=wheels` uses the wheels, as Gazebo does),
and the laser takes 0.2 s for a scan, while the robot moves on (`_sweep:=false` measures all beams at once, as Stage and
Gazebo do). See `rosmini.sim.engine.odometry`, `rosmini.sim.sensors.imu` and `rosmini.sim.sensors.lidar`.

As on the real robot (firmware 1.2.3) and in Stage, a command expires: half a second after the last
`cmd_vel` the robot stops. So a driving node must repeat the command, as `rostopic pub -r 10` does. With
`_cmd_vel_timeout:=0` it does not expire, as in Gazebo.

Without `~robots` there is one robot, whose topics are in the node's namespace. With it there are several, see
`rosmini.sim.starts.read_starts`.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any

from rosmini.core.errors import RosminiError
from rosmini.core.geometry.poses import Pose
from rosmini.core.graph import Node
from rosmini.core.parameters import Parameters, parameter
from rosmini.msgs import service_class

from .devices.obstacles import ObstacleMarkers
from .engine.engine import Engine
from .host import Host, HostState
from .models import RobotModel
from .models import model as model_called
from .simulation import Simulation
from .starts import START_HELP, Start, add, displacement, read_starts, start_pose
from .turtlebot import COMMAND_TIMEOUT, ODOMETRY, Options, TurtleBot
from .world import World, WorldError
from .worlds import world as world_called


@dataclass(frozen=True)
class SimulatorParameters(Parameters):
    """The private parameters of `rosmini_sim/simulator`; for `~robots` see `read_starts`."""

    strict = True
    allowed = ("robots",)

    world: str = parameter("room", "the world: a name, or the yaml file of a map")
    model: str | None = parameter(None, "the robot's model; by default that in TURTLEBOT3_MODEL, or else burger")
    x: float | None = parameter(None, "x of the robot at the start; by default at the world's first start", unit="m")
    y: float | None = parameter(None, "y of the robot at the start", unit="m")
    yaw: float | None = parameter(
        None, "the robot's heading at the start, counter-clockwise from the x axis", unit="rad"
    )
    noise: float = parameter(1.0, "factor of all errors of wheels and sensors; 0: no errors", minimum=0.0)
    odometry: str = parameter(ODOMETRY[0], "source of the heading in the odometry", choices=ODOMETRY)
    sweep: bool = parameter(
        True, "measure a scan's beams one after the other, as a real LDS-01 does, and not all at once"
    )
    cmd_vel_timeout: float = parameter(
        COMMAND_TIMEOUT, "how long a command holds; 0: until the next one", unit="s", minimum=0.0
    )
    tf: bool = parameter(True, "publish the transform from odom to base_footprint")
    tf_prefix: str = parameter("", "prefix of the names of the robot's frames: tb3_0 gives tb3_0/odom")
    board: bool = parameter(
        False, "also offer the topics of the robot's board: sensor_state, battery_state, motor_power, reset"
    )
    battery: float = parameter(
        1.0, "with the board: the charge of the batteries at the start", minimum=0.0, maximum=1.0
    )
    obstacles: bool = parameter(False, "publish all things that move or can be pushed, as markers on obstacles")
    use_rep_117: bool = parameter(
        True, "write inf for too far and -inf for too near; otherwise 0.0, as a real LDS-01 does"
    )


@dataclass(frozen=True)
class SimulatorState:
    """The result of `Simulator.save`: everything needed to continue. It can be pickled."""

    world: str
    host: HostState
    robots: tuple[Start, ...]


class Simulator(Simulation):
    """Robots in a world, as a node of a graph: initially one, more with `spawn` or the parameter `~robots`.

    Args:
        node: the started node; its private parameters select world and robot (`SimulatorParameters`).
        world: the world, or its name; overrides the parameter.
        model: the robot model, or its name; overrides the parameter.

    Raises:
        WorldError: there is no such world, or a robot has no room at its start.
        UnknownModel: there is no such robot.
        ParameterError: a parameter has an unknown name, a wrong type, or a value out of range.

    """

    program = "rosmini_sim/simulator"

    def __init__(self, node: Node, *, world: World | str | None = None, model: RobotModel | str | None = None) -> None:
        self.parameters = SimulatorParameters.read(node)
        world = self.parameters.world if world is None else world
        model = self.parameters.model if model is None else model
        world = world if isinstance(world, World) else world_called(world)
        self.model = model if isinstance(model, RobotModel) else model_called(model)
        own = self.parameters
        self._options = Options(
            own.noise, own.cmd_vel_timeout, own.tf, own.use_rep_117, own.board, own.battery, own.odometry, own.sweep
        )
        engine = Engine(world, lambda name: node.graph.rng(f"{node.name}/{name}"), noise=own.noise)
        pose = start_pose(world, own.x, own.y, own.yaw)
        starts = read_starts(node, self.model, world, pose, own.tf_prefix)
        self.name = starts[0].name
        """Name of the default robot of methods that take a name."""
        try:
            for start in starts:
                add(engine, start)
        except WorldError as error:
            raise WorldError(f"{error}. {START_HELP}") from error
        if moved := displacement(engine, starts[0]):
            node.logwarn(moved)
        super().__init__(node, Host(node, engine))
        if own.obstacles:
            self.host.add(ObstacleMarkers(self.host))
        self.robots: dict[str, TurtleBot] = {}
        """The robots in the world by name, in order of arrival."""
        for start in starts:
            self._bring(start)
        self._service = node.service("reset_positions", service_class("std_srvs/Empty"), self._reset_positions)

    @property
    def world(self) -> World:
        """The world with all obstacles that are in it now."""
        return self.engine.world

    def __repr__(self) -> str:
        first = self.robots.get(self.name)
        what = "removed" if first is None else f"{self.name} at ({first.robot.pose[0]:.2f}, {first.robot.pose[1]:.2f})"
        more = len(self.robots) - (first is not None)
        return f"<Simulator {self.node.name}: {what}{f' and {more} more' if more else ''} in {self.world.name}>"

    def _bring(self, start: Start) -> TurtleBot:
        """Create the topics of a robot in the engine."""
        robot = TurtleBot(
            self.host,
            self.engine.robot(start.name),
            namespace=start.namespace,
            tf_prefix=start.tf_prefix,
            options=self._options,
        )
        self.robots[start.name] = robot
        return robot

    def _reset_positions(self, _: Any) -> dict[str, Any]:
        self.reset()
        return {}

    # -- robots --------------------------------------------------------------------------------------------------

    def spawn(
        self,
        name: str,
        model: RobotModel | str | None = None,
        pose: Pose | None = None,
        *,
        namespace: str | None = None,
        tf_prefix: str | None = None,
    ) -> TurtleBot:
        """Add another robot at run time.

        Without a model it is like the first one; without a pose it starts at a free start of the world, or at the
        nearest free position. `namespace` is the namespace of its topics, `tf_prefix` the prefix of its frames; both
        are its name if not given.

        Raises `RosminiError` for a name that is used, `IllegalName` for one that is not valid for topics,
        `UnknownModel`, and `WorldError`, with the nearest free position, if something is in the way.
        """

        def bring() -> TurtleBot:
            kind = self.model if model is None else model
            kind = kind if isinstance(kind, RobotModel) else model_called(kind)
            self.host.catch_up()
            space = name if namespace is None else namespace
            start = Start(name, kind, pose, space, space if tf_prefix is None else tf_prefix)
            add(self.engine, start)
            return self._bring(start)

        return self._do(bring)

    def _delete(self, name: str) -> None:
        robot = self.robot(name)
        self.host.catch_up()
        robot.close()
        self.engine.remove(name)
        del self.robots[name]

    def robot(self, name: str = "") -> TurtleBot:
        """Return the robot of this name, or the first. Raises `RobotGone`, with the reason."""
        self._check_running()
        wanted = name or self.name
        if wanted not in self.robots:
            self.engine.robot(wanted)
        return self.robots[wanted]

    def _entity(self, name: str) -> str:
        if any(each.name == name for each in self.engine.world.obstacles):
            return name
        return self.robot(name).name

    def _subject(self) -> str:
        return f"the robot {self.name!r}"

    # -- saving --------------------------------------------------------------------------------------------------

    def save(self) -> SimulatorState:
        """Return everything the world continues from: poses, velocities, odometry, random generators and time.

        Saving changes nothing, and the result can be pickled. Messages in transit are not included: subscribers get a
        step's messages right after the step, so after saving between the two and restoring, they receive those messages
        as well.
        """

        def saved() -> SimulatorState:
            starts = tuple(
                Start(each.name, each.model, each.robot.start, each.namespace, each.tf_prefix)
                for each in self.robots.values()
            )
            return SimulatorState(self.world.name, self.host.save(), starts)

        return self._do(saved)

    def restore(self, state: SimulatorState) -> None:
        """Continue exactly as after `save`, to the last bit: later additions are removed, removed objects come back.

        Time goes back too, but not the node's clock, from which the stamps come. Raises `RosminiError` for a state of
        another world or other devices.
        """

        def become() -> None:
            if not isinstance(state, SimulatorState):
                what = type(state).__name__
                raise RosminiError(
                    f"{self.node.name} can only be restored from what save() returned, not from a {what}"
                )
            if state.world != self.world.name:
                raise RosminiError(
                    f"a state of the world {state.world!r} cannot be restored in the world {self.world.name!r}"
                )
            before = {start.name: (start.model, start.namespace, start.tf_prefix) for start in state.robots}
            for name, robot in list(self.robots.items()):
                if before.get(name) != (robot.model, robot.namespace, robot.tf_prefix):
                    self._delete(name)
            self.engine.restore(state.host.engine)
            for start in state.robots:
                if start.name not in self.robots:
                    self._bring(start)
            self.robots = {start.name: self.robots[start.name] for start in state.robots}
            self.host.restore(state.host)

        self._do(become)

    def remove(self) -> None:
        """Remove all robots: their topics close, and the graph continues. Harmless when repeated."""

        def end() -> None:
            for name in list(self.robots):
                self._delete(name)
            self._end()
            self._service.shutdown("the robot was removed")

        self.node.scheduler.run_in_scheduler(end)

    def _end(self) -> None:
        super()._end()
        self.robots.clear()
