"""Handle of a built-in node, which may be started several times.

A built-in node is an entry point of the group `rosmini.nodes`: a callable that takes the started
``Node`` (and the arguments other than remappings, as strings), sets itself up, and returns the
object that owns the node's topics, services and timers. It may block meanwhile, for instance to wait for a service.
"""

from __future__ import annotations

import inspect
import os
from dataclasses import dataclass
from typing import TYPE_CHECKING, Any

from rosmini.core.errors import ROSException, ROSInterruptException, ScriptError
from rosmini.core.graph import Graph, LaneExit, Node
from rosmini.core.names import Remappings

from .environment import OwnEnviron
from .handle import LaneHandle
from .streams import OwnStreams

if TYPE_CHECKING:
    import signal
    from collections.abc import Callable, Sequence

    from rosmini.core.graph.lanes import Waiter
    from rosmini.core.packages import Executable

    from .console import Console


PATIENCE = 60.0
"""Maximum wait of ``instance()`` for the set-up of a node [s of graph time]."""


@dataclass(frozen=True)
class NodeSpec:
    """A built-in node to run, with its ROS arguments; ``environ`` are changes to its environment."""

    executable: Executable
    args: tuple[str, ...] = ()
    environ: tuple[tuple[str, str], ...] = ()


class NodeHandle(LaneHandle):
    """A built-in node of a graph; see :class:`~rosmini.ros.scripts.handle.Handle`.

    It ends when its node is shut down. Its exit status is the ``exit_status`` of its object, if there is one, else 0,
    or 1 if the set-up failed.

    Raises ``ScriptError`` if the node does not accept these arguments.
    """

    def __init__(
        self, graph: Graph, spec: NodeSpec, console: Callable[[], Console], *, owns_console: bool = True
    ) -> None:
        super().__init__(graph, spec.args, console, owns_console=owns_console)
        self.executable = spec.executable
        self._changes = spec.environ
        self._entry = spec.executable.load()
        self._others = Remappings.other_arguments(spec.args)
        _check_arguments(spec.executable, self._entry, self._others)
        self._remappings = Remappings.from_argv(spec.args)
        self.node: Node | None = None
        self._instance: Any = None
        self._problem: BaseException | None = None
        self._ready: Waiter | None = None
        self._is_set_up = False
        self._awaited = False
        self._forced: int | None = None
        self._streams: OwnStreams | None = None
        self._environ: OwnEnviron | None = None

    @property
    def name(self) -> str:
        """Name of the executable."""
        return self.executable.name

    def instance(self) -> Any:
        """Wait until the node is set up and return the object it created; raises the errors of the set-up.

        Raises ``ScriptError`` if it was never started, or is not set up after ``PATIENCE`` of graph time: a costmap
        waits for its frames without a limit. The set-up then continues, and the call may be repeated.
        """
        if self._ready is None:
            raise ScriptError(f"{self.name} was not started; call start() first")
        if not self._is_set_up and self._problem is None:
            self._awaited = True
            try:
                is_ready = self._ready.wait(round(PATIENCE * 1e9))
            except BaseException:
                self._set_up_lane.kill()
                raise
            self._awaited = False
            if not is_ready:
                raise ScriptError(
                    f"{self.name} is still being set up after {PATIENCE:g} s. What it waits for is in its log; "
                    "start that and ask again, or kill() it"
                )
        if self._problem is not None:
            raise self._problem
        return self._instance

    def _launch(self) -> None:
        self._instance = self._problem = self._forced = None
        self._is_set_up = self._awaited = False
        # gzserver's node is named gazebo, as in ROS
        name = getattr(self._entry, "node_name", self.executable.name)
        namespace = os.environ.get("ROS_NAMESPACE", "")
        label = self._remappings.node_name or name
        streams = self._streams = OwnStreams(self.console.sink, label) if self.console.is_apart else None
        self._environ = OwnEnviron(self._changes, streams) if self._changes else None
        context = self._environ or streams
        node = self.node = Node(name, self.graph, namespace=namespace, remappings=self._remappings, context=context)
        node.logger.streams = streams
        node.on_exit = lambda: self._ended(node)
        node.process = self
        ready = self._ready = self.scheduler.waiter(f"the node {node.name} to be set up")
        self._set_up_lane = self.scheduler.spawn(
            f"{node.name} set-up", lambda: self._set_up(node, ready), node=node, context=context
        )

    def _set_up(self, node: Node, ready: Waiter) -> None:
        try:
            node.program = self._instance = self._entry(node, *self._others)
        except BaseException as error:
            gone = isinstance(error, LaneExit | ROSInterruptException) or (
                isinstance(error, ROSException) and node.shutdown_reason is not None
            )
            self._problem = error
            if gone:
                self._problem = ROSInterruptException(f"the node {node.name} was ended before it was set up")
            elif not self._awaited:
                self.console.report(self.name, error)
            node.shutdown("it could not be set up")
            ready.fail(self._problem)
            if isinstance(error, LaneExit):
                raise
        else:
            self._is_set_up = True
            ready.wake()

    def _ended(self, node: Node) -> None:
        if node is not self.node or not self._running:
            return
        for own in (self._streams, self._environ):
            if own is not None:
                own.finish()
        status = 1 if self._problem is not None else getattr(self._instance, "exit_status", 0)
        self._conclude(status if self._forced is None else self._forced)

    def ask_to_end(self, reason: str) -> None:
        """Shut the node down, in a separate lane."""
        node = self.node
        if node is not None:
            node.spawn(f"{node.name} shutdown", lambda: node.shutdown(reason))

    def _signal(self, signum: signal.Signals) -> None:
        if signum.name in ("SIGINT", "SIGTERM"):  # as roscpp's and rospy's handlers do
            self.ask_to_end(f"signal-{signum}")

    def end_now(self, returncode: int) -> None:
        """Kill it, with this return code."""
        self._forced = returncode
        self._set_up_lane.kill()
        node = self.node
        if node is not None:
            node.shutdown(f"{self.name} was killed", hooks=False)


def _check_arguments(executable: Executable, entry: Callable[..., Any], others: Sequence[str]) -> None:
    """Raise ``ScriptError`` if the built-in node does not accept these arguments besides ROS's own."""
    try:
        inspect.signature(entry).bind(None, *others)
    except TypeError as error:
        raise ScriptError(
            f"{executable.package}/{executable.name} does not take the arguments {list(others)}: {error}. "
            "A parameter is given as _name:=value, a name is changed as from:=to."
        ) from None
