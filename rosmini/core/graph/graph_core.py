"""What every node needs of its graph: the scheduler, the port to the Master, the transport, and where errors go."""

from __future__ import annotations

import os
import sys
import zlib
from abc import ABC, abstractmethod
from typing import TYPE_CHECKING, Any, Protocol

from rosmini.core.errors import TransportException
from rosmini.core.names import AnonymousNames
from rosmini.core.time import Time
from rosmini.msgs import message_class

from .event_queue import span_ns
from .log_file import log_folder
from .master import Master
from .master_port import MasterPort, MasterProxy
from .notebook import kernel_shell
from .notices import Changes, Notices
from .observers.faults import Gates
from .scheduler import Scheduler
from .transport import Transports

if TYPE_CHECKING:
    from collections.abc import Callable, Sequence
    from pathlib import Path

    import numpy as np

    from .connection import Connection, Observer
    from .lanes import Lane
    from .report import RunReport
    from .transport import Transport


MASTER_URI = "http://localhost:11311/"

ROSCORE_PARAMETERS = {
    "/rosdistro": "noetic\n",
    "/rosversion": "1.16.0\n",
    "/run_id": "00000000-0000-0000-0000-000000000001",
}
"""What ``roscore`` sets; its run id is random, that of a graph is not unless it is given one."""


class Drive(Protocol):
    """What lets a graph go on by itself."""

    running: bool

    def stop(self) -> None:
        """Let the graph stand still again."""


class GraphCore(ABC):
    """The part of a :class:`~rosmini.core.graph.graph.Graph` that its nodes know; the arguments are described there."""

    def __init__(
        self,
        *,
        simulated: bool,
        rate: float,
        seed: int,
        strict: bool,
        transports: Sequence[Callable[[Scheduler], Transport]],
        log_dir: str | Path | None,
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
        self.nodes: dict[str, Any] = {}
        """The nodes in this process, by name."""
        self.gates = Gates(self.scheduler)
        """What messages have to pass on their way to subscribers."""
        self.closing = False
        """True while the whole graph shuts down."""
        self.log_class = message_class("rosgraph_msgs/Log")
        self.clock_class = message_class("rosgraph_msgs/Clock")
        self._live: Drive | None = None
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

    @abstractmethod
    def node(self, name: str, **options: Any) -> Any:
        """Start a node."""

    @abstractmethod
    def live(self, rate: float = 1.0) -> Drive:
        """Let the graph go on by itself in a notebook."""

    @abstractmethod
    def add_node(self, node: Any) -> Path | None:
        """Learn of a new node; return where its log file is to be, if it has one."""

    @abstractmethod
    def remove_node(self, node: Any) -> None:
        """Learn that a node has ended."""

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
