"""The order within each layer: few crossings, groups kept together.

Barycentre sweeps down and up with exchanges of neighbours, the best order seen being kept (Sugiyama, Tagawa and
Toda, "Methods for visual understanding of hierarchical system structures", 1981). The number of passes is fixed.
"""

from __future__ import annotations

from bisect import bisect_left, bisect_right, insort
from collections.abc import Callable, Sequence
from itertools import pairwise

from rosmini.viz.layout.slots import Proper, Slot

Order = list[list[Slot]]
PASSES = 24
FREE_PASSES = 6
"""The first sweeps leave the groups free to move: their mean places then fix the order of the groups for good."""


def order_layers(proper: Proper) -> None:
    """Reorder `proper.layers` in place."""
    starts = (_start(proper, outward=True), _start(proper, outward=False))
    results = [_sweep(proper, start) for start in starts]
    best = min(results, key=crossings)  # min keeps the first of equals
    proper.layers[:] = best


def crossings(order: Order) -> int:
    """The number of crossings between all neighbouring layers."""
    return sum(_crossings_between(a, b) for a, b in pairwise(order))


def _crossings_between(upper: Sequence[Slot], lower: Sequence[Slot]) -> int:
    place = {id(slot): i for i, slot in enumerate(lower)}
    seen: list[int] = []
    total = 0
    for slot in upper:
        ends = sorted(place[id(other)] for other, _ in slot.following)
        for end in ends:
            total += len(seen) - bisect_right(seen, end)
        for end in ends:
            insort(seen, end)
    return total


def _start(proper: Proper, *, outward: bool) -> Order:
    """Slots in the order in which a depth-first walk along (or against) the edges meets them."""
    met: dict[int, int] = {}
    roots = proper.layers if outward else proper.layers[::-1]
    for row in roots:
        for root in row:
            stack = [root]
            while stack:
                slot = stack.pop()
                if id(slot) in met:
                    continue
                met[id(slot)] = len(met)
                onward = slot.following if outward else slot.previous
                stack.extend(other for other, _ in reversed(onward))
    return [sorted(row, key=lambda slot: met[id(slot)]) for row in proper.layers]


def _sweep(proper: Proper, order: Order) -> Order:
    ranking: dict[tuple[str, ...], float] = {}
    best, fewest = order, -1
    for turn in range(PASSES):
        if proper.groups and turn == FREE_PASSES:
            ranking = _group_ranking(proper, order)
        order = _pass(order, downward=turn % 2 == 0, ranking=ranking)
        _exchange_neighbours(order)
        settled = not proper.groups or turn >= FREE_PASSES
        count = crossings(order)
        if settled and (fewest < 0 or count < fewest):
            best, fewest = [list(row) for row in order], count
        if settled and fewest == 0:
            break
    return best


def _group_ranking(proper: Proper, order: Order) -> dict[tuple[str, ...], float]:
    places: dict[tuple[str, ...], list[float]] = {group: [] for group in proper.groups}
    for row in order:
        for i, slot in enumerate(row):
            for depth in range(1, len(slot.groups) + 1):
                places[slot.groups[:depth]].append((i + 0.5) / len(row))
    return {group: sum(values) / len(values) for group, values in places.items()}


def _pass(order: Order, *, downward: bool, ranking: dict[tuple[str, ...], float]) -> Order:
    result: Order = [list(row) for row in order]
    layers = range(len(result)) if downward else range(len(result) - 1, -1, -1)
    place = {id(slot): float(i) for row in result for i, slot in enumerate(row)}
    for layer in layers:
        row = result[layer]
        wish = {id(slot): _barycentre(slot, place, downward=downward) for slot in row}
        result[layer] = _arrange(row, lambda slot, wish=wish: wish[id(slot)], 0, ranking)  # type: ignore[misc]
        for i, slot in enumerate(result[layer]):
            place[id(slot)] = float(i)
    return result


def _barycentre(slot: Slot, place: dict[int, float], *, downward: bool) -> float:
    links = slot.previous if downward else slot.following
    if not links:
        return place[id(slot)]
    return sum(place[id(other)] for other, _ in links) / len(links)


def _arrange(
    row: Sequence[Slot],
    wish: Callable[[Slot], float],
    depth: int,
    ranking: dict[tuple[str, ...], float],
) -> list[Slot]:
    """Sort by wish, a group counting as one thing; where groups have a ranking, it decides between them."""
    bundles: dict[object, list[Slot]] = {}
    for slot in row:
        key: object = slot.groups[: depth + 1] if len(slot.groups) > depth else id(slot)
        bundles.setdefault(key, []).append(slot)
    entries = sorted(bundles.items(), key=lambda entry: sum(map(wish, entry[1])) / len(entry[1]))
    if ranking:
        grouped = [i for i, (key, _) in enumerate(entries) if isinstance(key, tuple)]
        ranked = sorted(
            (entries[i] for i in grouped),
            key=lambda entry: (ranking[entry[0]], entry[0]),  # type: ignore[index]
        )
        for i, entry in zip(grouped, ranked, strict=True):
            entries[i] = entry
    result: list[Slot] = []
    for key, slots in entries:
        result.extend(_arrange(slots, wish, depth + 1, ranking) if isinstance(key, tuple) else slots)
    return result


Ends = tuple[list[int], list[int]]
"""The places of a slot's neighbours in the layer before and in the layer after, each sorted."""


def _exchange_neighbours(order: Order) -> None:
    """Swap neighbours of the same group while that removes crossings."""
    place = {id(slot): i for row in order for i, slot in enumerate(row)}
    for _ in range(4):
        improved = False
        for row in order:
            ends = [_ends(slot, place) for slot in row]
            for i in range(len(row) - 1):
                if row[i].groups == row[i + 1].groups and _gains(ends[i], ends[i + 1]):
                    row[i], row[i + 1] = row[i + 1], row[i]
                    ends[i], ends[i + 1] = ends[i + 1], ends[i]
                    improved = True
            for i, slot in enumerate(row):
                place[id(slot)] = i
        if not improved:
            break


def _ends(slot: Slot, place: dict[int, int]) -> Ends:
    return (
        sorted([place[id(other)] for other, _ in slot.previous]),
        sorted([place[id(other)] for other, _ in slot.following]),
    )


def _gains(first: Ends, second: Ends) -> bool:
    """Whether two neighbours in a layer have fewer crossings between their edges the other way round."""
    now = swapped = 0
    for a, b in zip(first, second, strict=True):
        if a and b:
            now += sum([bisect_left(b, end) for end in a])
            swapped += sum([bisect_left(a, end) for end in b])
    return swapped < now
