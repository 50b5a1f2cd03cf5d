"""The teleoperation pad: keys that become `geometry_msgs/Twist` on a topic, in a notebook and in a script.

>>> from rosmini import Graph
>>> from rosmini.msgs.geometry_msgs.msg import Twist
>>> graph = Graph()
>>> robot = graph.node("robot")
>>> heard = []
>>> _ = robot.subscriber("cmd_vel", Twist, lambda twist: heard.append(twist.linear.x))
>>> pad = TeleopPad(graph)
>>> pad.press("w")
>>> pad.press("w")
>>> _ = graph.run(0.3)
>>> heard
[0.005, 0.01, 0.015, 0.02]
>>> pad.stop()
>>> pad
teleop_pad publishes geometry_msgs/Twist on /cmd_vel
wanted 0.00 m/s and 0.0 rad/s; sent 0.00 m/s and 0.0 rad/s; 5 messages
"""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

from rosmini.core.errors import ROSException, ROSInterruptException, RosminiError
from rosmini.core.graph import Graph, Node
from rosmini.core.graph.clock import Timer
from rosmini.core.names import resolve
from rosmini.msgs import message_class
from rosmini.sim.simulation import Simulation
from rosmini.sim.turtlesim import TurtleSim
from rosmini.viz.live.key_maps import TeleopError

from .driven_robot import DrivenRobot
from .driven_turtle import DrivenTurtle
from .key_maps import key_map
from .live_view import LiveView
from .teleop import PERIOD, Limits, Teleop

NAME = "teleop_pad"
"""Name of a pad's node."""

CONNECT_S = 1.0
"""Time for which a new pad waits for existing subscribers [s], so that its first message is not lost."""


class PadNode(Node):
    """The node of a pad. A new pad of the same name replaces it without a warning, as when a cell is run again."""


class TeleopPad(LiveView):
    """A node that publishes velocities as ROS's teleoperation programs do; in a notebook it shows a pad with keys.

    A key publishes at once, and then every 0.1 s a velocity closer to the target. Once target and velocity are zero,
    the pad is silent until the next key. (The original keeps on publishing zeros, which disturbs any other node that
    drives the robot.)

    The keys, buttons, touches and gamepads of a browser also call `press`, `steer` and `stop`.

    Args:
        driven: a simulator, stageros or gzserver, to drive and show its robot; turtlesim, to drive its turtle; or a
            graph, to show only the messages.
        robot: name of the robot or turtle; by default the first. A robot without a laser is driven but not shown.
        title: caption under the pad, and first line of its text form.

    Raises:
        TeleopError: `driven` is not one of these, or the robot or program does not exist.

    """

    def __init__(self, driven: Simulation | TurtleSim | Graph, *, robot: str = "", title: str | None = None) -> None:
        self.shown_robot: DrivenRobot | None = None
        self.turtle: DrivenTurtle | None = None
        self.chosen = ""
        """Name of the one of `choices` that is driven."""
        self._driven = driven
        self._limits: Limits | None = None
        namespace, topic = "/", "cmd_vel"
        if isinstance(driven, Graph):
            self.graph: Graph = driven
        elif isinstance(driven, Simulation | TurtleSim):
            self.graph = driven.node.graph
            chosen = self._set_driven(driven, robot)
            namespace, topic = chosen.namespace, chosen.topic
        else:
            raise TeleopError(
                f"a pad drives the robot of a simulator, a turtle, or the subscribers of a graph, not a "
                f"{type(driven).__name__}. Give it rosrun('rosmini_sim', 'simulator').instance(), that of stageros, "
                "gzserver or turtlesim_node, or a Graph."
            )
        self.title = title
        usual = "turtlebot3_teleop_key" if self.turtle is None else "turtle_teleop_key"
        self.teleop = Teleop(self._limits, key_map(usual))
        self.sent = 0
        """Number of published messages."""
        self.twist_class = message_class("geometry_msgs/Twist")
        before = self.graph.nodes.get(resolve(NAME, namespace))
        if isinstance(before, PadNode):
            before.shutdown("a new pad took its place")
        self.node = PadNode(NAME, self.graph, namespace=namespace)
        self._publisher = self.node.publisher(topic, self.twist_class, queue_size=10)
        if isinstance(driven, Graph):
            self.chosen = self.topic
        self._twist = self.twist_class()
        self._timer: Timer | None = None
        self._listeners: list[Callable[[Any], object]] = []
        self._wait_for_subscribers()

    def _set_driven(self, driven: Simulation | TurtleSim, robot: str) -> DrivenRobot | DrivenTurtle:
        chosen: DrivenRobot | DrivenTurtle
        if isinstance(driven, TurtleSim):
            chosen = self.turtle = DrivenTurtle(driven, robot)
        else:
            chosen = DrivenRobot(driven, robot)
            self.shown_robot = chosen if chosen.has_laser else None
        self.chosen, self._limits = chosen.name, chosen.limits
        return chosen

    def _wait_for_subscribers(self) -> None:
        if self.topic in dict(self.node.master.ask("getSystemState")[1]):
            try:
                self._publisher.wait_for_subscribers(timeout=CONNECT_S)
            except ROSInterruptException:
                raise
            except ROSException:  # no subscriber answered in time: the publisher itself warns of messages that are lost
                pass

    # -- driving -------------------------------------------------------------------------------------------------

    @property
    def topic(self) -> str:
        """Global name of the topic that the pad publishes on."""
        return self._publisher.topic

    @property
    def twist(self) -> Any:
        """The last published message; zero before the first."""
        return self._twist

    def press(self, key: str, times: int = 1) -> None:
        """Press a key (`w`, `x`, `a`, `d`, `s`, `space`, or arrow `up`, `down`, `left`, `right`) `times` times, now.

        These are the keys of `turtlebot3_teleop_key`; after `use`, those of the selected program apply.

        Raises `TeleopError` for an unknown key and if the robot was removed, `ROSException` if the node was
        shut down.
        """
        named = self.teleop.keys.named(key)
        if times < 1:
            raise TeleopError(f"a key must be pressed at least once, not {times} times")
        self._require_robot()
        for _ in range(times):
            self._publish(self.teleop.press(named))

    def stop(self) -> None:
        """Stop at once, like the key `s`. Raises the same errors as `press`."""
        self.press("space")

    def steer(self, linear: float, angular: float) -> None:
        """Set the target velocities [m/s, rad/s], within the limits, like a gamepad. Raises as `press` does."""
        self._require_robot()
        self._publish(self.teleop.steer(linear, angular))

    def use(self, keys: str) -> None:
        """Switch to the keys of another program, and stop. Raises as `press` does, also for an unknown program."""
        found = key_map(keys)
        self._rest()
        self.teleop.use(found)

    @property
    def keys(self) -> str:
        """Name of the program whose keys are in use."""
        return self.teleop.keys.name

    @property
    def choices(self) -> tuple[str, ...]:
        """Names that can be driven: the simulation's robots, the turtles, or the graph's topics with subscribers."""
        if isinstance(self._driven, Simulation):
            return DrivenRobot.names(self._driven)
        if isinstance(self._driven, TurtleSim):
            return DrivenTurtle.names(self._driven)
        master = self.node.master
        types = dict(master.ask("getTopicTypes"))
        heard = {topic for topic, _ in master.ask("getSystemState")[1]}
        found = {topic for topic in heard if types.get(topic) == self.twist_class._type}
        return tuple(sorted(found | {self.topic}))

    def choose(self, name: str) -> None:
        """Stop the current robot and drive another of the `choices`, with its limits.

        Raises `TeleopError` for any other name, and `ROSException` if the node was shut down.
        """
        if isinstance(self._driven, Simulation | TurtleSim):
            kind = DrivenRobot if isinstance(self._driven, Simulation) else DrivenTurtle
            if name not in self.choices:
                kind(self._driven, name)  # type: ignore[arg-type]  # raises an error with the available names
            self._rest()
            topic = self._set_driven(self._driven, name).topic
        else:
            if name not in self.choices:
                raise TeleopError(f"no node subscribes to {name!r}; the pad can drive {', '.join(self.choices)}")
            self._rest()
            topic = self.chosen = name
        self.teleop = Teleop(self._limits, self.teleop.keys)
        if topic != self.topic:
            self._publisher.unregister()
            self._publisher = self.node.publisher(topic, self.twist_class, queue_size=10)
            self._wait_for_subscribers()

    @property
    def others(self) -> tuple[str, ...]:
        """Other nodes that publish on the topic: a robot obeys the last message, from any publisher."""
        publishers = dict(self.node.master.ask("getSystemState")[0]).get(self.topic, ())
        return tuple(sorted(name for name in publishers if name != self.node.name))

    def _rest(self) -> None:
        if self.gone is None and not self.teleop.at_rest:
            self.stop()

    def reset(self) -> None:
        """Stop, and reset the simulator's robot. Raises `TeleopError` without a simulator, else as `press` does."""
        if self.turtle is not None:
            self.stop()
            self.turtle.reset()
            return
        if self.shown_robot is None:
            raise TeleopError(
                "this pad has no simulator, so it cannot reset a robot; give it one: TeleopPad(simulator)"
            )
        self.stop()
        self.shown_robot.reset()
        self.shown_robot.trail.clear()

    def on_publish(self, callback: Callable[[Any], object]) -> None:
        """Call `callback(twist)` for each message published from now on."""
        self._listeners.append(callback)

    def _publish(self, velocity: tuple[float, float]) -> None:
        if self._timer is not None:
            self._timer.shutdown()
            self._timer = None
        twist = self.twist_class()
        twist.linear.x, twist.angular.z = velocity
        twist.linear.y, twist.linear.z = self.teleop.aside
        self._publisher.publish(twist)
        self._twist = twist
        self.sent += 1
        for listener in self._listeners:
            listener(twist)
        if not self.teleop.at_rest:
            until = PERIOD if self.teleop.repeats else self.teleop.keys.holds or PERIOD
            self._timer = self.node.timer(until, self._cycle, oneshot=True)

    def _cycle(self, _event: object) -> None:
        self._timer = None
        if self.gone is not None:
            return
        if self.teleop.repeats:
            self._publish(self.teleop.cycle())
        else:
            self.teleop.stop()  # the robot or turtle no longer follows the message by now

    # -- the robot -----------------------------------------------------------------------------------------------

    @property
    def gone(self) -> str | None:
        """Reason why there is nothing left to drive (robot removed or node shut down), or None."""
        if self.node.is_shutdown():
            return f"the node {self.node.name} was shut down."
        if self.shown_robot is not None or self.turtle is not None:
            try:
                _ = self.shown_robot.truth() if self.shown_robot is not None else self.turtle and self.turtle.turtle
            except RosminiError as error:
                return str(error)
        return None

    def _require_robot(self) -> None:
        why = self.gone
        if why is not None:
            self.teleop.stop()
            raise TeleopError(f"the pad has nothing to drive: {why} The graph keeps running.")

    # -- to look at ----------------------------------------------------------------------------------------------

    @property
    def text(self) -> str:
        """Text form: target and sent velocities, and the state of the robot."""
        return self._state() if self.title is None else f"{self.title}\n{self._state()}"

    def _state(self) -> str:
        (v, w), (sent_v, sent_w) = self.teleop.target, self.teleop.command
        messages = "1 message" if self.sent == 1 else f"{self.sent} messages"
        lines = [
            f"{self.node.name.lstrip('/')} publishes {self.twist_class._type} on {self.topic}",
            f"wanted {v:.2f} m/s and {w:.1f} rad/s; sent {sent_v:.2f} m/s and {sent_w:.1f} rad/s; {messages}",
        ]
        why = self.gone
        if why is not None:
            lines.append(f"nothing to drive: {why}")
        elif self.shown_robot is not None or self.turtle is not None:
            lines.append((self.shown_robot or self.turtle).describe())  # type: ignore[union-attr]  # one of them exists
        return "\n".join(lines)

    @property
    def alt(self) -> str:
        """Alternative text: the pad in one or two sentences."""
        drives = "" if self.shown_robot is None else f" the {self.shown_robot.model.name} in its world and"
        if self.turtle is not None:
            drives = " turtles in their window and"
        keys = "w, a, s, d and x" if self.teleop.keys.adds else f"of {self.keys}"
        return f"A pad with the keys {keys} that shows{drives} the messages on {self.topic}. {self._state()}"

    def _images(self) -> dict[str, bytes]:
        return {}

    @property
    def html(self) -> str:
        """The pad as a page without a kernel, which drives its own robot in the same world."""
        from .page import static_html

        return static_html(self, caption=self.title)

    def _new_link(self) -> Any:
        from .live import Link

        return Link(self)
