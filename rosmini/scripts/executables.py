"""Built-in nodes: what the name `package/executable` stands for, and how it becomes a node of a graph.

An executable is a script in the package, or a built-in node: an entry point of the group `rosmini.nodes`, a callable that
takes the started :class:`~rosmini.graph.Node` (and the arguments that are no remappings, as strings), sets itself up, and
returns the object to which the node's topics, services and timers belong. It may block meanwhile, as a node does that waits
for a service.
"""

from __future__ import annotations

import inspect
import os
from typing import TYPE_CHECKING, Any

from rosmini.errors import ROSInterruptException, ScriptError
from rosmini.graph import Graph, LaneExit, Node
from rosmini.names import Remappings
from rosmini.packages import PackageIndex

if TYPE_CHECKING:
    from collections.abc import Callable, Sequence

    from rosmini.packages import Executable


def find(name: str) -> Executable:
    """Return what ``package/executable`` names.

    Raises ``ScriptError`` if the name has another form, or if there is no such executable, and ``UnknownPackage``.
    """
    package, slash, executable = name.partition("/")
    if not (package and slash and executable) or "/" in executable:
        raise ScriptError(
            f"{name!r} is not of the form PACKAGE/EXECUTABLE, for example rosmini_sim/simulator"
        )
    return PackageIndex().find_executable(package, executable)


class BuiltIn:
    """A built-in node that is started with ROS arguments; ``on_failure`` hears of what it raises while it is set up.

    Raises ``ScriptError`` if it does not take these arguments.
    """

    def __init__(
        self,
        graph: Graph,
        executable: Executable,
        args: Sequence[str] = (),
        on_failure: Callable[[BaseException], object] | None = None,
    ) -> None:
        self.graph = graph
        self.made: Any = None
        """The object that the node gives, once it is set up."""
        self._failed = False
        self._on_failure = on_failure
        self._entry = executable.load()
        self._others = Remappings.other_arguments(args)
        check_arguments(executable, self._entry, self._others)
        self._name = getattr(
            self._entry, "node_name", executable.name
        )  # gzserver is called gazebo, as ROS's is
        self._remappings = Remappings.from_argv(args)

    def start(self) -> None:
        """Start the node, and set it up in a lane of its own."""
        namespace = os.environ.get("ROS_NAMESPACE", "")
        self.node = Node(self._name, self.graph, namespace=namespace, remappings=self._remappings)
        self._ready = self.graph.scheduler.waiter(f"the node {self.node.name} to be set up")
        self._lane = self.graph.scheduler.spawn(f"{self.node.name} set-up", self._set_up, node=self.node)

    def _set_up(self) -> None:
        try:
            self.made = self._entry(self.node, *self._others)
        except LaneExit as error:
            self._ready.fail(
                ROSInterruptException(f"the node {self.node.name} was ended before it was set up")
            )
            raise error from None
        except BaseException as error:
            self._failed = True
            self.end("it could not be set up")
            self._ready.fail(error)
            if self._on_failure is not None:
                self._on_failure(error)
        else:
            self._ready.wake()

    def wait(self) -> Any:
        """Wait until the node is set up and return its object; what it raised meanwhile is raised here."""
        try:
            self._ready.wait()
        except BaseException:
            self._lane.kill()
            self.end("it could not be set up")
            raise
        return self.made

    @property
    def status(self) -> int:
        """The exit status: 1 if it could not be set up, else what the object that the node gives has for one, if it has any."""
        return 1 if self._failed else getattr(self.made, "exit_status", 0)

    @property
    def ended(self) -> bool:
        """Tell whether the node was shut down."""
        return self.node.is_shutdown()

    def end(self, reason: str) -> None:
        """Shut the node down; harmless when repeated."""
        self.node.shutdown(reason)


def check_arguments(executable: Executable, entry: Callable[..., Any], others: Sequence[str]) -> None:
    """Raise ``ScriptError`` if the built-in node does not take these arguments beside ROS's own."""
    try:
        inspect.signature(entry).bind(None, *others)
    except TypeError as error:
        raise ScriptError(
            f"{executable.package}/{executable.name} does not take the arguments {list(others)}: {error}. A parameter is "
            "given as _name:=value, a name is changed as from:=to."
        ) from error
