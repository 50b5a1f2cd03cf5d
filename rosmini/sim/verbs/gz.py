"""`rosmini gz`: the verbs of Gazebo's tool (http://classic.gazebosim.org/tutorials?tut=components).

`sdf` works on files. The others act on a running server through the ROS services of /gazebo: in a terminal that of the
Master at ROS_MASTER_URI, in Python that of a graph. `topic`, and `world` with the options for which gazebo_ros has no
service, act on the server itself, which must run in the same process. In a terminal name the server after a `+`, as in
`rosmini gz topic -l + gazebo_ros/gzserver worlds/empty.world`. In Python:

    gz = Gz(graph)
    gz("topic", "-l")
"""

from __future__ import annotations

from argparse import Namespace
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from dataclasses import dataclass
from pathlib import Path
from typing import Any

from rosmini.core.errors import UsageError
from rosmini.core.graph import Node
from rosmini.core.markup import parse_file
from rosmini.core.verbs import SECOND, ArgumentParser, Call, Lines, Overview, Result, Span, Tool, tool_node
from rosmini.msgs import message_class, service_class
from rosmini.sim import sdf, urdf
from rosmini.sim.gazebo.errors import GazeboError
from rosmini.sim.gazebo.from_urdf import from_urdf
from rosmini.sim.gazebo.services import pose_message, pose_of
from rosmini.sim.gazebo.to_sdf import to_sdf
from rosmini.sim.gazebo.topics import GazeboMaster, address, find_master

TOOL = Tool(
    "gz",
    "Gazebo's own tool: topics, models, time, SDF files",
    usage_status=255,
    elsewhere=("camera", "debug", "joint", "log", "marker", "physics"),
    example="gazebo_ros/gzserver worlds/empty.world",
    group="Run and look",
    purpose="looking at a Gazebo server and changing its world",
    overview=Overview(closing="Type {tool} <command> -h for more detailed usage", status=0, unknown_status=255),
)
Gz = TOOL.on

LOOK_BACK = 20
"""Number of samples over which `gz stats` averages."""

EXAMPLES = {
    "topic": "-l + gazebo_ros/gzserver worlds/empty.world",
    "model": "-m ground_plane -p",
    "world": "-p 1",
    "stats": "-d 2",
    "sdf": "-k my_robot.sdf",
}


def _master(call: Call) -> GazeboMaster:
    """Return the Master of the server in this process. Raises `GazeboError` if there is none."""
    master = find_master(call.graph)
    if master is None:
        raise GazeboError(
            f"an instance of Gazebo is not running: there is no Master at {address()}. "
            "Start `gazebo_ros/gzserver` in the same graph; in a terminal, name it after a +: "
            f"`rosmini gz topic {EXAMPLES['topic']}`"
        )
    return master


@dataclass(frozen=True)
class _Services:
    """The ROS services of a running server; ``name`` is the name of its node."""

    node: Node
    name: str

    def call(self, service: str, kind: str, **fields: Any) -> Any:
        """Return the response. Raises `GazeboError` if the server refuses."""
        answer = self.node.service_client(f"{self.name}/{service}", service_class(kind), numpy=False)(**fields)
        if not getattr(answer, "success", True):
            raise GazeboError(answer.status_message)
        return answer


@contextmanager
def _services(call: Call) -> Iterator[_Services]:
    """Start a node that calls the server. Raises `GazeboError` if no server runs."""
    master = find_master(call.graph)
    name = "/gazebo" if master is None else master.world.node.name
    with tool_node(call.graph, "gz") as node:
        if call.peers.ask_as("/gz").find("lookupService", f"{name}/get_world_properties") is None:
            raise GazeboError(
                f"an instance of Gazebo is not running: no node offers {name}/get_world_properties. "
                "Start one with `rosrun gazebo_ros gzserver`"
            )
        yield _Services(node, name)


def _parser(verb: str, description: str, fill: Callable[[ArgumentParser], object]) -> Callable[[], ArgumentParser]:
    """Return a function that makes the parser of a verb."""

    def make() -> ArgumentParser:
        parser = ArgumentParser(f"gz {verb}", description, epilog=f"for example: rosmini gz {verb} {EXAMPLES[verb]}")
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
    add("-l", "--list", action="store_true", help="list all topics")
    add("-i", "--info", metavar="TOPIC", help="show the publishers and subscribers of a topic")
    add("-z", "--hz", metavar="TOPIC", help="measure the average rate of a topic")
    add("-d", "--duration", type=float, default=1.0, help="how long to measure [s]; Gazebo never ends")


_TOPIC = _parser("topic", "List Gazebo's own topics", _topic_options)


@dataclass(frozen=True, kw_only=True)
class TopicInfo(Result):
    """The type of a topic, and the addresses of its publishers and subscribers."""

    type: str
    publishers: tuple[str, ...]
    subscribers: tuple[str, ...]

    def __str__(self) -> str:
        ends = [("Publishers:", self.publishers), ("Subscribers:", self.subscribers)]
        listed = [line for head, names in ends for line in (head, *(f"\t{name}" for name in names), "")]
        return "\n".join([f"Type: {self.type}", "", *listed])


@dataclass(frozen=True, kw_only=True)
class Frequency(Result):
    """The average rate of a topic [Hz]; None if fewer than two messages arrived."""

    hz: float | None

    def __str__(self) -> str:
        return "no new messages" if self.hz is None else f"Hz: {self.hz:6.2f}"


@TOOL.verb("list Gazebo's own topics", parser=_TOPIC, needs_graph=True)
def topic(given: Namespace, call: Call) -> Result:
    """List the topics, or show one."""
    master = _master(call)
    if given.list:
        return Lines(lines=tuple(master.topics()))
    if given.info:
        found = master.info(master.resolve(given.info))
        return TopicInfo(type=found.type, publishers=found.publisher_addresses, subscribers=found.subscriber_addresses)
    if not given.hz:
        raise _say_what(_TOPIC)
    name = master.info(master.resolve(given.hz)).topic
    times: list[int] = []

    def note(_: object) -> None:
        times.append(call.graph.scheduler.now_ns())

    measured = [each for each in (master.poses, master.statistics) if master.resolve(each.name) == name]
    for each in measured:
        each.listeners.append(note)
    duration = round(given.duration * SECOND)
    for _ in Span.of(call.graph, duration).every(duration):
        pass
    for each in measured:
        each.listeners.remove(note)
    return Frequency(hz=(len(times) - 1) * 1e9 / (times[-1] - times[0]) if len(times) > 1 else None)


# -- model -------------------------------------------------------------------------------------------------------


def _model_options(parser: ArgumentParser) -> None:
    add = parser.add_argument
    add("-m", "--model-name", metavar="MODEL", help="which model")
    add("-d", "--delete", action="store_true", help="remove it from the world")
    add("-f", "--spawn-file", metavar="FILE", help="spawn it; without -m under its own name")
    add(
        "-p", "--pose", action="store_true",
        help="print its pose: x y z roll pitch yaw; also without any option, where Gazebo moves it to the origin",
    )  # fmt: skip
    for name in ("-x", "-y", "-z", "-R", "-P", "-Y"):
        add(name, type=float, help="its new pose [m, rad]; 0 by default")


@dataclass(frozen=True, kw_only=True)
class ModelPose(Result):
    """The pose of a model: x, y, z [m], roll, pitch, yaw [rad]."""

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
    parts = (given.x, given.y, given.z, given.R, given.P, given.Y)
    x, y, z, roll, pitch, yaw = (part or 0.0 for part in parts)  # parts that are not given are 0, as in Gazebo
    pose, name = pose_message((x, y, z, roll, pitch, yaw)), given.model_name or ""
    if given.spawn_file:
        text = _read(Path(given.spawn_file))
        with _services(call) as server:
            fields = {"model_name": name, "model_xml": text, "initial_pose": pose}
            server.call("spawn_sdf_model", "gazebo_msgs/SpawnModel", **fields)
        return Result()
    if not name:
        raise UsageError("gz model: which model? -m MODEL")
    with _services(call) as server:
        if given.delete:
            server.call("delete_model", "gazebo_msgs/DeleteModel", model_name=name)
        elif any(part is not None for part in parts):
            state = message_class("gazebo_msgs/ModelState")(model_name=name, pose=pose)
            server.call("set_model_state", "gazebo_msgs/SetModelState", model_state=state)
        else:
            found = server.call("get_model_state", "gazebo_msgs/GetModelState", model_name=name)
            return ModelPose(pose=pose_of(found.pose))
    return Result()


def _read(path: Path) -> str:
    if not path.is_file():
        raise GazeboError(f"gz model: there is no file {path}")
    return path.read_text(encoding="utf-8")


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
    steps = given.multi_step if given.multi_step is not None else int(given.step)
    if given.multi_step is not None and steps < 1:
        raise UsageError(f"gz world: the number of steps must be at least 1, not {steps}")
    services = [
        name
        for wanted, name in (
            (given.reset_all, "reset_simulation"),
            (given.reset_models, "reset_world"),
            (given.pause == 1, "pause_physics"),
            (given.pause == 0, "unpause_physics"),
        )
        if wanted
    ]
    if not (services or steps or given.reset_time):
        raise _say_what(_WORLD)
    master = _master(call) if steps or given.reset_time else None  # gazebo_ros has no service for these
    if services:
        with _services(call) as server:
            for name in services:
                server.call(name, "std_srvs/Empty")
    if master is not None:
        if given.reset_time:
            master.world.host.reset_time()
        if steps:
            master.world.step(steps)
        master.publish_clock()
    return Result()


def _stats_options(parser: ArgumentParser) -> None:
    parser.add_argument("-d", "--duration", type=float, default=1.0, help="how long [s]; Gazebo never ends")


@dataclass(frozen=True)
class Sample:
    """The time of a world [s], and the time since the command started [s]."""

    sim: float
    real: float
    paused: bool


@dataclass(frozen=True, kw_only=True)
class Statistics(Result):
    """The progress of a world's time, sample by sample."""

    samples: tuple[Sample, ...]

    def __str__(self) -> str:
        lines = []
        for count in range(2, len(self.samples) + 1):
            first, last = self.samples[max(0, count - LOOK_BACK)], self.samples[count - 1]
            factor = max(0.0, (last.sim - first.sim) / (last.real - first.real))
            flag = "T" if last.paused else "F"
            lines.append(f"Factor[{factor:4.2f}] SimTime[{last.sim:4.2f}] RealTime[{last.real:4.2f}] Paused[{flag}]")
        return "\n".join(lines)


@TOOL.verb(
    "show how fast time passes",
    parser=_parser("stats", "Show how fast time passes, five times a second", _stats_options),
    needs_graph=True,
)
def stats(given: Namespace, call: Call) -> Statistics:
    """Sample the time of the world."""
    clock = call.graph.scheduler
    start, found = clock.now_ns(), []
    with _services(call) as server:
        for _ in Span.of(call.graph, round(given.duration * SECOND)).every(SECOND // 5):
            sim = server.call("get_world_properties", "gazebo_msgs/GetWorldProperties").sim_time
            paused = server.call("get_physics_properties", "gazebo_msgs/GetPhysicsProperties").pause
            found.append(Sample(sim, (clock.now_ns() - start) / SECOND, paused))
    return Statistics(samples=tuple(found))


# -- sdf ---------------------------------------------------------------------------------------------------------


def _sdf_options(parser: ArgumentParser) -> None:
    parser.add_argument("-k", "--check", metavar="FILE", help="check a file")
    parser.add_argument("-p", "--print", metavar="FILE", help="print a file as SDF")


_SDF = _parser("sdf", "Check SDF and URDF files, and print them as SDF", _sdf_options)


@TOOL.verb("check SDF and URDF files, and print them as SDF", name="sdf", parser=_SDF, only_asks=True)
def sdf_(given: Namespace, _call: Call) -> Lines:
    """Check a file, or convert it to SDF. Raises the errors of the file's reader."""
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
