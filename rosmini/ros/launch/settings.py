"""``<param>``, ``<rosparam>``, ``<remap>`` and ``<env>``."""

from __future__ import annotations

import os
from typing import TYPE_CHECKING, Any

from rosmini.core.errors import ParameterError, RosminiError, shown
from rosmini.core.files import read
from rosmini.core.names import canonicalize, is_legal_name, is_private, join
from rosmini.core.rosparam import RosParamException, assignments, load_str

from .commands import output_of
from .errors import LaunchError, Missing, Place
from .loading import source
from .plan import Setting, Verb
from .values import convert, flag

if TYPE_CHECKING:
    from rosmini.core.markup import Element

    from .loading import Loading
    from .scope import Scope

MAX_BYTES = 16_000_000
"""Maximum size of a file whose text becomes a parameter [bytes]."""

VALUES = ("value", "textfile", "binfile", "command")


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
