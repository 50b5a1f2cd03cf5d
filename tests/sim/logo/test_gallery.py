"""The programs in rosmini_logo: they run on paper, fit into turtlesim's window, and draw their figures."""

from __future__ import annotations

import math
from pathlib import Path

import pytest

from rosmini.core.packages import PackageIndex
from rosmini.sim.logo import Logo

PROGRAMS = sorted((PackageIndex().path("rosmini_logo") / "programs").glob("*.logo"))


def drawn(name: str) -> Logo:
    (path,) = [path for path in PROGRAMS if path.stem == name]
    logo = Logo()
    logo.run(path.read_text(encoding="utf-8"))
    return logo


@pytest.mark.parametrize("path", PROGRAMS, ids=lambda path: path.stem)
def test_each_fits_into_the_window(path: Path) -> None:
    drawing = drawn(path.stem).drawing
    assert drawing.lines
    assert all(abs(part) <= 249.5 for stroke in drawing.strokes for part in stroke.end[:2])


@pytest.mark.parametrize(
    ("name", "lines"), [("square", 4), ("star", 5), ("koch", 3 * 4**4), ("dragon", 2**10), ("hilbert", 4**5 - 1)]
)
def test_number_of_lines(name, lines):
    assert len(drawn(name).drawing.lines) == lines


def test_closed_figures_close():
    for name in ("square", "star", "koch"):
        drawing = drawn(name).drawing
        assert math.dist(drawing.lines[0].start[:2], drawing.turtles["turtle1"][:2]) < 1e-9


def test_hilberts_curve_visits_each_point_once():
    drawing = drawn("hilbert").drawing
    points = {(round(line.start.x), round(line.start.y)) for line in drawing.lines}
    points.add((round(drawing.lines[-1].end.x), round(drawing.lines[-1].end.y)))
    assert len(points) == 4**5
    assert {(x + 217) % 14 for x, _ in points} == {0}
