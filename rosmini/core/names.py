"""ROS names: validation, resolution, remapping (http://wiki.ros.org/Names, http://wiki.ros.org/Remapping%20Arguments).

A *graph resource name* (node, topic, service, parameter) is global (``/scan``), relative (``scan``), private
(``~scan``) or, if relative and without ``/``, a base name. :func:`resolve` converts them to global names.
A *package resource name* is ``package/Type``.
"""

from __future__ import annotations

import re
from collections.abc import Iterable, Mapping
from typing import Any

from rosmini.core.errors import IllegalName, ROSInitException, shown

ROS_RELEASE = {"ROS_VERSION": "1", "ROS_DISTRO": "noetic", "ROS_PYTHON_VERSION": "3"}
"""Environment variables that identify the ROS release; conditions in manifests (REP 149) refer to them too."""

GRAPH_NAME = re.compile(r"(?:[~/A-Za-z][A-Za-z0-9_/]*)?")
BASE_NAME = re.compile(r"[A-Za-z][A-Za-z0-9_]*")
REMAPPING = re.compile(r"[~/A-Za-z_][\w/]*:=.*")


# ---- validation ----


def check_name(name: str, what: str = "name") -> str:
    """Return ``name`` if its characters are legal in a graph resource name; the empty name is legal.

    ``what`` is the kind of name in the message (``"topic"``). Raises ``IllegalName`` with a caret under the first
    illegal character.
    """
    if isinstance(name, str) and GRAPH_NAME.fullmatch(name):
        return name
    raise _illegal(name, what, first="~/", rest="/_", rule="a letter, '/' or '~', then letters, digits, '_' and '/'")


def check_base_name(name: str, what: str = "node name") -> str:
    """Return ``name`` if it is a legal base name, without a namespace. Raises ``IllegalName``."""
    if isinstance(name, str) and BASE_NAME.fullmatch(name):
        return name
    raise _illegal(name, what, first="", rest="_", rule="a letter, then letters, digits and '_'")


def is_legal_name(name: str | None) -> bool:
    """Return whether ``name`` is legal, as ``rosgraph.names`` does: False for None and for a name with '//'.

    Raises ``TypeError`` for any other value that is not a str.
    """
    return name is not None and GRAPH_NAME.fullmatch(name) is not None and "//" not in name


def is_legal_base_name(name: str | None) -> bool:
    """Return whether ``name`` is a legal base name, without a namespace; False for None.

    Raises ``TypeError`` for any other value that is not a str.
    """
    return name is not None and BASE_NAME.fullmatch(name) is not None


def _illegal(name: object, what: str, *, first: str, rest: str, rule: str) -> IllegalName:
    if not isinstance(name, str):
        return IllegalName(f"a {what} is a str, not {type(name).__name__} ({name!r})")
    if not name:
        return IllegalName(f"a {what} must not be empty: allowed are {rule}")
    bad = 0
    if _is_letter(name[0]) or name[0] in first:
        bad = next(i for i, char in enumerate(name) if i and not (char.isascii() and (char.isalnum() or char in rest)))
    reason = _reason(name[bad], bad == 0, first, rest)
    shown = [repr(char)[1:-1] if not char.isprintable() else char for char in name]
    caret = " " * len("".join(shown[:bad])) + "^"
    return IllegalName(f"illegal {what}:\n    {''.join(shown)}\n    {caret}\n{reason}; allowed are {rule}")


def _is_letter(char: str) -> bool:
    return char.isascii() and char.isalpha()


def _reason(char: str, at_start: bool, first: str, rest: str) -> str:
    shown = "a space" if char == " " else repr(char)
    if at_start and char.isascii() and (char.isdigit() or char in rest):
        return f"it starts with {shown}"
    if char in first or (char == "~" and not at_start):
        return f"{shown} may only be the first character" if first else f"{shown} is for names with a namespace"
    if char == "/":
        return "'/' is for names with a namespace: give the namespace apart (__ns:=)"
    if char in "- .":
        return f"{shown} is not allowed: use '_' instead"
    return f"{shown} is not allowed"


# ---- splitting and joining names ----


def is_global(name: str) -> bool:
    """Return True for a global name, such as ``/scan``."""
    return name[:1] == "/"


def is_private(name: str) -> bool:
    """Return True for a private name, such as ``~scan``."""
    return name[:1] == "~"


def namespace(name: str) -> str:
    """Return the namespace of ``name``, with a trailing slash: ``/robot1/`` for ``/robot1/talker``.

    Raises ``ValueError`` for None and ``TypeError`` for anything else that is not a str.
    """
    if name is None:
        raise ValueError("None is not a name: namespace() takes a text, such as '/robot1/talker'")
    if not isinstance(name, str):
        raise TypeError(f"a name is a str, not {type(name).__name__} ({name!r})")
    return name.removesuffix("/").rpartition("/")[0] + "/"


def join(ns: str, name: str) -> str:
    """Put ``name`` into the namespace ``ns``; global and private names do not change."""
    if not ns or is_global(name) or is_private(name):
        return name
    return ns + name if ns.endswith("/") or ns == "~" else f"{ns}/{name}"


def canonicalize(name: str) -> str:
    """Return a name without double and trailing slashes: ``/a/b`` for ``/a//b/``."""
    if not name or name == "/":
        return name
    parts = "/".join(part for part in name.split("/") if part)
    return "/" + parts if name[0] == "/" else parts


# ---- resolution ----


def resolve_for(name: str, caller_id: str) -> str:
    """Resolve ``name`` as the Master does for the node ``caller_id``: no validation, no remapping."""
    if not name:
        return namespace(caller_id)
    name = canonicalize(name)
    if name[0] == "/":
        return name
    if name[0] == "~":
        return canonicalize(f"{caller_id}/{name[1:]}")
    return namespace(caller_id) + name


def resolve(
    name: str,
    namespace: str,
    node_name: str | None = None,
    remappings: Remappings | None = None,
    *,
    what: str = "name",
    check: bool = True,
) -> str:
    """Resolve ``name`` to a global name, as rospy does.

    Args:
        name: any graph resource name; the empty name means the namespace itself (with a trailing slash).
        namespace: the namespace of relative names, ``/`` or ``/robot1``.
        node_name: the node's global name, the namespace of private names.
        remappings: applied to the resolved name.
        what: the kind of name, for the message ("topic").
        check: refuse illegal characters (rospy accepts them in parameter names).

    Raises ``IllegalName``, also for a private name if there is no ``node_name``.

    >>> resolve("scan", "/robot1"), resolve("~rate", "/robot1", "/robot1/talker")
    ('/robot1/scan', '/robot1/talker/rate')

    """
    if check:
        check_name(name, what)
    if node_name is None:
        if is_private(name):
            raise IllegalName(
                f"{name} is private to a node, and there is no node yet: call init_node first, or name the node"
            )
        node_name = join(canonicalize(namespace) or "/", "node")
    # rospy reads "~/rate" as "/rate" (roscpp as "/node/rate"); we follow rospy.
    private = is_private(name)
    resolved = join(node_name, canonicalize(name)[1:]) if private else resolve_for(name, node_name)
    return remappings.apply(resolved, node_name) if remappings is not None else resolved


# ---- remapping ----


def is_remapping(argument: str) -> bool:
    """Return True for a command-line argument that ROS consumes: ``a:=b``, ``_rate:=10``, ``__name:=talker``."""
    return REMAPPING.fullmatch(argument) is not None


class Remappings:
    """The ``:=`` arguments: remapped names, private parameters of the node, and ROS's special keys.

    ``names`` maps names as written; ``private_parameters`` maps names without the underscore to values;
    ``special`` contains ``__name``, ``__ns``, ``__log``, ``__ip``, ``__hostname`` and ``__master``.
    """

    def __init__(self, rules: Mapping[str, Any] | None = None) -> None:
        self.names: dict[str, str] = {}
        self.private_parameters: dict[str, Any] = {}
        self.special: dict[str, str] = {}
        self._resolved: dict[str, dict[str, str]] = {}
        for source, target in (rules or {}).items():
            self._add(source, target)

    @classmethod
    def from_argv(cls, argv: Iterable[str]) -> Remappings:
        """Read the remapping arguments among ``argv``; values of parameters are YAML (``_ranges:=[1, 2]``).

        Raises ``ROSInitException`` for an argument with two ``:=`` or with a value that is not YAML.
        """
        made = cls()
        for argument in argv:
            if not is_remapping(argument):
                continue
            source, *targets = (part.strip() for part in argument.split(":="))
            if len(targets) > 1:
                raise ROSInitException(f"invalid remapping argument {argument!r}: one ':=' is enough")
            if source and targets[0] and not (source == "__ns" and "__ns" in made.special):
                made._add(source, _yaml(argument, targets[0]) if _is_parameter(source) else targets[0])
        return made

    def _add(self, source: str, target: Any) -> None:
        if source.startswith("__"):
            self.special[source] = target
        elif _is_parameter(source):
            self.private_parameters[source[1:]] = target
        else:
            self.names[source] = target

    @staticmethod
    def other_arguments(argv: Iterable[str]) -> list[str]:
        """Return the script's own arguments (``rospy.myargv``)."""
        return [argument for argument in argv if not is_remapping(argument)]

    @property
    def node_name(self) -> str | None:
        """The node's name from ``__name:=``, or None."""
        return self.special.get("__name")

    @property
    def namespace(self) -> str | None:
        """The node's namespace from ``__ns:=``, always global, or None."""
        given = self.special.get("__ns")
        return None if given is None else canonicalize("/" + given)

    @property
    def log_file(self) -> str | None:
        """The path of the node's log file from ``__log:=``, or None."""
        return self.special.get("__log")

    def apply(self, resolved: str, node_name: str) -> str:
        """Return the global name that replaces ``resolved`` in the node ``node_name``; itself if no rule applies."""
        if not self.names:
            return resolved
        table = self._resolved.get(node_name)
        if table is None:
            table = {resolve_for(a, node_name): resolve_for(b, node_name) for a, b in self.names.items()}
            self._resolved[node_name] = table
        return table.get(resolved, resolved)

    def __repr__(self) -> str:
        private = {"_" + key: value for key, value in self.private_parameters.items()}
        return f"Remappings({ {**self.names, **private, **self.special} })"


def _is_parameter(source: str) -> bool:
    return len(source) > 1 and source[0] == "_" and source[1] != "_"


def _yaml(argument: str, text: str) -> Any:
    from rosmini.core.yaml_text import documents  # slow to import, and few nodes need it

    def failure(message: str, _source: str, _line: int | None) -> ROSInitException:
        return ROSInitException(f"invalid command-line parameter {shown(argument)}: {message}")

    found = [value for value, _ in documents(text, argument, failure)]
    if len(found) > 1:
        raise failure(f"it has {len(found)} YAML documents, but must be a single value", argument, None)
    return found[0] if found else None


class AnonymousNames:
    """Makes names for anonymous nodes, in rospy's form ``talker_<pid>_<milliseconds>``.

    A counter from ``seed`` replaces the process id, and graph time the wall-clock time, so that
    each run gives the same names.
    """

    def __init__(self, seed: int = 1) -> None:
        self._next = seed

    def make(self, base: str, now_ns: int) -> str:
        """Return a new name for ``base`` at ``now_ns`` nanoseconds of graph time."""
        number, self._next = self._next, self._next + 1
        return f"{base}_{number}_{now_ns // 1_000_000}"
