"""``<param>``, ``<rosparam>``, ``<remap>`` and ``<env>``."""

from __future__ import annotations

import os
import shlex
from collections.abc import Callable, Sequence
from pathlib import Path, PurePath
from typing import TYPE_CHECKING, Any

from rosmini.core.errors import ParameterError, RosminiError, UsageError, shown
from rosmini.core.files import read
from rosmini.core.graph.show import find_extension
from rosmini.core.names import canonicalize, is_legal_name, is_private, join
from rosmini.core.rosparam import RosParamException, assignments, load_str

from .errors import LaunchError, Missing, Place
from .loading import source
from .plan import Setting, Verb
from .values import convert, flag

if TYPE_CHECKING:
    from rosmini.core.markup import Element
    from rosmini.core.packages import PackageIndex

    from .loading import Loading
    from .scope import Scope

MAX_BYTES = 16_000_000
"""Maximum size of a file whose text becomes a parameter [bytes]."""

PYTHONS = ("python", "python3", "python2")

VALUES = ("value", "textfile", "binfile", "command")


class NotAllowed(RosminiError):
    """A command that rosmini does not support."""


def read_param(loading: Loading, element: Element, scope: Scope, *, local: bool = False) -> None:
    """Set a parameter (http://wiki.ros.org/roslaunch/XML/param), inside a node (``local``) a private one.

    Raises ``LaunchError``.
    """
    loading.check_attributes(element, ("name", "type", *VALUES))
    given = [name for name in VALUES if name in element.attributes]
    if len(given) != 1:
        raise element.error(
            "<param> tag must have one and only one of value/textfile/binfile/command, and this has "
            f"{', '.join(given) or 'none'}. The tag is {source(element)}"
        )
    name = loading.required(element, scope, "name").strip()
    if not name:
        raise element.error(f"<param>: its name is empty. The tag is {source(element)}")
    text = loading.required(element, scope, given[0])
    place = Place(element.path, element.line)
    kind = loading.resolve(element.get("type", "auto"), scope, element) or "auto"
    try:
        value, origin = _value(loading, element, given[0], text, kind)
        if value is _NOTHING:
            return
        if local or is_private(name):
            key = name.removeprefix("~")
            scope.private.pop(key, None)
            scope.private[key] = Setting(key, value, place, origin)
        else:
            loading.set(canonicalize(join(scope.namespace, name)), value, place, origin)
    except LaunchError:
        raise
    except ParameterError as error:
        raise element.error(f"Invalid <param> tag: {name}: {error}") from error


_NOTHING: Any = object()
"""Value of a parameter whose file or command is missing."""


def _value(loading: Loading, element: Element, how: str, text: str, kind: str) -> tuple[Any, str]:
    """Return a parameter's value and its source."""
    if how == "value":
        return convert(text.strip(), kind), ""
    try:
        if how == "textfile":
            return convert(read(text, MAX_BYTES).decode("utf-8"), kind), text
        if how == "binfile":
            return read(text, MAX_BYTES), text
        if loading.is_incomplete(text):
            return _NOTHING, ""
        return convert(output_of(text, loading.packages), kind), text
    except OSError as error:
        loading.lacks_file(element, how, error.filename or text, error.strerror or str(error))
    except UnicodeDecodeError as error:
        raise element.error(f"<param>: the {how} [{text}] is not UTF-8: {error}") from error
    except ParameterError:
        raise
    except RosminiError as error:
        place = Place(element.path, element.line)
        loading.lacks(Missing("command's output", text, place, f"command [{text}]: {error}"))
    return _NOTHING, ""


def read_rosparam(loading: Loading, element: Element, scope: Scope) -> None:
    """Load, dump or delete parameters (http://wiki.ros.org/roslaunch/XML/rosparam). Raises ``LaunchError``."""
    loading.check_attributes(element, ("command", "ns", "file", "param", "subst_value"))
    command = loading.optional(element, scope, "command") or "load"
    param = join(loading.optional(element, scope, "ns") or "", loading.optional(element, scope, "param") or "")
    param = param.removeprefix("~")
    file = loading.optional(element, scope, "file")
    substitutes = flag(element, "subst_value", loading.optional(element, scope, "subst_value"))
    full = canonicalize(join(scope.namespace, param)) or "/"
    if command == "load":
        _load(loading, element, scope, full, file, substitutes=substitutes, named=bool(param))
    elif command in ("dump", "delete"):
        _note(loading, element, command, full, file)
    else:
        raise element.error(f"<rosparam>: command must be 'load', 'dump', or 'delete', and this is {command!r}")


def _load(
    loading: Loading, element: Element, scope: Scope, full: str, file: str | None, *, substitutes: bool, named: bool
) -> None:
    text, origin = element.written, ""
    if file is not None:
        try:
            text, origin = read(file, MAX_BYTES).decode("utf-8"), file
        except OSError as error:
            loading.lacks_file(element, "rosparam file", file, error.strerror or str(error))
            return
        except UnicodeDecodeError as error:
            raise element.error(f"<rosparam>: the file [{file}] is not UTF-8: {error}") from error
    if substitutes:
        text = loading.resolve(text, scope, element)
    try:
        documents = load_str(text, file or element.path, full) if text.strip() else []
    except RosParamException as error:
        raise _bad_yaml(element, error, inline=file is None) from error
    if len(documents) > 1:
        raise element.error(f"<rosparam>: {len(documents)} YAML documents, and one is needed")
    for document in documents:
        if not isinstance(document.values, dict) and not named:
            what = shown(document.values) if file is None else f"a {type(document.values).__name__}"
            raise element.error(
                f"'param' attribute must be set for non-dictionary values: what is loaded is {what}, "
                "no lines of the form `name: value`"
            )
        try:
            for name, value in assignments(document.namespace, document.values):
                loading.set(canonicalize(name), value, Place(element.path, element.line), origin)
        except ParameterError as error:
            raise element.error(f"<rosparam>{f' [{file}]' if file else ''}: {error}") from error


def _bad_yaml(element: Element, error: RosParamException, *, inline: bool) -> LaunchError:
    """Return the error for invalid YAML, with the line in the launch file if the YAML is ``inline``."""
    if inline:
        line = element.line + (error.line or 1) - 1
        return LaunchError(f"Error within YAML block: {error.message}", element.path, line)
    where = f" in line {error.line}" if error.line else ""
    message = f"file {error.file} contains invalid YAML{where}: {error.message}"
    return LaunchError(message, element.path, element.line)


def _note(loading: Loading, element: Element, command: str, full: str, file: str | None) -> None:
    """Record an action on the Parameter Server to carry out before the nodes start."""
    if command == "delete" and file is not None:
        raise element.error("'file' attribute is invalid with 'delete' command.")
    if command == "dump":
        if file is None:
            raise element.error('<rosparam command="dump"> needs a file="..." to write to')
        if os.path.splitext(file)[1].lower() not in (".yaml", ".yml"):  # noqa: PTH122 - a text
            raise element.error(
                f'<rosparam command="dump">: [{file}] is not written: a launch file writes files that end in .yaml only'
            )
    loading.plan.verbs.append(Verb(command, full, file or "", Place(element.path, element.line)))


def read_remap(loading: Loading, element: Element, scope: Scope) -> None:
    """Add a remapping for the rest of this scope. Raises ``LaunchError``."""
    loading.check_attributes(element, ("from", "to"))
    ends = [canonicalize(loading.required(element, scope, name)) for name in ("from", "to")]
    for name, end in zip(("from", "to"), ends, strict=True):
        if not end:
            raise element.error("remap from/to attributes cannot be empty")
        if not is_legal_name(end):
            raise element.error(f"remap {name} [{end}] is not a valid ROS name")
    scope.remap(*ends)


def read_env(loading: Loading, element: Element, scope: Scope) -> None:
    """Set an environment variable for the rest of this scope. Raises ``LaunchError``."""
    loading.check_attributes(element, ("name", "value"))
    name, value = (loading.required(element, scope, each) for each in ("name", "value"))
    if not name:
        raise element.error("<env>: 'name' attribute must be non-empty")
    if "=" in name or "\0" in name + value:
        raise element.error(f"<env>: {shown(name)} is not the name of an environment variable")
    scope.environment.pop(name, None)
    scope.environment[name] = value


def output_of(command: str, packages: PackageIndex) -> str:
    """Return the output of a ``command="..."`` of ``<param>``.

    ROS runs any program there. Here no program or shell is run: the commands that launch files need in practice are
    functions of rosmini, and any other command is refused with a suggestion.

    Supported are ``xacro`` (also by its path, or after ``rosrun xacro`` or ``python``), ``cat``, ``echo`` and
    ``rospack find``. Raises ``NotAllowed`` for any other, ``OSError`` for a file, and the errors of xacro.
    """
    try:
        words = shlex.split(command)
    except ValueError as error:
        raise UsageError(f"command [{command}] cannot be split into words: {error}") from error
    if words and PurePath(words[0]).name in PYTHONS:
        words = words[1:]
    if words[:1] == ["rosrun"]:
        words = words[2:]
    name = PurePath(words[0]).name.removesuffix(".py") if words else ""
    act = ALLOWED.get(name)
    if act is None:
        raise NotAllowed(
            f"command [{command}] is not run: in a launch file rosmini does {', '.join(sorted(ALLOWED))} itself, "
            'and no other program. Run it beforehand, write what it prints to a file, and load that with textfile="..."'
        )
    return act(words[1:], packages)


def _xacro(words: Sequence[str], packages: PackageIndex) -> str:
    mappings = dict(word.split(":=", 1) for word in words if ":=" in word)
    files = [word for word in words if ":=" not in word and not word.startswith("-")]
    if len(files) != 1:
        raise UsageError(f"xacro takes one file, not {' '.join(files) or 'none'}")
    expand = find_extension("rosmini.launch_commands", "xacro")
    expanded: str = expand(files[0], mappings, packages=packages)
    return expanded


def _cat(words: Sequence[str], packages: PackageIndex) -> str:  # noqa: ARG001 - alike
    return "".join(read(Path(word), MAX_BYTES).decode("utf-8") for word in words if word != "-")


def _echo(words: Sequence[str], packages: PackageIndex) -> str:  # noqa: ARG001 - alike
    newline = words[:1] != ["-n"]
    return " ".join(words if newline else words[1:]) + ("\n" if newline else "")


def _rospack(words: Sequence[str], packages: PackageIndex) -> str:
    if len(words) != 2 or words[0] != "find":
        raise NotAllowed(f"rospack {' '.join(words)}: in a launch file there is `rospack find PACKAGE`")
    return f"{packages.path(words[1])}\n"


ALLOWED: dict[str, Callable[[Sequence[str], PackageIndex], str]] = {
    "cat": _cat,
    "echo": _echo,
    "rospack": _rospack,
    "xacro": _xacro,
}
