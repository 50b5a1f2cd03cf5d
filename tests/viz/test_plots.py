"""Plots of a few series."""

import pytest

from rosmini.viz.plots import plot
from rosmini.viz.view import ViewError


def test_text_and_picture_say_what_is_plotted():
    picture = plot(
        {"slow": ([0, 1, 2], [0.0, 0.5, 1.25]), "fast": ([0, 2], [0.1, -0.1])},
        x="time [s]",
        y="age [s]",
        title="Figure 1: Ages",
        alt="One line climbs.",
    )
    assert picture.text == (
        "Figure 1: Ages: age [s] over time [s]\n"
        "slow: 3 points, from 0.00 to 1.25, last 1.25\n"
        "fast: 2 points, from -0.10 to 0.10, last -0.10"
    )
    svg = picture.svg
    for word in ("time [s]", "age [s]", "slow", "fast", "One line climbs."):
        assert word in svg


def test_a_single_point_and_a_flat_line_have_a_frame():
    assert "1 point, from 3.00 to 3.00" in plot({"a": ([1], [3])}, x="x", y="y").text
    assert "last 0.00" in plot({"a": ([1, 2], [0, 0])}, x="x", y="y").text


@pytest.mark.parametrize(
    ("series", "word"),
    [
        ({}, "1 to 5 series"),
        ({str(i): ([0], [0]) for i in range(6)}, "not 6"),
        ({"a": ([0, 1], [0])}, "same length"),
        ({"a": ([], [])}, "at least one"),
        ({"a": ([0], ["x"])}, "numbers"),
        ({"a": ([0], [float("nan")])}, "finite"),
    ],
)
def test_what_cannot_be_plotted_is_refused(series, word):
    with pytest.raises(ViewError, match=word):
        plot(series, x="x", y="y")
