"""Finds the node, the script and the graph behind a call of a plain function such as ``rospy.loginfo``.

rospy keeps one node in the globals of a process. Here many scripts share a process, so this state is kept in
a :class:`Session`, an attribute of the script's context (or of the graph: for the main program and notebook cells);
this package has no global state. The graph and the script follow from what runs the caller; the main program's graph
is the default one.
"""

from __future__ import annotations

import atexit
import os
import sys
import weakref
from typing import TYPE_CHECKING, Any

from rosmini.core.errors import ROSInitException, ROSInterruptException
from rosmini.core.graph import Graph, Node, running_graph
from rosmini.core.graph.lanes import LaneContext
from rosmini.core.graph.rosout import LogGates
from rosmini.core.names import Remappings, canonicalize

if TYPE_CHECKING:
    from collections.abc import Callable

    from rosmini.core.graph.node import Node

_ATTRIBUTE = "_rospy_session"


class UnnamedNode(Node):
    """Calls the Master for a script without a node, for parameters and services; invisible to others."""

    def _start(self, *, has_rosout: bool) -> None:
        """Do not register: only ``init_node`` does."""

    def shutdown(self, reason: str = "", *, hooks: bool = True) -> None:
        """Do nothing: there is nothing to shut down."""


class Session:
    """The state that rospy keeps in a process: the node, requests made before it existed, and log calls."""

    def __init__(self, graph: Graph, context: LaneContext | None) -> None:
        self.graph = graph
        self.context = context
        self.node: Node | None = None
        self.arguments: tuple[Any, ...] | None = None
        self.given_argv: list[str] | None = None
        self.pending: list[Callable[[Node], None]] = []
        self.hooks: list[Callable[[], object]] = []
        self.preshutdown_hooks: list[Callable[[str], object]] = []
        self.shutdown_hooks: list[Callable[[str], object]] = []
        self.shutdown_reason: str | None = None
        self.stopped = False
        self.log_gates = LogGates()
        self.has_time: bool | None = None
        """True or False if the script has set whether the time can be read; None: it can once there is a node."""
        self.set_time_ns: int | None = None
        """The time set by the script."""
        self._unnamed: UnnamedNode | None = None
        self._armed = False

    @property
    def is_main(self) -> bool:
        """True for the main program or a notebook, False for a script run by rosmini."""
        return self.context is None

    def argv(self) -> list[str]:
        """Return the arguments that contain remappings."""
        if self.given_argv is not None:
            return self.given_argv
        remaining: Callable[[], list[str]] | None = getattr(self.context, "remaining_argv", None)
        return sys.argv if remaining is None else remaining()

    def remappings(self) -> Remappings:
        """Return the remappings of the arguments. Raises ``ROSInitException`` for an invalid argument."""
        return Remappings.from_argv(self.argv())

    def namespace(self) -> str:
        """Return the namespace of relative names."""
        given = self.remappings().namespace or canonicalize("/" + os.environ.get("ROS_NAMESPACE", ""))
        return given or "/"

    def unnamed(self) -> UnnamedNode:
        """Return the caller before ``init_node``."""
        if self._unnamed is None:
            names = Remappings(self.remappings().names)
            self._unnamed = UnnamedNode(
                "unnamed", self.graph, namespace=self.namespace(), remappings=names, context=self.context
            )
        return self._unnamed

    # -- the end -------------------------------------------------------------------------------------------------

    def arm(self) -> None:
        """Ensure that the hooks run when the script or the program ends."""
        if self._armed:
            return
        self._armed = True
        at_shutdown: list[Callable[[str], object]] | None = getattr(self.context, "at_shutdown", None)
        if at_shutdown is not None:
            at_shutdown.append(self.shutdown)
        elif not self.graph.notebook:
            reference = weakref.ref(self)

            def at_exit() -> None:
                session = reference()
                if session is not None:
                    session.shutdown("atexit")

            atexit.register(at_exit)

    def shutdown(self, reason: str) -> None:
        """Shut the node down, or record that no node may start any more."""
        if self.node is not None:
            self.node.shutdown(reason)
        elif self.shutdown_reason is None:
            self.shutdown_reason = reason
            self.run_hooks()
            self.stopped = True

    def run_hooks(self) -> None:
        """Call the shutdown hooks in the order of registration.

        If one fails, the others still run.
        """
        node = self.node or self.unnamed()
        reason = node.shutdown_reason or self.shutdown_reason or ""
        hooks, self.hooks = self.hooks, []
        before, self.preshutdown_hooks = self.preshutdown_hooks, []
        after, self.shutdown_hooks = self.shutdown_hooks, []
        for hook in hooks:
            node.guarded(hook, what="rospy.on_shutdown")
        for reasoned in (*before, *after):
            node.guarded(reasoned, reason, what="shutdown hook")

    def is_shutdown(self) -> bool:
        """Return True if the node was shut down."""
        return self.stopped if self.node is None else self.node.is_shutdown()

    def restart(self) -> None:
        """Discard a node that was shut down; in the main program, a notebook cell may be run again."""
        self.node = None
        self.arguments = None
        self.shutdown_reason = None
        self.stopped = False


def current_session() -> Session:
    """Return the session of the caller's script or program."""
    graph = running_graph()
    context = graph.scheduler.current().context
    owner: Any = graph if context is None else context
    found: Session | None = vars(owner).get(_ATTRIBUTE)
    if found is None or found.graph is not graph:
        found = Session(graph, context)
        vars(owner)[_ATTRIBUTE] = found
    return found


def current_node() -> Node | None:
    """Return the caller's node: that of its lane (in a callback, the subscriber's), or that of its script.

    Return None before ``init_node``.
    """
    node: Node | None = running_graph().scheduler.current().node
    return current_session().node if node is None else node


def any_node() -> Node:
    """Return the caller's node, or the unnamed caller before ``init_node``."""
    return current_node() or current_session().unnamed()


def answer_interrupt(node: Node, error: KeyboardInterrupt) -> BaseException:
    """Return the exception that a blocking call raises on Ctrl-C.

    In a standalone program rospy shuts the node down, unless ``init_node`` was told not to handle signals;
    in a notebook only the cell ends, and scripts run by rosmini get it from their runner.
    """
    session = current_session()
    signals = session.arguments is not None and not session.arguments[-1]
    if isinstance(error, ROSInterruptException) or not session.is_main or node.graph.notebook or not signals:
        return error
    session.shutdown("signal-2")
    return ROSInterruptException(f"ROS shutdown request: Ctrl-C ended node {node.name}")


def require_node(what: str) -> Node:
    """Return the caller's node. Raises ``ROSInitException`` before ``init_node``: ``what`` needs a node."""
    node = current_node()
    if node is None:
        raise ROSInitException(
            f"{what} needs a node, and rospy.init_node() has not been called yet. Call rospy.init_node('name') first."
        )
    return node
