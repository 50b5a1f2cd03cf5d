"""Pictures of costmaps: what they say, what they draw, and what they refuse."""

import numpy as np
import pytest

from rosmini.navigation.costmap_2d import Costmap2D
from rosmini.viz.costmap_pictures import costmap_picture
from rosmini.viz.view import ViewError

COSTS = np.array([[0, 0, 0, 100], [253, 254, 255, 255]])


def grid():
    return Costmap2D.of(COSTS, 0.5, (-1.0, 2.0))


def test_it_says_how_large_it_is_and_what_is_in_it():
    view = grid().show(title="Figure 33.1: Costs", robot=(0.0, 2.5, 1.5708), plan=[(0, 2.5), (1, 2.5)], goal=(1, 2.5))
    assert view.text == (
        "Figure 33.1: Costs: 4 x 2 cells of 0.5 m, 2.00 x 1.00 m, origin (-1.00, 2.00)\n"
        "free 38 %, near something 13 %, inscribed 13 %, obstacle 13 %, unknown 25 %\n"
        "plan: 1.00 m\n"
        "goal: (1.00, 2.50)\n"
        "robot: pose (0.00, 2.50, 90.0 deg)"
    )
    assert view.alt.startswith("A costmap from above: 4 by 2 cells of 0.5 m")
    for word in ("inscribed", "obstacle", "unknown", "plan", "goal"):
        assert word in view.svg


def test_a_window_and_a_footprint():
    square = [(0.2, 0.2), (0.2, -0.2), (-0.2, -0.2), (-0.2, 0.2)]
    view = grid().show(window=(1, 0, 9, 1), robot=(0, 2, 0), footprint=square, scheme="safe", name="local_costmap")
    assert view.text.startswith("local_costmap: 3 x 1 cells of 0.5 m, 1.50 x 0.50 m, origin (-0.50, 2.00)\n")
    assert view.text.endswith("footprint of 4 points")
    assert view.svg != grid().show(window=(1, 0, 9, 1), robot=(0, 2, 0), scheme="safe").svg


@pytest.mark.parametrize(
    ("options", "said"),
    [
        ({"window": (2, 2, 2, 2)}, "there is nothing to draw"),
        ({"robot": (0, 0)}, "the robot's pose"),
        ({"plan": [1, 2]}, "the plan"),
        ({"scheme": "rainbow"}, "no colour scheme"),
    ],
)
def test_what_cannot_be_drawn_is_told(options, said):
    with pytest.raises(ViewError, match=said):
        grid().show(**options)


def test_an_array_is_no_costmap():
    with pytest.raises(ViewError, match="not a ndarray"):
        costmap_picture(COSTS)
