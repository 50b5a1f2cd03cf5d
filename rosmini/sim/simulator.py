"""The node `rosmini_sim/simulator`: TurtleBot3s in a world, with the topics of the real ones.

Each subscribes to `cmd_vel` and publishes `scan`, `odom`, `/tf`, `joint_states` and `imu` at the rates of the robot's firmware, a waffle also what its
camera sees, and beside them `base_pose_ground_truth`, where the robot really is (Stage's name; no real robot knows that). With `_board:=true` there are
`sensor_state`, `battery_state`, `motor_power` and `reset` too. It offers `reset_positions` (Stage's name too).

As on the real robot, the heading of `odom` comes from the IMU (`_odometry:=wheels` takes the wheels, as Gazebo does), and the laser takes 0.2 s for a scan,
while the robot moves on (`_sweep:=false` measures all beams at once, as Stage and Gazebo do). See `rosmini.sim.engine.odometry`, `rosmini.sim.sensors.imu` and
`rosmini.sim.sensors.lidar`.

As on the real robot (firmware 1.2.3) and in Stage, a command holds for a moment only: half a second after the last `cmd_vel` the robot stops. So
whoever drives it repeats the command, as `rostopic pub -r 10` does. `_cmd_vel_timeout:=0` lets it go on, as in Gazebo.

Without `~robots` there is one robot, whose topics are in the node's own namespace. With it there are several, see `rosmini.sim.starts.read_starts`.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any

import numpy as np
from numpy.typing import NDArray

from rosmini.errors import RosminiError
from rosmini.geometry.poses import Pose
from rosmini.graph import Node
from rosmini.graph.show import show
from rosmini.msgs import service_class

from .devices.obstacles import ObstacleMarkers
from .dragging import drag
from .engine.engine import Engine, RobotGone
from .host import Host, HostState
from .models import RobotModel
from .models import model as model_called
from .parameters import Parameters, parameter
from .starts import Start, add, read_starts, start_pose
from .turtlebot import COMMAND_TIMEOUT, ODOMETRY, Options, TurtleBot
from .world import World
from .worlds import world as world_called

Floats = NDArray[np.float64]


@dataclass(frozen=True)
class SimulatorParameters(Parameters):
    """The private parameters of `rosmini_sim/simulator`; beside them `~robots`, see `read_starts`."""

    allowed = ("robots",)

    world: str = parameter("room", "which world: a name, or a map's yaml file")
    model: str | None = parameter(None, "which robot; without it what TURTLEBOT3_MODEL says, else burger")
    x: float | None = parameter(
        None, "where the robot starts; without it at the world's first start", unit="m"
    )
    y: float | None = parameter(None, "where the robot starts", unit="m")
    yaw: float | None = parameter(None, "its heading there, counter-clockwise from the x axis", unit="rad")
    noise: float = parameter(1.0, "scales every error of wheels and sensors; 0: none", minimum=0.0)
    odometry: str = parameter(
        ODOMETRY[0], "what says how far a robot has turned, for its odometry", choices=ODOMETRY
    )
    sweep: bool = parameter(
        True, "measure a scan's beams one after the other, as a real LDS-01 does, and not all at once"
    )
    cmd_vel_timeout: float = parameter(
        COMMAND_TIMEOUT, "how long a command holds; 0: until the next", unit="s", minimum=0.0
    )
    tf: bool = parameter(True, "publish the transform from odom to base_footprint")
    tf_prefix: str = parameter("", "what the names of the robot's frames begin with: tb3_0 gives tb3_0/odom")
    board: bool = parameter(
        False, "have the topics of the robot's board too: sensor_state, battery_state, motor_power, reset"
    )
    battery: float = parameter(
        1.0, "with the board: how full the batteries are at first", minimum=0.0, maximum=1.0
    )
    obstacles: bool = parameter(
        False, "publish where all that moves by itself or can be pushed is, as markers on obstacles"
    )
    use_rep_117: bool = parameter(
        True,
        "write inf for what is too far and -inf for what is too near; else 0.0, as a real LDS-01 does",
    )


@dataclass(frozen=True)
class SimulatorState:
    """What `Simulator.save` returns."""

    world: str
    robots: tuple[Start, ...]
    host: HostState


class Simulator:
    """Robots in a world, as a node of a graph: one at first, more with `spawn` or the parameter `~robots`.

    Args:
        node: the started node; its private parameters say which world and robot (`SimulatorParameters`).
        world: the world, or its name; before the parameter.
        model: the robot, or its name; before the parameter.

    Raises:
        WorldError: there is no such world, or a robot has no room where it is to start.
        UnknownModel: there is no such robot.
        ParameterError: a parameter has no such name, a wrong type, or a value out of range.

    """

    def __init__(
        self, node: Node, *, world: World | str | None = None, model: RobotModel | str | None = None
    ) -> None:
        self.node = node
        self.parameters = SimulatorParameters.read(node)
        world = self.parameters.world if world is None else world
        model = self.parameters.model if model is None else model
        world = world if isinstance(world, World) else world_called(world)
        self.model = model if isinstance(model, RobotModel) else model_called(model)
        own = self.parameters
        self._options = Options(
            own.noise,
            own.cmd_vel_timeout,
            own.tf,
            own.use_rep_117,
            own.board,
            own.battery,
            own.odometry,
            own.sweep,
        )
        self.engine = Engine(world, lambda name: node.graph.rng(f"{node.name}/{name}"), noise=own.noise)
        pose = start_pose(world, own.x, own.y, own.yaw)
        starts = read_starts(node, self.model, world, pose, own.tf_prefix)
        self.name = starts[0].name
        """Of the robot that is meant where none is named."""
        for start in starts:
            add(self.engine, start)
        if starts[0].model.lidar is not None:
            self.engine.scan(self.name)  # where numba has to compile, it does so now and not on the way
        self.host = Host(node, self.engine)
        """Its time: it can be paused, stepped and go on; and the devices of all robots."""
        if own.obstacles:
            self.host.add(ObstacleMarkers(self.host))
        self._ended = False
        self.robots: dict[str, TurtleBot] = {}
        """Those that are in the world, by name, in the sequence of their coming."""
        for start in starts:
            self._bring(start)
        self._service = node.service(
            "reset_positions", service_class("std_srvs/Empty"), self._reset_positions
        )
        node.on_shutdown(self._end)

    @property
    def world(self) -> World:
        """The world, with what has been put into it, and without what has been taken away, since it began."""
        return self.engine.world

    def __repr__(self) -> str:
        first = self.robots.get(self.name)
        what = (
            "removed"
            if first is None
            else f"{self.name} at ({first.robot.pose[0]:.2f}, {first.robot.pose[1]:.2f})"
        )
        more = len(self.robots) - (first is not None)
        return (
            f"<Simulator {self.node.name}: {what}{f' and {more} more' if more else ''} in {self.world.name}>"
        )

    def _bring(self, start: Start) -> TurtleBot:
        """Give a robot that is in the engine its topics."""
        robot = TurtleBot(
            self.host,
            self.engine.robot(start.name),
            namespace=start.namespace,
            tf_prefix=start.tf_prefix,
            options=self._options,
        )
        self.robots[start.name] = robot
        if start.name == self.name:
            self._first = robot
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
        """Put another robot into the world, while all goes on.

        Without a model it is one like the first; without a pose it comes to a free start of the world, or to the nearest place that is free. Its
        topics are in the namespace, and its frames begin with the prefix, which both are its name if nothing else is said.

        Raises `RosminiError` for a name that is used, `IllegalName` for one that cannot be that of its topics, `UnknownModel`,
        and `WorldError`, with the nearest free place, if something stands there.
        """

        def bring() -> TurtleBot:
            self._open()
            kind = self.model if model is None else model
            kind = kind if isinstance(kind, RobotModel) else model_called(kind)
            self.host.catch_up()
            space = name if namespace is None else namespace
            start = Start(name, kind, pose, space, space if tf_prefix is None else tf_prefix)
            add(self.engine, start)
            return self._bring(start)

        return self.node.scheduler.on_hub(bring)

    def delete(self, name: str) -> None:
        """Take a robot out of the world, whether it moves or not: its topics end, and all else goes on. Raises `RobotGone`."""

        def take() -> None:
            robot = self.robot(name)
            self.host.catch_up()
            robot.close()
            self.engine.remove(name)
            del self.robots[name]

        self.node.scheduler.on_hub(take)

    def robot(self, name: str = "") -> TurtleBot:
        """Return the robot of this name, or the first. Raises `RobotGone`, which says what became of it."""
        self._open()
        wanted = name or self.name
        if wanted not in self.robots:
            self.engine.robot(wanted)
        return self.robots[wanted]

    def _open(self) -> None:
        """Raise `RobotGone` if the simulator has ended."""
        if self._ended:
            why = f"the node {self.node.name} was shut down" if self.node.is_shutdown() else "it was removed"
            msg = f"the robot {self.name!r} is no longer in the world {self.world.name!r}: {why}. Start another simulator."
            raise RobotGone(msg)

    # -- for who started it --------------------------------------------------------------------------------------

    @property
    def scan_pose(self) -> Pose:
        """Where the robot was when it took the last scan."""
        return self._first.robot.start if self._first.laser is None else self._first.laser.pose

    @property
    def scan_poses(self) -> Floats:
        """Where the robot was at each beam of the last scan (beams, 3); (1, 3) if all of them were measured at once."""
        laser = self._first.laser
        return np.array([self.scan_pose]) if laser is None else laser.seen_from

    def truth(self, robot: str = "") -> Pose:
        """Where the robot really is now: x [m], y [m], heading [rad, not wrapped], in the frame map. Raises `RobotGone`."""
        return self.node.scheduler.on_hub(
            lambda: self.engine.peek(self.robot(robot).name, self.host.engine_now)
        )

    @property
    def odometry(self) -> Pose:
        """Where the robot believes to be, by its last odometry: x [m], y [m], heading [rad, not wrapped], in the frame odom."""
        return self._first.odometry

    def place(self, pose: Pose, robot: str = "") -> None:
        """Lift the robot and put it down elsewhere, at rest; its wheels do not notice, but its IMU feels the turn. Raises `WorldError` and `RobotGone`."""

        def put() -> None:
            name = self.robot(robot).name
            self.host.catch_up()
            self.engine.place(name, pose)

        self.node.scheduler.on_hub(put)

    def drag(self, name: str, pose: Pose) -> None:
        """Take a robot, or a thing that can be pushed, and put it down elsewhere, at rest. Raises `WorldError` and `RobotGone`."""

        def put() -> None:
            self._open()
            self.host.catch_up()
            drag(self.engine, name, pose)

        self.node.scheduler.on_hub(put)

    def reset(self) -> None:
        """Put all robots and all movable obstacles back to where they began, with odometry at zero. Raises `RobotGone`."""

        def put_back() -> None:
            self._open()
            self.host.reset()

        self.node.scheduler.on_hub(put_back)

    def last_scan(self, robot: str = "") -> Any:
        """The last `sensor_msgs/LaserScan`, whether anybody heard it or not; None before the first. Raises `RobotGone`."""

        def copy() -> Any:
            laser = self.robot(robot).laser
            return None if laser is None else laser.message

        return self.node.scheduler.on_hub(copy)

    def save(self) -> SimulatorState:
        """Everything that it will go on from: robots, odometry, batteries, movable obstacles, time, random generators. It can be pickled.

        Messages that are on their way are no part of it: who saves at the very moment of a scan hears that one after restoring too.
        """

        def take() -> SimulatorState:
            self._open()
            starts = [
                Start(each.name, each.model, each.robot.start, each.namespace, each.tf_prefix)
                for each in self.robots.values()
            ]
            return SimulatorState(self.world.name, tuple(starts), self.host.save())

        return self.node.scheduler.on_hub(take)

    def restore(self, state: SimulatorState) -> None:
        """Go on from there, to the last bit as it went on then: robots that have come since go, those that have gone come back.

        Stamps follow the node's clock, which does not go back. Raises `RosminiError` for what is no state of a simulator, or that of another world.
        """

        def become() -> None:
            self._open()
            if not isinstance(state, SimulatorState):
                msg = f"the simulator {self.node.name} can only be restored from what its save() returned, not from a {type(state).__name__}"
                raise RosminiError(msg)
            if state.world != self.world.name:
                msg = f"a state of the world {state.world!r} cannot be restored in the world {self.world.name!r}"
                raise RosminiError(msg)
            before = {start.name: start for start in state.robots}
            for name, robot in list(self.robots.items()):
                start = before.get(name)
                if start is None or (robot.model, robot.namespace, robot.tf_prefix) != (
                    start.model,
                    start.namespace,
                    start.tf_prefix,
                ):
                    self.delete(name)
            missing = [start for start in state.robots if start.name not in self.robots]
            self.engine.restore(state.host.engine)
            for start in missing:
                self._bring(start)
            self.robots = {name: self.robots[name] for name in before}
            self.host.restore(state.host)

        self.node.scheduler.on_hub(become)

    def remove(self) -> None:
        """Take all robots out of the world: their topics end, and the graph goes on. Harmless when repeated."""

        def end() -> None:
            for name in list(self.robots):
                self.delete(name)
            self._end()
            self._service.shutdown("the robot was removed")

        self.node.scheduler.on_hub(end)

    def _end(self) -> None:
        """Let time stand for ever."""
        self._ended = True
        self.host.end()
        self.robots.clear()

    # -- pictures ------------------------------------------------------------------------------------------------

    def show(self, **options: Any) -> Any:
        """A picture of the world as it is now, with its robots.

        Options, with what they are unless given:
            scan=True: draw the first robot's last scan from where it was taken; there is none before its laser's first revolution
            trail=None: where the robot was: a `Recording`, of which odometry is drawn, too, or poses (n, 2) or (n, 3)
            title=None: a caption under the picture, and the first words of its text form
            size=(660.0, 540.0): the largest width and height [CSS px]
        """
        return show("simulation", self, **options)

    def show3d(self, **options: Any) -> Any:
        """The robot in its world, to be turned.

        Options, with what they are unless given:
            focus='robot': what the camera looks at, or 'world'
            distance=None: of the camera from what it looks at [m]; None: what shows it well
            azimuth=None: from where it looks [deg]: at 0 from the side of x, at 90 from the side of y; None: what shows it well
            elevation=None: how high from [deg]; None: what shows it well
            title=None: a caption under the picture, and the first words of its text form
            height=420: of the viewer [CSS px]
        """
        return show("simulation_3d", self, **options)

    def view(self, **options: Any) -> Any:
        """The running world, in which robots and boxes are dragged.

        Options, with what they are unless given:
            title=None: a caption under the view, and the first line of its text form
        """
        return show("simulation_view", self, **options)

    def pad(self, robot: str = "", **options: Any) -> Any:
        """A pad to drive a robot with, the first if none is named.

        Options, with what they are unless given:
            topic='cmd_vel': where to publish, as the simulation's node calls it: in its namespace, remapped as it is there
            name='teleop_pad': the name of the pad's node
            limits=None: how fast at most; None: as fast as the robot may
            title=None: a caption under the pad, and the first line of its text form
        """
        return show("teleop_pad", self, robot=robot, **options)
