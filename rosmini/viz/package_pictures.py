"""Packages as pictures: what is in the folder of one, and which needs which."""

from __future__ import annotations

from collections.abc import Iterator
from pathlib import Path
from typing import NamedTuple

from rosmini.packages import PackageIndex, read_package
from rosmini.viz import style
from rosmini.viz.graph_drawing import arrow, box, drawing, name, rule
from rosmini.viz.layout import Edge, Vertex, layered
from rosmini.viz.metrics import text_width
from rosmini.viz.outline import HEAD, KIND, NAME, Row, outline
from rosmini.viz.svg import element
from rosmini.viz.view import Picture, ViewError
from rosmini.viz.words import plural

__all__ = ["package_graph", "package_tree"]

MEANINGS = {
    "CMakeLists.txt": "what is built, and how",
    "action": "definitions of actions",
    "cfg": "parameters that can be changed while a node runs",
    "config": "settings of nodes",
    "include": "C++ headers",
    "launch": "launch files",
    "maps": "maps",
    "meshes": "3D shapes",
    "models": "models of a simulator",
    "msg": "definitions of messages",
    "nodes": "programs in Python",
    "package.xml": "the manifest",
    "param": "settings of nodes",
    "rviz": "settings of RViz",
    "scripts": "programs in Python",
    "src": "source files",
    "srv": "definitions of services",
    "test": "tests",
    "urdf": "descriptions of robots",
    "worlds": "worlds of a simulator",
}
"""What stands by custom under these names in the folder of a package."""

DEEPEST, MOST = 3, 8
"""How many levels of folders are shown, and how many entries of one folder."""


class Entry(NamedTuple):
    """A row of the tree: its depth, its name, and what it is; "" where the name says it."""

    depth: int
    name: str
    meaning: str


def package_tree(package: str, *, index: PackageIndex | None = None, title: str | None = None) -> Picture:
    """Draw the folder of a package, and say what its parts are for.

    Args:
        package: its name.
        index: where packages are looked for; by default what `ROS_PACKAGE_PATH` names, and rosmini's own.
        title: a caption under the picture, and the first words of its text form.

    Raises:
        PackageNotFound: no such package.

    """
    folder = (index or PackageIndex()).path(package)
    entries = [Entry(0, package, _role(folder)), *_inside(folder, 1)]
    rows, last = [], {0: -1}
    for number, entry in enumerate(entries):
        kind = HEAD if entry.depth == 0 or entry.name.endswith("/") else NAME
        said = ((KIND, entry.meaning),) if entry.meaning else ()
        rows.append(Row(entry.depth, last.get(entry.depth - 1, -1), ((kind, entry.name), *said)))
        last[entry.depth] = number
    lines = [
        f"{'  ' * each.depth}{each.name}{f'  ({each.meaning})' if each.meaning else ''}" for each in entries
    ]
    alt = f"Tree of the folder of {package}: " + ", ".join(each.name for each in entries[1:])
    text = "\n".join(([f"{title}:"] if title else []) + lines)
    return Picture(outline(rows, title or package, alt), text=text, alt=alt, caption=title)


def _role(folder: Path) -> str:
    return "a metapackage" if read_package(folder).is_metapackage else "a package"


def _inside(folder: Path, depth: int) -> Iterator[Entry]:
    """Yield what is in a folder: files first, then folders, each by name."""
    found = sorted(folder.iterdir(), key=lambda path: (path.is_dir(), path.name))
    found = [path for path in found if not path.name.startswith((".", "__"))]
    for path in found[:MOST]:
        meaning = MEANINGS.get(path.name, "") if depth == 1 else ""
        yield Entry(depth, path.name + "/" * path.is_dir(), meaning)
        if path.is_dir() and depth < DEEPEST:
            yield from _inside(path, depth + 1)
    if len(found) > MOST:
        yield Entry(depth, "...", f"{len(found) - MOST} more")


def package_graph(
    *packages: str, depth: int = 1, index: PackageIndex | None = None, title: str | None = None
) -> Picture:
    """Draw which packages need which, as their manifests say.

    Args:
        packages: the names to begin with.
        depth: how many steps along the dependencies are taken from there.
        index: where packages are looked for; by default what `ROS_PACKAGE_PATH` names, and rosmini's own.
        title: a caption under the picture, and the first words of its text form.

    Raises:
        PackageNotFound: no such package.
        ViewError: no package is given.

    """
    if not packages:
        raise ViewError("package_graph() needs the name of a package, such as 'turtlebot3_gazebo'")
    index = index or PackageIndex()
    needs = _needs(index, packages, depth)
    shown = sorted({*needs, *(each for found in needs.values() for each in found)})
    groups = {each for each in shown if each in index and index.find(each).is_metapackage}
    lines = [f"{each} -> {', '.join(needs[each])}" for each in sorted(needs) if needs[each]]
    head = f"{title or 'packages'}: {plural(len(shown), 'package')}"
    if groups:
        lines.append(f"metapackages: {', '.join(sorted(groups))}")
    alt = f"Graph of {plural(len(shown), 'package')}. {'; '.join(lines)}".replace("->", "needs")
    svg = _draw(shown, needs, groups, title or "packages", alt)
    return Picture(svg, text="\n".join([head, *lines]), alt=alt, caption=title)


def _needs(index: PackageIndex, packages: tuple[str, ...], depth: int) -> dict[str, tuple[str, ...]]:
    """Return the dependencies of packages, and of those up to `depth` steps away."""
    needs: dict[str, tuple[str, ...]] = {}
    level = list(packages)
    for each in packages:
        index.path(each)
    for _ in range(depth):
        for each in level:
            needs[each] = index.find(each).depends if each in index else ()
        level = sorted({need for each in level for need in needs[each]} - set(needs))
    return needs


def _draw(shown: list[str], needs: dict[str, tuple[str, ...]], groups: set[str], title: str, alt: str) -> str:
    vertices = [Vertex(each, text_width(each, style.TEXT_SIZE) + 26, 30.0, "box") for each in shown]
    edges = [Edge(f"{each} {need}", each, need, 0.0, 0.0) for each in sorted(needs) for need in needs[each]]
    layout = layered(vertices, edges, direction="down")
    parts = [element("g", arrow(layout.edges[edge.name]), class_="pk-edge") for edge in edges]
    for vertex in vertices:
        rect = layout.vertices[vertex.name]
        kind = "topic" if vertex.name in groups else "node"
        shape = box(rect, kind, 6.0) + name(vertex.name, rect)
        parts.append(element("g", shape, class_=f"pk-{kind}"))
    css = (
        rule(".pk-node rect", fill="node-fill", stroke="node-line")
        + rule(".pk-topic rect", fill="topic-fill", stroke="topic-line")
        + rule(".pk-node text,.rosmini-svg .pk-topic text", fill="ink")
        + rule(".pk-edge path:first-of-type", stroke="line")
        + rule(".pk-edge path:last-of-type", fill="line")
        + f".rosmini-svg path:first-of-type,.rosmini-svg rect{{stroke-width:{style.LINE_WIDTH}}}"
    )
    colours = ["ink", "line", "node-fill", "node-line", "topic-fill", "topic-line"]
    return drawing(parts, layout, title=title, alt=alt, css=css, colours=colours)
