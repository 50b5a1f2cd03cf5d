"""Build the proper layered graph: every edge is a chain of slots, one in each layer that it passes through."""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from dataclasses import dataclass, field
from itertools import pairwise, takewhile
from typing import Generic, TypeVar

from rosmini.viz.layout.model import Edge, Vertex
from rosmini.viz.layout.ranks import feedback_arcs, layers

T = TypeVar("T", int, str)

LABEL_RISE = 3.0
"""Distance between a line and the bottom of the label above it [px]."""
LOOP_DEPTH = 18.0
"""Distance that the loop of an edge from a vertex to itself extends beyond the vertex [px]."""


@dataclass(eq=False)
class Slot:
    """A position in a layer: for a vertex, a bend of an edge, a label, or a spacer that keeps a group together.

    `before` and `after` are the extents across the layer's direction, on either side of the centre line `at`.
    """

    name: str
    layer: int
    length: float = 0.0
    before: float = 0.0
    after: float = 0.0
    groups: tuple[str, ...] = ()
    bend: bool = True
    at: float = 0.0
    previous: list[tuple[Slot, float]] = field(default_factory=list)
    following: list[tuple[Slot, float]] = field(default_factory=list)

    def link(self, other: Slot, weight: float) -> None:
        """Connect to a slot of the next layer; a greater weight makes the line straighter."""
        self.following.append((other, weight))
        other.previous.append((self, weight))


def shared_depth(a: Slot, b: Slot) -> int:
    """Return the number of groups, from the outermost on, that two slots share."""
    alike = (one == other for one, other in zip(a.groups, b.groups, strict=False))
    return sum(1 for _ in takewhile(bool, alike))


@dataclass(eq=False)
class Chain:
    """An edge with the slots that it passes through, from the lower layer to the higher one."""

    edge: Edge
    slots: list[Slot]
    label: Slot | None
    reversed: bool


@dataclass(eq=False)
class Proper:
    """A component that is ready for ordering: its layers from first to last, its chains, its loops and its groups."""

    layers: list[list[Slot]]
    vertices: dict[str, Slot]
    chains: list[Chain]
    loops: dict[str, list[Edge]]
    groups: list[tuple[str, ...]]


class Joined(Generic[T]):
    """Disjoint sets (union-find), each represented by its least member."""

    def __init__(self, things: Iterable[T]) -> None:
        self._leader: dict[T, T] = {thing: thing for thing in things}

    def find(self, thing: T) -> T:
        """Return the least member of the set that contains `thing`."""
        while (leader := self._leader[thing]) != thing:
            self._leader[thing] = self._leader[leader]
            thing = leader
        return thing

    def join(self, a: T, b: T) -> bool:
        """Merge the sets of two things; return True if they were different."""
        first, second = sorted((self.find(a), self.find(b)))
        self._leader[second] = first
        return first != second


def make_proper(vertices: Sequence[Vertex], edges: Sequence[Edge], first: str | None = None) -> Proper:
    """Layer a connected component. `vertices` and `edges` are sorted, with sizes as (along, across) the layers.

    Cycles begin at the vertex named `first`, if it is in the component.
    """
    loops: dict[str, list[Edge]] = {}
    straight: list[Edge] = []
    for edge in edges:
        if edge.source == edge.target:
            loops.setdefault(edge.source, []).append(edge)
        else:
            straight.append(edge)
    index = {vertex.name: i for i, vertex in enumerate(vertices)}
    arcs = [(index[edge.source], index[edge.target]) for edge in straight]
    back = feedback_arcs(len(vertices), arcs, index.get(first or ""))
    forward = [(head, tail) if i in back else (tail, head) for i, (tail, head) in enumerate(arcs)]
    lengths = [2 if edge.labelled else 1 for edge in straight]
    forward, lengths = _with_group_ties(vertices, forward, lengths)
    layer_of = layers(len(vertices), forward, lengths)
    by_name = {
        vertex.name: _vertex_slot(vertex, layer_of[i], loops.get(vertex.name, [])) for i, vertex in enumerate(vertices)
    }
    rows: list[list[Slot]] = [[] for _ in range(max(layer_of) + 1)]
    for slot in by_name.values():
        rows[slot.layer].append(slot)
    chains = [_chain(edge, i in back, by_name, rows) for i, edge in enumerate(straight)]
    groups = _all_groups(vertices)
    for group in groups:
        _fill_gaps(group, rows)
    return Proper(rows, by_name, chains, loops, groups)


def _all_groups(vertices: Sequence[Vertex]) -> list[tuple[str, ...]]:
    """Return every group that has a vertex, outer groups before inner ones."""
    paths = {vertex.groups[:depth] for vertex in vertices for depth in range(1, len(vertex.groups) + 1)}
    return sorted(paths, key=lambda path: (len(path), path))


def _with_group_ties(
    vertices: Sequence[Vertex], arcs: list[tuple[int, int]], lengths: list[int]
) -> tuple[list[tuple[int, int]], list[int]]:
    """Connect vertices that only a shared group joins by a tie of length 0."""
    joined = Joined(range(len(vertices)))
    for tail, head in arcs:
        joined.join(tail, head)
    for i, vertex in enumerate(vertices):
        for j in range(i):
            if vertex.groups and vertices[j].groups[:1] == vertex.groups[:1] and joined.join(i, j):
                arcs, lengths = [*arcs, (j, i)], [*lengths, 0]
    return arcs, lengths


def _vertex_slot(vertex: Vertex, layer: int, loops: list[Edge]) -> Slot:
    labels = [edge for edge in loops if edge.labelled]
    hanging = (LOOP_DEPTH if loops else 0.0) + sum(edge.label_height + LABEL_RISE for edge in labels)
    return Slot(
        name=vertex.name,
        layer=layer,
        length=max([vertex.width, *(edge.label_width for edge in labels)]),
        before=vertex.height / 2,
        after=vertex.height / 2 + hanging,
        groups=vertex.groups,
        bend=False,
    )


def _chain(edge: Edge, backward: bool, by_name: dict[str, Slot], rows: list[list[Slot]]) -> Chain:
    first, last = by_name[edge.source], by_name[edge.target]
    if backward:
        first, last = last, first
    shared = first.groups[: shared_depth(first, last)]
    label_layer = (first.layer + last.layer) // 2
    slots = [first]
    label = None
    for layer in range(first.layer + 1, last.layer):
        slot = Slot(f"{edge.name}@{layer}", layer, groups=shared)
        if edge.labelled and layer == label_layer:
            slot.length = edge.label_width
            slot.before = edge.label_height + LABEL_RISE
            slot.after = LABEL_RISE
            label = slot
        rows[layer].append(slot)
        slots.append(slot)
    slots.append(last)
    for a, b in pairwise(slots):
        # Long edges are kept straighter than short ones (weights of Gansner et al.).
        a.link(b, 8.0 if a.bend and b.bend else 2.0 if a.bend or b.bend else 1.0)
    return Chain(edge, slots, label, backward)


def _fill_gaps(group: tuple[str, ...], rows: list[list[Slot]]) -> None:
    """Give a group a spacer in each layer that it spans without a member, so that nothing else gets in."""
    depth = len(group)
    members = [[slot for slot in row if slot.groups[:depth] == group] for row in rows]
    filled = [layer for layer, slots in enumerate(members) if slots]
    last = members[filled[0]][0]
    for layer in range(filled[0] + 1, filled[-1] + 1):
        if members[layer]:
            last = members[layer][0]
            continue
        spacer = Slot(f"{'/'.join(group)}@{layer}", layer, groups=group)
        rows[layer].append(spacer)
        last.link(spacer, 0.5)
        last = spacer
