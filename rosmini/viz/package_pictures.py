"""Packages as pictures: the contents of the folder of a package or workspace, and the dependencies of packages."""

from __future__ import annotations

import os
from collections.abc import Iterator, Mapping
from pathlib import Path
from typing import NamedTuple

from rosmini.core.packages import DEVEL_MARKER, MANIFEST, PackageIndex, read_package
from rosmini.viz import style
from rosmini.viz.graph_drawing import arrow, box, drawing, name, rule
from rosmini.viz.layout import Edge, Vertex, layered
from rosmini.viz.metrics import text_width
from rosmini.viz.outline import HEAD, KIND, NAME, Row, outline
from rosmini.viz.svg import element
from rosmini.viz.view import Picture, ViewError
from rosmini.viz.words import plural

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
"""Usual contents of a package's folder, by name."""

SPACES = {
    "build": "the build space: the notes of the build",
    "build/rosmini.json": "what was made of what",
    "devel": "the development space: what was made",
    "devel/env.sh": "runs one command with them set",
    "devel/include": "C++ headers that were made",
    "devel/lib": "modules, libraries and programs",
    "devel/setup.bash": "sets the variables of a shell",
    "devel/setup.ps1": "the same for PowerShell",
    "devel/setup.sh": "the same for any POSIX shell",
    "devel/setup.zsh": "the same for zsh",
    "devel/share": "data that was made",
    "install": "the install space: what is delivered",
    "src": "the source space: what you write",
    "src/CMakeLists.txt": "makes one build of all packages",
}
"""Contents of a catkin workspace, by relative path."""

MAX_DEPTH, MAX_ENTRIES = 3, 8
"""Maximum number of levels of folders, and of entries of a folder, that are shown."""


class Entry(NamedTuple):
    """A row of the tree: its depth, its name, and its meaning ("" if the name is enough)."""

    depth: int
    name: str
    meaning: str


def package_tree(package: str, *, index: PackageIndex | None = None, title: str | None = None) -> Picture:
    """Draw the folder of a package with the purpose of its parts.

    Args:
        package: the name of the package.
        index: the index in which packages are searched; by default `ROS_PACKAGE_PATH` and rosmini's own packages.
        title: a caption under the picture, and the first words of its text form.

    Raises:
        PackageNotFound: no such package.

    """
    folder = (index or PackageIndex()).path(package)
    entries = [Entry(0, package, _role(folder)), *_inside(folder, 1, MEANINGS)]
    return _tree(entries, f"Tree of the folder of {package}", title)


def workspace_tree(space: str = "", *, devel: Path | None = None, title: str | None = None) -> Picture:
    """Draw the folders of a workspace with their purposes.

    Args:
        space: draw only this folder, such as "src"; by default all folders, to the second level.
        devel: its development space; by default the first one in `CMAKE_PREFIX_PATH`: the workspace sourced last.
        title: a caption under the picture, and the first words of its text form.

    Raises:
        ViewError: no workspace is in use, or it has no such folder.

    """
    paths = os.environ.get("CMAKE_PREFIX_PATH", "").split(os.pathsep) if devel is None else [str(devel)]
    found = [Path(each) for each in paths if each and (Path(each) / DEVEL_MARKER).is_file()]
    if not found:
        raise ViewError("no workspace is in use; catkin_make builds one, and `source devel/setup.bash` uses it")
    base = found[0].parent
    folder = base / space
    if not folder.is_dir():
        raise ViewError(f"the workspace {base.name} has no folder {space!r}; has it been built?")
    if space:
        meanings = {key.removeprefix(f"{space}/"): value for key, value in SPACES.items()}
        entries = [Entry(0, f"{base.name}/{space}/", SPACES.get(space, "")), *_inside(folder, 1, meanings)]
    else:
        entries = [Entry(0, f"{base.name}/", "a workspace"), *_inside(folder, 1, SPACES, deepest=2)]
    return _tree(entries, f"Tree of the folder {entries[0].name}", title)


def _tree(entries: list[Entry], what: str, title: str | None) -> Picture:
    rows, last = [], {0: -1}
    for number, entry in enumerate(entries):
        kind = HEAD if entry.depth == 0 or entry.name.endswith("/") else NAME
        said = ((KIND, entry.meaning),) if entry.meaning else ()
        rows.append(Row(entry.depth, last.get(entry.depth - 1, -1), ((kind, entry.name), *said)))
        last[entry.depth] = number
    lines = [f"{'  ' * each.depth}{each.name}{f'  ({each.meaning})' if each.meaning else ''}" for each in entries]
    alt = f"{what}: " + ", ".join(each.name for each in entries[1:])
    text = "\n".join(([f"{title}:"] if title else []) + lines)
    return Picture(outline(rows, title or entries[0].name, alt), text=text, alt=alt, caption=title)


def _role(folder: Path) -> str:
    return "a metapackage" if read_package(folder).is_metapackage else "a package"


def _inside(
    folder: Path, depth: int, meanings: Mapping[str, str], *, deepest: int = MAX_DEPTH, below: str = ""
) -> Iterator[Entry]:
    """Yield the contents of a folder: files first, then folders, each by name; `meanings` is keyed by relative path."""
    found = sorted(folder.iterdir(), key=lambda path: (path.is_dir(), path.name))
    found = [path for path in found if not path.name.startswith((".", "__"))]
    for path in found[:MAX_ENTRIES]:
        meaning, inner, place = meanings.get(below + path.name, ""), meanings, f"{below}{path.name}/"
        if (path / MANIFEST).is_file():
            meaning, inner, place = _role(path), MEANINGS, ""
        yield Entry(depth, path.name + "/" * path.is_dir(), meaning)
        if path.is_dir() and depth < deepest:
            yield from _inside(path, depth + 1, inner, deepest=deepest, below=place)
    if len(found) > MAX_ENTRIES:
        yield Entry(depth, "...", f"{len(found) - MAX_ENTRIES} more")


def package_graph(
    *packages: str, depth: int = 1, index: PackageIndex | None = None, title: str | None = None
) -> Picture:
    """Draw the dependencies between packages, according to their manifests.

    Args:
        packages: the names of the packages to start from.
        depth: the number of steps along the dependencies.
        index: the index in which packages are searched; by default `ROS_PACKAGE_PATH` and rosmini's own packages.
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
