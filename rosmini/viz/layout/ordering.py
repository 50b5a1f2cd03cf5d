"""The order of the slots in each layer: few crossings, groups kept together.

Barycentre sweeps down and up with exchanges of neighbours, keeping the best order seen (Sugiyama, Tagawa and
Toda, "Methods for visual understanding of hierarchical system structures", 1981). The number of passes is bounded.
"""

from __future__ import annotations

from bisect import bisect_left, bisect_right, insort
from collections.abc import Sequence
from itertools import pairwise

from rosmini.viz.layout.slots import Proper, Slot

Order = list[list[int]]
"""The layers; each slot is given by its number."""
Groups = tuple[str, ...]
Ends = tuple[list[int], list[int]]
"""The positions of a slot's neighbours in the previous and in the next layer, each sorted."""
PASSES = 24
FREE_PASSES = 6
"""During the first sweeps groups may move; their mean positions then fix the order of the groups permanently."""
ROUNDS = 4
"""Maximum number of rounds of exchanges in all layers after each pass."""


def order_layers(proper: Proper) -> None:
    """Reorder `proper.layers` in place."""
    links = _Links(proper)
    starts = [_start(proper, links, outward=True), _start(proper, links, outward=False)]
    if starts[0] == starts[1]:
        del starts[1]
    results = [_sweep(proper, links, start) for start in starts]
    best = min(results, key=links.crossings)  # min returns the first of several equal ones
    proper.layers[:] = [[links.slots[number] for number in row] for row in best]


class _Links:
    """The slots by number, with the numbers of their neighbours; a layout spends most of its time here."""

    def __init__(self, proper: Proper) -> None:
        self.slots = [slot for row in proper.layers for slot in row]
        self.numbers = {id(slot): number for number, slot in enumerate(self.slots)}
        self.groups = [slot.groups for slot in self.slots]
        self.previous = [self._of(slot.previous) for slot in self.slots]
        self.following = [self._of(slot.following) for slot in self.slots]

    def _of(self, links: Sequence[tuple[Slot, float]]) -> list[int]:
        return [self.numbers[id(other)] for other, _ in links]

    def places(self, order: Order) -> list[int]:
        """Return the position of each slot in its layer."""
        place = [0] * len(self.slots)
        for row in order:
            for i, slot in enumerate(row):
                place[slot] = i
        return place

    def crossings(self, order: Order) -> int:
        """Return the number of crossings between all neighbouring layers."""
        place = self.places(order)
        return sum(self._crossings_below(row, place) for row, _ in pairwise(order))

    def _crossings_below(self, row: Sequence[int], place: Sequence[int]) -> int:
        seen: list[int] = []
        total = 0
        for slot in row:
            ends = sorted([place[other] for other in self.following[slot]])
            for end in ends:
                if seen and end < seen[-1]:
                    total += len(seen) - bisect_right(seen, end)
            for end in ends:
                insort(seen, end)
        return total

    def ends(self, slot: int, place: Sequence[int]) -> Ends:
        """Return the positions of the slots that a slot's edges lead to."""
        return (
            sorted([place[other] for other in self.previous[slot]]),
            sorted([place[other] for other in self.following[slot]]),
        )


def _start(proper: Proper, links: _Links, *, outward: bool) -> Order:
    """Return slots in the order in which a depth-first walk along (or against) the edges visits them."""
    met: dict[int, int] = {}
    order = [[links.numbers[id(slot)] for slot in row] for row in proper.layers]
    onward = links.following if outward else links.previous
    for row in order if outward else order[::-1]:
        for root in row:
            stack = [root]
            while stack:
                slot = stack.pop()
                if slot not in met:
                    met[slot] = len(met)
                    stack.extend(reversed(onward[slot]))
    return [sorted(row, key=met.__getitem__) for row in order]


def _sweep(proper: Proper, links: _Links, order: Order) -> Order:
    ranking: dict[Groups, float] = {}
    best, fewest = order, -1
    seen: set[tuple[bool, tuple[tuple[int, ...], ...]]] = set()
    for turn in range(PASSES):
        downward = turn % 2 == 0
        if proper.groups and turn == FREE_PASSES:
            ranking = _group_ranking(proper, links, order)
        order = _pass(links, order, downward=downward, ranking=ranking)
        _exchange_neighbours(links, order)
        if proper.groups and turn < FREE_PASSES:
            continue
        state = (downward, tuple(map(tuple, order)))
        if state in seen:  # the sweeps would now repeat themselves
            break
        seen.add(state)
        count = links.crossings(order)
        if fewest < 0 or count < fewest:
            best, fewest = order, count
        if fewest == 0:
            break
    return best


def _group_ranking(proper: Proper, links: _Links, order: Order) -> dict[Groups, float]:
    places: dict[Groups, list[float]] = {group: [] for group in proper.groups}
    for row in order:
        for i, slot in enumerate(row):
            groups = links.groups[slot]
            for depth in range(1, len(groups) + 1):
                places[groups[:depth]].append((i + 0.5) / len(row))
    return {group: sum(values) / len(values) for group, values in places.items()}


def _pass(links: _Links, order: Order, *, downward: bool, ranking: dict[Groups, float]) -> Order:
    result: Order = [list(row) for row in order]
    place = links.places(result)
    beyond = links.previous if downward else links.following
    for layer in range(len(result)) if downward else range(len(result) - 1, -1, -1):
        row = result[layer]
        wish = {}
        for slot in row:
            others = beyond[slot]
            wish[slot] = sum([place[other] for other in others]) / len(others) if others else place[slot]
        result[layer] = _arrange(row, wish, links.groups, 0, ranking)
        for i, slot in enumerate(result[layer]):
            place[slot] = i
    return result


def _arrange(
    row: Sequence[int], wish: dict[int, float], groups: Sequence[Groups], depth: int, ranking: dict[Groups, float]
) -> list[int]:
    """Sort by wish, treating a group as one item; if groups have a ranking, it decides their order."""
    if not any(len(groups[slot]) > depth for slot in row):
        return sorted(row, key=wish.__getitem__)
    bundles: dict[object, list[int]] = {}
    for slot in row:
        key: object = groups[slot][: depth + 1] if len(groups[slot]) > depth else slot
        bundles.setdefault(key, []).append(slot)
    entries = sorted(bundles.items(), key=lambda entry: sum([wish[slot] for slot in entry[1]]) / len(entry[1]))
    if ranking:
        grouped = [i for i, (key, _) in enumerate(entries) if isinstance(key, tuple)]
        ranked = sorted(
            (entries[i] for i in grouped),
            key=lambda entry: (ranking[entry[0]], entry[0]),  # type: ignore[index]
        )
        for i, entry in zip(grouped, ranked, strict=True):
            entries[i] = entry
    result: list[int] = []
    for key, slots in entries:
        result.extend(_arrange(slots, wish, groups, depth + 1, ranking) if isinstance(key, tuple) else slots)
    return result


def _exchange_neighbours(links: _Links, order: Order) -> None:
    """Swap neighbours of the same group while that removes crossings."""
    place = links.places(order)
    waiting = set(range(len(order)))
    for _ in range(ROUNDS):
        if not waiting:
            break
        for layer, row in enumerate(order):
            if layer not in waiting:  # nothing around it has changed since its last check
                continue
            waiting.discard(layer)
            if _exchange_in(links, row, place):
                waiting.update(each for each in (layer - 1, layer, layer + 1) if 0 <= each < len(order))


def _exchange_in(links: _Links, row: list[int], place: list[int]) -> bool:
    """Go once through a layer and swap neighbours; return True if any were swapped."""
    improved = False
    ends = [links.ends(slot, place) for slot in row]
    for i in range(len(row) - 1):
        if links.groups[row[i]] == links.groups[row[i + 1]] and _gains(ends[i], ends[i + 1]):
            row[i], row[i + 1] = row[i + 1], row[i]
            ends[i], ends[i + 1] = ends[i + 1], ends[i]
            improved = True
    if improved:
        for i, slot in enumerate(row):
            place[slot] = i
    return improved


def _gains(first: Ends, second: Ends) -> bool:
    """Return True if swapping two neighbours in a layer reduces the crossings between their edges."""
    (a, c), (b, d) = first, second
    if not ((a and b and b[0] < a[-1]) or (c and d and d[0] < c[-1])):  # most pairs have no crossings
        return False
    pairs = ((a, b), (c, d))
    now = sum([bisect_left(b, end) for a, b in pairs for end in a])
    return sum([bisect_left(a, end) for a, b in pairs for end in b]) < now
