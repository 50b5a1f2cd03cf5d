"""Positions along the layers, and curves: horizontal through the layers, bending only in the gaps between them.

A slot reserves the full width of its layer at its own height, and gaps contain nothing but curves, so no edge can
cross a vertex or the label of another edge.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from math import sqrt

from rosmini.viz.layout.coordinates import GROUP_PAD
from rosmini.viz.layout.model import Edge, Point, Rect, Route, Vertex
from rosmini.viz.layout.slots import LABEL_RISE, LOOP_DEPTH, Chain, Proper, Slot

LAYER_GAP = 30.0
LABEL_GAP = 22.0
"""Gap beside a layer that contains only labels and bends."""


class Bands:
    """The start and end of each layer along the direction of the layout."""

    def __init__(self, proper: Proper, head: float) -> None:
        widths = [max((slot.length for slot in row), default=0.0) for row in proper.layers]
        opens, closes = _group_ends(proper)
        self.start: list[float] = []
        position = opens[0] * head
        for layer, width in enumerate(widths):
            if layer:
                position += _gap(proper.layers[layer - 1], proper.layers[layer])
                position += closes[layer - 1] * GROUP_PAD + opens[layer] * head
            self.start.append(position)
            position += width
        self.widths = widths
        self.length = position + closes[-1] * GROUP_PAD

    def end(self, layer: int) -> float:
        """Return the end of a layer."""
        return self.start[layer] + self.widths[layer]

    def middle(self, layer: int) -> float:
        """Return the centre line of a layer."""
        return self.start[layer] + self.widths[layer] / 2


def _group_ends(proper: Proper) -> tuple[list[int], list[int]]:
    """Return, for each layer, the nesting depth of the groups that begin there, and of those that end there."""
    opens, closes = [0] * len(proper.layers), [0] * len(proper.layers)
    spans: dict[tuple[str, ...], tuple[int, int]] = {}
    for group in proper.groups:
        inside = [s.layer for row in proper.layers for s in row if s.groups[: len(group)] == group]
        spans[group] = min(inside), max(inside)
    for group, (first, last) in spans.items():
        prefixes = [group[:depth] for depth in range(1, len(group) + 1)]
        opens[first] = max(opens[first], sum(1 for p in prefixes if spans[p][0] == first))
        closes[last] = max(closes[last], sum(1 for p in prefixes if spans[p][1] == last))
    return opens, closes


def _gap(row: Sequence[Slot], following: Sequence[Slot]) -> float:
    """Return the gap between two layers; steep curves get more room."""
    steepest = max((abs(slot.at - other.at) for slot in row for other, _ in slot.following), default=0.0)
    base = LAYER_GAP if any(not s.bend for s in row) and any(not s.bend for s in following) else LABEL_GAP
    return base + min(50.0, 0.16 * steepest)


def rectangles(proper: Proper, bands: Bands, vertices: Sequence[Vertex]) -> dict[str, Rect]:
    """Place each vertex in the middle of its layer."""
    return {
        vertex.name: Rect(
            bands.middle(proper.vertices[vertex.name].layer) - vertex.width / 2,
            proper.vertices[vertex.name].at - vertex.height / 2,
            vertex.width,
            vertex.height,
        )
        for vertex in vertices
    }


def group_rectangles(proper: Proper, bands: Bands, along: float, across: float) -> dict[tuple[str, ...], Rect]:
    """Return a box around each group; `along` and `across` are the room at its beginning in the two directions."""
    boxes: dict[tuple[str, ...], Rect] = {}
    for group in reversed(proper.groups):  # inner boxes first, because the outer ones enclose them
        depth = len(group)
        own = [s for row in proper.layers for s in row if s.groups == group]
        inner = [box for path, box in boxes.items() if path[:depth] == group]
        left = min([bands.start[s.layer] for s in own] + [box.x for box in inner]) - along
        right = max([bands.end(s.layer) for s in own] + [box.right for box in inner]) + GROUP_PAD
        top = min([s.at - s.before for s in own] + [box.y for box in inner]) - across
        bottom = max([s.at + s.after for s in own] + [box.bottom for box in inner]) + GROUP_PAD
        boxes[group] = Rect(left, top, right - left, bottom - top)
    return boxes


def routes(proper: Proper, bands: Bands, vertices: Sequence[Vertex]) -> dict[str, Route]:
    """Return the curve of every edge, loops included, from its source to its target."""
    rects = rectangles(proper, bands, vertices)
    shapes = {vertex.name: vertex.shape for vertex in vertices}
    ports = _Ports(proper, rects, shapes)
    result = {chain.edge.name: _route(chain, bands, ports) for chain in proper.chains}
    for name, loops in proper.loops.items():
        result.update(_loops(loops, rects[name], shapes[name] == "ellipse"))
    return result


class _Ports:
    """The points where edges touch a vertex: spread over its side, in the order of the edges' other ends."""

    def __init__(self, proper: Proper, rects: dict[str, Rect], shapes: Mapping[str, str]) -> None:
        self.rects = rects
        self.shapes = shapes
        self.offsets: dict[tuple[str, str], float] = {}
        ends: dict[tuple[str, bool], list[tuple[float, int, str]]] = {}
        for i, chain in enumerate(proper.chains):
            first, last = chain.slots[0], chain.slots[-1]
            ends.setdefault((first.name, True), []).append((chain.slots[1].at, i, chain.edge.name))
            ends.setdefault((last.name, False), []).append((chain.slots[-2].at, i, chain.edge.name))
        for (vertex, outgoing), found in ends.items():
            self._spread(vertex, outgoing, sorted(found))

    def _spread(self, vertex: str, outgoing: bool, found: list[tuple[float, int, str]]) -> None:
        usable = self.rects[vertex].height * (0.62 if self.shapes[vertex] == "ellipse" else 0.7)
        step = min(11.0, usable / max(1, len(found) - 1))
        centre = self.rects[vertex].centre[1]
        lowest = centre - step * (len(found) - 1) / 2
        if len(found) == 1:  # a single edge goes straight on if the side is high enough
            lowest = max(centre - usable / 4, min(found[0][0], centre + usable / 4))
        for i, (_, _, edge) in enumerate(found):
            self.offsets[edge, "out" if outgoing else "in"] = lowest + i * step

    def point(self, vertex: str, edge: str, *, outgoing: bool) -> Point:
        rect = self.rects[vertex]
        y = self.offsets[edge, "out" if outgoing else "in"]
        reach = rect.width / 2
        if self.shapes[vertex] == "ellipse":
            share = (y - rect.centre[1]) / (rect.height / 2)
            reach *= sqrt(max(0.0, 1 - share * share))
        return (rect.centre[0] + (reach if outgoing else -reach), y)


def _route(chain: Chain, bands: Bands, ports: _Ports) -> Route:
    """Return a curve that is straight through each layer at the slot's height, with an S-curve in each gap."""
    first, last = chain.slots[0], chain.slots[-1]
    start = ports.point(first.name, chain.edge.name, outgoing=True)
    end = ports.point(last.name, chain.edge.name, outgoing=False)
    stops: list[tuple[Point, Point]] = [(start, (bands.end(first.layer), start[1]))]
    stops += [((bands.start[s.layer], s.at), (bands.end(s.layer), s.at)) for s in chain.slots[1:-1]]
    stops.append(((bands.start[last.layer], end[1]), end))
    points = [start]
    for i, (entry, leave) in enumerate(stops):
        if i:
            (x0, y0), (x1, y1) = points[-1], entry
            middle = (x0 + x1) / 2
            points += [(middle, y0), (middle, y1), entry]
        if leave[0] > points[-1][0] + 0.05:
            (x0, y0), x1 = points[-1], leave[0]
            points += [(x0 + (x1 - x0) / 3, y0), (x1 - (x1 - x0) / 3, y0), leave]
    label = None
    if chain.label:
        slot = chain.label
        width, height = chain.edge.label_width, chain.edge.label_height
        label = Rect(bands.middle(slot.layer) - width / 2, slot.at - LABEL_RISE - height, width, height)
    if chain.reversed:
        points.reverse()
    return Route(tuple(points), label, chain.reversed)


def _loops(edges: Sequence[Edge], rect: Rect, ellipse: bool) -> dict[str, Route]:
    """Return one shared loop for edges from a vertex to itself, on its far side, with their labels stacked below."""
    x, _ = rect.centre
    spread = min(rect.width * 0.22, 26.0)
    share = spread / (rect.width / 2)
    y = rect.centre[1] + rect.height / 2 * (sqrt(1 - share * share) if ellipse else 1.0)
    low = rect.bottom + (LOOP_DEPTH - (y - rect.y - rect.height)) / 0.75 - 4.0
    points = ((x + spread, y), (x + spread * 1.6, low), (x - spread * 1.6, low), (x - spread, y))
    result = {}
    foot = rect.bottom + LOOP_DEPTH
    for edge in edges:
        label = None
        if edge.labelled:
            label = Rect(x - edge.label_width / 2, foot + LABEL_RISE, edge.label_width, edge.label_height)
            foot = label.bottom
        result[edge.name] = Route(points, label)
    return result
