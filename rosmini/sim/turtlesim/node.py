"""`turtlesim/turtlesim_node` (http://wiki.ros.org/turtlesim): turtles in a window, as a node of a graph.

Each turtle has the topics `NAME/cmd_vel` (geometry_msgs/Twist), `NAME/pose` and `NAME/color_sensor`, and the services
`NAME/set_pen`, `NAME/teleport_absolute` and `NAME/teleport_relative`; the node has `clear`, `reset`, `spawn` and
`kill`. As in ROS, a Twist takes effect at the next update (the last one if there are several), and holds for a second.
Requests that change the drawing or a pose (pens, teleports, `clear`) are answered at the next update, within 16 ms.
"""

from __future__ import annotations

import random
from collections.abc import Callable
from dataclasses import dataclass
from typing import Any

from rosmini.core.errors import IllegalName, ParameterError, RosminiError, ServiceRefused, nearest
from rosmini.core.graph import Graph, Node, running_graph
from rosmini.core.graph.clock import GraphClock
from rosmini.core.graph.lanes import Waiter
from rosmini.core.graph.show import has_own_process, show
from rosmini.core.names import check_name, resolve
from rosmini.core.parameters import Parameters, parameter
from rosmini.msgs import message_class, service_class

from .drawings import DRAWINGS
from .frame import Frame
from .paper import BACKGROUND, Colour
from .tape import Tape
from .turtle import START, STEP_S, Turtle, TurtleError

STEP_NS = round(STEP_S * 1e9)


@dataclass(frozen=True)
class TurtleSimParameters(Parameters):
    """The private parameters of `turtlesim_node`, which sets the background parameters if they do not exist.

    A changed background takes effect at `clear` or `reset`.
    """

    background_r: int = parameter(BACKGROUND[0], "red of the background")
    background_g: int = parameter(BACKGROUND[1], "green of the background")
    background_b: int = parameter(BACKGROUND[2], "blue of the background")
    holonomic: bool = parameter(True, "turtles obey linear.y of a Twist, and move sideways, as in Noetic")

    @property
    def background(self) -> Colour:
        """The background colour; only the lowest byte of each number is used, as in Qt's `qRgb`."""
        return self.background_r & 255, self.background_g & 255, self.background_b & 255


class TurtleSim:
    """A window of turtlesim: `frame` contains the turtles and their drawing, `show()` returns a picture of it.

    Args:
        node: the started node.

    Raises:
        ParameterError: a parameter has an unknown name, a wrong type, or a value out of range.

    """

    node_name = "turtlesim"

    def __init__(self, node: Node) -> None:
        self.node = node
        self.parameters = TurtleSimParameters.read(node)
        rng = random.Random(f"{node.graph.seed}{node.name}/turtles")  # noqa: S311 - the graph's needs numpy
        self.frame = Frame(self.parameters.background, lambda: int(rng.random() * len(DRAWINGS)))
        self._interfaces: dict[str, TurtleInterface] = {}
        self._tapes: list[Tape] = []
        self._requests: list[tuple[Callable[[], object], Waiter]] = []
        self._clock = GraphClock(node.scheduler)
        for colour in ("background_r", "background_g", "background_b"):
            if not node.has_param(f"~{colour}"):
                node.set_param(f"~{colour}", getattr(self.parameters, colour))
        empty = service_class("std_srvs/Empty")
        node.service("clear", empty, self._clear)
        node.service("reset", empty, self._reset)
        node.service("spawn", service_class("turtlesim/Spawn"), self._spawn)
        node.service("kill", service_class("turtlesim/Kill"), self._kill)
        node.loginfo(f"Starting turtlesim with node name {node.name}")
        self.spawn(*START)
        self._due_ns = self._clock.now_ns() + STEP_NS
        self._cancel = self._clock.call_at(self._due_ns, self._wake)
        node.on_shutdown(self._end)
        if has_own_process(node.graph):
            show("turtle_window", self)

    @property
    def turtles(self) -> dict[str, Turtle]:
        """The turtles by name."""
        return self.frame.turtles

    def state(self, since: int = 0, clears: int | None = None) -> dict[str, Any]:
        """Return the data for drawing the window on a canvas: see `Frame.state`."""
        return self.frame.state(since, clears)

    def record(self) -> Tape:
        """Record the turtles' motion and drawing until the tape's `stop()`; its `replay()` plays it."""
        tape = Tape(self.node.name, self._clock.now_ns() * 1e-9, self.frame)
        self._tapes.append(tape)
        return tape

    def show(self, **options: Any) -> Any:
        """Return a picture of the window.

        Options and their defaults:
            title=None: a caption under the picture, and the first words of its text form
            size=360.0: its width and height [CSS px]
        """
        return show("turtlesim", self.frame, **options)

    def pad(self, robot: str = "", **options: Any) -> Any:
        """Return a pad for driving a turtle, the first if none is named; in a live notebook its window moves.

        Options and their defaults:
            title=None: a caption under the pad, and the first line of its text form
        """
        return show("teleop_pad", self, robot=robot, **options)

    # -- turtles -------------------------------------------------------------------------------------------------

    def spawn(self, x: float, y: float, theta: float, name: str = "") -> str:
        """Add a turtle at a pose [m, m, rad], with its topics and services; return its name.

        Raises `TurtleError`, and `RosminiError` if the name is not valid for topics.
        """
        if name:
            self._check_name(name)
        holonomic = self.parameters.holonomic
        turtle = self.frame.spawn(x, y, theta, name, holonomic=holonomic)
        try:
            interface = TurtleInterface(self, turtle)
        except BaseException:
            self.frame.turtles.pop(turtle.name, None)
            raise
        if self.frame.turtles.get(turtle.name) is not turtle:  # killed while its topics were created
            interface.close()
            raise TurtleError(f"turtle {turtle.name} was killed before it had its topics")
        self._interfaces[turtle.name] = interface
        self.node.loginfo(f"Spawning turtle [{turtle.name}] at x=[{x:f}], y=[{y:f}], theta=[{theta:f}]")
        return turtle.name

    def _check_name(self, name: str) -> None:
        """Raise unless this name is valid for a new turtle's topics; whether it is taken is checked elsewhere."""
        space = self.node.resolve(check_name(name, "turtle name"))
        same = next((each for each in self.turtles if self.node.resolve(each) == space), name)
        if same != name:
            raise TurtleError(f"a turtle {name} would have the topics of {same}: give another name")

    def _spawn(self, request: Any) -> str:
        try:
            return self.spawn(request.x, request.y, request.theta, request.name)
        except (TurtleError, IllegalName) as error:
            if request.name in self.frame.turtles:  # as in ROS: no error text for the caller, and this in the log
                self.node.logerr(f"A turtled named [{request.name}] already exists")
                raise ServiceRefused from error
            raise self._refused(error) from error

    def _kill(self, request: Any) -> list[Any]:
        try:
            turtle = self.frame.kill(request.name)
        except TurtleError as error:
            self.node.logerr(f"Tried to kill turtle [{request.name}], which does not exist")
            raise ServiceRefused from error
        self._close_interface(turtle)
        return []

    def _reset(self, _: Any) -> list[Any]:
        self.node.loginfo("Resetting turtlesim.")
        for turtle in self.frame.reset():
            self._close_interface(turtle)
        self.spawn(*START)
        self.frame.paper.clear(self._background())
        return []

    def _clear(self, _: Any) -> list[Any]:
        self.node.loginfo("Clearing turtlesim.")
        background = self._background()
        self.at_update(lambda: self.frame.paper.clear(background))
        return []

    def _background(self) -> Colour:
        """Return the colour in the current parameters, or the previous one if they are invalid."""
        try:
            return TurtleSimParameters.read(self.node).background
        except ParameterError as error:
            self.node.logerr(f"the background stays as it is: {error}")
            return self.frame.paper.background

    def _close_interface(self, turtle: Turtle) -> None:
        interface = self._interfaces.pop(turtle.name, None)
        if interface is not None:
            interface.close()

    def _refused(self, error: RosminiError) -> ServiceRefused:
        self.node.logerr(error)
        return ServiceRefused(str(error))

    def _end(self) -> None:
        self._cancel()

    # -- updates -------------------------------------------------------------------------------------------------

    def at_update(self, work: Callable[[], object]) -> None:
        """Run `work` at the beginning of the next update, and wait for it. A `TurtleError` refuses the service."""
        waiter = self.node.waiter("the next update of turtlesim")
        self._requests.append((work, waiter))
        try:
            self.node.wait(waiter)
        except TurtleError as error:
            raise self._refused(error) from error

    def _wake(self) -> None:
        """Make an update. This event has no lane, because nothing in it blocks."""
        late = self._clock.now_ns() - self._due_ns
        self._due_ns += STEP_NS * (1 + late // STEP_NS)  # missed updates are not made up for
        self._cancel = self._clock.call_at(self._due_ns, self._wake)
        self.node.guarded(self._update, what="the update of the turtles")

    def _update(self) -> None:
        requests, self._requests = self._requests, []
        for work, waiter in requests:
            try:
                work()
            except TurtleError as error:
                waiter.fail(error)
            else:
                waiter.wake()
        frame, now = self.frame, self._clock.now_ns() * 1e-9
        if frame.updates:  # the first one only reads the clock, as in ROS
            for turtle in frame.turtles.values():
                interface = self._interfaces.get(turtle.name)
                if interface is None:  # its topics are being created
                    continue
                bump = turtle.move(now, frame.paper)
                if bump is not None:
                    x, y = bump
                    self.node.logwarn(f"Oh no! I hit the wall! (Clamping from [x={x:f}, y={y:f}])")
                interface.publish(turtle)
                turtle.draw(frame.paper)
        frame.updates += 1
        if self._tapes:
            for tape in self._tapes:
                tape.note(now, frame)
            self._tapes = [tape for tape in self._tapes if tape.is_running]


class TurtleInterface:
    """The topics and services of one turtle."""

    def __init__(self, sim: TurtleSim, turtle: Turtle) -> None:
        self.sim = sim
        self.turtle = turtle
        node, name = sim.node, turtle.name
        pose, colour = message_class("turtlesim/Pose"), message_class("turtlesim/Color")
        self._pose, self._colour = pose(), colour()
        self._velocities = node.subscriber(
            f"{name}/cmd_vel", message_class("geometry_msgs/Twist"), self._command, queue_size=1
        )
        self._poses = node.publisher(f"{name}/pose", pose, queue_size=1)
        self._colours = node.publisher(f"{name}/color_sensor", colour, queue_size=1)
        self._services = [
            node.service(f"{name}/{kind}", service_class(f"turtlesim/{spec}"), handler)
            for kind, spec, handler in (
                ("set_pen", "SetPen", self._set_pen),
                ("teleport_relative", "TeleportRelative", self._teleport_relative),
                ("teleport_absolute", "TeleportAbsolute", self._teleport_absolute),
            )
        ]

    def close(self) -> None:
        """Close all topics and services."""
        for service in self._services:
            service.shutdown("the turtle is gone")
        self._velocities.unregister()
        self._poses.unregister()
        self._colours.unregister()

    def publish(self, turtle: Turtle) -> None:
        """Publish the turtle's pose and the colour under it, each if its topic has a subscriber."""
        if self._poses.num_connections():
            pose = self._pose
            pose.x, pose.y, pose.theta = turtle.x, turtle.y, turtle.theta
            pose.linear_velocity, pose.angular_velocity = turtle.linear_velocity, turtle.angular_velocity
            self._poses.publish(pose)
        if self._colours.num_connections():
            colour = self._colour
            colour.r, colour.g, colour.b = self.sim.frame.paper.pixel(*turtle.pixel)
            self._colours.publish(colour)

    def _command(self, twist: Any) -> None:
        try:
            self.turtle.command(twist.linear.x, twist.linear.y, twist.angular.z)
        except TurtleError as error:
            self.turtle.command(0.0, 0.0, 0.0)
            self.sim.node.logwarn(f"{error}. It counts as a stop.", throttle=1.0)

    def _set_pen(self, request: Any) -> list[Any]:
        pen = request.r, request.g, request.b, request.width, request.off
        self.sim.at_update(lambda: self.turtle.set_pen(*pen))
        return []

    def _teleport_relative(self, request: Any) -> list[Any]:
        self.sim.at_update(lambda: self.turtle.teleport_relative(request.linear, request.angular))
        return []

    def _teleport_absolute(self, request: Any) -> list[Any]:
        self.sim.at_update(lambda: self.turtle.teleport_absolute(request.x, request.y, request.theta))
        return []


def window(name: str | None = None, graph: Graph | None = None) -> TurtleSim:
    """Return the turtlesim of this graph (the default one if not given) with this name, or the only one.

    >>> from rosmini import Graph, rosrun
    >>> graph = Graph()
    >>> _ = rosrun("turtlesim", "turtlesim_node", graph=graph).instance()
    [INFO] [1000.000000]: Starting turtlesim with node name /turtlesim
    [INFO] [1000.000000]: Spawning turtle [turtle1] at x=[5.544445], y=[5.544445], theta=[0.000000]
    >>> list(window(graph=graph).turtles)
    ['turtle1']

    Raises `TurtleError` if there is no turtlesim of this name, none at all, or more than one.
    """
    nodes = (running_graph() if graph is None else graph).nodes
    found = {name: node.program for name, node in sorted(nodes.items()) if isinstance(node.program, TurtleSim)}
    if not found:
        raise TurtleError(
            "no turtlesim runs in this graph: start one with `rosrun turtlesim turtlesim_node`, and let time pass"
        )
    if name is None and len(found) == 1:
        return next(iter(found.values()))
    if name is None:
        raise TurtleError(f"there are {len(found)} windows: say which one is meant, of {', '.join(found)}")
    full = resolve(name, "/")
    if full not in found:
        raise TurtleError(f"no turtlesim is called {full}: {nearest(full, found) or 'there is ' + ', '.join(found)}")
    return found[full]
