"""Maps over time: runs of cells that give every map back, and maps too large, too small or turned."""

from __future__ import annotations

import json

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from hypothesis.extra.numpy import arrays

from rosmini.viz import ViewError
from rosmini.viz.map_colours import colours_of
from rosmini.viz.replay.grids import MAX_CELLS, Grid, Grids, coarse, grid, pasted, runs_of

from .unpacking import columns, naturals, unpack

SIDES = st.integers(1, 9)
CELLS = st.sampled_from([0, 50, 99, 100, 255])


def decoded(data) -> list[np.ndarray]:
    """What the page makes of it: the colour of each cell, as text."""
    places = columns(data["places"], 8)
    counts = unpack(data["counts"])
    tokens = naturals(data["runs"]).reshape(-1, 3)
    maps, at, before = [], 0, None
    for (width, height, _, _, _, _, dx, dy), count in zip(places.tolist(), counts, strict=True):
        cells = pasted(before, (height, width), dx, dy).ravel()
        position = 0
        for gap, length, value in tokens[at : at + count].tolist():
            position += gap
            cells[position : position + length] = value
            position += length
        at += count
        before = cells.reshape(height, width)
        maps.append(np.array(data["colours"])[before])
    return maps


@given(st.data())
def test_every_map_comes_back_wherever_it_lies(data):
    grids = []
    for _ in range(data.draw(st.integers(1, 4))):
        shape = (data.draw(SIDES), data.draw(SIDES))
        cells = data.draw(arrays(np.uint8, shape, elements=CELLS))
        origin = (0.05 * data.draw(st.integers(-5, 5)), 0.05 * data.draw(st.integers(-5, 5)), 0.0)
        grids.append(Grid(cells, 0.05, origin))
    layer = Grids("/map", np.arange(float(len(grids))), tuple(grids))
    packed = json.loads(json.dumps(layer.data()))
    table = colours_of("map")
    for found, given_grid in zip(decoded(packed), grids, strict=True):
        wanted = ["#" + "".join(f"{part:02x}" for part in table[cell]) for cell in given_grid.cells.ravel()]
        assert found.ravel().tolist() == wanted


@given(arrays(np.uint8, 30, elements=st.integers(0, 3)), arrays(np.uint8, 30, elements=st.integers(0, 3)))
def test_runs_say_what_differs_and_no_more(before, after):
    row, at = before.copy(), 0
    for gap, length, value in runs_of(before, after).tolist():
        at += gap
        assert (before[at : at + length] != value).all()
        row[at : at + length] = value
        at += length
    assert row.tolist() == after.tolist()


def test_a_window_that_moves_costs_only_what_is_new():
    world = np.random.default_rng(0).integers(0, 101, (80, 80)).astype(np.uint8)
    steps = [Grid(world[i : i + 40, i : i + 40], 0.05, (0.05 * i, 0.05 * i, 0.0)) for i in range(5)]
    moving = Grids("/map", np.arange(5.0), tuple(steps)).data()
    first, *others = unpack(moving["counts"]).tolist()
    assert first > 1000
    assert max(others) < 120


def test_a_large_map_is_drawn_coarsely_and_what_is_occupied_stays():
    cells = np.full((4000, 4000), 255, dtype=np.uint8)
    cells[1000:3000, 1000:3000] = 0
    cells[2000, 2000] = 100
    found = grid(cells, 0.05, (0.0, 0.0, 0.0))
    assert max(found.cells.shape) <= MAX_CELLS
    assert found.resolution == pytest.approx(0.05 * 8)
    assert (found.cells == 100).sum() == 1
    assert set(np.unique(found.cells)) == {0, 100, 255}
    layer = Grids("/map", np.array([0.0]), (found,))
    assert len(json.dumps(layer.data())) < 2000
    assert "8 x" not in layer.text() and "500 x 500 cells of 0.400 m" in layer.text()


def test_coarse_cells_are_the_highest_that_is_known():
    cells = np.array([[255, 255, 0], [255, 7, 255]], dtype=np.uint8)
    assert coarse(cells, 2).tolist() == [[7, 0]]
    assert coarse(np.full((2, 2), 255, dtype=np.uint8), 2).tolist() == [[255]]


@pytest.mark.parametrize(
    ("shape", "resolution", "origin"),
    [((0, 0), 0.05, (0, 0, 0)), ((2, 2), 0.0, (0, 0, 0)), ((2, 2), float("nan"), (0, 0, 0)),
     ((2, 2), 0.05, (float("inf"), 0, 0))],
)  # fmt: skip
def test_a_map_without_cells_or_a_place_is_refused(shape, resolution, origin):
    with pytest.raises(ViewError, match="a map"):
        grid(np.zeros(shape, dtype=np.uint8), resolution, origin)


def test_what_is_too_heavy_becomes_less_until_nothing_is_left_to_take_away():
    cells = np.random.default_rng(1).integers(0, 101, (200, 200)).astype(np.uint8)
    layer = Grids("/map", np.arange(7.0), (Grid(cells, 0.05, (0.0, 0.0, 0.0)),) * 7, found=70)
    times = []
    while layer is not None:
        times.append(layer.times.tolist())
        layer = layer.thinner()
    assert times[1] == [0.0, 2.0, 4.0, 6.0]
    assert times[-1][-1] == 6.0, "the last map stays"
