"""Whose rospy call it is: the node, the script and the graph behind a plain function like ``rospy.loginfo``.

rospy keeps one node in the globals of a process. Here many scripts share a process, so what rospy would keep there is
a :class:`Session`, an attribute of the script's context (or of the graph, for the main program and notebook cells);
this package has no state of its own. What runs the caller says which graph and which script; the main program's graph
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
from rosmini.core.graph.log_gates import LogGates
from rosmini.core.names import Remappings, canonicalize

if TYPE_CHECKING:
    from collections.abc import Callable

    from rosmini.core.graph.node_port import NodePort

_ATTRIBUTE = "_rospy_session"


class UnnamedNode(Node):
    """Asks the Master for things in the name of a script without a node: parameters, services. Nobody else sees it."""

    def _start(self, *, has_rosout: bool) -> None:
        """Register nothing: only ``init_node`` does."""

    def shutdown(self, reason: str = "", *, hooks: bool = True) -> None:
        """Do nothing: there is nothing to shut down."""


class Session:
    """What rospy would keep in a process: the node, what was asked for before there was one, and what was logged."""

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
        """Whether the time may be read, if the script has said so; else it may be when there is a node."""
        self.set_time_ns: int | None = None
        """The time that the script has set itself."""
        self._unnamed: UnnamedNode | None = None
        self._armed = False

    @property
    def is_main(self) -> bool:
        """True for the main program or a notebook, false for a script run by rosmini."""
        return self.context is None

    def argv(self) -> list[str]:
        """Return the arguments that rospy reads remappings from."""
        if self.given_argv is not None:
            return self.given_argv
        remaining: Callable[[], list[str]] | None = getattr(self.context, "remaining_argv", None)
        return sys.argv if remaining is None else remaining()

    def remappings(self) -> Remappings:
        """Return what the arguments remap. Raises ``ROSInitException`` for a bad argument."""
        return Remappings.from_argv(self.argv())

    def namespace(self) -> str:
        """Return the namespace in which relative names start."""
        given = self.remappings().namespace or canonicalize("/" + os.environ.get("ROS_NAMESPACE", ""))
        return given or "/"

    def unnamed(self) -> UnnamedNode:
        """Return who calls before ``init_node``."""
        if self._unnamed is None:
            names = Remappings(self.remappings().names)
            self._unnamed = UnnamedNode(
                "unnamed", self.graph, namespace=self.namespace(), remappings=names, context=self.context
            )
        return self._unnamed

    # -- the end -------------------------------------------------------------------------------------------------

    def arm(self) -> None:
        """See to it that the hooks run when the script, or the program, ends."""
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
        """Shut the node down, or note that there is to be none any more."""
        if self.node is not None:
            self.node.shutdown(reason)
        elif self.shutdown_reason is None:
            self.shutdown_reason = reason
            self.run_hooks()
            self.stopped = True

    def run_hooks(self) -> None:
        """Call the shutdown hooks, in the order in which they came.

        One that fails does not keep the others from running.
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
        """Return whether the node was shut down."""
        return self.stopped if self.node is None else self.node.is_shutdown()

    def restart(self) -> None:
        """Forget a node that was shut down. For the main program: a notebook's cell may be run again."""
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
    """Return the caller's node: that of its lane (a callback's is the subscriber's), else that of its script.

    None before ``init_node``.
    """
    node: Node | None = running_graph().scheduler.current().node
    return current_session().node if node is None else node


def any_node() -> Node:
    """Return the caller's node, or the unnamed caller before ``init_node``."""
    return current_node() or current_session().unnamed()


def answer_interrupt(node: NodePort, error: KeyboardInterrupt) -> BaseException:
    """Return what a blocking call raises at Ctrl-C.

    In a program of its own rospy answers it by shutting the node down, unless ``init_node`` was told to leave signals
    alone; in a notebook it ends the cell and nothing else, and scripts run by rosmini get it from their runner.
    """
    session = current_session()
    signals = session.arguments is not None and not session.arguments[-1]
    if isinstance(error, ROSInterruptException) or not session.is_main or node.graph.notebook or not signals:
        return error
    session.shutdown("signal-2")
    return ROSInterruptException(f"ROS shutdown request: Ctrl-C ended node {node.name}")


def require_node(what: str) -> Node:
    """Return the caller's node. Raises ``ROSInitException`` before ``init_node``, saying that ``what`` needs one."""
    node = current_node()
    if node is None:
        raise ROSInitException(
            f"{what} needs a node, and rospy.init_node() has not been called yet. Call rospy.init_node('name') first."
        )
    return node
