"""Pictures of costmaps: their text form and their contents."""

import numpy as np
import pytest

from rosmini.navigation.costmap_2d.costmap import Costmap2D
from rosmini.viz.costmap_pictures import costmap_picture
from rosmini.viz.view import ViewError

COSTS = np.array([[0, 0, 0, 100], [253, 254, 255, 255]])
SQUARE = [(0.2, 0.2), (0.2, -0.2), (-0.2, -0.2), (-0.2, 0.2)]


def test_it_reports_its_size_and_its_cells():
    grid = Costmap2D.of(COSTS, 0.5, (-1.0, 2.0))
    view = costmap_picture(grid, robot=(0.0, 2.5, 1.5708), footprint=SQUARE, title="Figure 33.1: Costs")
    assert view.text == (
        "Figure 33.1: Costs: 4 x 2 cells of 0.5 m, 2.00 x 1.00 m, origin (-1.00, 2.00)\n"
        "free 38%, near something 13%, inscribed 13%, obstacle 13%, unknown 25%\n"
        "robot: pose (0.00, 2.50, 90.0 deg), footprint of 4 points"
    )
    assert view.alt.startswith("A costmap from above: 4 by 2 cells of 0.5 m")
    for word in ("inscribed", "obstacle", "unknown", "footprint"):
        assert word in view.svg


def test_a_costmap_without_cells_is_refused():
    with pytest.raises(ViewError, match="no cells"):
        costmap_picture(Costmap2D(0, 0, 0.5), robot=(0, 0, 0), footprint=SQUARE)
