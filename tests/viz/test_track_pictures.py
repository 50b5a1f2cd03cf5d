"""A way from above: its words, and that it is drawn to scale."""

import re

import numpy as np
import pytest

from rosmini.viz import ViewError
from rosmini.viz.track_pictures import track_picture

SQUARE = np.array([[0.0, 0.0], [2.0, 0.0], [2.0, 1.0], [0.0, 1.0]])


def test_text_and_alt():
    picture = track_picture(SQUARE, title="Figure 1: round")
    assert picture.text == "Figure 1: round: 5.00 m from (0.00, 0.00) to (0.00, 1.00), 4 positions"
    assert "begins at (0.00, 0.00) and ends at (0.00, 1.00)" in picture.alt
    assert track_picture({"pose.pose.position.x": SQUARE[:, 0], "pose.pose.position.y": SQUARE[:, 1]}).text.startswith(
        "track: 5.00 m"
    )


def test_it_is_drawn_to_scale():
    """Two metres across are twice as long as one metre up."""
    svg = track_picture(SQUARE).svg
    paths = [
        [tuple(map(float, pair.split())) for pair in re.split("[ML]", path)[1:]]
        for path in re.findall(r'd="(M[\d. L-]+)"', svg)
    ]
    (way,) = [path for path in paths if len(path) == 4]
    across, up = way[1][0] - way[0][0], way[1][1] - way[2][1]
    assert across == pytest.approx(2 * up, rel=0.01)
    assert across > 200


@pytest.mark.parametrize("still", [np.zeros((1, 2)), np.zeros((5, 2))])
def test_a_robot_that_stands_still(still):
    assert "track: 0.00 m from (0.00, 0.00)" in track_picture(still).text


@pytest.mark.parametrize("wrong", [{"x": [1.0]}, np.zeros((0, 2)), np.zeros(4), [[np.nan, 0.0]]])
def test_what_has_no_positions(wrong):
    with pytest.raises(ViewError):
        track_picture(wrong)
