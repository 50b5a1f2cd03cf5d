"""One layered layout for every graph that rosmini draws: plain Python, with the same result on every machine.

`layered(vertices, edges)` takes names and sizes and returns positions and curves. It does not know what is drawn,
and it sorts its input first, so that the same graph gives the same drawing in whatever order it arrives.
"""

from __future__ import annotations

from collections.abc import Iterable, Sequence

from rosmini.viz.layout.coordinates import GROUP_HEAD, GROUP_PAD, assign_across
from rosmini.viz.layout.model import Direction, Edge, Layout, Rect, Route, Vertex
from rosmini.viz.layout.ordering import order_layers
from rosmini.viz.layout.routing import Bands, group_rectangles, rectangles, routes
from rosmini.viz.layout.slots import Joined, make_proper

__all__ = ["Direction", "Edge", "Layout", "Rect", "Route", "Vertex", "layered"]

ARROW_ROOM = 12.0
COMPONENT_GAP = 26.0
PAGE_WIDTH = 680.0
"""Components are placed side by side up to this width, or up to the width of the widest component."""


def layered(
    vertices: Iterable[Vertex], edges: Iterable[Edge], *, direction: Direction = "right", first: str | None = None
) -> Layout:
    """Lay out a directed graph in layers that follow its edges to the right or down.

    Args:
        vertices: the vertices to place; their names are unique.
        edges: edges from vertex name to vertex name; their names are unique. Parallel edges and loops are allowed.
        direction: the direction of the edges: "right" as in rqt_graph, or "down" as in a tree of frames.
        first: the vertex at which cycles begin; None breaks cycles so that the fewest edges run backwards.

    Raises:
        ValueError: a name is used twice, or an end of an edge is not a vertex.

    """
    vertices = sorted(vertices, key=lambda vertex: vertex.name)
    edges = sorted(edges, key=lambda edge: edge.name)
    _check(vertices, edges)
    if direction == "down":
        vertices, edges = [_turned_vertex(v) for v in vertices], [_turned_edge(e) for e in edges]
    parts = [_component(some, among, direction, first) for some, among in _components(vertices, edges)]
    layout = _on_shelves(parts, direction)
    return layout if direction == "right" else _turned(layout)


def _check(vertices: Sequence[Vertex], edges: Sequence[Edge]) -> None:
    names = {vertex.name for vertex in vertices}
    if len(names) < len(vertices) or len({edge.name for edge in edges}) < len(edges):
        raise ValueError("the names of vertices and of edges must be unique")
    for edge in edges:
        if edge.source not in names or edge.target not in names:
            raise ValueError(f"edge {edge.name!r} leads from {edge.source!r} to {edge.target!r}: no such vertex")


def _components(vertices: Sequence[Vertex], edges: Sequence[Edge]) -> list[tuple[list[Vertex], list[Edge]]]:
    """Return sets of vertices connected by edges or by an outermost group; the largest first, then by name."""
    joined = Joined(vertex.name for vertex in vertices)
    first_of_group: dict[str, str] = {}
    for vertex in vertices:
        if vertex.groups:
            joined.join(vertex.name, first_of_group.setdefault(vertex.groups[0], vertex.name))
    for edge in edges:
        joined.join(edge.source, edge.target)
    parts: dict[str, tuple[list[Vertex], list[Edge]]] = {}
    for vertex in vertices:
        parts.setdefault(joined.find(vertex.name), ([], []))[0].append(vertex)
    for edge in edges:
        parts[joined.find(edge.source)][1].append(edge)
    return [parts[root] for root in sorted(parts, key=lambda root: (-len(parts[root][0]), root))]


def _component(vertices: Sequence[Vertex], edges: Sequence[Edge], direction: Direction, first: str | None) -> Layout:
    # The name of a group is written along its upper border, whatever the direction of the layers. In a downward
    # layout, arrowheads end below that name and need extra room.
    along, across = (GROUP_PAD, GROUP_HEAD) if direction == "right" else (GROUP_HEAD + ARROW_ROOM, GROUP_PAD)
    proper = make_proper(vertices, edges, first)
    order_layers(proper)
    assign_across(proper, across)
    bands = Bands(proper, along)
    return _at_origin(
        Layout(
            vertices=rectangles(proper, bands, vertices),
            edges=routes(proper, bands, vertices),
            groups=group_rectangles(proper, bands, along, across),
            layers={name: slot.layer for name, slot in proper.vertices.items()},
        )
    )


def _at_origin(part: Layout) -> Layout:
    boxes = [*part.vertices.values(), *part.groups.values()]
    boxes += [route.label for route in part.edges.values() if route.label]
    points = [point for route in part.edges.values() for point in route.points]
    left = min([box.x for box in boxes] + [x for x, _ in points])
    top = min([box.y for box in boxes] + [y for _, y in points])
    right = max([box.right for box in boxes] + [x for x, _ in points])
    bottom = max([box.bottom for box in boxes] + [y for _, y in points])
    return _moved(part, -left, -top, right - left, bottom - top)


def _moved(part: Layout, dx: float, dy: float, width: float, height: float) -> Layout:
    return Layout(
        width,
        height,
        {name: rect.moved(dx, dy) for name, rect in part.vertices.items()},
        {name: route.moved(dx, dy) for name, route in part.edges.items()},
        {path: rect.moved(dx, dy) for path, rect in part.groups.items()},
        part.layers,
    )


def _on_shelves(parts: Sequence[Layout], direction: Direction) -> Layout:
    """Put components side by side in rows, as wide as the page or as the widest component."""
    if direction == "down":  # at this point the parts are still transposed
        return _turned(_on_shelves([_turned(part) for part in parts], "right"))
    limit = max([PAGE_WIDTH, *(part.width for part in parts)])
    x = y = shelf = widest = 0.0
    whole = Layout()
    for part in parts:
        if x > 0 and x + part.width > limit:
            x, y, shelf = 0.0, y + shelf + COMPONENT_GAP, 0.0
        placed = _moved(part, x, y, part.width, part.height)
        for name in ("vertices", "edges", "groups", "layers"):
            getattr(whole, name).update(getattr(placed, name))
        widest = max(widest, x + part.width)
        x += part.width + COMPONENT_GAP
        shelf = max(shelf, part.height)
    return _moved(whole, 0.0, 0.0, widest, y + shelf)


def _turned_vertex(v: Vertex) -> Vertex:
    return Vertex(v.name, v.height, v.width, v.shape, v.groups)


def _turned_edge(e: Edge) -> Edge:
    return Edge(e.name, e.source, e.target, e.label_height, e.label_width)


def _turned_rect(r: Rect) -> Rect:
    return Rect(r.y, r.x, r.height, r.width)


def _turned(layout: Layout) -> Layout:
    """Mirror a layout in the diagonal, so that edges to the right lead down."""
    return Layout(
        layout.height,
        layout.width,
        {name: _turned_rect(rect) for name, rect in layout.vertices.items()},
        {
            name: Route(
                tuple((y, x) for x, y in route.points),
                _turned_rect(route.label) if route.label else None,
                route.reversed,
            )
            for name, route in layout.edges.items()
        },
        {path: _turned_rect(rect) for path, rect in layout.groups.items()},
        layout.layers,
    )
