"""The plan of a launch: the nodes, parameters, machines and tests of launch files, before anything runs."""

from __future__ import annotations

import os
import shlex
from collections.abc import Iterator, Mapping
from dataclasses import dataclass, field, replace
from typing import Any

from rosmini.core.errors import nearest
from rosmini.core.names import canonicalize, join
from rosmini.core.rosparam import dumps

from .errors import LaunchError, Missing, Place

TIME_LIMIT_S = 60.0
"""Default time limit of a test [s]."""

WIDEST = 20
"""Maximum number of characters of a value in the summary, as in roslaunch."""


@dataclass(frozen=True)
class Setting:
    """A parameter setting, with its place.

    ``source`` is the file or the command that gave the value, if it is not written in the launch file.
    """

    name: str
    value: Any
    place: Place
    source: str = ""


@dataclass(frozen=True)
class NodePlan:
    """A ``<node>`` (http://wiki.ros.org/roslaunch/XML/node). ``namespace`` ends in a slash."""

    package: str
    type: str
    name: str
    namespace: str
    place: Place
    args: str = ""
    remappings: tuple[tuple[str, str], ...] = ()
    environment: tuple[tuple[str, str], ...] = ()
    respawn: bool = False
    respawn_delay: float = 0.0
    required: bool = False
    output: str = "log"
    cwd: str | None = None
    launch_prefix: str = ""
    machine: str = ""

    @property
    def full_name(self) -> str:
        """Global name of the node."""
        return join(self.namespace, self.name)

    @property
    def executable(self) -> str:
        """Executable as ``package/type``."""
        return f"{self.package}/{self.type}"

    def words(self, *, with_namespace: bool = False) -> tuple[str, ...]:
        """Return its command line: arguments, remappings, name and, if asked for, the namespace."""
        own = shlex.split(self.args)
        remaps = [f"{source}:={target}" for source, target in self.remappings]
        space = [f"__ns:={self.namespace.rstrip('/') or '/'}"] if with_namespace else []
        return (*own, *remaps, f"__name:={self.name}", *space)


@dataclass(frozen=True)
class TestPlan(NodePlan):
    """A ``<test>`` (http://wiki.ros.org/roslaunch/XML/test): a node that ends and writes its results."""

    __test__ = False  # not one of pytest's

    test_name: str = ""
    time_limit: float = TIME_LIMIT_S
    retry: int = 0


@dataclass(frozen=True)
class Machine:
    """A ``<machine>`` (http://wiki.ros.org/roslaunch/XML/machine); its ``password`` is never shown."""

    name: str
    address: str
    place: Place
    env_loader: str = ""
    ssh_port: int = 22
    user: str = ""
    password: str = field(default="", repr=False)
    timeout: float = 10.0
    is_default: bool = False

    def same_as(self, other: Machine) -> bool:
        """Return True if another machine has the same declaration."""
        return replace(self, place=other.place, is_default=other.is_default) == other

    @property
    def is_local(self) -> bool:
        """True if its address is this machine's."""
        import socket

        return self.address in ("localhost", "127.0.0.1", "::1", socket.gethostname(), os.environ.get("ROS_IP"))


@dataclass(frozen=True)
class Argument:
    """An ``<arg>`` of the launched file: ``default`` is None if a value is required."""

    name: str
    default: str | None
    doc: str
    place: Place


@dataclass(frozen=True)
class Verb:
    """A ``<rosparam command="dump">`` or ``"delete"``, which is executed before the nodes start."""

    command: str
    name: str
    file: str
    place: Place


@dataclass
class LaunchFile:
    """A launch file that was read: its includes and its own contents; ``place`` is where it is included."""

    path: str
    namespace: str = "/"
    place: Place | None = None
    args: Mapping[str, str] = field(default_factory=dict)
    includes: list[LaunchFile] = field(default_factory=list)
    nodes: list[NodePlan] = field(default_factory=list)
    settings: list[Setting] = field(default_factory=list)

    def walk(self) -> Iterator[LaunchFile]:
        """Yield this file and all files that it includes, in reading order."""
        yield self
        for file in self.includes:
            yield from file.walk()


@dataclass
class Plan:
    """The complete contents of launch files; the last setting of a parameter wins."""

    roots: list[LaunchFile] = field(default_factory=list)
    nodes: list[NodePlan] = field(default_factory=list)
    tests: list[TestPlan] = field(default_factory=list)
    settings: dict[str, Setting] = field(default_factory=dict)
    cleared: list[str] = field(default_factory=list)
    """Namespaces whose parameters are deleted first; each ends in a slash."""
    machines: dict[str, Machine] = field(default_factory=dict)
    verbs: list[Verb] = field(default_factory=list)
    arguments: dict[str, Argument] = field(default_factory=dict)
    warnings: list[str] = field(default_factory=list)
    """Problems that do not prevent a launch; each begins with its place."""
    missing: list[Missing] = field(default_factory=list)

    @property
    def parameters(self) -> dict[str, Any]:
        """Values of all parameters, by name."""
        return {name: setting.value for name, setting in self.settings.items()}

    def all_nodes(self) -> list[NodePlan]:
        """Return the nodes and then the tests."""
        return [*self.nodes, *self.tests]

    def files(self) -> list[str]:
        """Return the files that were read, in reading order."""
        return [file.path for root in self.roots for file in root.walk()]

    def node(self, name: str) -> NodePlan:
        """Return the node or test of a name; a relative name is taken from the root. Raises ``LaunchError``."""
        wanted = canonicalize("/" + name)
        for node in self.all_nodes():
            if node.full_name == wanted:
                return node
        names = [node.full_name for node in self.all_nodes()]
        hint = nearest(wanted, names)
        listed = "".join(f"\n * {each}" for each in names) or " none"
        raise LaunchError(
            f"Cannot find node named [{wanted}] in [{', '.join(root.path for root in self.roots)}]"
            f"{f'; {hint}' if hint else ''}.\nNode names are:{listed}"
        )

    def dump(self) -> str:
        """Return the output of `roslaunch --dump-params`."""
        return dumps(self.parameters)

    def ros_args(self) -> str:
        """Return the output of `roslaunch --ros-args`."""
        if not self.arguments:
            return "No arguments."
        lines = []
        listed = sorted(self.arguments.values(), key=lambda each: each.name)
        required = [each for each in listed if not each.default]
        optional = [each for each in listed if each.default]
        if required:
            lines.append("Required Arguments:")
            lines += [f"  {each.name}: {each.doc or 'undocumented'}" for each in required]
        if optional:
            lines.append("Optional Arguments:")
            lines += [f'  {each.name} (default "{each.default}"): {each.doc or "undocumented"}' for each in optional]
        return "\n".join(lines)

    def summary(self, more: Mapping[str, Any] | None = None) -> str:
        """Return the summary that roslaunch prints before it starts; ``more`` are additional parameters."""
        lines = ["SUMMARY", "========"]
        if self.cleared:
            lines += ["", "CLEAR PARAMETERS", *sorted(f" * {name}" for name in self.cleared)]
        values = {**(more or {}), **self.parameters}
        if values:
            lines += ["", "PARAMETERS", *sorted(f" * {name}: {shortened(value)}" for name, value in values.items())]
        if self.machines:
            lines += ["", "MACHINES", *sorted(f" * {name}" for name in self.machines)]
        lines += ["", "NODES"]
        for space in sorted({node.namespace for node in self.nodes}):
            lines.append(f"  {space}")
            lines += sorted(f"    {node.name} ({node.executable})" for node in self.nodes if node.namespace == space)
        return "\n".join(lines)


def shortened(value: Any, widest: int = WIDEST) -> str:
    """Return a value as in roslaunch's summary: short, and on one line."""
    text = str(value)
    if len(text) > widest:
        text = text[: widest - 3] + "..."
    if all(" " <= char <= "~" for char in text.rstrip()):
        return text.rstrip() if not text.isprintable() else text
    return "<...>"
