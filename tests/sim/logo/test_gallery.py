"""The programs in rosmini_logo: they run on paper, fit into turtlesim's window, and draw their figures."""

import pytest

from rosmini.core.packages import PackageIndex
from rosmini.sim.logo import Logo

PROGRAMS = sorted((PackageIndex().path("rosmini_logo") / "programs").glob("*.logo"))


def drawn(name):
    (path,) = [path for path in PROGRAMS if path.stem == name]
    logo = Logo()
    logo.run(path.read_text(encoding="utf-8"))
    return logo


@pytest.mark.parametrize("path", PROGRAMS, ids=lambda path: path.stem)
def test_each_fits_into_the_window(path):
    drawing = drawn(path.stem).drawing
    assert drawing.lines
    assert all(abs(part) <= 249.5 for stroke in drawing.strokes for part in stroke.end[:2])


@pytest.mark.parametrize(
    ("name", "lines"), [("square", 4), ("star", 5), ("koch", 3 * 4**4), ("dragon", 2**10), ("hilbert", 4**5 - 1)]
)
def test_number_of_lines(name, lines):
    assert len(drawn(name).drawing.lines) == lines
