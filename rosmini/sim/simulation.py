"""Common base of the simulator, Stage and Gazebo's server: a world with robots, whose time passes in a graph.

Every method may be called from the main program, a callback, a script or another thread.
"""

from __future__ import annotations

from abc import ABC, abstractmethod
from collections.abc import Callable
from typing import Any, ClassVar, TypeVar

import numpy as np
from numpy.typing import NDArray

from rosmini.core.errors import RosminiError
from rosmini.core.geometry.poses import Pose
from rosmini.core.graph import Node
from rosmini.core.graph.show import show

from .devices.drive import DifferentialDrive
from .devices.laser import RangeDevice
from .dragging import drag
from .engine.engine import Engine, RobotGone
from .host import Host

T = TypeVar("T")


class Simulation(ABC):
    """A world with robots in a node; the base of `Simulator`, `Stageros` and `GazeboServer`.

    Args:
        node: the started node.
        host: the world's time.

    """

    program: ClassVar[str]
    """The package and the executable, as in rosrun's arguments."""

    def __init__(self, node: Node, host: Host) -> None:
        self.node = node
        self.host = host
        """The world's time, and its devices."""
        self._ended = False
        node.on_shutdown(self._end)

    @property
    def engine(self) -> Engine:
        """The engine, which moves everything."""
        return self.host.engine

    def _end(self) -> None:
        """Stop time permanently."""
        self._ended = True
        self.host.end()

    def _do(self, action: Callable[[], T]) -> T:
        """Perform an action on the world in the graph's thread. Raises `RobotGone` after the simulation has ended."""

        def act() -> T:
            self._check_running()
            return action()

        return self.node.scheduler.run_in_scheduler(act)

    def _check_running(self) -> None:
        if self._ended:
            why = f"the node {self.node.name} was shut down" if self.node.is_shutdown() else "it was removed"
            world, again = self.engine.world.name, self.program.partition("/")[2]
            raise RobotGone(f"{self._subject()} is no longer in the world {world!r}: {why}. Start another {again}.")

    def _subject(self) -> str:
        """Return the subject of the error message after the end."""
        return "the robot"

    @abstractmethod
    def _entity(self, name: str) -> str:
        """Return the engine's name of a robot or obstacle; "" means the first robot. Raises the errors of `truth`."""

    # -- time ----------------------------------------------------------------------------------------------------

    @property
    def now(self) -> float:
        """The world's time [s]."""
        return self.host.now

    @property
    def paused(self) -> bool:
        """True if time is paused."""
        return self.host.paused

    @property
    def speed(self) -> float:
        """Seconds of the world's time per second of the graph's."""
        return self.host.speed

    @speed.setter
    def speed(self, speed: float) -> None:
        self._do(lambda: self._set_speed(speed))

    def _set_speed(self, speed: float) -> None:
        self.host.speed = speed

    def pause(self) -> None:
        """Pause the world's time; harmless when repeated."""
        self._do(self.host.pause)

    def unpause(self) -> None:
        """Resume the world's time; harmless when repeated."""
        self._do(self.host.unpause)

    def step(self, seconds: float) -> None:
        """Advance the world's time by `seconds` at once, and pause. Raises `RosminiError` for an invalid duration."""
        self._do(lambda: self._step(seconds))

    def _step(self, seconds: float) -> None:
        self.host.pause()
        self.host.step(seconds)

    def reset(self) -> None:
        """Return all robots and movable obstacles to their initial poses; time continues."""
        self._do(self._reset)

    def _reset(self) -> None:
        self.host.reset()

    # -- robots and things ---------------------------------------------------------------------------------------

    def truth(self, name: str = "") -> Pose:
        """Return the true pose of a robot or obstacle: x [m], y [m], heading [rad, not wrapped], in the world's frame.

        Without a name: the first robot. Raises `RobotGone`, or `UnknownEntity` in Gazebo.
        """
        return self._do(lambda: self._truth(name))

    def _truth(self, name: str) -> Pose:
        entity, engine = self._entity(name), self.engine
        if entity in engine.robots:
            return engine.predict_pose(entity, self.host.engine_now)
        self.host.catch_up()
        return engine.pose(entity)

    def drag(self, name: str, pose: Pose) -> None:
        """Put a robot or a movable obstacle elsewhere, at rest, as with the mouse in a simulator's window.

        Raises `WorldError` if something is in the way, and the errors of `truth` for an unknown name.
        """
        self._do(lambda: self._drag(name, pose))

    def _drag(self, name: str, pose: Pose) -> None:
        entity = self._entity(name)
        self.host.catch_up()
        drag(self.engine, entity, pose)

    def place(self, pose: Pose, robot: str = "") -> None:
        """Put a robot elsewhere, the first if none is named, as `drag` does; its IMU notices, its encoders do not."""
        self._do(lambda: self._drag(robot, pose))

    def delete(self, name: str) -> None:
        """Remove a robot or a model: its topics close, all else continues. Raises the errors of `truth`."""
        self._do(lambda: self._delete(name))

    def _delete(self, name: str) -> None:
        raise RosminiError(f"{self.program} cannot remove {name!r}: its world file says what is in the world")

    def _laser(self, robot: str = "") -> RangeDevice | None:
        name = self._entity(robot)
        lasers = (each for each in self.host.devices if isinstance(each, RangeDevice))
        return next((each for each in lasers if each.robot.name == name), None)

    def last_scan(self, robot: str = "") -> Any:
        """Return the last `sensor_msgs/LaserScan` of a robot's first laser, or None. Raises the errors of `truth`.

        In Gazebo a laser measures only while its topic has a subscriber.
        """

        def copy() -> Any:
            laser = self._laser(robot)
            return None if laser is None else laser.message

        return self._do(copy)

    @property
    def scan_pose(self) -> Pose:
        """Pose of the first robot at its last scan; its start if it has no laser."""
        laser = self._laser()
        return self.engine.robot(self._entity("")).start if laser is None else laser.pose

    @property
    def scan_poses(self) -> NDArray[np.float64]:
        """Pose of the first robot at each beam of its last scan (beams, 3); (1, 3) if all were measured at once."""
        laser = self._laser()
        return np.array([self.scan_pose]) if laser is None else laser.seen_from

    @property
    def odometry(self) -> Pose:
        """Pose of the first robot by its last odometry: x [m], y [m], heading [rad]. Raises `RobotGone`."""
        name = self._entity("")
        for device in self.host.devices:
            if isinstance(device, DifferentialDrive) and device.robot.name == name:
                return device.reckoned.pose
        raise RobotGone(f"the first robot in the world {self.engine.world.name!r} has no drive, and no odometry")

    # -- pictures ------------------------------------------------------------------------------------------------

    def show(self, **options: Any) -> Any:
        """Return a picture of the world as it is now, with its robots and the first robot's last scan.

        Options and their defaults:
            title=None: a caption under the picture, and the first words of its text form
            size=(660.0, 540.0): the largest width and height [CSS px]
        """
        return show("simulation", self, **options)

    def show3d(self, **options: Any) -> Any:
        """Return a view of the world with its robots that can be rotated.

        Options and their defaults:
            focus='robot': the target of the camera; or 'world'
            distance=None: of the camera from its target [m]; None: chosen automatically
            azimuth=None: direction of the camera [deg], 0: from the side of x, 90: of y; None: chosen automatically
            elevation=None: elevation of the camera [deg]; None: chosen automatically
            title=None: a caption under the picture, and the first words of its text form
            height=420: of the viewer [CSS px]
        """
        return show("simulation_3d", self, **options)

    def pad(self, robot: str = "", **options: Any) -> Any:
        """Return a pad for driving a robot, the first if none is named.

        Options and their defaults:
            title=None: a caption under the pad, and the first line of its text form
        """
        return show("teleop_pad", self, robot=robot and self._do(lambda: self._entity(robot)), **options)
