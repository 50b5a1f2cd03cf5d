"""Checks periodically if the Master still knows the nodes of this process.

A restarted Master has forgotten everything. Nodes of real ROS do not notice; rosmini's log it once and
register again. A node also learns that another one has taken its name if the Master's notice did not reach it.
"""

from __future__ import annotations

import asyncio
from functools import partial
from typing import TYPE_CHECKING, Any, NamedTuple

from rosmini.core.errors import MasterUnreachable, ROSException, TransportException

from .remote_master import checked

if TYPE_CHECKING:
    from concurrent.futures import Future

    from rosmini.core.graph import Graph, Node
    from rosmini.core.graph.transport import Triple

    from .io_thread import IoThread
    from .xmlrpc_client import XmlRpcClient

PERIOD_S = 2.0
"""Period of the checks, in wall-clock time [s]."""

TIMEOUT_S = 5.0
"""Timeout of a check [s]."""


class _Seen(NamedTuple):
    """A node, and its address when it was checked."""

    node: Node
    uri: str


class Watch:
    """Watches the Master at ``uri`` for the nodes of ``graph``; starts with the first registration."""

    def __init__(self, graph: Graph, uri: str, io: IoThread, client: XmlRpcClient) -> None:
        self._graph = graph
        self._uri = uri
        self._io = io
        self._client = client
        self._task: Future[None] | None = None
        self._turn = 0
        self._pid: int | None = None
        self._is_lost = False
        self._forgotten: dict[str, int] = {}
        """Number of consecutive checks in which the Master did not know a node."""

    def begin(self) -> None:
        """Start watching; may be called repeatedly."""
        if self._task is None or self._task.done():
            self._is_lost, self._pid = False, None
            self._task = self._io.start(self._run())

    def end(self) -> None:
        """Stop watching; may be called repeatedly."""
        if self._task is not None:
            self._task.cancel()

    # -- in the loop's thread ------------------------------------------------------------------------------------

    async def _run(self) -> None:
        scheduler = self._graph.scheduler
        while True:
            await asyncio.sleep(PERIOD_S)
            nodes = await self._io.submit(scheduler, self._nodes)
            if nodes:
                await self._look(nodes)

    async def _look(self, nodes: list[_Seen]) -> None:
        """Check if it is the same Master, and check one node, a different one each time."""
        self._turn += 1
        chosen = nodes[self._turn % len(nodes)]
        scheduler = self._graph.scheduler
        try:
            pid = (await self._ask("getPid", chosen.node.name))[2]
            code, _, uri = await self._ask("lookupNode", chosen.node.name, chosen.node.name)
        except (TransportException, MasterUnreachable) as error:
            if not self._is_lost:
                self._is_lost = True
                scheduler.call_soon_threadsafe(partial(self._say_lost, error))
            return
        if code == 1:
            self._forgotten.pop(chosen.node.name, None)
        is_new = self._is_lost or self._pid not in (None, pid)
        self._is_lost, self._pid = False, pid
        if is_new:
            await self._io.submit(scheduler, partial(self._register_again, nodes, "is back"))
        elif code != 1 and self._may_register(chosen):
            await self._io.submit(scheduler, partial(self._register_again, [chosen], "has forgotten"))
        elif code == 1 and uri != chosen.uri:
            await self._io.submit(scheduler, partial(self._end_replaced, chosen))

    def _may_register(self, seen: _Seen) -> bool:
        """Return True if an unknown node is to be registered again: less and less often if that has no effect."""
        count = self._forgotten[seen.node.name] = self._forgotten.get(seen.node.name, 0) + 1
        return count & (count - 1) == 0

    async def _ask(self, method: str, caller_id: str, *arguments: Any) -> Triple:
        answer = await self._client.request(self._uri, method, (caller_id, *arguments), TIMEOUT_S)
        return checked(self._uri, method, answer)

    # -- in the scheduler's thread -------------------------------------------------------------------------------

    def _nodes(self) -> list[_Seen]:
        """Return the running, registered nodes; for a starting one, the Master may have a killed one's address."""
        return [
            _Seen(node, node.uri)
            for node in self._graph.nodes.values()
            if node.shutdown_reason is None and node.is_registered
        ]

    def _say_lost(self, error: Exception) -> None:
        self._say(
            f"the Master at {self._uri} does not answer any more: {error}. Connections stay; this process registers "
            "again when it is back.",
            [seen.node for seen in self._nodes()],
        )

    def _say(self, text: str, nodes: list[Node]) -> None:
        """Log a message once, through the first of the nodes."""
        for node in nodes[:1]:
            node.spawn(f"{node.name} tells of the Master", partial(node.logwarn, text))

    def _end_replaced(self, seen: _Seen) -> None:
        """End a node whose name another one has taken."""
        if seen in self._nodes():
            seen.node.shutdown_requested("/master", f"[{seen.node.name}] Reason: new node registered with same name")

    def _register_again(self, forgotten: list[_Seen], what: str) -> None:
        present = set(self._nodes())
        nodes = [seen.node for seen in forgotten if seen in present]
        for node in nodes:
            node.spawn(f"{node.name} registers again", partial(_register, node))
        names = ", ".join(node.name for node in nodes)
        self._say(f"the Master at {self._uri} {what}: {names} registers again", nodes)


def register_again(node: Node) -> None:
    """Register the publishers, subscribers and services of a node.

    It may park the calling lane, and retries while the Master does not answer and the node runs. Raises
    ``ROSException`` if the Master refuses.
    """
    master, warn = node.master, node.logerr
    for topic, publication in list(node.publications.items()):
        if node.publications.get(topic) is publication and node.shutdown_reason is None:
            master.register("registerPublisher", topic, publication.message_class._type, node.uri, warn=warn)
    for topic, subscription in list(node.subscriptions.items()):
        if node.subscriptions.get(topic) is not subscription or node.shutdown_reason is not None:
            continue
        before = subscription.updates
        uris = master.register("registerSubscriber", topic, subscription.message_class._type, node.uri, warn=warn)
        if subscription.updates == before and node.subscriptions.get(topic) is subscription:
            subscription.update_publishers(uris)
    services_at = node.graph.transport.service_uri(node.uri)
    for name, server in list(node.services.items()):
        if node.services.get(name) is server and node.shutdown_reason is None:
            master.register("registerService", name, services_at, node.uri, warn=warn)


def _register(node: Node) -> None:
    try:
        register_again(node)
    except MasterUnreachable:
        return  # it has ended meanwhile
    except ROSException as error:
        node.logerr(error)
