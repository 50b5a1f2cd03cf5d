"""The chapter Global planners: what it says of its planners is what its cells print."""

from __future__ import annotations

import re

from rosmini.book.exercises.global_planners import search

from .conftest import all_printed


def test_what_the_text_says_is_printed(cells):
    said = all_printed(cells)
    trust = {float(a): (int(b), int(c)) for a, b, c in re.findall(r"^ *([\d.]+) +(\d+) +(\d+)$", said, re.MULTILINE)}
    assert trust[0][1] == trust[0.5][1] == trust[1][1] < trust[1000][1]
    assert trust[0][0] > 2 * trust[1][0]
    factors = {
        factor: (float(length), int(highest))
        for factor, length, highest in re.findall(r"\(\d+, ([\d.]+)\): ([\d.]+) m, costs (\d+)", said)
    }
    assert factors["0.55"][0] - factors["0.01"][0] > 0.7
    assert factors["0.01"][1] == factors["5.0"][1] > factors["3.0"][1] > factors["0.55"][1]
    assert "(6.02, -3.48), within 0.0 m: no plan\n" in said
    assert re.search(r"\(6\.02, -3\.48\), within 0\.8 m: [\d.]+ m\n", said)


def test_the_checks_search_is_the_chapters():
    price = {(x, y): 4 if x in (2, 3) and y == 0 else 1 for x in range(6) for y in range(2)}
    assert search(price, (0, 0), (5, 0), 0) == search(price, (0, 0), (5, 0), 1) == 7
    assert search(price, (0, 0), (5, 0), 1000) == 11
