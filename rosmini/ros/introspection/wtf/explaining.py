"""Finds the finding that explains an error: `roswtf` for a cell that failed."""

from __future__ import annotations

import re
from dataclasses import replace
from pathlib import Path, PurePath
from typing import TYPE_CHECKING

from rosmini.core.errors import (
    GraphEnded,
    ROSException,
    RosminiError,
    ScriptError,
    TypeMismatch,
    UnknownPackage,
    nearest,
)

from . import graph_rules
from .findings import Finding

if TYPE_CHECKING:
    from collections.abc import Callable, Iterable, Iterator

    from .survey import Survey

_NAME = re.compile(r"(?<![\w:./])/[A-Za-z]\w*(?:/\w+)*")
"""A global graph name in a text; not a path with a dot in it, and not part of an address."""
_WAITED = re.compile(r"time(d ?)?out|waiting|wait(ed)? for|never|nothing (more|else)", re.IGNORECASE)
_CLOCKS = ("no_clock", "several_clocks")


def is_known(error: BaseException) -> bool:
    """Return True if there are rules for errors of this kind."""
    return isinstance(error, RosminiError | ModuleNotFoundError)


def explain(error: BaseException, graph: Survey | None, static: Callable[[], Iterable[Finding]]) -> Finding | None:
    """Return the finding that explains an error, with the related places; None if no finding does.

    Args:
        error: the exception.
        graph: the survey of the graph, if any.
        static: finds problems of the environment and the packages; called only if they may be the cause.

    """
    if isinstance(error, UnknownPackage | ScriptError | ModuleNotFoundError):
        return next(_of_packages(error, static()), None)
    if graph is None or not isinstance(error, RosminiError) or isinstance(error, TypeMismatch):
        return None  # the error message is sufficient
    return next(_of_graph(error, graph), None)


def _of_packages(error: BaseException, findings: Iterable[Finding]) -> Iterator[Finding]:
    text = str(error)
    words = set(re.findall(r"\w+", text))
    for each in findings:
        if each.rule == "missing_folders" and isinstance(error, UnknownPackage):
            yield each
        where = tuple(line for line in each.where if line not in text and _package_in(line) in words)
        if where:
            yield replace(each, where=where)


def _package_in(line: str) -> str:
    """Return the package named in a line of a static finding: ``name: ...``, ``name/script: ...`` or a manifest."""
    place = re.split(r":(?:\s|\d)", line, maxsplit=1)[0]
    path = PurePath(place)
    return path.parent.name if path.name in ("package.xml", "manifest.xml") else path.parts[0] if path.parts else ""


def _of_graph(error: RosminiError, graph: Survey) -> Iterator[Finding]:
    text = str(error)
    names = set(_NAME.findall(text))
    found = [each for rule in graph_rules.RULES for each in rule(graph)]
    if isinstance(error, ROSException | GraphEnded) and _WAITED.search(text):
        yield from (each for each in found if each.rule in _CLOCKS)
    if "did you mean" not in text:
        yield from _misnamed(names, graph)
    sources = {node for name in names for node in graph.publishers.get(name, ())}
    for each in found:
        where = tuple(_about(each.where, names | sources))
        if where and each.rule not in _CLOCKS:
            yield replace(each, where=where)


def _misnamed(names: set[str], graph: Survey) -> Iterator[Finding]:
    """Yield the probable meaning of a name that does not exist in the graph."""
    published = {name for name, nodes in graph.publishers.items() if nodes}
    known = {*published, *graph.services, *graph.nodes}
    for name in sorted(names - known):
        if Path("/", name.split("/")[1]).exists():
            continue  # a path
        hint = nearest(name, known)
        if hint:
            yield Finding("misnamed", "ERROR", f"Nothing in the graph is called {name}; {hint}")


def _about(lines: Iterable[str], names: set[str]) -> Iterator[str]:
    """Yield the places that mention one of these names, each with its indented lines."""
    is_about = False
    for line in lines:
        is_about = is_about if line.startswith(" ") else bool(names & set(_NAME.findall(line)))
        if is_about:
            yield line
