"""The `gz` command line as functions (http://classic.gazebosim.org/tutorials?tut=components): verbs that act on a running server by Gazebo's own topics.

    gz = Gz(graph)
    gz("topic", "-l")
    gz("model", "-m", "box", "-x", "1.5")

A call does what the command does, and prints what it prints; `run` returns that instead.
"""

from __future__ import annotations

import argparse
from pathlib import Path
from typing import Any, NoReturn

from rosmini import urdf
from rosmini.errors import nearest
from rosmini.graph import Graph, default_graph
from rosmini.markup import parse_file
from rosmini.sim import sdf

from .errors import GazeboError
from .from_urdf import from_urdf
from .master import address, find_master
from .msgs import Factory, Model, Pose, Request, Response, WorldControl, WorldReset, WorldStatistics
from .snapshot import pose_of
from .to_sdf import to_sdf
from .transport import TransportNode

VERBS = {
    "topic": "Tell of Gazebo's own topics",
    "model": "Tell of models, move, spawn and delete them",
    "world": "Let the time of a world stand, go on by steps, or go back",
    "stats": "Tell how time goes on",
    "sdf": "Check SDF and URDF files, and print them as SDF",
    "help": "Tell of a command",
}
ELSEWHERE = ("camera", "debug", "joint", "log", "marker", "physics")

LOOK_BACK = 20
"""Over so many messages `gz stats` takes the average."""

TIMEOUT = 10.0
"""How long an answer or a message is waited for [s]."""


class UsageError(GazeboError):
    """A command line that makes no sense."""


class _Parser(argparse.ArgumentParser):
    def error(self, message: str) -> NoReturn:
        raise UsageError(f"{self.prog}: {message}. {self.format_usage().strip()}")


def parser(verb: str) -> argparse.ArgumentParser:
    """The options of a verb. Raises `UsageError` for one that there is not."""
    if verb not in VERBS or verb == "help":
        if verb in ELSEWHERE:
            raise UsageError(f"gz: {verb!r} is a command of Gazebo's own, which rosmini has not")
        hint = nearest(verb, VERBS) or f"there are: {', '.join(VERBS)}"
        raise UsageError(f"gz: there is no command {verb!r}; {hint}")
    made = _Parser(prog=f"gz {verb}", description=VERBS[verb], add_help=False)
    if verb != "sdf":
        made.add_argument("-w", "--world-name", metavar="WORLD", help="which world; there is one")
    {"topic": _topic, "model": _model, "world": _world, "stats": _stats, "sdf": _sdf}[verb](made)
    return made


def _topic(made: argparse.ArgumentParser) -> None:
    made.add_argument("-l", "--list", action="store_true", help="all topics")
    made.add_argument("-i", "--info", metavar="TOPIC", help="who publishes and who hears it")
    made.add_argument("-e", "--echo", metavar="TOPIC", help="what is published on it")
    made.add_argument(
        "-z", "--hz", metavar="TOPIC", help="how often that is, on the average; Gazebo tells each message's"
    )
    made.add_argument(
        "-d", "--duration", type=float, default=1.0, help="for so long [s]; Gazebo goes on for ever"
    )
    made.add_argument("-n", "--count", type=int, default=0, help="so many messages (not in Gazebo)")


def _model(made: argparse.ArgumentParser) -> None:
    made.add_argument("-m", "--model-name", metavar="MODEL", help="which model")
    made.add_argument("-d", "--delete", action="store_true", help="take it out of the world")
    made.add_argument(
        "-f",
        "--spawn-file",
        metavar="FILE",
        help="let it come into the world; without a model its own name is kept",
    )
    made.add_argument("-i", "--info", action="store_true", help="all that is known of it")
    made.add_argument(
        "-p",
        "--pose",
        action="store_true",
        help="where it is: x y z roll pitch yaw; so without any option, where Gazebo puts it to the origin",
    )
    for name in ("-x", "-y", "-z", "-R", "-P", "-Y"):
        made.add_argument(name, type=float, help="where it is to be [m, rad]; what is not given is 0")


def _world(made: argparse.ArgumentParser) -> None:
    made.add_argument("-p", "--pause", type=int, choices=(0, 1), help="1: time stands; 0: it goes on")
    made.add_argument("-s", "--step", action="store_true", help="one step of the physics")
    made.add_argument("-m", "--multi-step", type=int, metavar="N", help="so many steps")
    made.add_argument("-r", "--reset-all", action="store_true", help="time and models as in the beginning")
    made.add_argument("-t", "--reset-time", action="store_true", help="time as in the beginning")
    made.add_argument("-o", "--reset-models", action="store_true", help="models as in the beginning")


def _stats(made: argparse.ArgumentParser) -> None:
    made.add_argument(
        "-d", "--duration", type=float, default=1.0, help="for so long [s]; Gazebo goes on for ever"
    )
    made.add_argument("-p", "--plot", action="store_true", help="numbers with commas between")


def _sdf(made: argparse.ArgumentParser) -> None:
    made.add_argument("-k", "--check", metavar="FILE", help="tell whether a file is good")
    made.add_argument("-p", "--print", metavar="FILE", help="print a file as SDF")


class Gz:
    """The `gz` command line for the server of a graph; the default graph if none is given."""

    def __init__(self, graph: Graph | None = None) -> None:
        self._graph = graph
        self._lines: list[str] = []
        self._number = 0

    def __call__(self, *words: Any) -> None:
        """Do what the words say and print what `gz` prints. Raises `GazeboError`, and what the readers of files raise."""
        for line in self.run(*words):
            print(line)

    def run(self, *words: Any) -> list[str]:
        """The same, returning the lines."""
        self._lines = []
        text = [str(word) for word in words]
        if not text or text[0] in ("help", "-h", "--help"):
            return (
                [parser(text[1]).format_help()]
                if len(text) > 1
                else [f"  {verb:8}{what}" for verb, what in VERBS.items()]
            )
        verb, rest = text[0], text[1:]
        if {"-h", "--help"} & set(rest):
            return [parser(verb).format_help()]
        options = parser(verb).parse_args(rest)
        getattr(self, f"_do_{verb}")(options)
        return self._lines

    @property
    def graph(self) -> Graph:
        """Whose server it acts on."""
        return self._graph if self._graph is not None else default_graph()

    def _node(self) -> TransportNode:
        master = find_master(self.graph)
        if master is None:
            raise GazeboError(
                f"an instance of Gazebo is not running: there is no Master at {address()}. Start `gazebo_ros/gzserver` in the same graph"
            )
        return TransportNode(master, "gz", master.namespace)

    def _wait(self, found: list[Any], count: int, seconds: float) -> None:
        """Let the graph go on until so many messages have come, or the time is over."""
        scheduler = self.graph.scheduler
        end = scheduler.now_ns() + round(seconds * 1e9)
        if scheduler.may_park() and not scheduler.driven:
            self.graph.run(seconds, until=(lambda: len(found) >= count) if count else None)
            return
        while scheduler.now_ns() < end and not (count and len(found) >= count):
            scheduler.sleep_until(min(end, scheduler.now_ns() + 5_000_000))

    def _asked(self, request: str, data: str = "") -> Any:
        """What the server answers. Raises `GazeboError`."""
        node = self._node()
        self._number += 1
        number, answers = self._number, []

        def hear(message: Response) -> None:
            if message.id == number and message.request == request:
                answers.append(message)

        node.subscribe("~/response", hear)
        node.advertise("~/request", Request).publish(Request(number, request, data))
        node.close()
        answer: Response = answers[0]
        if answer.response != "success":
            raise GazeboError(str(answer.serialized_data))
        return answer.serialized_data

    # -- topic ---------------------------------------------------------------------------------------------------

    def _do_topic(self, options: argparse.Namespace) -> None:
        node = self._node()
        if options.list:
            self._lines += list(node.master.topics())
        elif options.info:
            info = node.master.info(node.resolve(options.info))
            self._lines += [
                f"Type: {info.type}",
                "",
                "Publishers:",
                *(f"\t{name}" for name in info.publisher_addresses),
            ]
            self._lines += ["", "Subscribers:", *(f"\t{name}" for name in info.subscriber_addresses), ""]
        elif options.echo or options.hz:
            topic = options.echo or options.hz
            node.master.info(node.resolve(topic))
            heard: list[tuple[int, Any]] = []
            clock = self.graph.scheduler.now_ns
            node.subscribe(topic, lambda message: heard.append((clock(), message)))
            self._wait(heard, options.count, options.duration if not options.count else TIMEOUT)
            if options.echo:
                for _, message in heard:
                    self._lines += [*str(message).splitlines(), ""]
            else:
                self._lines.append(_rate([when for when, _ in heard]))
        else:
            raise UsageError(f"gz topic: say what to do. {parser('topic').format_usage().strip()}")
        node.close()

    # -- model ---------------------------------------------------------------------------------------------------

    def _do_model(self, options: argparse.Namespace) -> None:
        if options.spawn_file:
            self._spawn(options)
            return
        if not options.model_name:
            raise UsageError("gz model: which model? -m MODEL")
        model = self._info(options.model_name)
        given = self._given(options)
        if options.delete:
            self._asked("entity_delete", options.model_name)
        elif options.info:
            self._lines += [*str(model).splitlines(), ""]
        elif any(part is not None for part in given):
            x, y, z, roll, pitch, yaw = (part or 0.0 for part in given)  # what is not said is 0, as in Gazebo
            node = self._node()
            moved = Pose.of(model.name, model.id, (x, y, z, roll, pitch, yaw))
            node.advertise("~/model/modify", Model).publish(Model(model.name, model.id, pose=moved))
            node.close()
        else:
            pose = pose_of(model.pose) if model.pose is not None else (0.0,) * 6
            self._lines.append(" ".join(f"{part + 0.0:.6f}" for part in pose))

    def _info(self, name: str) -> Model:
        try:
            found: Model = self._asked("entity_info", name)
        except GazeboError as error:
            where = self._node().namespace
            msg = f"Unable to get info on model[{name}] in the world[{where}]: {error}"
            raise GazeboError(msg) from error
        return found

    @staticmethod
    def _given(options: argparse.Namespace) -> tuple[float | None, ...]:
        return (options.x, options.y, options.z, options.R, options.P, options.Y)

    def _spawn(self, options: argparse.Namespace) -> None:
        path = Path(options.spawn_file)
        if not path.is_file():
            raise GazeboError(f"gz model: there is no file {options.spawn_file}")
        x, y, z, roll, pitch, yaw = (part or 0.0 for part in self._given(options))
        node = self._node()
        problems: list[str] = []

        def hear(message: Response) -> None:
            if message.request == "factory":
                problems.append(str(message.serialized_data))

        node.subscribe("~/response", hear)
        factory = Factory(
            path.read_text(encoding="utf-8"),
            options.model_name or "",
            Pose.of("", 0, (x, y, z, roll, pitch, yaw)),
        )
        node.advertise("~/factory", Factory).publish(factory)
        node.close()
        if problems:
            raise GazeboError(problems[0])

    # -- world and stats -----------------------------------------------------------------------------------------

    def _do_world(self, options: argparse.Namespace) -> None:
        reset = None
        if options.reset_all or options.reset_time or options.reset_models:
            reset = WorldReset(options.reset_all, options.reset_time, options.reset_models)
        pause = None if options.pause is None else bool(options.pause)
        if options.multi_step is not None and options.multi_step < 1:
            raise UsageError(
                f"gz world: a world is stepped once or more often, not {options.multi_step} times"
            )
        if reset is None and pause is None and not options.step and not options.multi_step:
            raise UsageError(f"gz world: say what to do. {parser('world').format_usage().strip()}")
        node = self._node()
        control = WorldControl(pause, options.step or None, options.multi_step, reset)
        node.advertise("~/world_control", WorldControl).publish(control)
        node.close()

    def _do_stats(self, options: argparse.Namespace) -> None:
        node = self._node()
        heard: list[WorldStatistics] = []
        node.subscribe("~/world_stats", heard.append)
        self._wait(heard, 0, options.duration)
        node.close()
        if options.plot:
            self._lines.append("# real-time factor (percent), simtime (sec), realtime (sec), paused (T or F)")
        for count in range(2, len(heard) + 1):
            told = heard[count - 1]
            sim, real = _seconds(told.sim_time), _seconds(told.real_time)
            factor = _factor(heard[max(0, count - LOOK_BACK) : count])
            flag = "T" if told.paused else "F"
            if factor is None:
                continue
            if options.plot:
                self._lines.append(f"{factor:4.2f}, {sim:16.6f}, {real:16.6f}, {flag}")
            else:
                self._lines.append(
                    f"Factor[{factor:4.2f}] SimTime[{sim:4.2f}] RealTime[{real:4.2f}] Paused[{flag}]"
                )

    # -- sdf -----------------------------------------------------------------------------------------------------

    def _do_sdf(self, options: argparse.Namespace) -> None:
        if options.check:
            root = parse_file(options.check)
            if root.tag == "robot":
                self._lines += list(from_urdf_file(options.check)[1])
            else:
                self._lines += [str(note) for note in sdf.load(Path(options.check)).notes]
            self._lines.append("Check complete")
        elif options.print:
            root = parse_file(options.print)
            if root.tag == "robot":
                self._lines += from_urdf_file(options.print)[0].splitlines()
            else:
                sdf.load(Path(options.print))
                self._lines += root.source().splitlines()
        else:
            raise UsageError(f"gz sdf: say what to do. {parser('sdf').format_usage().strip()}")


def from_urdf_file(path: str) -> tuple[str, tuple[str, ...]]:
    """The SDF text of a URDF file, and what is doubtful in it. Raises `UrdfError`."""
    robot = urdf.load(Path(path))
    return to_sdf(from_urdf(robot).model), robot.notes


def _factor(heard: list[WorldStatistics]) -> float | None:
    """How fast time goes, on the average since the first of these, as Gazebo reckons it; None if no time has passed."""
    sim, real = (
        sum(_seconds(getattr(each, name)) - _seconds(getattr(heard[0], name)) for each in heard)
        for name in ("sim_time", "real_time")
    )
    return max(0.0, sim / real) if real > 0 else None


def _seconds(time: Any) -> float:
    return float(time.sec + time.nsec * 1e-9)


def _rate(times: list[int]) -> str:
    if len(times) < 2 or times[-1] == times[0]:
        return "no new messages"
    return f"Hz: {(len(times) - 1) * 1e9 / (times[-1] - times[0]):6.2f}"


__all__ = ["VERBS", "Gz", "UsageError", "parser"]
