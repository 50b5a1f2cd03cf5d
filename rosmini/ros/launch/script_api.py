"""``import roslaunch``: the parts of ROS's module that scripts use (http://wiki.ros.org/roslaunch/API%20Usage).

The nodes run in the graph of the script that starts them, as with `rosmini.ros.launch.roslaunch`. ``roslaunch.core``,
``parent``, ``rlutil`` and ``scriptapi`` are this module.
"""

from __future__ import annotations

import os
import sys
import uuid
from collections.abc import Sequence
from functools import partial
from importlib import import_module
from pathlib import Path
from typing import TYPE_CHECKING, Any

from rosmini.core.graph import running_graph
from rosmini.core.names import is_remapping

if TYPE_CHECKING:
    from .errors import LaunchError as RLException
    from .plan import NodePlan, Plan
    from .running import Launch, Running

__all__ = [
    "Node",
    "Process",
    "RLException",
    "ROSLaunch",
    "ROSLaunchParent",
    "configure_logging",
    "get_or_generate_uuid",
    "resolve_launch_arguments",
]

__path__: list[str] = []
"""Makes the module a package, for ``import roslaunch.core``."""

core = parent = rlutil = scriptapi = sys.modules[__name__]


def __getattr__(name: str) -> Any:
    if name == "RLException":  # the XML reader is loaded on demand: every script gets this module
        from .errors import LaunchError

        return LaunchError
    if name in ("config", "xmlloader"):  # after `import roslaunch.config`; that file imports this one
        return import_module(f"{__package__}.script_config")
    raise AttributeError(f"module 'roslaunch' has no attribute {name!r}")


def get_or_generate_uuid(options_runid: str | None = None, options_wait_for_master: bool = False) -> str:  # noqa: ARG001
    """Return the run id: the given one, else the Master's, else a new one."""
    if options_runid is not None:
        return options_runid
    code, _, value = running_graph().ask_as("/roslaunch").call("getParam", "/run_id")
    return str(value) if code == 1 else str(uuid.uuid1())


def configure_logging(uuid: str) -> None:
    """Do nothing: a launch inside a script has no log files."""


def resolve_launch_arguments(args: Sequence[str]) -> list[str]:
    """Return the launch files named by the words of a command line. Raises ``RLException``."""
    words = [word for word in args if not is_remapping(word)]
    from .reader import find_file

    return find_file(words) if words else []


class Node:
    """A node to start, with the arguments of roslaunch's own class. Raises ``ValueError``."""

    def __init__(
        self,
        package: str,
        node_type: str,
        name: str | None = None,
        namespace: str = "/",
        machine_name: str | None = None,
        args: str = "",
        respawn: bool = False,
        respawn_delay: float = 0.0,
        remap_args: Sequence[Sequence[str]] | None = None,
        env_args: Sequence[Sequence[str]] | None = None,
        output: str | None = None,
        cwd: str | None = None,
        launch_prefix: str | None = None,
        required: bool = False,
        filename: str = "<unknown>",
    ) -> None:
        if respawn and required:
            raise ValueError("respawn and required cannot both be set to true")
        if name and "/" in name:
            raise ValueError("node name cannot contain a namespace")
        if not package or not node_type:
            raise ValueError("package and type must be non-empty")
        self.package, self.type, self.name = package, node_type, name
        self.args, self.machine_name, self.filename = args, machine_name, filename
        self.respawn, self.respawn_delay, self.required = respawn, respawn_delay, required
        self.remap_args = [tuple(pair) for pair in remap_args or ()]
        self.env_args = [tuple(pair) for pair in env_args or ()]
        self.output, self.cwd, self.launch_prefix = output, cwd, launch_prefix
        self.namespace = "/" + "".join(f"{part}/" for part in namespace.split("/") if part)
        self.plan = self._plan(
            package,
            node_type,
            name or Path(node_type).stem,
            self.namespace,
            filename,
            args=args,
            remappings=tuple((source, target) for source, target in remap_args or ()),
            environment=tuple((key, value) for key, value in env_args or ()),
            respawn=respawn,
            respawn_delay=respawn_delay,
            required=required,
            output=output or "log",
            cwd=cwd,
            launch_prefix=launch_prefix or "",
            machine=machine_name or "",
        )

    @staticmethod
    def _plan(package: str, kind: str, name: str, namespace: str, file: str, **others: Any) -> NodePlan:
        from .errors import Place
        from .plan import NodePlan

        return NodePlan(package, kind, name, namespace, Place(file, 1), **others)


class Process:
    """A node that was started."""

    def __init__(self, running: Running) -> None:
        self._running = running
        self.name = running.name

    @property
    def exit_code(self) -> int | None:
        """Exit status; None while it runs."""
        return self._running.handle.poll()

    def is_alive(self) -> bool:
        """Return True if it is running."""
        return self._running.handle.poll() is None

    def stop(self, errors: Any = None) -> None:  # noqa: ARG002 - roslaunch's signature
        """End it, and wait until it has ended."""
        self._running.asked_to_end = True
        self._running.handle.terminate()
        if self.is_alive():
            self._running.handle.wait()


def _launch(plan: Plan | None) -> Launch:
    from .plan import Plan
    from .running import Launch, in_graph

    graph = running_graph()
    say = partial(print, file=sys.stdout, flush=True)
    return Launch(plan or Plan(), graph, in_graph(graph), say=say, warn=say)


class ROSLaunch:
    """Starts single nodes: ``start()``, ``process = launch(node)``, ``process.stop()``, ``stop()``."""

    def __init__(self) -> None:
        self.started = False
        self._launch = _launch(None)

    def start(self) -> None:
        """Prepare for launching nodes."""
        self.started = True

    def launch(self, node: Node) -> Process:
        """Start a node. Raises ``RLException`` if that fails, or before ``start``."""
        if not self.started:
            raise core.RLException("please start ROSLaunch first: launch.start()")
        made = self._launch.start_node(node.plan)
        if made is None:
            raise core.RLException(f"[{node.package}/{node.type}] could not be started, as was told above")
        return Process(made)

    def stop(self) -> None:
        """End all nodes, and wait until they have ended."""
        self._launch.stop()

    def spin(self) -> None:
        """Wait until all nodes have ended."""
        _wait(self._launch)

    def spin_once(self) -> None:
        """Do nothing: the graph runs whenever the script waits for something."""


class ROSLaunchParent:
    """Starts all nodes of launch files.

    Args:
        run_id: id of the run; not used.
        roslaunch_files: paths, or pairs of a path and words such as ``["name:=value"]``.
        is_core: True starts nothing: the graph has a Master.

    """

    def __init__(
        self,
        run_id: str,
        roslaunch_files: Sequence[str | tuple[str, Sequence[str]]],
        is_core: bool = False,
        **others: Any,
    ) -> None:
        self.run_id, self.roslaunch_files, self.is_core = run_id, roslaunch_files, is_core
        self._strings: Sequence[str] = others.get("roslaunch_strs") or ()
        self._launches: list[Launch] = []

    def start(self, auto_terminate: bool = True) -> None:  # noqa: ARG002 - roslaunch's signature
        """Read the files, set the parameters and start the nodes. Raises ``RLException``."""
        from .reader import read

        plans = []
        for each in self.roslaunch_files:
            file, words = (each, ()) if isinstance(each, str | os.PathLike) else each
            words = [words] if isinstance(words, str) else words
            given = dict(word.split(":=", 1) for word in words if is_remapping(word))
            plans.append(read(file, args=given))
        plans += [read(text=text) for text in self._strings]
        for plan in plans:
            self._launches.append(_launch(plan))
            self._launches[-1].start()

    def spin(self) -> None:
        """Wait until all nodes have ended."""
        for each in self._launches:
            _wait(each)

    def spin_once(self) -> None:
        """Do nothing: the graph runs whenever the script waits for something."""

    def shutdown(self) -> None:
        """End all nodes, and wait until they have ended."""
        for each in reversed(self._launches):
            each.stop()


def _wait(launch: Launch) -> None:
    while not launch.over():
        for made in launch.running:
            if made.handle.poll() is None:
                made.handle.wait()
