"""A graph: one scheduler, one Master, and the nodes of one process."""

from __future__ import annotations

import sys
import zlib
from functools import partial
from typing import TYPE_CHECKING, Any

from rosmini.errors import RosminiError, UnknownPackage, UnknownType
from rosmini.msgs import message_class, service_class
from rosmini.names import AnonymousNames
from rosmini.time import Time

from .console import Console
from .event_queue import span_ns
from .lanes import Lane, Waiter
from .log_file import log_folder
from .master import Master
from .node import Node
from .notebook import kernel_shell
from .notices import Notices
from .report import RunReport
from .rosout import LEVELS
from .scheduler import Scheduler
from .show import show
from .transport import LocalTransport

if TYPE_CHECKING:
    from collections.abc import Callable
    from pathlib import Path
    from types import TracebackType
    from typing import Self

    import numpy as np

    from .live import LiveDrive
    from .transport import Header, Transport


ROSCORE_PARAMETERS = {
    "/rosdistro": "noetic\n",
    "/rosversion": "1.16.0\n",
    "/run_id": "00000000-0000-0000-0000-000000000001",
}
"""What ``roscore`` sets; its run id is random, ours is not."""


class Graph:
    """A ROS computation graph in this process.

    Args:
        simulated: simulated time, which jumps from event to event (the default), or wall time.
        rate: in wall time, how many seconds of graph time pass in one second.
        seed: what random numbers of this graph start from; see :meth:`rng`.
        strict: raise an exception that a callback lets out at the call that drives the graph; else log it, as ROS does.
        transport: makes the transport from the scheduler; in-process hand-over if not given.
        rosout: run the node ``/rosout``, which ``roscore`` starts.
        log_dir: write a log file for each node, ``<log_dir>/<run_id>/<node>-<number>.log``; if not given, the folder that the environment variable
            ``ROS_LOG_DIR`` names, and no files if there is none. A graph writes its files anew.

    Only the graph's creator drives it, with :meth:`run` or by any call that blocks.

    """

    def __init__(
        self,
        *,
        simulated: bool = True,
        rate: float = 1.0,
        seed: int = 0,
        strict: bool = True,
        transport: Callable[[Scheduler], Transport] | None = None,
        rosout: bool = True,
        log_dir: str | Path | None = None,
    ) -> None:
        self.scheduler = Scheduler(simulated=simulated, rate=rate)
        self.scheduler.on_error = self._lane_failed
        self.simulated = simulated
        self.seed = seed
        self.strict = strict
        self.notebook = kernel_shell() is not None
        if self.notebook:
            self.scheduler.ask_driver = self._run_errand
        self.master_uri = "http://localhost:11311/"
        self.master = Master(self.master_uri, Notices(self))
        self.transport: Transport = (transport or LocalTransport)(self.scheduler)
        self.nodes: dict[str, Node] = {}
        self.closing = False
        """True while the whole graph shuts down."""
        self.log_class = message_class("rosgraph_msgs/Log")
        self.clock_class = message_class("rosgraph_msgs/Clock")
        self._by_uri: dict[str, Node] = {}
        self._live: LiveDrive | None = None
        self._anonymous = AnonymousNames()
        self._watched: list[tuple[Callable[[], bool], Waiter]] = []
        self._check_queued = False
        for key, value in ROSCORE_PARAMETERS.items():
            self.master.setParam("/roscore", key, value)
        self.log_folder = log_folder(log_dir, ROSCORE_PARAMETERS["/run_id"])
        """Where the log files are, if there are any."""
        self._nodes_started = 0
        if rosout:
            self._start_rosout()

    def __repr__(self) -> str:
        kind = "simulated" if self.simulated else "wall"
        return f"<Graph with {len(self.nodes)} nodes in {kind} time>"

    def __enter__(self) -> Self:
        return self

    def __exit__(
        self, kind: type[BaseException] | None, value: BaseException | None, trace: TracebackType | None
    ) -> None:
        self.shutdown("the graph was closed")

    def _start_rosout(self) -> None:
        node = Node("rosout", self)
        aggregate = node.publisher("/rosout_agg", self.log_class, queue_size=None)

        def pass_on(message: Any) -> None:
            if not node.is_shutdown():  # the last words of others may still be on their way then
                aggregate.publish(message)

        node.subscriber("/rosout", self.log_class, pass_on)

    # -- driving -------------------------------------------------------------------------------------------------

    def now(self) -> Time:
        """Return the graph's time."""
        return Time.from_nsec(self.scheduler.now_ns())

    def run(self, duration: float | None = None, until: Callable[[], bool] | None = None) -> RunReport:
        """Let the graph go on for ``duration`` seconds of its time, until ``until()`` holds, or until nothing is left to happen.

        What a callback raises is raised here when the graph is strict. Ctrl-C stops the drive and leaves the graph in order. Raises
        ``RosminiError`` for a duration that is no number of seconds from zero on.
        """
        until_ns = (
            None if duration is None else self.scheduler.now_ns() + span_ns(duration, "a run's duration")
        )
        return self.scheduler.run(until_ns, until)

    def live(self, rate: float = 1.0) -> LiveDrive:
        """Let the graph go on by itself in a notebook, ``rate`` seconds of its time a second, while cells and widgets talk to it.

        Call ``stop()`` on the result to end that. Raises ``RosminiError`` where no event loop runs: use :meth:`run` in a program.
        """
        from .live import LiveDrive
        from .notebook import kernel_loop

        loop = kernel_loop()
        if self._live is not None:
            self._live.stop()
        self._live = LiveDrive(self, loop, rate=rate)
        return self._live

    @property
    def is_live(self) -> bool:
        """True while the graph goes on by itself after :meth:`live`."""
        return self._live is not None and self._live.running

    def _run_errand(self, waiter: Waiter) -> Callable[[], None]:
        from .live import Errand

        return Errand(self, waiter).complain

    def node(self, name: str, **options: Any) -> Node:
        """Start a node; the options are those of :class:`Node`."""
        return Node(name, self, **options)

    def shutdown(self, reason: str = "") -> None:
        """Shut every node down, newest first, and end what still blocks. The graph is empty then, and may be used again."""
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
            steps.append(lambda: scheduler.run(until_ns=scheduler.now_ns()))
        problems: list[Exception] = []
        for step in [*steps, scheduler.close]:
            try:
                step()
            except Exception as error:  # what one node does at its end must not keep another up
                problems.append(error)
        self.closing = False
        for problem in problems[1:]:
            self.report(problem, None, raise_strict=False)
        if problems:
            raise problems[0]

    def rng(self, name: str) -> np.random.Generator:
        """Return a random generator of its own for ``name``: the same on each run, and whoever else draws from another."""
        import numpy as np

        return np.random.default_rng([self.seed, zlib.crc32(name.encode())])

    def show(self, **options: Any) -> Any:
        """Return a picture of the graph, as the tool ``rqt_graph`` draws it.

        Options, with what they are unless given:
            mode='nodes_only': a topic is a label between nodes; 'nodes_topics_active': a box, if it is connected; 'nodes_topics_all': a box in any case
            hide=('debug', 'dead_sinks', 'leaf_topics', 'params', 'unreachable'): what is left out; 'tf' is possible, too, and () leaves nothing out
            group=('actions', 'images', 'tf'): what is drawn as one box, where topics are boxes
            namespaces=2: how deep boxes around namespaces nest; 0 draws none
            namespace='/': only these nodes: names or regular expressions with commas between, - excludes
            topics='/': only these topics, in the same form
            direction='right': or 'down'
            title=None: a caption under the picture, and the first words of its text form
        """
        return show("computation_graph", self, **options)

    def console(self, **options: Any) -> Console:
        """Keep the log messages of all nodes from now on; the options are those of :class:`Console`."""
        return Console(self, **options)

    @property
    def unreachable(self) -> tuple[str, ...]:
        """The nodes that the Master knows and that do not answer: they ended without a word."""
        state = self.master.getSystemState("/graph")[2]
        names = dict.fromkeys(name for part in state for _, holders in part for name in holders)
        return tuple(name for name in names if self.master.lookupNode("/graph", name)[2] not in self._by_uri)

    # -- errors --------------------------------------------------------------------------------------------------

    def report(self, error: BaseException, node: Node | None, *, raise_strict: bool = True) -> None:
        """Tell the user of a problem: raised where the graph is driven if it is strict, and logged if not."""
        if self.strict and raise_strict and self.scheduler.raise_in_driver(error):
            return
        if node is not None:
            node.logerr(error)
        else:
            sys.stderr.write(f"[ERROR] {error}\n")

    def _lane_failed(self, lane: Lane, error: BaseException) -> None:
        self.report(error, lane.node)

    # -- nodes ---------------------------------------------------------------------------------------------------

    def add_node(self, node: Node) -> None:
        """Learn of a new node; an older one of its name hears from the Master at the new one's first registration."""
        self.nodes[node.name] = node
        self._by_uri[node.uri] = node
        self._nodes_started += 1
        if self.log_folder is not None:
            base = node.name.lstrip("/").replace("/", "-")
            node.logger.open_file(self.log_folder / f"{base}-{self._nodes_started}.log")

    def remove_node(self, node: Node) -> None:
        """Learn that a node has ended."""
        if self.nodes.get(node.name) is node:
            del self.nodes[node.name]
        self._by_uri.pop(node.uri, None)
        node.logger.close_file()
        self.changed()

    def anonymous_name(self, base: str) -> str:
        """Return ``base`` with a number and a time that make it unique: the same on each run in simulated time."""
        return self._anonymous.make(base, self.scheduler.now_ns())

    def node_name_of(self, uri: str) -> str:
        """Return the name of the node at a slave API's URI, or the URI when it is not in this process."""
        node = self._by_uri.get(uri)
        return uri if node is None else node.name

    def publisher_class(self, uri: str, topic: str) -> Any:
        """Return the type with which the node at ``uri`` publishes ``topic``, if it is in this process."""
        node = self._by_uri.get(uri)
        publication = None if node is None else node.publications.get(topic)
        return None if publication is None else publication.message_class

    def service_class_at(self, uri: str, service: str) -> Any:
        """Return the type of a service in this process."""
        for node in self.nodes.values():
            if node.services.get(service) and self.transport.service_uri(node.uri) == uri:
                return node.services[service].service_class
        return None

    def who_publishes(self, topic: str) -> str:
        """Return a clause that says who publishes a topic."""
        publishers = [names for name, names in self.master.getSystemState("/graph")[2][0] if name == topic]
        return f"{', '.join(publishers[0])} publishes it" if publishers else "nobody publishes it"

    def quiet_topic(self, topic: str) -> bool:
        """Tell whether messages on a topic may go unheard without a word."""
        return topic == "/rosout_agg"

    def type_of_header(self, header: Header, default: Any) -> Any:
        """Return the class of what a connection carries, for subscribers that take any type; ``default`` if it is not known here."""
        try:
            return message_class(header["type"]) if "type" in header else default
        except (UnknownType, UnknownPackage):
            return default

    # -- conditions ----------------------------------------------------------------------------------------------

    def watch(self, condition: Callable[[], bool], waiter: Waiter) -> None:
        """Wake ``waiter`` as soon as ``condition()`` holds; it is looked at whenever the graph changes."""
        if condition():
            waiter.wake()
        else:
            self._watched.append((condition, waiter))

    def changed(self) -> None:
        """Learn that registrations or connections changed."""
        if self._watched and not self._check_queued:
            self._check_queued = True
            self.scheduler.call_soon(self._check)

    def _check(self) -> None:
        self._check_queued = False
        still = []
        for condition, waiter in self._watched:
            if waiter.done:
                continue
            if condition():
                waiter.wake()
            else:
                still.append((condition, waiter))
        self._watched = still

    # -- services that every node offers -------------------------------------------------------------------------

    def offer_logger_services(self, node: Node) -> None:
        """Offer ``~get_loggers`` and ``~set_logger_level``."""
        get_loggers = service_class("roscpp/GetLoggers")
        set_level = service_class("roscpp/SetLoggerLevel")
        logger_class = message_class("roscpp/Logger")

        def listing(_: Any) -> Any:
            return {
                "loggers": [logger_class(name=name, level=level) for name, level in node.logger.listing()]
            }

        def change(request: Any) -> Any:
            if request.level.upper() not in LEVELS:
                msg = f"no level {request.level!r}: use one of {', '.join(LEVELS)}"
                raise RosminiError(msg)
            node.logger.set_level(request.logger, request.level)
            return {}

        node.service("~get_loggers", get_loggers, listing)
        node.service("~set_logger_level", set_level, change)


_default: dict[str, Graph] = {}


def default_graph() -> Graph:
    """Return the graph that ``Node(name)`` and ``rospy`` use when none is given; made on first use, in simulated time."""
    if "graph" not in _default:
        _default["graph"] = Graph()
    return _default["graph"]


def set_default_graph(graph: Graph | None) -> Graph | None:
    """Make ``graph`` the default one and return what was it before; None: :func:`default_graph` makes a new one when asked."""
    before = _default.pop("graph", None)
    if graph is not None:
        _default["graph"] = graph
    return before
