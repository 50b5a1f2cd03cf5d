"""A graph: one scheduler, one Master, and the nodes of one process."""

from __future__ import annotations

import os
import sys
import zlib
from functools import partial
from pathlib import Path
from typing import TYPE_CHECKING, Any

from rosmini.core.errors import RosminiError, TransportException
from rosmini.core.names import AnonymousNames
from rosmini.core.time import Time
from rosmini.msgs import message_class

from .event_queue import span_ns
from .live import DriveForBlockedCall, LiveDrive
from .local_transport import LocalTransport
from .log_file import log_folder
from .master import Master
from .master_port import LEAVE_NS, MasterPort, MasterProxy
from .node import Node
from .notebook import kernel_loop, kernel_shell
from .notices import Changes, Notices
from .observers.console import Console
from .observers.faults import Faults, Gates
from .observers.history import History
from .observers.recording import Recording
from .scheduler import Scheduler
from .show import find_extension, show
from .threads import in_thread, running_scheduler
from .transport import Transports

if TYPE_CHECKING:
    from collections.abc import Callable, Mapping, Sequence
    from types import TracebackType
    from typing import Self

    import numpy as np

    from .connection import Connection, Observer
    from .lanes import Lane, Waiter
    from .report import RunReport
    from .transport import Transport


MASTER_URI = "http://localhost:11311/"

ROSCORE_PARAMETERS = {
    "/rosdistro": "noetic\n",
    "/rosversion": "1.16.0\n",
    "/run_id": "00000000-0000-0000-0000-000000000001",
}
"""The parameters that ``roscore`` sets; its run id is random, a graph's is fixed unless one is given."""


class Graph:
    """A ROS computation graph in this process.

    Args:
        simulated: use simulated time, which jumps from event to event (the default), instead of wall-clock time.
        rate: in wall-clock time, the seconds of graph time that pass in one second.
        seed: the seed of the graph's random numbers; see :meth:`rng`.
        strict: raise an exception of a callback at the call that drives the graph; if False, log it, as ROS does.
        transports: functions that return a transport for the scheduler, the preferred one first; by default only the
            transport within this process.
        rosout: run the node ``/rosout``, which ``roscore`` starts; a Master elsewhere has its own.
        log_dir: write a log file for each node, ``<log_dir>/<run_id>/<node>-<number>.log``; by default in the folder
            that the environment variable ``ROS_LOG_DIR`` names; without either, no files. A graph in simulated
            time overwrites its files.
        master: a function of the graph that returns the port of a Master elsewhere; by default the graph has its own.
        run_id: the value of ``/run_id`` and the name of the folder of log files; by default the same for all graphs.

    Only the graph's creator drives it, with :meth:`run` or with any call that blocks.

    """

    def __init__(
        self,
        *,
        simulated: bool = True,
        rate: float = 1.0,
        seed: int = 0,
        strict: bool = True,
        transports: Sequence[Callable[[Scheduler], Transport]] = (LocalTransport,),
        rosout: bool = True,
        log_dir: str | Path | None = None,
        master: Callable[[Any], MasterPort] | None = None,
        run_id: str | None = None,
    ) -> None:
        self.scheduler = Scheduler(simulated=simulated, rate=rate)
        self.scheduler.on_error = self._lane_failed
        self.simulated = simulated
        self.seed = seed
        self.strict = strict
        self.notebook = kernel_shell() is not None
        self.changes = Changes(self.scheduler)
        self.transport = Transports(self.scheduler, transports)
        self.notices = Notices(
            self.scheduler, self.changes, self.transport.call, lambda error: self.report(error, None)
        )
        """Delivers the notices of a Master in this process."""
        self.master: MasterPort = Master(MASTER_URI, self.notices) if master is None else master(self)
        """The Master in this process, or the port of one elsewhere."""
        self.nodes: dict[str, Node] = {}
        """The nodes in this process, by name."""
        self.gates = Gates(self.scheduler)
        """The injected faults that messages pass on their way to subscribers."""
        self.closing = False
        """True while the whole graph shuts down."""
        self.log_class = message_class("rosgraph_msgs/Log")
        self.clock_class = message_class("rosgraph_msgs/Clock")
        self._live: LiveDrive | None = None
        self._preparations: list[Callable[[], object]] = []
        """Functions to call when :meth:`live` starts the graph."""
        self._anonymous = AnonymousNames() if simulated else AnonymousNames(os.getpid())
        self.clock_node: str | None = None
        """Name of the node that publishes the graph's time on ``/clock`` for other processes, or None."""
        parameters = ROSCORE_PARAMETERS | ({} if run_id is None else {"/run_id": run_id})
        if self.master.is_local:
            roscore = self.ask_as("/roscore")
            for key, value in parameters.items():
                roscore.ask("setParam", key, value)
        self.log_folder = log_folder(log_dir, parameters["/run_id"] if self.master.is_local else "")
        """The folder of the log files, or None."""
        self.scheduler.graph = self
        if self.notebook:
            self.scheduler.ask_driver = self._drive_for_blocked_call
        self._nodes_started = 0
        self._online: Any = None
        self._recordings = 0
        self.faults = Faults(self)
        """Injects and lists faults; `%fault` uses it too."""
        if rosout and self.master.is_local:
            self.start_rosout()

    def __repr__(self) -> str:
        kind = "simulated" if self.simulated else "wall"
        return f"<Graph with {len(self.nodes)} nodes in {kind} time>"

    def __enter__(self) -> Self:
        return self

    def __exit__(
        self, kind: type[BaseException] | None, value: BaseException | None, trace: TracebackType | None
    ) -> None:
        self.shutdown("the graph was closed")

    def start_rosout(self) -> None:
        """Start the node ``/rosout``, which publishes all log messages again on ``/rosout_agg``."""
        node = Node("rosout", self, has_rosout=False)  # it would receive its own messages
        aggregate = node.publisher("/rosout_agg", self.log_class, queue_size=None)

        def pass_on(message: Any) -> None:
            if not node.is_shutdown():  # messages of other nodes may still arrive
                aggregate.publish(message)

        node.subscriber("/rosout", self.log_class, pass_on)

    @property
    def master_uri(self) -> str:
        """The Master's address."""
        return self.master.uri

    def ask_as(self, caller_id: str) -> MasterProxy:
        """Return an interface for calling the Master on behalf of ``caller_id``, for tools that are not nodes."""
        return MasterProxy(self, caller_id)

    # -- time ----------------------------------------------------------------------------------------------------

    def now(self) -> Time:
        """Return the graph's time."""
        return Time.from_nsec(self.scheduler.now_ns())

    def run(self, duration: float | None = None, until: Callable[[], bool] | None = None) -> RunReport:
        """Run the graph for ``duration`` seconds of its time, until ``until()`` is true, or until no event is left.

        If the graph is strict, exceptions of callbacks are raised here. Ctrl-C stops the run and leaves the graph
        consistent. Raises ``RosminiError`` if the duration is not a finite number of at least zero.
        """
        until_ns = None if duration is None else self.scheduler.now_ns() + span_ns(duration, "a run's duration")
        return self.scheduler.run(until_ns, until)

    @property
    def keeps_time(self) -> bool:
        """True while only ``clock_node`` publishes ``/clock``; the graph's nodes do not follow that topic then."""
        clock = self.clock_node
        return clock is not None and not any(
            "/clock" in node.publications for name, node in self.nodes.items() if name != clock
        )

    @property
    def is_live(self) -> bool:
        """True while the graph runs in the background after :meth:`~rosmini.core.graph.graph.Graph.live`."""
        return self._live is not None and self._live.running

    @property
    def runs_in_real_time(self) -> bool:
        """True in wall-clock time, and while the graph is live."""
        return not self.simulated or self.is_live

    def rng(self, name: str) -> np.random.Generator:
        """Return a separate random generator for ``name``, which gives the same numbers in each run."""
        import numpy as np

        return np.random.default_rng([self.seed, zlib.crc32(name.encode())])

    # -- nodes ---------------------------------------------------------------------------------------------------

    def anonymous_name(self, base: str) -> str:
        """Return ``base`` with a number and a time that make it unique; in simulated time, the same in each run."""
        return self._anonymous.make(base, self.scheduler.now_ns())

    def who_publishes(self, topic: str) -> str:
        """Return a clause for error messages that names the publishers of a topic."""
        return self.ask_as("/graph").who_publishes(topic)

    @property
    def unreachable(self) -> tuple[str, ...]:
        """The nodes that the Master knows but that do not respond, because they ended without unregistering."""
        return self.scheduler.run_in_scheduler(self._find_unreachable)

    def _find_unreachable(self) -> tuple[str, ...]:
        master = self.ask_as("/graph")
        state = master.ask("getSystemState")
        names = dict.fromkeys(name for part in state for _, holders in part for name in holders)
        return tuple(name for name in names if not self._answers(master.find("lookupNode", name)))

    def _answers(self, uri: str | None) -> bool:
        if uri is None:
            return False
        try:
            return bool(self.transport.call(uri, "getPid", "/graph"))
        except TransportException:
            return False

    # -- connections ---------------------------------------------------------------------------------------------

    def observers(self, connection: Connection) -> list[Observer]:
        """Return the faults that act on a connection, and the recording if there is one."""
        subscription, history = connection.subscription, self.scheduler.history
        found: list[Observer] = [*self.gates.of(subscription.topic, subscription.node.name)]
        if history is not None:
            found.append(history.observer(connection))
        return found

    def observers_changed(self) -> None:
        """Notify every publisher and connection of this process that faults or the recording have changed."""
        for node in self.nodes.values():
            for publication in node.publications.values():
                publication.connections_changed()
            for subscription in node.subscriptions.values():
                for connection in subscription.connections.values():
                    connection.observe()

    # -- errors --------------------------------------------------------------------------------------------------

    def report(self, error: BaseException, node: Any, *, raise_strict: bool = True) -> None:
        """Report an error, of ``node`` if given: raise it at the call that drives a strict graph, else log it.

        With ``raise_strict`` False, always log it.
        """
        if self.strict and raise_strict and self.scheduler.raise_in_driver(error):
            return
        if node is not None:
            node.logerr(error)
        else:
            sys.stderr.write(f"[ERROR] {error}\n")

    def _lane_failed(self, lane: Lane, error: BaseException) -> None:
        self.report(error, lane.node)

    # -- driving -------------------------------------------------------------------------------------------------

    def live(self, rate: float = 1.0) -> LiveDrive:
        """Run the graph in the background of a notebook, ``rate`` seconds of its time per second.

        Call ``stop()`` on the result to stop it. Raises ``RosminiError`` if no event loop runs: use :meth:`run`
        in a program.
        """
        loop = kernel_loop()
        if self._live is not None:
            self._live.stop()
        self._live = live = LiveDrive(self, loop, rate=rate)
        self.scheduler.call_soon_threadsafe(self._prepare)
        return live

    def before_live(self, function: Callable[[], object]) -> None:
        """Register a slow function to call in a helper thread when :meth:`live` starts; time stops meanwhile."""
        self._preparations.append(function)

    def _prepare(self) -> None:
        preparations, self._preparations = self._preparations, []
        for function in preparations:
            self.scheduler.spawn("preparations", partial(in_thread, self.scheduler, function))

    def online(
        self, master_uri: str | None = None, environ: Mapping[str, str] | None = None, *, live: bool = True
    ) -> Any:
        """Connect this graph with the nodes of other processes and machines, until :meth:`offline`.

        If a Master answers at ``master_uri`` (by default, the value of ``ROS_MASTER_URI``), the graph joins it: its
        nodes register there, and its parameters are set there. Otherwise the graph's own Master is served there; at
        port 0, it is served at any free port.
        Others reach the nodes at ``ROS_IP`` or ``ROS_HOSTNAME`` of ``environ`` (by default ``os.environ``); only this
        machine can if neither is set. In simulated time ``/clock`` is published and ``/use_sim_time`` set,
        until a simulator of the graph does it.

        In a notebook the graph runs in the background, as after :meth:`live`; elsewhere drive it with :meth:`run`,
        which now takes one second per second of simulated time, since other processes use it. With ``live`` False it
        runs only while it is driven, as fast as possible, and its time is not published.

        Raises ``MasterUnreachable`` if no Master answers and none can be served on this machine, or if the process
        that listens there does not answer within ten seconds (the graph then stays offline), and
        ``RosminiError`` if the graph is already online or already uses a Master elsewhere.
        """
        if self._online is not None:
            raise RosminiError(f"this graph is online already, at {self.master_uri}; offline() ends that")
        begin = find_extension("rosmini.wires", "online")
        self._online = self.scheduler.run_in_scheduler(lambda: begin(self, master_uri, environ, live=live))
        return self._online

    @property
    def is_online(self) -> bool:
        """True between :meth:`online` and :meth:`offline`."""
        return self._online is not None

    def keep_pace(self, condition: Callable[[], bool]) -> None:
        """Limit simulated time to the pace of real time while ``condition()`` is true; only with :meth:`online`."""
        if self._online is not None:
            self.scheduler.run_in_scheduler(self._online.keep_pace, condition)

    def offline(self) -> None:
        """Disconnect from other processes; the nodes of this one keep running. Safe to call again."""
        online, self._online = self._online, None
        if online is not None:
            self.scheduler.run_in_scheduler(online.end)

    def _drive_for_blocked_call(self, waiter: Waiter) -> Callable[[], None]:
        return DriveForBlockedCall(self, waiter).complain

    def shutdown(self, reason: str = "") -> None:
        """Shut every node down, newest first, and end all calls that still block.

        The graph is then empty and can be used again.
        """
        self.scheduler.run_in_scheduler(lambda: self._shutdown(reason))

    def _shutdown(self, reason: str) -> None:
        if self._live is not None:
            self._live.stop()
        scheduler = self.scheduler
        self.closing = True
        steps: list[Callable[[], object]] = [
            partial(node.shutdown, reason) for node in reversed(list(self.nodes.values()))
        ]
        if scheduler.current() is scheduler.root:
            steps.append(self._let_leave)
        steps.append(self.offline)
        problems: list[Exception] = []
        for step in [*steps, scheduler.close, self.transport.close]:
            try:
                step()
            except Exception as error:  # the failure of one node must not stop the others
                problems.append(error)
        self.closing = False
        self.notices.clear()
        for problem in problems[1:]:
            self.report(problem, None, raise_strict=False)
        if problems:
            raise problems[0]

    def _let_leave(self) -> None:
        """Let nodes that are shutting down in their own lanes finish unregistering."""
        scheduler = self.scheduler
        scheduler.run(until_ns=scheduler.now_ns())
        if self.nodes and not self.master.is_local:
            scheduler.run(until_ns=scheduler.now_ns() + LEAVE_NS, until=lambda: not self.nodes)

    # -- nodes ---------------------------------------------------------------------------------------------------

    def node(self, name: str, **options: Any) -> Node:
        """Start a node; the options are those of :class:`Node`."""
        return Node(name, self, **options)

    def add_node(self, node: Node) -> Path | None:
        """Add a node; return the path of its log file, or None. The Master ends an older node of the same name."""
        self.nodes[node.name] = node
        self._nodes_started += 1
        log_file = node.remappings.log_file
        if log_file is not None:
            return Path(log_file).absolute()
        if self.log_folder is None:
            return None
        name = node.name.lstrip("/")
        if not self.master.is_local:  # one of many processes: named as in rospy
            return self.log_folder / f"{name.replace('/', '_')}.log"
        return self.log_folder / f"{name.replace('/', '-')}-{self._nodes_started}.log"

    def remove_node(self, node: Node) -> None:
        """Remove a node that has ended."""
        if self.nodes.get(node.name) is node:
            del self.nodes[node.name]

    # -- pictures and recordings ---------------------------------------------------------------------------------

    def show(self, **options: Any) -> Any:
        """Return a picture of the graph, as the tool ``rqt_graph`` draws it.

        Options, with their defaults:
            mode='nodes_only': topics as labels; 'nodes_topics_active': connected ones as boxes; 'nodes_topics_all': all
            hide=('debug', 'dead_sinks', 'leaf_topics', 'params', 'unreachable'): what to leave out; also 'tf'; or ()
            group=('actions', 'images', 'tf'): kinds of topics drawn as one box, if topics are boxes
            namespaces=2: nesting depth of the boxes around namespaces; 0 draws none
            namespace='/': only these nodes: names or regular expressions separated by commas; - excludes
            topics='/': only these topics, in the same form
            direction='right': or 'down'
            since=None: an earlier state; additions since then are bold, removals are dashed
            highlight='': a node or topic: its sources are blue, its receivers green, everything else pale
            title=None: a caption under the picture, and the first words of its text form
        """
        return show("computation_graph", self, **options)

    def record(self) -> Recording:
        """Record from now on all calls and messages between nodes, and the cause of each.

        Call ``stop()`` on the result to end the recording, or use it in a ``with`` statement. ``%roswhy`` and
        ``%rossequence`` use the recording. A graph that does not record has no overhead.
        """
        return self.scheduler.run_in_scheduler(self._record)

    def _record(self) -> Recording:
        self._recordings += 1
        if self.scheduler.history is None:
            self._set_history(History(self.scheduler, self.nodes))
        return Recording(self.scheduler.history, lambda: self.scheduler.run_in_scheduler(self._record_no_more))

    @property
    def recorded(self) -> Recording | None:
        """Everything that this graph has recorded, or None if it is not recording."""
        history: History | None = self.scheduler.history
        return None if history is None else Recording(history, lambda: None, from_start=True)

    def _record_no_more(self) -> None:
        self._recordings -= 1
        if not self._recordings:
            self._set_history(None)

    def _set_history(self, history: History | None) -> None:
        self.scheduler.history = history
        self.observers_changed()

    def console(self, **options: Any) -> Console:
        """Collect the log messages of all nodes from now on; the options are those of :class:`Console`."""
        return Console(self, **options)


_default: dict[str, Graph] = {}


def default_graph() -> Graph:
    """Return the graph that ``Node(name)`` and ``rospy`` use by default; the first call makes it, in simulated time."""
    if "graph" not in _default:
        _default["graph"] = Graph()
    return _default["graph"]


def set_default_graph(graph: Graph | None) -> Graph | None:
    """Make ``graph`` the default one and return the previous one.

    If None, :func:`default_graph` makes a new one when it is called.
    """
    before = _default.pop("graph", None)
    if graph is not None:
        _default["graph"] = graph
    return before


def running_graph() -> Graph:
    """Return the graph that runs the caller (a callback, a script, a thread of a script), else the default one."""
    scheduler = running_scheduler()
    found: Graph | None = None if scheduler is None else scheduler.graph
    return default_graph() if found is None else found


Node.default_graph = staticmethod(running_graph)
