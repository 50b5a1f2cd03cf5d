"""Our turtles are drawn to scale."""

from __future__ import annotations

import re

import pytest

from rosmini.sim.turtlesim.drawings import DRAWINGS, Drawing


@pytest.mark.parametrize("drawing", DRAWINGS, ids=[each.name for each in DRAWINGS])
def test_a_drawing_is_about_a_metre_long_and_looks_to_the_right(drawing: Drawing) -> None:
    starts = [
        tuple(map(float, found.groups()))
        for path, colour in drawing.parts
        if re.fullmatch("#[0-9a-f]{6}", colour)
        for found in re.finditer(r"[ML](-?[\d.]+),(-?[\d.]+)", path)
    ]
    xs, ys = [x for x, _ in starts], [y for _, y in starts]
    assert -22.5 <= min(xs) < -12 and 11 < max(xs) <= 22.5
    assert max(map(abs, ys)) <= 22.5
    assert all(path.startswith("M") and path.endswith("Z") for path, _ in drawing.parts)
