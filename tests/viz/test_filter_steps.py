"""Steps of a particle filter: their text, their data, and what is refused."""

from __future__ import annotations

import numpy as np
import pytest

from rosmini.navigation.amcl import show_steps
from rosmini.navigation.map_server.grid_map import GridMap
from rosmini.viz.filter_steps import HEAVIEST, MOST, filter_steps
from rosmini.viz.view import ViewError


def grid():
    cells = np.zeros((20, 40), dtype=np.int8)
    cells[[0, -1], :] = cells[:, [0, -1]] = 100
    return GridMap(cells, 0.1, (-1.0, 0.0, 0.0))


def particles(count, seed=1):
    return np.random.default_rng(seed).uniform((-1, 0, -3), (3, 2, 3), (count, 3))


def test_its_text_says_how_it_began_and_ended():
    near = np.tile((1.0, 1.0, 0.5), (10, 1))
    steps = [
        ("start", particles(500), None, (1.0, 1.2, 0.0)),
        ("resample", near, np.ones(10), (1.0, 1.2, 0.0)),
    ]
    view = show_steps(grid(), steps, title="Found")
    assert view.text.split("\n") == [
        "Found: 2 steps",
        "start: 500 particles, spread 1.3 m, mean 0.2 m from the truth",
        "resample: 10 particles, spread 0.0 m, mean 0.2 m from the truth",
    ]
    assert "In the end, resample" in view.alt
    assert "Found" in view.html
    assert view.svg.count("<image") == 1


def test_many_particles_are_thinned_and_the_heaviest_stay():
    weights = np.zeros(5000) + 1e-3
    weights[4321] = 1.0
    many = particles(5000)
    data = filter_steps(grid(), steps=[("weigh", many, weights, None)]).data
    assert data["steps"][0]["shown"] == MOST
    assert data["weights"][-1] == 255
    places = np.frombuffer(data["places"], "<i2").reshape(-1, 2)
    assert places[-1] / 100 == pytest.approx(many[4321, :2] - (-1.0, 0.0), abs=0.006)
    assert len(data["headings"]) == MOST > HEAVIEST


def test_noise_in_the_last_bit_gives_the_same_bytes():
    some, weights = particles(900), np.random.default_rng(2).random(900)
    one = filter_steps(grid(), steps=[("weigh", some, weights, (0.0, 1.0, 0.0))])
    noisy = filter_steps(
        grid(), steps=[("weigh", some * (1 + 2e-16), weights * (1 + 2e-16), (0.0, 1.0, 0.0))]
    )
    assert noisy.data == one.data
    assert noisy.svg == one.svg


@pytest.mark.parametrize(
    ("steps", "message"),
    [
        ([], "1 to 200 steps"),
        ([("a", np.zeros((3, 2)), None, None)], "rows of finite x, y and heading"),
        ([("a", np.full((3, 3), np.nan), None, None)], "rows of finite x, y and heading"),
        ([("a", np.zeros((3, 3)), [1.0, 2.0], None)], "3 numbers, none below 0"),
        ([("a", np.zeros((3, 3)), [0.0, 0.0, 0.0], None)], "3 numbers, none below 0"),
        ([("a", np.zeros((3, 3)), None, (1.0, 2.0))], "true pose"),
    ],
)
def test_what_cannot_be_shown(steps, message):
    with pytest.raises(ViewError, match=message):
        filter_steps(grid(), steps=steps)


def test_it_takes_a_map():
    with pytest.raises(ViewError, match="shown on a GridMap"):
        filter_steps(3, steps=[("a", np.zeros((3, 3)), None, None)])
