"""What the simulator, Stage and Gazebo's server have in common: a world with robots, whose time passes in a graph.

Every method may be called from the main program, a callback, a script or another thread.
"""

from __future__ import annotations

from abc import ABC, abstractmethod
from collections.abc import Callable
from dataclasses import dataclass
from typing import Any, ClassVar, TypeVar

import numpy as np
from numpy.typing import NDArray

from rosmini.core.errors import RosminiError
from rosmini.core.geometry.poses import Pose
from rosmini.core.graph import Node
from rosmini.core.graph.show import show

from .devices import DifferentialDrive, RangeDevice
from .dragging import drag
from .engine.engine import Engine, RobotGone
from .host import Host, HostState

T = TypeVar("T")


@dataclass(frozen=True)
class SimulationState:
    """What `Simulation.save` returns: all that a simulation goes on from. It can be pickled."""

    program: str
    world: str
    host: HostState
    own: Any
    """What this kind of simulation adds: the robots of a simulator, the models of Gazebo."""


class Simulation(ABC):
    """A world with robots in a node; the base of `Simulator`, `Stageros` and `GazeboServer`.

    Args:
        node: the started node.
        host: the world's time.

    """

    program: ClassVar[str]
    """The package and the executable, as rosrun takes them."""

    def __init__(self, node: Node, host: Host) -> None:
        self.node = node
        self.host = host
        """The world's time, and all devices in it."""
        self._ended = False
        node.on_shutdown(self._end)

    @property
    def engine(self) -> Engine:
        """The engine, which moves everything."""
        return self.host.engine

    def _end(self) -> None:
        """Stop time for good."""
        self._ended = True
        self.host.end()

    def _do(self, action: Callable[[], T]) -> T:
        """Do something to the world, in the graph's thread. Raises `RobotGone` when the simulation has ended."""

        def act() -> T:
            self._check_running()
            return action()

        return self.node.scheduler.on_hub(act)

    def _check_running(self) -> None:
        if self._ended:
            why = f"the node {self.node.name} was shut down" if self.node.is_shutdown() else "it was removed"
            world, again = self.engine.world.name, self.program.partition("/")[2]
            raise RobotGone(
                f"{self._subject()} is no longer in the world {world!r}: {why}. Start another {again}."
            )

    def _subject(self) -> str:
        """What is said to be gone after the end."""
        return "the robot"

    @abstractmethod
    def _entity(self, name: str) -> str:
        """Return the engine's name of a robot or a thing; "" means the first robot. Raises as `truth` does."""

    # -- time ----------------------------------------------------------------------------------------------------

    @property
    def now(self) -> float:
        """The world's time [s]."""
        return self.host.now

    @property
    def paused(self) -> bool:
        """Whether time stands still."""
        return self.host.paused

    @property
    def speed(self) -> float:
        """How many seconds of the world pass in one second of the graph."""
        return self.host.speed

    @speed.setter
    def speed(self, speed: float) -> None:
        self._do(lambda: self._set_speed(speed))

    def _set_speed(self, speed: float) -> None:
        self.host.speed = speed

    def pause(self) -> None:
        """Stop the world's time. Harmless when repeated."""
        self._do(self.host.pause)

    def unpause(self) -> None:
        """Let the world's time go on. Harmless when repeated."""
        self._do(self.host.unpause)

    def step(self, seconds: float) -> None:
        """Let so much of the world's time pass at once, and pause. Raises `RosminiError` for what is no duration."""
        self._do(lambda: self._step(seconds))

    def _step(self, seconds: float) -> None:
        self.host.pause()
        self.host.step(seconds)

    def reset(self) -> None:
        """Put all robots and everything movable back to where it started; time goes on."""
        self._do(self._reset)

    def _reset(self) -> None:
        self.host.reset()

    # -- robots and things ---------------------------------------------------------------------------------------

    def truth(self, name: str = "") -> Pose:
        """Where a robot or a thing really is: x [m], y [m], heading [rad, not wrapped], in the world's frame.

        Without a name: the first robot. Raises `RobotGone`, or `UnknownEntity` in Gazebo.
        """
        return self._do(lambda: self._truth(name))

    def _truth(self, name: str) -> Pose:
        entity, engine = self._entity(name), self.engine
        if entity in engine.robots:
            return engine.peek(entity, self.host.engine_now)
        self.host.catch_up()
        return engine.pose(entity)

    def drag(self, name: str, pose: Pose) -> None:
        """Put a robot, or a thing that can be pushed, elsewhere, at rest, as with the mouse in a simulator's window.

        Raises `WorldError` if something is in the way, and as `truth` does for an unknown name.
        """
        self._do(lambda: self._drag(name, pose))

    def _drag(self, name: str, pose: Pose) -> None:
        entity = self._entity(name)
        self.host.catch_up()
        drag(self.engine, entity, pose)

    def place(self, pose: Pose, robot: str = "") -> None:
        """Put a robot elsewhere, the first if none is named, as `drag` does; only its IMU feels it."""
        self._do(lambda: self._drag(robot, pose))

    def delete(self, name: str) -> None:
        """Remove a robot or a model: its topics end, all else goes on. Raises as `truth` does."""
        self._do(lambda: self._delete(name))

    def _delete(self, name: str) -> None:
        raise RosminiError(f"{self.program} cannot remove {name!r}: its world file says what is in the world")

    def _laser(self, robot: str = "") -> RangeDevice | None:
        name = self._entity(robot)
        lasers = (each for each in self.host.devices if isinstance(each, RangeDevice))
        return next((each for each in lasers if each.robot.name == name), None)

    def last_scan(self, robot: str = "") -> Any:
        """The last `sensor_msgs/LaserScan` of a robot's first laser; None before the first one. Raises as `truth` does.

        In Gazebo a laser measures only while somebody listens.
        """

        def copy() -> Any:
            laser = self._laser(robot)
            return None if laser is None else laser.message

        return self._do(copy)

    @property
    def scan_pose(self) -> Pose:
        """Where the first robot was at its last scan; where it started if it has no laser."""
        laser = self._laser()
        return self.engine.robot(self._entity("")).start if laser is None else laser.pose

    @property
    def scan_poses(self) -> NDArray[np.float64]:
        """Where the first robot was at each beam of its last scan (beams, 3); (1, 3) if all were measured at once."""
        laser = self._laser()
        return np.array([self.scan_pose]) if laser is None else laser.seen_from

    @property
    def odometry(self) -> Pose:
        """Where the first robot's odometry last put it: x [m], y [m], heading [rad]. Raises `RobotGone`."""
        name = self._entity("")
        for device in self.host.devices:
            if isinstance(device, DifferentialDrive) and device.robot.name == name:
                return device.reckoned.pose
        raise RobotGone(
            f"the first robot in the world {self.engine.world.name!r} has no drive, and no odometry"
        )

    # -- saving --------------------------------------------------------------------------------------------------

    def save(self) -> SimulationState:
        """Return all that the world goes on from: poses, velocities, odometry, noise to come, time. It can be pickled.

        Saving changes nothing. Messages on their way are not part of it: what was published in a step is heard right
        after that step, so whoever saves between the two hears those messages after restoring too. Nor is what a
        plugin of Gazebo remembers elsewhere than in a device.
        """
        return self._do(
            lambda: SimulationState(self.program, self.engine.world.name, self.host.save(), self._own_state())
        )

    def _own_state(self) -> Any:
        return None

    def restore(self, state: SimulationState) -> None:
        """Go on exactly as after `save`, to the last bit: what came since goes, and what has gone comes back.

        Time goes back too, and with it /clock; only the simulator's stamps follow the node's clock, which does not go
        back. Raises `RosminiError` for what is no state of this program and this world, or of other devices.
        """

        def become() -> None:
            if not isinstance(state, SimulationState) or state.program != self.program:
                what = state.program if isinstance(state, SimulationState) else type(state).__name__
                msg = f"{self.node.name} can only be restored from what its own save() returned, not from a {what}"
                raise RosminiError(msg)
            if state.world != self.engine.world.name:
                world = self.engine.world.name
                raise RosminiError(
                    f"a state of the world {state.world!r} cannot be restored in the world {world!r}"
                )
            self._remove_new(state.own)
            self.engine.restore(state.host.engine)
            self._bring_back(state.own)
            self.host.restore(state.host)

        self._do(become)

    def _remove_new(self, own: Any) -> None:  # noqa: B027 - not every simulation has robots that come and go
        """Remove what was not there, or was another, when the state was saved."""

    def _bring_back(self, own: Any) -> None:  # noqa: B027
        """Give what was removed since, and is in the engine again, its devices."""

    # -- pictures ------------------------------------------------------------------------------------------------

    def show(self, **options: Any) -> Any:
        """A picture of the world as it is now, with its robots.

        Options, with what they are unless given:
            scan=True: draw the first robot's last scan, if there is one yet, from where it was taken
            trail=None: where the robot was: a `Recording`, of which odometry is drawn, too, or poses (n, 2) or (n, 3)
            title=None: a caption under the picture, and the first words of its text form
            size=(660.0, 540.0): the largest width and height [CSS px]
        """
        return show("simulation", self, **options)

    def show3d(self, **options: Any) -> Any:
        """The world with its robots, to be turned.

        Options, with what they are unless given:
            focus='robot': what the camera looks at, or 'world'
            distance=None: of the camera from what it looks at [m]; None: what shows it well
            azimuth=None: from where it looks [deg], 0: from the side of x, 90: of y; None: what shows it well
            elevation=None: how high from [deg]; None: what shows it well
            title=None: a caption under the picture, and the first words of its text form
            height=420: of the viewer [CSS px]
        """
        return show("simulation_3d", self, **options)

    def view(self, **options: Any) -> Any:
        """The running world, in which robots and things are dragged.

        Options, with what they are unless given:
            title=None: a caption under the view, and the first line of its text form
        """
        return show("simulation_view", self, **options)

    def pad(self, robot: str = "", **options: Any) -> Any:
        """A pad to drive a robot with, the first if none is named.

        Options, with what they are unless given:
            topic=None: where to publish, as the simulation's node resolves it; None: where the robot listens
            name='teleop_pad': the name of the pad's node
            limits=None: how fast at most, and how fast that changes; None: as fast as the robot may
            keys='': whose keys it has; '': those of turtlebot3_teleop_key; or 'teleop_twist_keyboard'
            hold=False: whether a key has to be held, as a dead man's switch has
            solid=False: whether the robot is shown in three dimensions, from behind, in the place of the map
            title=None: a caption under the pad, and the first line of its text form
        """
        return show("teleop_pad", self, robot=robot and self._do(lambda: self._entity(robot)), **options)
