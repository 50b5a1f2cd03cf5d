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
from .live import Errand, LiveDrive
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
from .threads import running_scheduler
from .transport import Transports

if TYPE_CHECKING:
    from collections.abc import Callable, Mapping, Sequence
    from pathlib import Path
    from types import TracebackType
    from typing import Self

    import numpy as np

    from .connection import Connection, Observer
    from .lanes import Lane, Waiter
    from .master_port import MasterPort
    from .report import RunReport
    from .scheduler import Scheduler
    from .transport import Transport


MASTER_URI = "http://localhost:11311/"

ROSCORE_PARAMETERS = {
    "/rosdistro": "noetic\n",
    "/rosversion": "1.16.0\n",
    "/run_id": "00000000-0000-0000-0000-000000000001",
}
"""What ``roscore`` sets; its run id is random, that of a graph is not unless it is given one."""


class Graph:
    """A ROS computation graph in this process.

    Args:
        simulated: simulated time, which jumps from event to event (the default), or wall time.
        rate: in wall time, how many seconds of graph time pass in one second.
        seed: what random numbers of this graph start from; see :meth:`rng`.
        strict: raise an exception that a callback lets out at the call that drives the graph; else log it, as ROS does.
        transports: each makes a transport from the scheduler, the preferred one first; in-process hand-over by default.
        rosout: run the node ``/rosout``, which ``roscore`` starts; a Master elsewhere has its own.
        log_dir: write a log file for each node, ``<log_dir>/<run_id>/<node>-<number>.log``; if not given, the folder
            that the environment variable ``ROS_LOG_DIR`` names, and no files if there is none. A graph writes its files
            anew.
        master: makes the way to a Master elsewhere from the graph; by default the graph has its own in this process.
        run_id: what ``/run_id`` is set to, and the folder of log files called; the same for all graphs by default.

    Only the graph's creator drives it, with :meth:`run` or by any call that blocks.

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
        """What carries the notices of a Master in this process."""
        self.master: MasterPort = Master(MASTER_URI, self.notices) if master is None else master(self)
        """The Master, or the way to it."""
        self.nodes: dict[str, Node] = {}
        """The nodes in this process, by name."""
        self.gates = Gates(self.scheduler)
        """What messages have to pass on their way to subscribers."""
        self.closing = False
        """True while the whole graph shuts down."""
        self.log_class = message_class("rosgraph_msgs/Log")
        self.clock_class = message_class("rosgraph_msgs/Clock")
        self._live: LiveDrive | None = None
        self._anonymous = AnonymousNames() if simulated else AnonymousNames(os.getpid())
        self.keeps_time = False
        """True while this graph publishes its time on ``/clock``: its own nodes do not follow that topic then."""
        parameters = ROSCORE_PARAMETERS | ({} if run_id is None else {"/run_id": run_id})
        if self.master.is_local:
            roscore = self.ask_as("/roscore")
            for key, value in parameters.items():
                roscore.ask("setParam", key, value)
        self.log_folder = log_folder(log_dir, parameters["/run_id"] if self.master.is_local else "")
        """Where the log files are, if there are any."""
        self.scheduler.graph = self
        if self.notebook:
            self.scheduler.ask_driver = self._run_errand
        self._nodes_started = 0
        self._online: Any = None
        self._recordings = 0
        self.faults = Faults(self)
        """What goes wrong because somebody asked for it; it does as `%fault`."""
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
        """Start the node ``/rosout``."""
        node = Node("rosout", self, has_rosout=False)  # it would hear itself
        aggregate = node.publisher("/rosout_agg", self.log_class, queue_size=None)

        def pass_on(message: Any) -> None:
            if not node.is_shutdown():  # the last words of others may still be on their way then
                aggregate.publish(message)

        node.subscriber("/rosout", self.log_class, pass_on)

    @property
    def master_uri(self) -> str:
        """The Master's address."""
        return self.master.uri

    def ask_as(self, caller_id: str) -> MasterProxy:
        """Return the Master as a caller of this name sees it: for tools that are no nodes."""
        return MasterProxy(self, caller_id)

    # -- time ----------------------------------------------------------------------------------------------------

    def now(self) -> Time:
        """Return the graph's time."""
        return Time.from_nsec(self.scheduler.now_ns())

    def run(self, duration: float | None = None, until: Callable[[], bool] | None = None) -> RunReport:
        """Run the graph for ``duration`` seconds of its time, until ``until()`` holds, or until nothing is left to do.

        What a callback raises is raised here when the graph is strict. Ctrl-C stops the drive and leaves the graph in
        order. Raises ``RosminiError`` for a duration that is no number of seconds from zero on.
        """
        until_ns = (
            None if duration is None else self.scheduler.now_ns() + span_ns(duration, "a run's duration")
        )
        return self.scheduler.run(until_ns, until)

    @property
    def is_live(self) -> bool:
        """True while the graph goes on by itself after :meth:`~rosmini.core.graph.graph.Graph.live`."""
        return self._live is not None and self._live.running

    def rng(self, name: str) -> np.random.Generator:
        """Return a random generator of its own for ``name``: the same on each run, whoever else draws from another."""
        import numpy as np

        return np.random.default_rng([self.seed, zlib.crc32(name.encode())])

    # -- nodes ---------------------------------------------------------------------------------------------------

    def anonymous_name(self, base: str) -> str:
        """Return ``base`` with a number and a time that make it unique: the same on each run in simulated time."""
        return self._anonymous.make(base, self.scheduler.now_ns())

    def who_publishes(self, topic: str) -> str:
        """Return a clause that says who publishes a topic."""
        return self.ask_as("/graph").who_publishes(topic)

    @property
    def unreachable(self) -> tuple[str, ...]:
        """The nodes that the Master knows and that do not answer: they ended without a word."""
        return self.scheduler.on_hub(self._find_unreachable)

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
        """Let every publisher and connection of this process learn that faults or the recording have changed."""
        for node in self.nodes.values():
            for publication in node.publications.values():
                publication.connections_changed()
            for subscription in node.subscriptions.values():
                for connection in subscription.connections.values():
                    connection.observe()

    # -- errors --------------------------------------------------------------------------------------------------

    def report(self, error: BaseException, node: Any, *, raise_strict: bool = True) -> None:
        """Report a problem, of ``node`` if given: raised where a strict graph is driven, else logged."""
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
        """Let the graph go on by itself in a notebook, ``rate`` seconds of its time a second, beside cells and widgets.

        Call ``stop()`` on the result to end that. Raises ``RosminiError`` where no event loop runs: use :meth:`run`
        in a program.
        """
        loop = kernel_loop()
        if self._live is not None:
            self._live.stop()
        self._live = live = LiveDrive(self, loop, rate=rate)
        return live

    def online(
        self, master_uri: str | None = None, environ: Mapping[str, str] | None = None, *, live: bool = True
    ) -> Any:
        """Connect this graph with the nodes of other processes and machines, until :meth:`offline`.

        Where a Master answers at ``master_uri`` (by default, what ``ROS_MASTER_URI`` names), the graph joins it: its
        nodes register there, and the parameters that it has go there. Else the graph's own Master is served there.
        Others reach the nodes at ``ROS_IP`` or ``ROS_HOSTNAME`` of ``environ`` (by default ``os.environ``); only this
        machine does if neither is set. In simulated time ``/clock`` is published and ``/use_sim_time`` set.

        In a notebook the graph goes on by itself, as after :meth:`live`; elsewhere drive it with :meth:`run`, which
        now takes a second for a second of simulated time, since others live on it. With ``live`` False it only goes
        on when it is driven, and as fast as it can.

        Raises ``MasterUnreachable`` where no Master answers and none of this machine's can be served, or what listens
        there does not answer within ten seconds (the graph stays offline then), and
        ``RosminiError`` if the graph is online already or has its Master elsewhere anyway.
        """
        if self._online is not None:
            raise RosminiError(f"this graph is online already, at {self.master_uri}; offline() ends that")
        begin = find_extension("rosmini.wires", "online")
        self._online = self.scheduler.on_hub(lambda: begin(self, master_uri, environ, live=live))
        return self._online

    @property
    def is_online(self) -> bool:
        """True between :meth:`online` and :meth:`offline`."""
        return self._online is not None

    def keep_pace(self, condition: Callable[[], bool]) -> None:
        """Let simulated time go no faster than real time while ``condition()`` is true; only with :meth:`online`."""
        if self._online is not None:
            self._online.keep_pace(condition)

    def offline(self) -> None:
        """Leave the nodes of other processes; those of this one go on among themselves. Harmless when repeated."""
        online, self._online = self._online, None
        if online is not None:
            self.scheduler.on_hub(online.end)

    def _run_errand(self, waiter: Waiter) -> Callable[[], None]:
        return Errand(self, waiter).complain

    def shutdown(self, reason: str = "") -> None:
        """Shut every node down, newest first, and end what still blocks.

        The graph is empty then and can be used again.
        """
        self.scheduler.on_hub(lambda: self._shutdown(reason))

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
            except Exception as error:  # what one node does at its end must not keep another up
                problems.append(error)
        self.closing = False
        self.notices.clear()
        for problem in problems[1:]:
            self.report(problem, None, raise_strict=False)
        if problems:
            raise problems[0]

    def _let_leave(self) -> None:
        """Let nodes whose end is under way in lanes of theirs take their registrations back."""
        scheduler = self.scheduler
        scheduler.run(until_ns=scheduler.now_ns())
        if self.nodes and not self.master.is_local:
            scheduler.run(until_ns=scheduler.now_ns() + LEAVE_NS, until=lambda: not self.nodes)

    # -- nodes ---------------------------------------------------------------------------------------------------

    def node(self, name: str, **options: Any) -> Node:
        """Start a node; the options are those of :class:`Node`."""
        return Node(name, self, **options)

    def add_node(self, node: Node) -> Path | None:
        """Learn of a new node; an older one of its name hears from the Master at the new one's first registration."""
        self.nodes[node.name] = node
        self._nodes_started += 1
        asked = node.remappings.log_file
        if asked is not None:
            return Path(asked).absolute()
        if self.log_folder is None:
            return None
        name = node.name.lstrip("/")
        if not self.master.is_local:  # one of many processes: as rospy names it
            return self.log_folder / f"{name.replace('/', '_')}.log"
        return self.log_folder / f"{name.replace('/', '-')}-{self._nodes_started}.log"

    def remove_node(self, node: Node) -> None:
        """Learn that a node has ended."""
        if self.nodes.get(node.name) is node:
            del self.nodes[node.name]

    # -- looking at it -------------------------------------------------------------------------------------------

    def show(self, **options: Any) -> Any:
        """Return a picture of the graph, as the tool ``rqt_graph`` draws it.

        Options, with their defaults:
            mode='nodes_only': topics as labels; 'nodes_topics_active': connected ones as boxes; 'nodes_topics_all': all
            hide=('debug', 'dead_sinks', 'leaf_topics', 'params', 'unreachable'): what to leave out; also 'tf'; or ()
            group=('actions', 'images', 'tf'): what is drawn as one box, where topics are boxes
            namespaces=2: how deep boxes around namespaces nest; 0 draws none
            namespace='/': only these nodes: names or regular expressions with commas between, - excludes
            topics='/': only these topics, in the same form
            direction='right': or 'down'
            since=None: an earlier state; what is new since then is bold, what is gone is dashed
            highlight='': a node or topic: what it hears is blue, what hears it green, all else pale
            title=None: a caption under the picture, and the first words of its text form
        """
        return show("computation_graph", self, **options)

    def record(self) -> Recording:
        """Record from now on who calls whom, who sends what to whom, and what each of it was caused by.

        Call ``stop()`` on the result to end that, or use it in a ``with`` statement. ``%roswhy`` and ``%rossequence``
        answer from what is recorded. A graph that does not record spends nothing on it.
        """
        return self.scheduler.on_hub(self._record)

    def _record(self) -> Recording:
        self._recordings += 1
        if self.scheduler.history is None:
            self._set_history(History(self.scheduler, self.nodes))
        return Recording(self.scheduler.history, lambda: self.scheduler.on_hub(self._record_no_more))

    @property
    def recorded(self) -> Recording | None:
        """All that this graph has recorded, if it records."""
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
        """Keep the log messages of all nodes from now on; the options are those of :class:`Console`."""
        return Console(self, **options)


_default: dict[str, Graph] = {}


def default_graph() -> Graph:
    """Return the graph that ``Node(name)`` and ``rospy`` use by default; made on first use, in simulated time."""
    if "graph" not in _default:
        _default["graph"] = Graph()
    return _default["graph"]


def set_default_graph(graph: Graph | None) -> Graph | None:
    """Make ``graph`` the default one and return the one before.

    None: :func:`default_graph` makes a new one when asked.
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
