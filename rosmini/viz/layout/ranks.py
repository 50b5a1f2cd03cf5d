"""Layers for a directed graph: break its cycles, then assign vertices to layers so that edges are short.

Cycles are broken after Eades, Lin and Smyth, "A fast and effective heuristic for the feedback arc set
problem" (1993); layers come from the network simplex method of Gansner, Koutsofios, North and Vo,
"A technique for drawing directed graphs" (1993). Everything is a list of integers; names do not appear here.
"""

from __future__ import annotations

from collections.abc import Sequence
from graphlib import CycleError, TopologicalSorter

Arc = tuple[int, int]
"""An edge as (tail, head), indices of vertices."""


def feedback_arcs(count: int, arcs: Sequence[Arc], first: int | None = None) -> set[int]:
    """Return a minimal set of indices of arcs whose reversal leaves no cycle.

    A vertex `first` precedes everything reachable from it: in a cycle through it, the arc into it is reversed.
    """
    sequence = _greedy_sequence(count, arcs)
    if first is not None:
        sequence = [first, *(vertex for vertex in sequence if vertex != first)]
    position = {vertex: place for place, vertex in enumerate(sequence)}
    backward = [i for i, (tail, head) in enumerate(arcs) if position[tail] > position[head]]
    backward.sort(key=lambda i: arcs[i][1] == first)
    successors: list[list[int]] = [[] for _ in range(count)]
    for tail, head in arcs:
        if position[tail] < position[head]:
            successors[tail].append(head)
    reversed_arcs = set()
    for i in backward:  # the greedy order may reverse an arc that is in no cycle
        tail, head = arcs[i]
        if _reaches(successors, head, tail):
            reversed_arcs.add(i)
        else:
            successors[tail].append(head)
    return reversed_arcs


def _greedy_sequence(count: int, arcs: Sequence[Arc]) -> list[int]:
    """Order vertices: sinks last, sources first, otherwise by the surplus of outgoing over incoming arcs."""
    out_degree = [0] * count
    in_degree = [0] * count
    for tail, head in arcs:
        out_degree[tail] += 1
        in_degree[head] += 1
    left: list[int] = []
    right: list[int] = []
    remaining = list(range(count))
    while remaining:
        sinks = [v for v in remaining if out_degree[v] == 0]
        sources = [v for v in remaining if in_degree[v] == 0]
        if sinks:
            chosen = sinks[0]
            right.append(chosen)
        elif sources:
            chosen = sources[0]
            left.append(chosen)
        else:
            chosen = max(remaining, key=lambda v: (out_degree[v] - in_degree[v], -v))
            left.append(chosen)
        remaining.remove(chosen)
        for tail, head in arcs:
            if tail == chosen:
                in_degree[head] -= 1
            if head == chosen:
                out_degree[tail] -= 1
    return left + right[::-1]


def _reaches(successors: Sequence[Sequence[int]], start: int, goal: int) -> bool:
    seen = {start}
    stack = [start]
    while stack:
        vertex = stack.pop()
        if vertex == goal:
            return True
        for head in successors[vertex]:
            if head not in seen:
                seen.add(head)
                stack.append(head)
    return False


def layers(count: int, arcs: Sequence[Arc], lengths: Sequence[int]) -> list[int]:
    """Return the layer of each vertex of a connected acyclic graph, counted from 0.

    Arc i spans at least `lengths[i]` layers, and the sum of all spans is minimal.
    """
    simplex = _NetworkSimplex(count, arcs, lengths)
    simplex.solve()
    lowest = min(simplex.rank, default=0)
    return [rank - lowest for rank in simplex.rank]


class _NetworkSimplex:
    """Ranks kept feasible by a spanning tree of tight arcs, improved by exchanging one tree arc at a time."""

    def __init__(self, count: int, arcs: Sequence[Arc], lengths: Sequence[int]) -> None:
        self.count = count
        self.arcs = arcs
        self.lengths = lengths
        self.rank = _longest_path(count, arcs, lengths)
        self.tree: set[int] = set()
        # Outgoing minus incoming arcs: summed over one side of a tree arc, this is the cost of lengthening that arc.
        self.pull = [0] * count
        for tail, head in arcs:
            self.pull[tail] += 1
            self.pull[head] -= 1

    def solve(self) -> None:
        if self.count < 2:
            return
        self._span_with_tight_arcs()
        for _ in range(4 * self.count + 8 * len(self.arcs)):  # far more than any graph has needed
            if not self._exchange():
                break

    def _slack(self, arc: int) -> int:
        tail, head = self.arcs[arc]
        return self.rank[head] - self.rank[tail] - self.lengths[arc]

    def _span_with_tight_arcs(self) -> None:
        reached = {0}
        while len(reached) < self.count:
            border = [i for i, (t, h) in enumerate(self.arcs) if (t in reached) != (h in reached)]
            if not border:
                raise ValueError("a graph to be layered must be connected")
            nearest = min(border, key=lambda i: (self._slack(i), i))
            tail, head = self.arcs[nearest]
            shift = self._slack(nearest) if head in reached else -self._slack(nearest)
            for vertex in range(self.count):
                if vertex not in reached:
                    self.rank[vertex] += shift
            reached |= {tail, head}
            self.tree.add(nearest)

    def _exchange(self) -> bool:
        """Replace one tree arc whose removal shortens the drawing; return False if there is none."""
        neighbours: list[list[Arc]] = [[] for _ in range(self.count)]
        for arc in sorted(self.tree):
            tail, head = self.arcs[arc]
            neighbours[tail].append((arc, head))
            neighbours[head].append((arc, tail))
        order, parent_arc = _walk(neighbours)
        total = list(self.pull)
        leaving, below = -1, -1
        for vertex in reversed(order[1:]):
            arc = parent_arc[vertex]
            tail, head = self.arcs[arc]
            cut = total[vertex] if tail == vertex else -total[vertex]
            if cut < 0 and (leaving < 0 or arc < leaving):
                leaving, below = arc, vertex
            total[head if tail == vertex else tail] += total[vertex]
        if leaving < 0:
            return False
        self._swap(leaving, _side(neighbours, below, leaving))
        return True

    def _swap(self, leaving: int, side: set[int]) -> None:
        tail_in_side = self.arcs[leaving][0] in side
        candidates = [
            i
            for i, (tail, head) in enumerate(self.arcs)
            if ((head in side and tail not in side) if tail_in_side else (tail in side and head not in side))
        ]
        entering = min(candidates, key=lambda i: (self._slack(i), i))
        shift = self._slack(entering)
        for vertex in side:
            self.rank[vertex] += -shift if tail_in_side else shift
        self.tree.remove(leaving)
        self.tree.add(entering)


def _longest_path(count: int, arcs: Sequence[Arc], lengths: Sequence[int]) -> list[int]:
    incoming: dict[int, list[tuple[int, int]]] = {vertex: [] for vertex in range(count)}
    for (tail, head), length in zip(arcs, lengths, strict=True):
        incoming[head].append((tail, length))
    rank = [0] * count
    try:
        for vertex in TopologicalSorter({v: [tail for tail, _ in of] for v, of in incoming.items()}).static_order():
            rank[vertex] = max((rank[tail] + length for tail, length in incoming[vertex]), default=0)
    except CycleError as error:
        raise ValueError("a graph to be layered must have no cycle") from error
    return rank


def _walk(neighbours: Sequence[Sequence[Arc]]) -> tuple[list[int], dict[int, int]]:
    """Return the tree's vertices, each after its parent, and the arc from each to its parent."""
    order = [0]
    parent_arc: dict[int, int] = {}
    for vertex in order:
        for arc, other in neighbours[vertex]:
            if other != 0 and other not in parent_arc:
                parent_arc[other] = arc
                order.append(other)
    return order, parent_arc


def _side(neighbours: Sequence[Sequence[Arc]], start: int, without: int) -> set[int]:
    seen = {start}
    stack = [start]
    while stack:
        for arc, other in neighbours[stack.pop()]:
            if arc != without and other not in seen:
                seen.add(other)
                stack.append(other)
    return seen
