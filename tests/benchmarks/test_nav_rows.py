"""Goals that are kept as data, and the page of the book that is made of them."""

from dataclasses import replace

import pytest
import yaml
from rosmini_bench import nav_charts, nav_quality, nav_rows
from rosmini_bench.nav_crossing import Crossing
from rosmini_bench.nav_explore import Explored
from rosmini_bench.nav_goals import Errand
from rosmini_bench.nav_study import Line
from rosmini_bench.nav_trial import Outcome, Setup


def test_the_page_and_its_charts_are_what_is_made_of_the_committed_goals():
    lines = nav_rows.load(nav_rows.FILE)
    run = "run: PYTHONPATH=tests/benchmarks python -m rosmini_bench.nav_rows"
    assert nav_rows.PAGE.read_text(encoding="utf-8") == nav_rows.write(lines), run
    for name, svg in nav_rows.charts(lines).items():
        assert (nav_charts.DRAWINGS / f"{name}.svg").read_text(encoding="utf-8") == svg + "\n", run


def test_a_goal_counts_as_reached_within_the_tolerances_of_the_files():
    for file in sorted((nav_rows.ROOT / "assets/ros/turtlebot3_navigation/param").glob("dwa_local_planner*.yaml")):
        own = yaml.safe_load(file.read_text(encoding="utf-8"))["DWAPlannerROS"]
        assert pytest.approx((own["xy_goal_tolerance"] + 0.02, own["yaw_goal_tolerance"] + 0.05)) == (
            nav_quality.XY,
            nav_quality.YAW,
        )


def test_the_tables():
    def errand(number):
        return Errand(number, (1.0, 2.0, 0.5), (4.0, 2.0, -1.0), 3.25, 2.0)

    def good(number):
        return Outcome(errand(number), "SUCCEEDED", "Goal reached.", 20.0, 3.5, 0.05, 0.1, (), ("walker 1",), 1.5)

    bad = Outcome(errand(3), "ABORTED", "no", 20.0, 0.5, 3.0, 0.1, ("wall",), (), 1.5, ("rotate_recovery",))
    house, ends = Setup("house", seed=4), ["Exploration stopped.", ""]
    amcl = replace(house, localization="amcl")
    lines = [
        *(Line("abc", good(number), house) for number in range(10)),
        Line("abd", bad, house),
        *(Line("abc", replace(good(number), off=0.2), amcl) for number in range(10)),
        *(Line("abc", replace(good(number), off=0.2), replace(house, careful=False)) for number in range(10)),
        *(Line("abc", good(number), Setup("maze", seed=4)) for number in range(9)),
        *(
            Line("abc", Explored("maze", "explore_lite", n, ends[n], 400.0, 80.0, 0.98 - n / 2, 60, n, 20.0))
            for n in (0, 1)
        ),
        Line("abc", Crossing(4, 1, 3, ("no result",), ("tb3_0 into tb3_1",), 240.0, 60.0)),
    ]
    made = nav_rows.page(lines)
    reached = "</a>house, burger, careful, seed 4 | 9 of 10 | 60% to 98% | 1 | 1.08 (1.08) | 1.29 (1.29) | 5 cm |"
    assert reached in made, "goal 3 was driven again by a later commit, and failed"
    assert "| house, burger, careful, seed 4 | 3 | 1.0, 2.0 | 4.0, 2.0 | ABORTED: no | 0.5 of 3.2 m | 1 |" in made
    assert "</a>house, burger, careful, amcl, seed 4 | 10 of 10 |" in made, "amcl may be off, too"
    assert '<a id="house-burger-seed-4"></a>house, burger, seed 4 | 0 of 10 |' in made
    assert "maze, burger" not in made, "nine goals are too few for a row"
    assert "</a>maze, explore_lite | 1 of 2 | 9% to 91% | 1 of 2 | 73% (48%) | 400 s | 80 m | 60 | 1 |" in made
    assert "</a>4 | 1 | 3 of 4 | 30% to 95% | 1 in 1 of 1 runs | 240 s | 1 x no result; 1 x tb3_0 into tb3_1 |" in made
    assert (
        "house, amcl, seed 4: 10 of 10; house, true pose, seed 4: 9 of 10" in nav_rows.charts(lines)["navigation_goals"]
    )
