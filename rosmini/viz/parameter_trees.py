"""The parameters of a graph as a tree: a branch for each namespace, a leaf for each value."""

from __future__ import annotations

from collections.abc import Collection, Iterable, Iterator, Mapping
from dataclasses import dataclass
from typing import Any

from rosmini.viz.outline import HEAD, KIND, NAME, VALUE, Row, outline
from rosmini.viz.view import Picture, ViewError
from rosmini.viz.words import plural

ROSCORE = ("/rosdistro", "/roslaunch", "/rosversion", "/run_id")
"""Parameters that roscore and roslaunch set themselves."""

MAX_LENGTH = 44
"""Maximum number of characters of a value that are shown."""


@dataclass(frozen=True)
class _Row:
    depth: int
    name: str
    parent: int
    value: Any
    is_namespace: bool


def parameter_tree(
    source: object, namespace: str = "/", *, hide: Collection[str] = ROSCORE, title: str | None = None
) -> Picture:
    """Draw the parameters in a namespace as a tree, in alphabetical order.

    Args:
        source: a graph, its Master, or a dictionary of parameters.
        namespace: the namespace to draw, `/` for all.
        hide: full names to leave out; by default the parameters that roscore and roslaunch set themselves.
        title: a caption under the picture, and the first words of its text form.

    Raises:
        ViewError: the source has no parameters, or the namespace does not exist.

    """
    rows = list(_rows(_tree(source, namespace), namespace, hide, 0, -1))
    leaves = sum(not row.is_namespace for row in rows)
    branches = len(rows) - leaves
    counted = f"{plural(leaves, 'parameter')} in {plural(branches, 'namespace')}"
    lines = [f"{title or 'parameters'}: {counted}"]
    for row in rows:
        said = row.name if row.is_namespace else f"{row.name}: {_shown(row.value)} ({_kind(row.value)})"
        lines.append("  " * row.depth + said)
    first = ", ".join(f"{row.name} is {_shown(row.value)}" for row in rows if not row.is_namespace)
    alt = f"Tree of parameters under {namespace}: {counted}. {first}".strip()
    drawn = [Row(row.depth, row.parent, _cells(row)) for row in rows]
    return Picture(outline(drawn, title or "Parameters", alt), text="\n".join(lines), alt=alt, caption=title)


def _cells(row: _Row) -> tuple[tuple[str, str], ...]:
    if row.is_namespace:
        return ((HEAD, row.name),)
    return ((NAME, row.name), (VALUE, _shown(row.value)), (KIND, _kind(row.value)))


def _tree(source: object, namespace: str) -> dict[str, Any]:
    master = getattr(source, "master", source)
    if isinstance(source, Mapping):
        return dict(source)
    if not hasattr(master, "getParam"):
        raise ViewError(f"{type(source).__name__} has no parameters: give a graph, its Master, or a dictionary")
    code, status, found = master.getParam("/parameter_tree", namespace)
    if code != 1:
        raise ViewError(status)
    if not isinstance(found, dict):
        raise ViewError(f"{namespace} is a parameter, {_shown(found)}, not a namespace")
    return found


def _rows(
    tree: Mapping[str, Any], full: str, hide: Collection[str], depth: int, parent: int, number: int = 0
) -> Iterator[_Row]:
    """Yield a namespace, as row `number`, and its contents."""
    yield _Row(depth, full if depth == 0 else full.rpartition("/")[2] + "/", parent, None, is_namespace=True)
    following = number + 1
    for name in sorted(tree):
        path = f"{full.rstrip('/')}/{name}"
        if path in hide:
            continue
        rows: Iterable[_Row] = [_Row(depth + 1, name, number, tree[name], is_namespace=False)]
        if isinstance(tree[name], Mapping):
            rows = _rows(tree[name], path, hide, depth + 1, number, following)
        for row in rows:
            yield row
            following += 1


def _kind(value: Any) -> str:
    return type(value).__name__


def _shown(value: Any) -> str:
    if isinstance(value, float):
        text = f"{value:.6g}"
        text = text if any(mark in text for mark in ".en") else text + ".0"
    elif isinstance(value, list):
        text = f"[{', '.join(_shown(item) for item in value)}]"
    else:
        text = repr(value)
    return text if len(text) <= MAX_LENGTH else text[: MAX_LENGTH - 3] + "..."
