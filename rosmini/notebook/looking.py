"""Magics that take the place of windows: ``%show``, ``%record``, ``%replay``, ``%drag``, and ``%click`` in RViz.

They take names of nodes and topics, so that a cell needs no object of rosmini. Each returns its result: after
``run = %replay``, ``run.recording`` has the recorded arrays.
"""

from __future__ import annotations

import re
from contextlib import suppress
from dataclasses import dataclass
from functools import partial
from typing import TYPE_CHECKING, Any, TypeVar

from rosmini.core.errors import ROSException, RosminiError, UsageError, nearest
from rosmini.core.graph.notebook import mark_as_shown
from rosmini.core.names import namespace
from rosmini.core.verbs import Parser, Result, Shown
from rosmini.core.verbs.options import global_name
from rosmini.sim.turtlesim import TurtleSim
from rosmini.sim.turtlesim.tape import Tape
from rosmini.tools.magics import words as words_of

if TYPE_CHECKING:
    from collections.abc import Mapping, Sequence
    from optparse import Values

    from rosmini.sim.recorder import Recorder
    from rosmini.sim.recording import Recording
    from rosmini.viz.rviz.tools import PublishingTool, Tools

    from .session import Session

BAGS = (".bag", ".mcap")
CONNECT_S = 2.0
"""Longest time for which ``%click`` waits for a subscriber of the tool's topic [s]."""
EVERYTHING = "*"
_NUMBER = re.compile(r"[-+]?(\d+\.?\d*|\.\d+)(e[-+]?\d+)?", re.IGNORECASE)
_R = TypeVar("_R", bound=Result)


@dataclass(frozen=True, kw_only=True)
class Replay(Shown):
    """A player, and the recordings that it plays: none for a bag."""

    recordings: tuple[Recording | Tape, ...] = ()

    @property
    def recording(self) -> Any:
        """The first recording: the times, poses, scans and commands of its robot as arrays.

        Raises ``RosminiError`` for a bag.
        """
        if not self.recordings:
            raise RosminiError("a bag has no recording: read its messages with rosbag.Bag(file).read_messages()")
        return self.recordings[0]


@dataclass(frozen=True, kw_only=True)
class Click(Result):
    """The text in RViz's status bar after a click."""

    text: str

    def __str__(self) -> str:
        return self.text


def show(session: Session, line: str) -> Shown:
    """Show the world of a simulation, or the window of a turtlesim, as it is now.

    ``%show`` shows the only one, ``%show /simulator`` the one of this node; ``--3d`` shows it in three dimensions.
    """
    parser = Parser("%show", "%show [NODE] [--3d]", "Show a simulation as it is now.", example="  %show /simulator")
    parser.flag("--3d", dest="solid", help="in three dimensions")
    given = _parsed(session, parser, line)
    found = _simulations(session, given.words)
    if len(found) > 1:
        raise UsageError(f"%show shows one simulation: name one of {', '.join(found)}")
    (name, program), *_ = found.items()
    if not given.solid:
        return _displayed(session, Shown(view=program.show()))
    if not hasattr(program, "show3d"):
        raise UsageError(f"{name} is flat: show it without --3d")
    return _displayed(session, Shown(view=program.show3d()))


def record(session: Session, line: str) -> None:
    """Record simulations from now on, until ``%replay``.

    Without names of nodes it records all simulations of the graph. A new ``%record`` discards what is recorded.
    """
    parser = Parser(
        "%record", "%record [NODE ...]", "Record simulations until %replay.", example="  %record /simulator"
    )
    found = _simulations(session, _parsed(session, parser, line).words)
    turtles = {name for name, program in found.items() if isinstance(program, TurtleSim)}
    if turtles and len(turtles) < len(found):
        raise UsageError(f"a recording has either turtles or robots: name some of {', '.join(found)}")
    for recorder in session.recorders:
        recorder.stop()
    session.recorders = [_recorder(session, name, program) for name, program in found.items()]


def replay(session: Session, line: str) -> Replay:
    """Stop the recording and show it in a player; topics are drawn as layers over the world.

    ``%replay /map /plan`` also shows a map and a plan, ``%replay "*"`` every topic that can be drawn; ``--3d`` shows
    robots in three dimensions; ``--end`` shows the end first; ``%replay drive.bag`` plays a bag or an MCAP file.
    """
    parser = Parser(
        "%replay", "%replay [--3d | --end] [-f FRAME] [TOPIC ...] | [FILE.bag ...]", "Play the recording, or bags.",
        example="  %replay /map",
    )  # fmt: skip
    parser.flag("--3d", dest="solid", help="in three dimensions")
    parser.flag("--end", dest="at_end", help="show the end first, instead of the start")
    parser.add_option("-f", "--frame", metavar="FRAME", help="the frame of the layers (default: map, odom or world)")
    parser.add_option("--robot", metavar="MODEL", help="the model of a bag's robot, such as burger")
    given = _parsed(session, parser, line)
    bags = [word for word in given.words if word.endswith(BAGS)]
    topics = [word for word in given.words if word not in bags]
    layers = None if EVERYTHING in topics else topics
    if bags:
        view = _player(given)(*bags, topics=layers or None, frame=given.frame, robot=given.robot)
        return _displayed(session, Replay(view=view))
    if not session.recorders:
        raise RosminiError("nothing is recorded: write %record, and let time pass with rosmini.wait(10)")
    for recorder in session.recorders:
        recorder.stop()
    return _displayed(session, _replay(session.recorders, given, layers))


def drag(session: Session, line: str) -> None:
    """Put a robot or a movable object elsewhere, as with the mouse in a simulator's window: ``%drag "crate" X Y YAW``.

    X and Y are in the frame of the world [m]; the yaw is the heading [rad].
    """
    parser = Parser(
        "%drag", '%drag "NAME" X Y [YAW]', "Put a robot or an object elsewhere.", example='  %drag "crate" 1 0.5'
    )
    given, pose = _with_pose(session, parser, line, "give a name, x and y, and a heading")
    (name, program), *others = _simulations(session, []).items()
    if others:
        raise UsageError(f"%drag needs one simulation, and there are {1 + len(others)}")
    if not _is_simulation(program):
        raise UsageError(f"nothing in {name} can be dragged")
    program.drag(given.words[0], pose)


def click(session: Session, line: str) -> Click:
    """Use a tool of RViz at a point: ``%click "2D Nav Goal" X Y YAW``.

    X and Y are in the fixed frame [m]: map, or odom if there is no map, unless ``-f FRAME`` names another one. The
    yaw is the direction in which the mouse is dragged [rad]. ``-d FILE`` takes the tools of a .rviz file. Without
    these options an open window of ``%rviz --live`` is clicked, where the mouse does the same.
    """
    parser = Parser(
        "%click", '%click "TOOL" X Y [YAW] [-f FRAME] [-d FILE]', "Use a tool of RViz at a point.",
        example='  %click "2D Nav Goal" 2.5 3 1.57',
    )  # fmt: skip
    parser.add_option("-f", "--fixed-frame", metavar="FRAME", help="the frame of the point")
    parser.add_option("-d", "--display-config", metavar="FILE", help="a .rviz file")
    given, pose = _with_pose(session, parser, line, "give a tool, x and y, and for a pose its yaw")
    text = _click(_tools(session, given.display_config, given.fixed_frame), given.words[0], pose)
    session.graph.scheduler.yield_to_others()
    session.say(text)
    return _without_echo(session, Click(text=text))


def _with_pose(session: Session, parser: Parser, line: str, needed: str) -> tuple[Values, tuple[float, float, float]]:
    """Return what a line says: options and one word, and a pose whose yaw may be missing."""
    session.attach()
    words = words_of(line, parser.get_prog_name().lstrip("%"), session.shell.user_ns)
    numbers = [float(word) for word in words if _NUMBER.fullmatch(word)]  # -2 would be an option
    given = parser.parse([word for word in words if not _NUMBER.fullmatch(word)])
    if len(given.words) != 1 or len(numbers) not in (2, 3):
        parser.error(needed)
    x, y, yaw = (*numbers, 0.0)[:3]
    return given, (x, y, yaw)


def _click(tools: Tools, name: str, pose: tuple[float, float, float]) -> str:
    from rosmini.viz.rviz.tools import PoseTool, PublishingTool

    tool = tools[name]
    if isinstance(tool, PublishingTool):
        _await_subscriber(tool)
    return tool.set_pose(*pose) if isinstance(tool, PoseTool) else tool.click(pose[:2])


def _await_subscriber(tool: PublishingTool) -> None:
    """Let time pass until a node subscribes to the tool's topic. A window is open long before its user clicks."""
    with suppress(ROSException):  # the publisher warns of a message without subscribers
        tool.publisher.wait_for_subscribers(timeout=CONNECT_S)


def _tools(session: Session, config: str | None, frame: str | None) -> Tools:
    """Return the tools of RViz's open window, or those of a node that starts with the first click, and stays."""
    from rosmini.viz.rviz import Scene
    from rosmini.viz.rviz.suggestions import suggested
    from rosmini.viz.rviz.tools import Tools
    from rosmini.viz.rviz.window import RVizWindow

    graph = session.graph
    window = getattr(graph.nodes.get("/rviz"), "panel", None)
    if isinstance(window, RVizWindow) and config is None and frame is None:
        return window.tools
    if (config, frame) not in session.rviz:
        chosen = suggested(graph, frame).options()["Fixed Frame"] if config is None else frame
        node = graph.node("rviz", anonymous="/rviz" in graph.nodes)
        session.rviz[config, frame] = Tools(Scene(graph, config, fixed_frame=chosen, node=node))
    return session.rviz[config, frame]


def _parsed(session: Session, parser: Parser, line: str) -> Values:
    """Return the options and words of a line. Raises ``UsageError``."""
    session.attach()
    return parser.parse(words_of(line, parser.get_prog_name().lstrip("%"), session.shell.user_ns))


def _simulations(session: Session, names: Sequence[str]) -> Mapping[str, Any]:
    """Return the programs of the named nodes, or of all nodes that are simulations.

    A gzclient shows the world of its gzserver, so it counts only if it is named. Raises ``RosminiError`` for a node
    that is no simulation, and if there is none.
    """
    nodes = session.graph.nodes
    known = {name: node.program for name, node in sorted(nodes.items()) if hasattr(node.program, "show")}
    for name in map(global_name, names):
        if name not in known:
            what = "is no simulation" if name in nodes else "does not run"
            hint = nearest(name, known) or f"running simulations: {', '.join(known) or 'none'}"
            raise RosminiError(f"{name} {what}; {hint}")
    if not known:
        raise RosminiError("no simulation runs: start one, for example with %rosrun rosmini_sim simulator")
    if names:
        return {name: known[name] for name in map(global_name, names)}
    shown = {name: each for name, each in known.items() if isinstance(each, TurtleSim) or _is_simulation(each)}
    return shown or known


def _is_simulation(program: Any) -> bool:
    """Return whether the program is a ``Simulation``, a class that needs numpy and is not imported for turtles."""
    return hasattr(program, "drag")


def _recorder(session: Session, name: str, program: Any) -> Recorder | Tape:
    if isinstance(program, TurtleSim):
        return program.record()
    from rosmini.sim.recorder import Recorder

    return Recorder(session.graph, program, namespace=namespace(name), layers=True)


def _player(given: Values) -> Any:
    from rosmini.viz.meshcat.runs import replay_3d
    from rosmini.viz.replay.player import replay as replay_flat

    if not given.solid:
        return partial(replay_flat, opens_at_end=given.at_end)
    if given.at_end:
        raise UsageError("--end is for players without --3d")
    return replay_3d


def _replay(recorders: Sequence[Recorder | Tape], given: Values, topics: Sequence[str] | None) -> Replay:
    """Return the player of a finished recording; several simulations are shown side by side."""
    from rosmini.viz.turtle_replay import turtle_replay

    tapes = [recorder for recorder in recorders if isinstance(recorder, Tape)]
    robots = [recorder for recorder in recorders if not isinstance(recorder, Tape)]
    if not robots:
        if given.solid or given.at_end or given.words:
            raise UsageError("turtles are flat and have no layers: write %replay without arguments")
        return Replay(view=turtle_replay(*tapes), recordings=tuple(tapes))
    recordings = tuple(recorder.recording() for recorder in robots)
    names = [namespace(recorder.node.name).strip("/") for recorder in robots] if len(robots) > 1 else None
    view = _player(given)(*recordings, topics=topics, frame=given.frame, names=names)
    return Replay(view=view, recordings=recordings)


def _displayed(session: Session, result: _R) -> _R:
    """Show the view of a result below the cell."""
    from IPython.core.display_functions import display

    display(result.view)  # type: ignore[no-untyped-call, attr-defined]
    return _without_echo(session, result)


def _without_echo(session: Session, result: _R) -> _R:
    mark_as_shown(result, session.shell)
    return result
