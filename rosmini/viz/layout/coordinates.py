"""Positions across the layers: edges as straight as the order and the sizes allow.

Each layer in turn takes the positions nearest, in least squares, to those that its neighbours ask for (pool adjacent
violators: Ayer et al., 1955). Then everything is pushed apart until the groups fit too, and slots slide to the
median of their neighbours as far as there is room, which straightens the edges.
"""

from __future__ import annotations

from collections.abc import Sequence
from itertools import pairwise
from math import inf

from rosmini.viz.layout.slots import Proper, Slot, shared_depth

VERTEX_GAP = 20.0
BEND_GAP = 9.0
GROUP_PAD = 10.0
GROUP_HEAD = 20.0
"""Room for the name of a group inside its box, above its members."""
SWEEPS = 24
STRAIGHTENING = 12

Node = Slot | tuple[str, tuple[str, ...]]
"""Something that needs a position: a slot, or the ("top" or "bottom", group) border of a group."""


def gap(a: Slot, b: Slot) -> float:
    """Return the minimum distance between the borders of two neighbours that share all their groups."""
    return VERTEX_GAP if not a.bend and not b.bend else BEND_GAP if a.bend and b.bend else 13.0


def assign_across(proper: Proper, head: float) -> None:
    """Set `at` of every slot. `head` is the room at the beginning of each group, in pixels."""
    layers = [_Layer(row, head) for row in proper.layers]
    for layer in layers:
        layer.pack([0.0] * len(layer.slots))
    for turn in range(SWEEPS):
        downward = turn % 2 == 0
        both = turn >= SWEEPS // 2
        for layer in layers if downward else layers[::-1]:
            layer.pack([_wish(slot, downward=downward, both=both) for slot in layer.slots])
    borders = _Borders(proper, head)
    borders.push_apart()
    borders.straighten()
    top = min(slot.at - slot.before for row in proper.layers for slot in row)
    for row in proper.layers:
        for slot in row:
            slot.at -= top


def _wish(slot: Slot, *, downward: bool, both: bool) -> float:
    links = slot.previous if downward else slot.following
    if both:
        links = slot.previous + slot.following
    if not links:
        return slot.at
    if len(links) == 1:
        ((other, weight),) = links
        return other.at * weight / weight
    return sum([other.at * w for other, w in links]) / sum([w for _, w in links])


def distance(a: Slot, b: Slot, head: float) -> float:
    """Return the minimum distance between the centre lines of two neighbours in a layer, including group borders."""
    depth = shared_depth(a, b)
    closing, opening = len(a.groups) - depth, len(b.groups) - depth
    return a.after + gap(a, b) + b.before + closing * GROUP_PAD + opening * head


class _Layer:
    """A layer in order, with the distances between its slots."""

    def __init__(self, row: Sequence[Slot], head: float) -> None:
        self.slots = row
        self._offsets = [0.0]
        for a, b in pairwise(row):
            self._offsets.append(self._offsets[-1] + distance(a, b, head))
        self._weights = [sum(w for _, w in slot.previous + slot.following) or 0.1 for slot in row]

    def pack(self, wishes: Sequence[float]) -> None:
        """Place the slots as near to the wishes as least squares allows."""
        blocks: list[tuple[float, float, int]] = []  # mean, weight, number of slots
        for wish, offset, own in zip(wishes, self._offsets, self._weights, strict=False):
            mean, weight, count = wish - offset, own, 1
            while blocks and blocks[-1][0] >= mean:
                last_mean, last_weight, last_count = blocks.pop()
                mean = (mean * weight + last_mean * last_weight) / (weight + last_weight)
                weight += last_weight
                count += last_count
            blocks.append((mean, weight, count))
        i = 0
        for mean, _, count in blocks:
            for _ in range(count):
                self.slots[i].at = mean + self._offsets[i]
                i += 1


class _Borders:
    """The order constraints between slots and group borders, and moves that respect them."""

    def __init__(self, proper: Proper, head: float) -> None:
        self.layers = proper.layers
        self.chains = [bends for chain in proper.chains if len(bends := chain.slots[1:-1]) > 1]
        self.head = head
        self.position: dict[Node, float] = {}
        self.after: dict[Node, list[tuple[Node, float]]] = {}
        self.before: dict[Node, list[tuple[Node, float]]] = {}
        for row in proper.layers:
            for slot in row:
                self._add(slot, slot.at)
        for group in proper.groups:
            members = [s for row in proper.layers for s in row if s.groups[: len(group)] == group]
            self._add(("top", group), min(s.at - s.before for s in members) - head)
            self._add(("bottom", group), max(s.at + s.after for s in members) + GROUP_PAD)
        for row in proper.layers:
            self._constrain(row)

    def _add(self, node: Node, position: float) -> None:
        self.position[node] = position
        self.after[node] = []
        self.before[node] = []

    def _require(self, first: Node, second: Node, apart: float) -> None:
        self.after[first].append((second, apart))
        self.before[second].append((first, apart))

    def _constrain(self, row: Sequence[Slot]) -> None:
        for a, b in zip([None, *row], [*row, None], strict=True):
            depth = shared_depth(a, b) if a and b else 0
            closing = list(range(len(a.groups), depth, -1)) if a else []
            opening = list(range(depth + 1, len(b.groups) + 1)) if b else []
            chain: list[tuple[Node, float, float]] = []  # a border or slot, its extents before and after
            if a:
                chain.append((a, 0.0, a.after))
                chain += [(("bottom", a.groups[:level]), GROUP_PAD, 0.0) for level in closing]
            start = len(chain)
            if b:
                chain += [(("top", b.groups[:level]), 0.0, self.head) for level in opening]
                chain.append((b, b.before, 0.0))
            between = gap(a, b) if a and b else 0.0
            for i, (first, second) in enumerate(pairwise(chain)):
                inner = between if i == start - 1 else 0.0
                self._require(first[0], second[0], first[2] + second[1] + inner)

    def push_apart(self) -> None:
        """Move everything forwards, never back, until all constraints are met."""
        waiting = {node: len(self.before[node]) for node in self.position}
        ready = [node for node in self.position if waiting[node] == 0]
        for node in ready:
            for other, apart in self.after[node]:
                self.position[other] = max(self.position[other], self.position[node] + apart)
                waiting[other] -= 1
                if waiting[other] == 0:
                    ready.append(other)
        self._store()

    def straighten(self) -> None:
        """Slide every slot to the weighted median of its neighbours, as far as the constraints allow."""
        slots = [slot for row in self.layers for slot in row]
        borders = [node for node in self.position if isinstance(node, tuple)]
        for turn in range(STRAIGHTENING):
            for border in borders:
                self._tighten(border)
            for bends in self.chains:
                self._align(bends)
            for slot in slots if turn % 2 == 0 else slots[::-1]:
                links = slot.previous + slot.following
                if links:
                    self._slide(slot, _median([(other.at, weight) for other, weight in links], slot.at))
        for border in borders:
            self._tighten(border)

    def _tighten(self, border: Node) -> None:
        """Move a border as near to the members of its group as they allow."""
        if border[0] == "top":  # type: ignore[index]
            self.position[border] = min(self.position[n] - apart for n, apart in self.after[border])
        else:
            self.position[border] = max(self.position[n] + apart for n, apart in self.before[border])

    def _room(self, slot: Slot) -> tuple[float, float]:
        position, low, high = self.position, -inf, inf
        for other, apart in self.before[slot]:
            if (border := position[other] + apart) > low:
                low = border
        for other, apart in self.after[slot]:
            if (border := position[other] - apart) < high:
                high = border
        return low, high

    def _slide(self, slot: Slot, wish: float) -> None:
        low, high = self._room(slot)
        if low <= high:
            self.position[slot] = slot.at = max(low, min(wish, high))

    def _align(self, bends: Sequence[Slot]) -> None:
        """Put the bends of an edge on one line, or on as few lines as possible."""
        run: list[Slot] = []
        low, high = -inf, inf
        for bend in bends:
            bend_low, bend_high = self._room(bend)
            if run and max(low, bend_low) > min(high, bend_high):
                self._level(run, low, high)
                run, low, high = [], -inf, inf
            run.append(bend)
            low, high = max(low, bend_low), min(high, bend_high)
        self._level(run, low, high)

    def _level(self, run: Sequence[Slot], low: float, high: float) -> None:
        if low > high:
            return
        ends = [(other.at, weight) for other, weight in run[0].previous + run[-1].following]
        wish = _median(ends, sum(bend.at for bend in run) / len(run))
        for bend in run:
            self.position[bend] = bend.at = max(low, min(wish, high))

    def _store(self) -> None:
        for row in self.layers:
            for slot in row:
                slot.at = self.position[slot]


def _median(values: list[tuple[float, float]], current: float) -> float:
    """Return the weighted median; if it is an interval, the point of it nearest to `current`."""
    values = sorted(values)
    half = sum([weight for _, weight in values]) / 2
    seen = 0.0
    for i, (value, weight) in enumerate(values):
        seen += weight
        if seen > half + 1e-9:
            return value
        if seen >= half - 1e-9:
            return max(value, min(current, values[i + 1][0]))
    return current
