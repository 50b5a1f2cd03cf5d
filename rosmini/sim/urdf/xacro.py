"""xacro: macros of robot descriptions (http://wiki.ros.org/xacro), expanded by ROS's own xacro from PyPI.

That package finds packages as ROS 2 does; here ``$(find ...)`` uses our `PackageIndex`. Each file is first read by
`rosmini.core.markup`, which reports invalid XML with its line and refuses hostile XML. Expressions are confined (see
`rosmini.sim.urdf.confined`) unless the caller disables it.
"""

from __future__ import annotations

import re
import sys
import threading
import xml.dom.minidom
from collections.abc import Iterator, Mapping, Sequence
from contextlib import contextmanager
from os import PathLike, fspath
from pathlib import Path
from typing import Any

from rosmini.core.errors import RosminiError, nearest
from rosmini.core.expressions import ExpressionError, NotAllowed
from rosmini.core.files import exists
from rosmini.core.markup import parse, parse_file
from rosmini.core.packages import SCHEME, PackageIndex

from .confined import Confined
from .errors import UrdfError

USAGE = "usage: xacro [-o FILE] [--unconfined] INPUT [name:=value ...]"

UNCONFINED = (
    "rosmini restricts xacro's expressions to the calculations that a robot description needs; if you trust this file "
    "to run any Python code on this computer, add --unconfined to the command, or confined=False to the call"
)

MAX_MACROS = 5
"""Maximum number of nested macros in an error message."""

SHOWN = 1000
"""Number of characters at the beginning and at the end of xacro's message in an error."""

PREFIXLESS = {
    "arg": ("name", "default"),
    "if": ("value",),
    "include": ("filename",),
    "insert_block": ("name",),
    "macro": ("name",),
    "property": ("name", "value"),
    "unless": ("value",),
}
"""Tags that may lack the prefix `xacro:`, and the attributes by which they are recognised."""

_one_at_a_time = threading.Lock()
"""Needed because xacro keeps its state in its module."""


def expand(
    path: str | PathLike[str],
    mappings: Mapping[str, Any] | None = None,
    *,
    packages: PackageIndex | None = None,
    confined: bool = True,
) -> str:
    """Return the URDF that a xacro file expands to.

    Args:
        path: the file; ``package://...`` is possible too.
        mappings: arguments by name, like ``name:=value`` on the command line.
        packages: the index of packages for ``$(find ...)``; by default `PackageIndex()`.
        confined: False passes expressions to Python's ``eval``, as ROS does: they can do anything that you can.

    Raises:
        UrdfError: a file cannot be read or is not XML; a macro, property, argument or package is unknown; an expression
            fails or is not allowed.

    """
    index = packages if packages is not None else PackageIndex()
    try:
        file = index.resolve(fspath(path)) if fspath(path).startswith(SCHEME) else Path(path)
    except RosminiError as error:
        raise UrdfError(str(error)) from error
    given = {name: _written(value) for name, value in (mappings or {}).items()}
    with _one_at_a_time:
        document = _process(file, given, index, confined=confined)
    root = document.documentElement
    assert root is not None  # noqa: S101 (a document has one)
    return f'<?xml version="1.0" ?>\n{root.toprettyxml(indent="  ")}'


def _written(value: Any) -> str:
    """Format an argument as in launch files."""
    return str(value).lower() if isinstance(value, bool) else str(value)


def _process(file: Path, mappings: dict[str, str], index: PackageIndex, *, confined: bool) -> xml.dom.minidom.Document:
    """Return xacro's expansion of a file, with our search for packages and our checks of XML."""
    import xacro
    from xacro import substitution_args

    with _patched_xacro(xacro, substitution_args, file if confined else None, index):
        try:
            document: xml.dom.minidom.Document = xacro.process_file(str(file), mappings=dict(mappings))
        # Expressions are Python: whatever they raise, the description is invalid.
        except Exception as error:
            cause = _cause(error)
            if isinstance(cause, UrdfError) and (cause.file in (None, str(file)) or exists(str(cause.file))):
                if cause is error:
                    raise
                raise cause from error
            where = next((name for name in reversed(xacro.filestack or []) if name and exists(name)), str(file))
            macros = [each.body.getAttribute("name") for each in reversed(xacro.macrostack or [])]
            told = [*macros[:MAX_MACROS], *(["..."] if len(macros) > MAX_MACROS else [])]
            inside = f" (in the macro {', called by '.join(told)})" if macros else ""
            raise UrdfError(_message(error, mappings) + inside, where) from error
    return document


@contextmanager
def _patched_xacro(xacro: Any, substitution: Any, confined: Path | None, index: PackageIndex) -> Iterator[None]:
    """Make xacro use our package index, our file reading and our limits; restore its globals afterwards.

    `confined` is the expanded file, or None for no limits.
    """

    def find(name: str) -> str:
        return str(index.path(name))

    limits = None if confined is None else Confined(xacro, substitution, confined, find)
    old_style = OldStyle(xacro)

    def read(text: Any, filename: str | None = None) -> xml.dom.minidom.Document:
        if text is not None or filename is None:
            source = text if isinstance(text, str | bytes) else text.read()
            parse(source, "<text>", UrdfError)
            return xml.dom.minidom.parseString(source)  # noqa: S318 (found harmless in the line above)
        if not exists(filename):  # xacro accepts this for an optional include
            xacro.filestack.pop()
            missing = OSError(f"{filename}: cannot be read: No such file or directory")
            raise xacro.XacroException(exc=missing)
        if limits is not None:
            limits.opened(filename)
        parse_file(filename, UrdfError)
        document = xml.dom.minidom.parse(filename)  # noqa: S318 (found harmless in the line above)
        old_style.add_prefixes(document, filename)
        return document

    arguments = xacro.substitution_args_context
    symbols = substitution._eval_dict  # noqa: SLF001 (there is no other way in)
    kept = dict(arguments), symbols["find"]
    for_xacro = {} if limits is None else limits.for_xacro()
    for_substitution = {} if limits is None else limits.for_substitution()
    with (
        _patched(substitution, _eval_find=find, **for_substitution),
        _patched(
            xacro,
            parse=read,
            filestack=None,
            macrostack=None,
            all_includes=[],
            handle_macro_call=old_style.handle_macro_call,
            **for_xacro,
        ),
    ):
        try:
            symbols["find"] = find
            arguments.clear()
            yield
        finally:
            arguments.clear()
            arguments.update(kept[0])
            symbols["find"] = kept[1]


@contextmanager
def _patched(module: Any, **values: Any) -> Iterator[None]:
    """Set names in a module for the duration of a block."""
    before = {name: getattr(module, name) for name in values}
    for name, value in values.items():
        setattr(module, name, value)
    try:
        yield
    finally:
        for name, value in before.items():
            setattr(module, name, value)


def _cause(error: BaseException) -> BaseException:
    """Return the error wrapped by xacro."""
    while getattr(error, "exc", None) is not None:
        error = error.exc  # type: ignore[attr-defined]  # checked in the line above
    return error


def _is_refused(error: BaseException | None) -> bool:
    """Return True if the root cause is an operation that is not allowed."""
    while error is not None:
        if isinstance(error, NotAllowed):
            return True
        error = getattr(error, "exc", None) or error.__cause__
    return False


def _message(error: Exception, mappings: Mapping[str, str]) -> str:
    """Return xacro's message, with advice."""
    said = " ".join(_ends(str(error)).split()) or repr(error)
    argument = re.search(r"Undefined substitution argument (\S+)", said)
    if argument:
        hint = nearest(argument[1], mappings)
        return (
            f"$(arg {argument[1]}) was not given and has no default: say {argument[1]}:=VALUE, or add "
            f'<xacro:arg name="{argument[1]}" default="..."/>{f"; {hint}" if hint else ""}'
        )
    cause = _cause(error)
    if _is_refused(error):
        return f"{said}: {UNCONFINED}"
    if isinstance(cause, RosminiError) and not isinstance(cause, ExpressionError):
        return str(cause)
    if isinstance(cause, RecursionError):
        return "macros call or include one another without end"
    return re.sub(r"<class '[\w.]+'>: ", "", said)


def _ends(text: str) -> str:
    """Return the beginning and the end of a text, because the cost of the patterns is quadratic in its length."""
    return text if len(text) <= 2 * SHOWN else f"{text[:SHOWN]} ... {text[-SHOWN:]}"


def main(arguments: Sequence[str]) -> int:
    """Run `rosrun xacro xacro FILE name:=value ...`: print the URDF or write it to the file after `-o`; return status.

    Obsolete options (`--inorder`, `-i`) are ignored, as in ROS.
    """
    mappings: dict[str, str] = {}
    files: list[str] = []
    output = None
    confined = True
    rest = list(arguments)
    while rest:
        word = rest.pop(0)
        if word == "-o" and rest:
            output = Path(rest.pop(0))
        elif word == "--unconfined":
            confined = False
        elif ":=" in word:
            name, _, value = word.partition(":=")
            mappings[name] = value
        elif word not in {"--inorder", "-i", "--xacro-ns"}:
            files.append(word)
    if len(files) != 1 or files[0].startswith("-"):
        print(f"xacro takes one file, not {' '.join(files) or 'none'}\n{USAGE}", file=sys.stderr)
        return 2
    try:
        text = expand(files[0], mappings, confined=confined)
        if output is not None:
            output.write_text(text, encoding="utf-8")
    except (RosminiError, OSError) as error:
        print(f"xacro: {error}", file=sys.stderr)
        return 2
    if output is None:
        print(text.rstrip("\n"))
    return 0


class OldStyle:
    """Reads files in the old style, `<macro>` and `<property>` without the prefix `xacro:`, and warns once.

    ROS accepted them until Melodic, with a warning. Since Noetic such tags are ordinary XML.
    """

    def __init__(self, xacro: Any) -> None:
        self._xacro, self._handle_macro_call = xacro, xacro.handle_macro_call
        self._names: set[str] = set()
        self._has_warned = False

    def add_prefixes(self, document: xml.dom.minidom.Document, file: str) -> None:
        """Add the prefix to the tags of a document. Inside `<plugin>` every tag belongs to the plugin."""
        found = []
        waiting: list[Any] = [document.documentElement]
        while waiting:
            element = waiting.pop()
            if element.tagName in ("macro", "xacro:macro"):
                self._names.add(element.getAttribute("name").removeprefix("xacro:"))
            attributes = PREFIXLESS.get(element.tagName)
            if attributes and all(element.hasAttribute(name) for name in attributes):
                found.append(element.tagName)
                _add_prefix(element)
            if element.tagName != "plugin":
                waiting += [child for child in element.childNodes if child.nodeType == child.ELEMENT_NODE]
        if found and not self._has_warned:
            self._has_warned = True
            tags = ", ".join(f"<{tag}>" for tag in sorted(set(found)))
            self._xacro.warning(
                f"{file}: {tags} without the prefix xacro: are read as xacro tags, as ROS did until Melodic; "
                "Noetic ignores them, so write <xacro:...>"
            )

    def handle_macro_call(self, node: Any, macros: Any, symbols: Any) -> Any:
        """Expand a macro call, which may lack the prefix if a macro of this name was read."""
        if self._has_warned and node.tagName in self._names:
            _add_prefix(node)
        return self._handle_macro_call(node, macros, symbols)


def _add_prefix(element: Any) -> None:
    element.tagName = element.nodeName = f"xacro:{element.tagName}"
