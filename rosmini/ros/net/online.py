"""Connects a graph of this process, for instance in a notebook, with the ROS graph of other processes.

If a Master answers, the graph joins it; otherwise it serves its own Master at that address. Nodes get addresses that
others can reach; connections within this process stay as they are. In a notebook the graph then runs by itself. A
graph in simulated time runs no faster than real time. Unless it already has a simulator, it publishes ``/clock`` until
one starts; its own nodes stay on the graph's time.
"""

from __future__ import annotations

import concurrent.futures
import sys
import threading
import time
from typing import TYPE_CHECKING, Any

from rosmini.core.errors import MasterUnreachable, RosminiError, TransportException
from rosmini.core.graph.master import Master
from rosmini.core.graph.master_port import MasterPort

from .addresses import addresses, is_loopback
from .io_thread import IoThread, later
from .master_server import MasterServer
from .network import Network
from .remote_master import RemoteMaster, checked, patience, unreachable
from .sockets import Unreached
from .watch import Watch, register_again

if TYPE_CHECKING:
    from collections.abc import Callable, Mapping

    from rosmini.core.graph import Graph
    from rosmini.core.graph.event_queue import Timer
    from rosmini.core.graph.transport import Triple

    from .addresses import Addresses

CLOCK_HZ = 100.0
"""Rate at which the time is published [Hz]."""

CLOCK_NODE = "rosmini_clock"
CLOCK = "/clock"
USE_SIM_TIME = "/use_sim_time"
ROSCORE = ("/rosdistro", "/rosversion", "/run_id")
"""Parameters that each Master sets itself."""

LAG_NS = 100_000_000
"""Maximum delay that is made up for by running faster [ns]; after a longer one, time continues from there."""

PERIOD_NS = 10_000_000
"""Interval at which simulated and real time are compared [ns]."""


class _StandingStill(MasterPort):
    """A Master elsewhere, called while the graph does not run: when joining and leaving."""

    keeps_trying = False

    def __init__(self, uri: str, network: Network) -> None:
        self.uri = uri
        self._network = network

    def call(self, method: str, caller_id: str, *arguments: Any) -> Triple:
        """Return the Master's answer; blocks everything else. Raises ``MasterUnreachable``."""
        asked = self._network.io.start(
            self._network.client.request(self.uri, method, (caller_id, *arguments), patience(method))
        )
        try:
            answer = asked.result()
        except concurrent.futures.CancelledError:
            raise MasterUnreachable("the network of this graph was closed") from None
        except TransportException as error:
            raise unreachable(self.uri, error) from error
        return checked(self.uri, method, answer)


class Pace:
    """Stops a graph's time, while data from the network is processed, until real time has caught up.

    So other processes can keep up. A live graph keeps its own pace.
    """

    def __init__(self, graph: Graph, io: IoThread) -> None:
        self._graph = graph
        self._scheduler = graph.scheduler
        self._io = io
        self._lock = threading.Lock()
        self._holds = False
        self._conditions: list[Callable[[], bool]] = []
        self._timer: Timer | None = None

    def keep(self, condition: Callable[[], bool]) -> None:
        """Limit the graph's time to real time while ``condition()`` is true. Only from the scheduler's thread."""
        if not self._conditions:
            self._begin()
        self._conditions.append(condition)
        if self._timer is None:
            self._next()

    def _begin(self) -> None:
        self._graph_ns, self._wall_ns = self._scheduler.now_ns(), time.perf_counter_ns()

    def _next(self) -> None:
        self._timer = self._scheduler.call_at(self._scheduler.now_ns() + PERIOD_NS, self._compare)

    def _compare(self) -> None:
        self._conditions = [condition for condition in self._conditions if condition()]
        if not self._conditions:
            self._timer = None
            return
        self._next()
        if not self._graph.is_live:
            self._wait()

    def _wait(self) -> None:
        """Stop the time if it is ahead."""
        passed = time.perf_counter_ns() - self._wall_ns
        ahead = self._scheduler.now_ns() - self._graph_ns - passed
        if ahead < -LAG_NS:
            self._begin()
        elif ahead > 0 and not self._holds:
            self._holds = True
            self._scheduler.hold()
            later(self._io.loop, ahead / 1e9, self._release)

    def end(self) -> None:
        """Stop comparing, and release the time. Only from the scheduler's thread."""
        self._conditions.clear()
        if self._timer is not None:
            self._timer.cancel()
            self._timer = None
        self._release()

    def _release(self) -> None:
        """Release the time; may be called repeatedly and from any thread."""
        with self._lock:
            held, self._holds = self._holds, False
        if held:
            self._scheduler.release()


def _is_absent(error: MasterUnreachable) -> bool:
    """Return True if no process listens at the Master's address, unlike a Master that hangs, or another server."""
    cause = error.__cause__
    return isinstance(cause, Unreached) and not isinstance(cause.__cause__, TimeoutError)


def online(
    graph: Graph, master_uri: str | None = None, environ: Mapping[str, str] | None = None, *, live: bool = True
) -> Online:
    """Connect a graph with others; see :meth:`Graph.online <rosmini.core.graph.graph.Graph.online>`."""
    where = addresses(environ, {"__master": master_uri} if master_uri else None, any_port=True)
    return Online(graph, where, live=live)


class Online:
    """A graph's membership in the ROS graph of other processes, from ``graph.online()`` to ``graph.offline()``."""

    def __init__(self, graph: Graph, where: Addresses, *, live: bool = True) -> None:
        if not isinstance(graph.master, Master):
            raise RosminiError(f"this graph has its Master elsewhere already, at {graph.master_uri}")
        self.graph = graph
        self.where = where
        self.network = Network(graph.scheduler, where)
        self.joined = False
        """True if the Master belongs to another process."""
        self._own = graph.master
        self.server: MasterServer | None = None
        """Server of this graph's Master; None if the graph has joined another one."""
        self._pace = Pace(graph, self.network.io)
        self._is_live_of_ours = False
        self._had_rosout = False
        try:
            self._find_master()
        except BaseException:
            self.network.close()
            raise
        self._move(self.graph.transport.add)
        try:
            if self.joined:
                self._join()
            if live and graph.simulated:
                self.keep_pace(lambda: True)
                self._begin_clock()
        except MasterUnreachable as error:  # it hangs since it was found, or has gone
            self.end()
            raise MasterUnreachable(f"{error}. This graph is offline again, as before") from error
        if live:
            self._go_on()
        for line in where.notes:
            sys.stderr.write(f"rosmini: {line}\n")

    # -- going online --------------------------------------------------------------------------------------------

    def _find_master(self) -> None:
        """Find a Master that answers, or serve our own: at port 0 at once, since no Master can be there."""
        uri = self.where.master_uri
        host, port = self.where.master
        if not port:
            self._serve(port)
            return
        try:
            _StandingStill(uri, self.network).call("getPid", "/rosmini")
        except MasterUnreachable as error:
            if not _is_absent(error):
                raise
            if not is_loopback(host) and host != self.where.host:
                raise MasterUnreachable(
                    f"{error}. If {host} is this machine, set ROS_IP or ROS_HOSTNAME to {host}: then the Master of "
                    "this graph is served there"
                ) from error
            self._serve(port)
        else:
            self.joined = True

    def _serve(self, port: int) -> None:
        self.server = MasterServer(self.network.io, self._own, self.where, port, warn=self.network.warn)

    def _move(self, change: Any) -> None:
        """Give all nodes the addresses of the current transports."""
        graph = self.graph
        nodes = {node.uri: node for node in graph.nodes.values()}
        moved: dict[str, str] = change(self.network.transport, nodes)
        for old, node in nodes.items():
            node.uri = moved[old]
            node.master.update_addresses(moved)
        for node in nodes.values():
            for subscription in node.subscriptions.values():
                subscription.publishers_moved(moved)
        self._own.move(moved)

    def _join(self) -> None:
        graph = self.graph
        rosout = graph.nodes.get("/rosout")
        self._had_rosout = rosout is not None
        if rosout is not None:
            rosout.shutdown("the Master that this graph joins has its own")
        still = _StandingStill(self.where.master_uri, self.network)
        for name in self._own.getParamNames("/rosmini")[2]:
            if name not in ROSCORE:
                still.call("setParam", "/rosmini", name, self._own.getParam("/rosmini", name)[2])
        self._own.forget_nodes()
        graph.master = still
        for node in list(graph.nodes.values()):
            register_again(node)
        client = self.network.client
        watch = Watch(graph, still.uri, self.network.io, client)
        graph.master = RemoteMaster(still.uri, client, watch)
        watch.begin()

    def _begin_clock(self) -> None:
        """Publish the graph's time, unless a node publishes the time already."""
        graph = self.graph
        port = graph.master if self.server is not None else _StandingStill(graph.master_uri, self.network)
        if CLOCK in (name for name, _ in port.call("getPublishedTopics", "/rosmini", "")[2]):
            return
        graph.clock_node = f"/{CLOCK_NODE}"
        node = graph.node(CLOCK_NODE)
        port.call("setParam", node.name, USE_SIM_TIME, True)
        publisher = node.publisher(CLOCK, graph.clock_class, queue_size=1)

        def tell_time(_: Any) -> None:
            if not graph.keeps_time:  # a simulator or a bag player has started
                graph.clock_node = None
                node.shutdown(f"another node publishes {CLOCK}")
            elif publisher.num_connections():
                publisher.publish(clock=graph.now())

        node.timer(1 / CLOCK_HZ, tell_time)

    def keep_pace(self, condition: Callable[[], bool]) -> None:
        """Limit simulated time to real time while ``condition()`` is true; has no effect in wall-clock time."""
        if self.graph.simulated:
            self._pace.keep(condition)

    def _go_on(self) -> None:
        """Run the graph in the background of a notebook."""
        if self.graph.notebook and not self.graph.is_live:
            self.graph.live()
            self._is_live_of_ours = True

    # -- going offline -------------------------------------------------------------------------------------------

    def end(self) -> None:
        """Disconnect from other processes; nodes of this process continue among themselves."""
        graph = self.graph
        port: MasterPort = _StandingStill(self.where.master_uri, self.network) if self.joined else self._own
        if self._is_live_of_ours and graph._live is not None:  # noqa: SLF001
            graph._live.stop()  # noqa: SLF001
        if self.joined:
            graph.master = port
        self._pace.end()
        clock = graph.nodes.get(graph.clock_node or "")
        graph.clock_node = None
        if clock is not None:
            clock.shutdown("the graph goes offline")
            self._ask(port, "deleteParam", "/rosmini", USE_SIM_TIME)
        if self.joined:
            for node in graph.nodes.values():
                self._leave(port, node)
        graph.master = self._own
        self._close_connections()
        self._move(graph.transport.remove)
        if self.server is not None:
            self.server.close()
        if self.joined:
            for node in list(graph.nodes.values()):
                register_again(node)
            if self._had_rosout and not graph.closing:
                graph.start_rosout()
        self.network.close()

    def _leave(self, port: MasterPort, node: Any) -> None:
        services_at = self.graph.transport.service_uri(node.uri)
        for name in node.services:
            self._ask(port, "unregisterService", node.name, name, services_at)
        for topic in node.subscriptions:
            self._ask(port, "unregisterSubscriber", node.name, topic, node.uri)
        for topic in node.publications:
            self._ask(port, "unregisterPublisher", node.name, topic, node.uri)

    def _ask(self, port: MasterPort, method: str, *arguments: Any) -> None:
        """Call the Master, unless an earlier call was not answered."""
        if port.leave_by is None:
            try:
                port.call(method, *arguments)
            except MasterUnreachable:
                port.leave_by = 0

    def _close_connections(self) -> None:
        """Close the connections with nodes elsewhere; only those within this process remain."""
        protocol = self.network.transport.protocol
        for node in self.graph.nodes.values():
            for publication in node.publications.values():
                for number, sender in list(publication.senders.items()):
                    if sender.protocol == protocol:
                        publication.remove(number)
                        sender.close()
            for subscription in node.subscriptions.values():
                for connection in list(subscription.connections.values()):
                    if connection.protocol == protocol:
                        subscription.forget(connection)
                        connection.close()
