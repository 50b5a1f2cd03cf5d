"""Goals that are kept as data, and the page of the book that is made of them."""

from dataclasses import replace

import pytest
import yaml
from rosmini_bench import nav_quality, nav_rows
from rosmini_bench.nav_crossing import Crossing
from rosmini_bench.nav_explore import Explored
from rosmini_bench.nav_goals import Errand
from rosmini_bench.nav_study import Line
from rosmini_bench.nav_trial import Outcome, Setup


def test_the_page_is_what_is_made_of_the_committed_goals():
    assert nav_rows.PAGE.read_text(encoding="utf-8") == nav_rows.page(nav_rows.load(nav_rows.FILE)), (
        "run: PYTHONPATH=tests/benchmarks python -m rosmini_bench.nav_rows"
    )


def test_a_goal_counts_as_reached_within_the_tolerances_of_the_files():
    for file in sorted((nav_rows.ROOT / "assets/ros/turtlebot3_navigation/param").glob("dwa_local_planner*.yaml")):
        own = yaml.safe_load(file.read_text(encoding="utf-8"))["DWAPlannerROS"]
        assert pytest.approx((own["xy_goal_tolerance"] + 0.02, own["yaw_goal_tolerance"] + 0.05)) == (
            nav_quality.XY,
            nav_quality.YAW,
        )


def test_the_tables():
    errand = Errand(3, (1.0, 2.0, 0.5), (4.0, 2.0, -1.0), 3.25, 2.0)
    good = Outcome(errand, "SUCCEEDED", "Goal reached.", 20.0, 3.5, 0.05, 0.1, (), ("walker 1",), 1.5)
    bad = Outcome(errand, "ABORTED", "no", 20.0, 0.5, 3.0, 0.1, ("wall",), (), 1.5, ("rotate_recovery",))
    off = replace(good, off=0.2)
    house, ends = Setup("house", seed=4), ["Exploration stopped.", ""]
    made = nav_rows.page(
        [
            Line("abc", good, house),
            Line("abc", bad, house),
            Line("abd", bad, house),
            Line("abc", off, replace(house, localization="amcl")),
            Line("abc", off, replace(house, careful=False)),
            *(
                Line("abc", Explored("maze", "explore_lite", n, ends[n], 400.0, 80.0, 0.98 - n / 2, 60, n, 20.0))
                for n in (0, 1)
            ),
            Line("abc", Crossing(4, 1, 3, ("no result",), ("tb3_0 into tb3_1",), 240.0, 60.0)),
        ]
    )
    reached = "| house, burger, careful, seed 4 | 1 of 2 | 9% to 91% | 1 | 1.08 | 1.08 | 1.29 | 1.29 | 5 cm | abc |"
    assert reached in made
    assert "| house, burger, careful, seed 4 | 0 of 1 |" in made, "of another commit"
    assert "| house, burger, careful, seed 4 | 3 | 1.0, 2.0 | 4.0, 2.0 | ABORTED: no | 0.5 of 3.2 m | 1 |" in made
    assert "| house, burger, careful, amcl, seed 4 | 1 of 1 |" in made, "amcl may be off, too"
    assert "| house, burger, seed 4 | 0 of 1 |" in made
    assert (
        "| maze | explore_lite | 1 of 2 | 9% to 91% | 1 of 2 | 73% | 48% | 400 s | 80 m | 60 | 1 | 20.0 | abc |" in made
    )
    assert "| 4 | 1 | 3 of 4 | 30% to 95% | 1 | 240 s | 4.0 | 1 x no result; 1 x tb3_0 into tb3_1 |" in made
