"""The parameters of a graph as a tree: a branch for each namespace, a leaf for each value."""

from __future__ import annotations

from collections.abc import Collection, Iterable, Iterator, Mapping
from dataclasses import dataclass
from typing import Any

from rosmini.viz import style
from rosmini.viz.metrics import text_width
from rosmini.viz.rqt.wording import plural
from rosmini.viz.svg import document, element, escape
from rosmini.viz.view import Picture, ViewError

__all__ = ["parameter_tree"]

ROSCORE = ("/rosdistro", "/roslaunch", "/rosversion", "/run_id")
"""What roscore and roslaunch set for themselves."""

LONGEST = 44
"""How many characters of a value are shown."""

MARGIN, ROW, STEP, GAP = 12.0, 24.0, 24.0, 14.0
COLOURS = ["ink", "muted", "group-line", "node-line", "topic-fill", "topic-line"]


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
        namespace: what to draw, `/` for all.
        hide: full names that are left out; those that roscore sets for itself, if not given.
        title: a caption under the picture, and the first words of its text form.

    Raises:
        ViewError: the source has no parameters, or there is no such namespace.

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
    return Picture(_draw(rows, title or "Parameters", alt), text="\n".join(lines), alt=alt, caption=title)


def _tree(source: object, namespace: str) -> dict[str, Any]:
    master = getattr(source, "master", source)
    if isinstance(source, Mapping):
        return dict(source)
    if not hasattr(master, "getParam"):
        raise ViewError(
            f"{type(source).__name__} has no parameters: give a graph, its Master, or a dictionary"
        )
    code, status, found = master.getParam("/parameter_tree", namespace)
    if code != 1:
        raise ViewError(status)
    if not isinstance(found, dict):
        raise ViewError(f"{namespace} is no namespace but a parameter, {_shown(found)}")
    return found


def _rows(
    tree: Mapping[str, Any], full: str, hide: Collection[str], depth: int, parent: int, number: int = 0
) -> Iterator[_Row]:
    """Yield a namespace, as row `number`, and what is in it."""
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
    return text if len(text) <= LONGEST else text[: LONGEST - 3] + "..."


def _draw(rows: list[_Row], title: str, alt: str) -> str:
    parts: list[str] = []
    width = 200.0
    for number, row in enumerate(rows):
        x, y = MARGIN + STEP * row.depth, MARGIN + ROW * (number + 0.5)
        if row.parent >= 0:
            trunk, top = x - STEP + 6, MARGIN + ROW * (row.parent + 0.5) + 9
            parts.append(element("path", d=f"M{trunk:.1f},{top:.1f}V{y:.1f}H{x - 4:.1f}", class_="pt-line"))
        cells = [("pt-namespace" if row.is_namespace else "pt-name", row.name)]
        if not row.is_namespace:
            cells += [("pt-value", _shown(row.value)), ("pt-kind", _kind(row.value))]
        for kind, text in cells:
            parts.append(element("text", escape(text), x=x, y=y + 4.5, class_=kind))
            x += text_width(text, style.TEXT_SIZE) * (1.08 if kind == "pt-namespace" else 1.0) + GAP
        width = max(width, x + MARGIN)
    css = (
        f".pt-line{{fill:none;stroke:{style.variable('group-line')};stroke-width:{style.HAIRLINE};"
        "shape-rendering:crispEdges}"
        f".rosmini-svg text{{font-size:{style.TEXT_SIZE}px;fill:{style.variable('ink')}}}"
        ".rosmini-svg .pt-namespace{font-weight:700}"
        f".rosmini-svg .pt-value{{fill:{style.variable('node-line')}}}"
        f".rosmini-svg .pt-kind{{fill:{style.variable('muted')};font-style:italic}}"
    )
    height = ROW * len(rows) + 2 * MARGIN
    return document(
        "".join(parts), width=width, height=height, title=title, alt=alt, css=css, colours=COLOURS
    )
