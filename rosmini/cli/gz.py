"""`rosmini gz`: the verbs of Gazebo's own tool (http://classic.gazebosim.org/tutorials?tut=components).

`sdf` works on files. The others act on a running server by Gazebo's own topics. In a terminal that is named after a
`+`, as in
`rosmini run`, and runs in the same process: `rosmini gz topic -l + gazebo_ros/gzserver worlds/empty.world`. In Python:

    gz = Gz(graph)
    gz("topic", "-l")
"""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import TYPE_CHECKING, Any

from rosmini import urdf
from rosmini.errors import UsageError
from rosmini.markup import parse_file
from rosmini.sim import sdf
from rosmini.sim.gazebo.errors import GazeboError
from rosmini.sim.gazebo.from_urdf import from_urdf
from rosmini.sim.gazebo.msgs import (
    Factory,
    Message,
    Model,
    Pose,
    Request,
    Response,
    WorldControl,
    WorldReset,
    WorldStatistics,
)
from rosmini.sim.gazebo.snapshot import pose_of
from rosmini.sim.gazebo.to_sdf import to_sdf
from rosmini.sim.gazebo.transport import TransportNode, address, find_master

from .verbs import ArgumentParser, Call, Lines, Result, Tool

if TYPE_CHECKING:
    from argparse import Namespace

    from rosmini.graph import Graph

TOOL = Tool(
    "gz",
    "Gazebo's own tool: topics, models, time, SDF files",
    usage_status=255,
    elsewhere=("camera", "debug", "joint", "log", "marker", "physics"),
    example="gazebo_ros/gzserver worlds/empty.world",
)
add_parser, main, Gz = TOOL.add_parser, TOOL.main, TOOL.on

LOOK_BACK = 20
"""Over so many messages `gz stats` takes the average."""

TIMEOUT = 10.0
"""How long an answer or a message is waited for [s]."""


class _Client:
    """Talks to the server of a graph."""

    def __init__(self, graph: Graph) -> None:
        self.graph = graph

    def node(self) -> TransportNode:
        """Return a new node of Gazebo's. Raises `GazeboError` if there is no server."""
        master = find_master(self.graph)
        if master is None:
            raise GazeboError(
                f"an instance of Gazebo is not running: there is no Master at {address()}. "
                "Start `gazebo_ros/gzserver` in the same graph"
            )
        return TransportNode(master, "gz")

    def wait(self, found: Sequence[object], count: int, seconds: float) -> None:
        """Let the graph go on until so many messages have come, or the time is over."""
        scheduler = self.graph.scheduler
        end = scheduler.now_ns() + round(seconds * 1e9)
        if scheduler.is_hub_thread() and not scheduler.driven:
            self.graph.run(seconds, until=(lambda: len(found) >= count) if count else None)
            scheduler.give_way()  # what was published at the last moment arrives
            return
        while scheduler.now_ns() < end and not (count and len(found) >= count):
            scheduler.sleep_until(min(end, scheduler.now_ns() + 5_000_000))

    def ask(self, request: str, data: str = "") -> Any:
        """Return what the server answers. Raises `GazeboError`."""
        node = self.node()
        waiter = self.graph.scheduler.waiter("an answer of Gazebo's server")
        number = int(node.address.rpartition(":")[2])  # its port: nobody else asks under it

        def hear(message: Response) -> None:
            if message.id == number and message.request == request:
                waiter.wake(message)

        node.subscribe("~/response", hear)
        node.advertise("~/request", Request).publish(Request(number, request, data))
        answered = waiter.wait(round(TIMEOUT * 1e9))
        node.close()
        if not answered:
            raise GazeboError(f"Gazebo's server does not answer {request!r}")
        answer: Response = waiter.value
        if answer.response != "success":
            raise GazeboError(str(answer.serialized_data))
        return answer.serialized_data

    def publish(self, topic: str, message: Message) -> None:
        """Publish one message, and go on when it has been dealt with."""
        node = self.node()
        node.advertise(topic, type(message)).publish(message)
        self.graph.scheduler.give_way()
        node.close()


EXAMPLES = {
    "topic": "-e /gazebo/default/world_stats -n 1 + gazebo_ros/gzserver worlds/empty.world",
    "model": "-m ground_plane -i + gazebo_ros/gzserver worlds/empty.world",
    "world": "-p 1 + gazebo_ros/gzserver worlds/empty.world",
    "stats": "-d 2 + gazebo_ros/gzserver worlds/empty.world",
    "sdf": "-k my_robot.sdf",
}


def _parser(
    verb: str, description: str, fill: Callable[[ArgumentParser], object]
) -> Callable[[], ArgumentParser]:
    """Return what makes the parser of a verb."""

    def make() -> ArgumentParser:
        parser = ArgumentParser(
            f"gz {verb}", description, epilog=f"for example: rosmini gz {verb} {EXAMPLES[verb]}"
        )
        if verb != "sdf":
            parser.add_argument("-w", "--world-name", metavar="WORLD", help="which world; there is one")
        fill(parser)
        return parser

    return make


def _say_what(parser: Callable[[], ArgumentParser]) -> UsageError:
    made = parser()
    return UsageError(f"{made.prog}: say what to do. {made.format_usage().strip()}")


# -- topic -------------------------------------------------------------------------------------------------------


def _topic_options(parser: ArgumentParser) -> None:
    add = parser.add_argument
    add("-l", "--list", action="store_true", help="all topics")
    add("-i", "--info", metavar="TOPIC", help="who publishes and who hears it")
    add("-e", "--echo", metavar="TOPIC", help="what is published on it")
    add("-u", "--unformatted", action="store_true", help="with -e: each message in one line")
    add("-z", "--hz", metavar="TOPIC", help="its average rate; Gazebo prints one for each message")
    add("-d", "--duration", type=float, default=1.0, help="for how long [s]; Gazebo goes on for ever")
    add("-n", "--count", type=int, default=0, help="how many messages (not in Gazebo)")


_TOPIC = _parser("topic", "List Gazebo's own topics, and look into them", _topic_options)


@dataclass(frozen=True, kw_only=True)
class TopicInfo(Result):
    """A topic's type, and the addresses of those who publish and hear it."""

    type: str
    publishers: tuple[str, ...]
    subscribers: tuple[str, ...]

    def __str__(self) -> str:
        ends = [("Publishers:", self.publishers), ("Subscribers:", self.subscribers)]
        listed = [line for head, names in ends for line in (head, *(f"\t{name}" for name in names), "")]
        return "\n".join([f"Type: {self.type}", "", *listed])


@dataclass(frozen=True, kw_only=True)
class Heard(Result):
    """The messages that were heard on a topic."""

    messages: tuple[Message, ...]
    unformatted: bool = False

    def __str__(self) -> str:
        if self.unformatted:
            return "\n".join(" ".join(map(str.strip, str(message).splitlines())) for message in self.messages)
        return "\n".join(line for message in self.messages for line in (*str(message).splitlines(), ""))


@dataclass(frozen=True, kw_only=True)
class Frequency(Result):
    """The average rate of a topic [Hz]; None if fewer than two messages came."""

    hz: float | None

    def __str__(self) -> str:
        return "no new messages" if self.hz is None else f"Hz: {self.hz:6.2f}"


@TOOL.verb("list Gazebo's own topics, and look into them", parser=_TOPIC, needs_graph=True)
def topic(given: Namespace, call: Call) -> Result:
    """List topics, or look into one."""
    client = _Client(call.graph)
    node = client.node()
    try:
        if given.list:
            return Lines(lines=tuple(node.master.topics()))
        if given.info:
            found = node.master.info(node.resolve(given.info))
            ends = tuple(found.publisher_addresses), tuple(found.subscriber_addresses)
            return TopicInfo(type=found.type, publishers=ends[0], subscribers=ends[1])
        if not (given.echo or given.hz):
            raise _say_what(_TOPIC)
        name = given.echo or given.hz
        node.master.info(node.resolve(name))
        heard: list[tuple[int, Any]] = []
        clock = call.graph.scheduler.now_ns
        node.subscribe(name, lambda message: heard.append((clock(), message)))
        client.wait(heard, given.count, TIMEOUT if given.count else given.duration)
    finally:
        node.close()
    if given.echo:
        return Heard(messages=tuple(message for _, message in heard), unformatted=given.unformatted)
    times = [when for when, _ in heard]
    span = times[-1] - times[0] if times else 0
    return Frequency(hz=(len(times) - 1) * 1e9 / span if span else None)


# -- model -------------------------------------------------------------------------------------------------------


def _model_options(parser: ArgumentParser) -> None:
    add = parser.add_argument
    add("-m", "--model-name", metavar="MODEL", help="which model")
    add("-d", "--delete", action="store_true", help="remove it from the world")
    add("-f", "--spawn-file", metavar="FILE", help="spawn it; without -m under its own name")
    add("-i", "--info", action="store_true", help="all that is known of it")
    add(
        "-p", "--pose", action="store_true",
        help="where it is: x y z roll pitch yaw; so without any option, where Gazebo moves it to the origin",
    )  # fmt: skip
    for name in ("-x", "-y", "-z", "-R", "-P", "-Y"):
        add(name, type=float, help="where it is to be [m, rad]; 0 if not given")


@dataclass(frozen=True, kw_only=True)
class ModelInfo(Result):
    """All that is known of a model."""

    model: Model

    def __str__(self) -> str:
        return "\n".join([*str(self.model).splitlines(), ""])


@dataclass(frozen=True, kw_only=True)
class ModelPose(Result):
    """Where a model is: x, y, z [m], roll, pitch, yaw [rad]."""

    pose: tuple[float, ...]

    def __str__(self) -> str:
        return " ".join(f"{part + 0.0:.6f}" for part in self.pose)


@TOOL.verb(
    "show, move, spawn and delete models",
    parser=_parser("model", "Show, move, spawn and delete models", _model_options),
    needs_graph=True,
)
def model(given: Namespace, call: Call) -> Result:
    """Show, move, spawn or delete a model."""
    client = _Client(call.graph)
    place = (given.x, given.y, given.z, given.R, given.P, given.Y)
    x, y, z, roll, pitch, yaw = (part or 0.0 for part in place)  # what is not given is 0, as in Gazebo
    if given.spawn_file:
        _spawn(
            client,
            Path(given.spawn_file),
            given.model_name or "",
            Pose.of("", 0, (x, y, z, roll, pitch, yaw)),
        )
        return Result()
    if not given.model_name:
        raise UsageError("gz model: which model? -m MODEL")
    found = _found(client, given.model_name)
    if given.delete:
        client.ask("entity_delete", given.model_name)
    elif given.info:
        return ModelInfo(model=found)
    elif any(part is not None for part in place):
        moved = Pose.of(found.name, found.id, (x, y, z, roll, pitch, yaw))
        client.publish("~/model/modify", Model(found.name, found.id, pose=moved))
    else:
        return ModelPose(pose=(0.0,) * 6 if found.pose is None else tuple(pose_of(found.pose)))
    return Result()


def _found(client: _Client, name: str) -> Model:
    try:
        found: Model = client.ask("entity_info", name)
    except GazeboError as error:
        where = client.node().master.namespace
        msg = f"Unable to get info on model[{name}] in the world[{where}]: {error}"
        raise GazeboError(msg) from error
    return found


def _spawn(client: _Client, path: Path, name: str, pose: Pose) -> None:
    if not path.is_file():
        raise GazeboError(f"gz model: there is no file {path}")
    node = client.node()
    problems: list[str] = []

    def hear(message: Response) -> None:
        if message.request == "factory":
            problems.append(str(message.serialized_data))

    node.subscribe("~/response", hear)
    client.publish("~/factory", Factory(path.read_text(encoding="utf-8"), name, pose))
    client.graph.scheduler.give_way()  # a complaint is on its way
    node.close()
    if problems:
        raise GazeboError(problems[0])


# -- world and stats ---------------------------------------------------------------------------------------------


def _world_options(parser: ArgumentParser) -> None:
    add = parser.add_argument
    add("-p", "--pause", type=int, choices=(0, 1), help="1: pause; 0: go on")
    add("-s", "--step", action="store_true", help="one step of the physics")
    add("-m", "--multi-step", type=int, metavar="N", help="N steps")
    add("-r", "--reset-all", action="store_true", help="reset time and models")
    add("-t", "--reset-time", action="store_true", help="reset the time")
    add("-o", "--reset-models", action="store_true", help="reset the models")


_WORLD = _parser("world", "Pause, step and reset a world", _world_options)


@TOOL.verb("pause, step and reset a world", parser=_WORLD, needs_graph=True)
def world(given: Namespace, call: Call) -> Result:
    """Pause, step or reset the world."""
    reset = None
    if given.reset_all or given.reset_time or given.reset_models:
        reset = WorldReset(given.reset_all, given.reset_time, given.reset_models)
    pause = None if given.pause is None else bool(given.pause)
    if given.multi_step is not None and given.multi_step < 1:
        raise UsageError(f"gz world: a world is stepped once or more often, not {given.multi_step} times")
    if reset is None and pause is None and not given.step and not given.multi_step:
        raise _say_what(_WORLD)
    control = WorldControl(pause, given.step or None, given.multi_step, reset)
    _Client(call.graph).publish("~/world_control", control)
    return Result()


def _stats_options(parser: ArgumentParser) -> None:
    add = parser.add_argument
    add("-d", "--duration", type=float, default=1.0, help="for how long [s]; Gazebo goes on for ever")
    add("-p", "--plot", action="store_true", help="comma-separated values")


@dataclass(frozen=True, kw_only=True)
class Statistics(Result):
    """What the server said of its time, message by message; ``plot`` prints it as comma-separated values."""

    messages: tuple[WorldStatistics, ...]
    plot: bool = False

    def __str__(self) -> str:
        head = "# real-time factor (percent), simtime (sec), realtime (sec), paused (T or F)"
        lines = [head] if self.plot else []
        for count in range(2, len(self.messages) + 1):
            last = self.messages[count - 1]
            factor = _factor(self.messages[max(0, count - LOOK_BACK) : count])
            if factor is None:
                continue
            sim, real, flag = _seconds(last.sim_time), _seconds(last.real_time), "T" if last.paused else "F"
            if self.plot:
                lines.append(f"{factor:4.2f}, {sim:16.6f}, {real:16.6f}, {flag}")
            else:
                lines.append(
                    f"Factor[{factor:4.2f}] SimTime[{sim:4.2f}] RealTime[{real:4.2f}] Paused[{flag}]"
                )
        return "\n".join(lines)


@TOOL.verb(
    "show how fast time passes",
    parser=_parser("stats", "Show how fast time passes", _stats_options),
    needs_graph=True,
)
def stats(given: Namespace, call: Call) -> Statistics:
    """Listen to how fast time passes."""
    client = _Client(call.graph)
    node = client.node()
    heard: list[WorldStatistics] = []
    node.subscribe("~/world_stats", heard.append)
    client.wait(heard, 0, given.duration)
    node.close()
    return Statistics(messages=tuple(heard), plot=given.plot)


def _factor(heard: Sequence[WorldStatistics]) -> float | None:
    """Return the average real-time factor since the first, as Gazebo computes it; None if no time has passed."""
    sim, real = (
        sum(_seconds(getattr(each, name)) - _seconds(getattr(heard[0], name)) for each in heard)
        for name in ("sim_time", "real_time")
    )
    return max(0.0, sim / real) if real > 0 else None


def _seconds(time: Any) -> float:
    return float(time.sec + time.nsec * 1e-9)


# -- sdf ---------------------------------------------------------------------------------------------------------


def _sdf_options(parser: ArgumentParser) -> None:
    parser.add_argument("-k", "--check", metavar="FILE", help="check a file")
    parser.add_argument("-p", "--print", metavar="FILE", help="print a file as SDF")


_SDF = _parser("sdf", "Check SDF and URDF files, and print them as SDF", _sdf_options)


@TOOL.verb("check SDF and URDF files, and print them as SDF", name="sdf", parser=_SDF)
def sdf_(given: Namespace, _call: Call) -> Lines:
    """Check a file, or convert it to SDF. Raises what the readers of files raise."""
    name = given.check or given.print
    if not name:
        raise _say_what(_SDF)
    root, path = parse_file(name), Path(name)
    if root.tag == "robot":
        robot = urdf.load(path)
        text, notes = to_sdf(from_urdf(robot).model), [str(note) for note in robot.notes]
    else:
        text, notes = root.source(), [str(note) for note in sdf.load(path).notes]
    return Lines(lines=(*notes, "Check complete") if given.check else tuple(text.splitlines()))
