"""Drives that are written down line by line: what is read again, and what is not driven again."""

import pytest
from rosmini_bench import nav_study
from rosmini_bench.nav_crossing import Crossing
from rosmini_bench.nav_explore import Explored
from rosmini_bench.nav_goals import Errand
from rosmini_bench.nav_study import Line
from rosmini_bench.nav_trial import FIELD, Outcome, Setup

from rosmini.core.errors import RosminiError

ERRAND = Errand(3, (1.0, 2.0, 0.5), (4.0, 2.0, -1.0), 3.25, 2.0)
OUTCOME = Outcome(ERRAND, "ABORTED", "no", 20.0, 0.5, 3.0, 0.1, ("wall",), (), 1.5, ("rotate_recovery",))
LINES = [
    Line("abc", OUTCOME, Setup("maze", overrides=(("planner_frequency", 2.0),), careful=False, seed=4)),
    Line("abc", OUTCOME, Setup(FIELD, gap=2.0, localization="amcl", seed=7)),
    Line("abd", Explored("maze", "explore_lite", 2, "Exploration stopped.", 400.0, 80.0, 0.98, 60, 0, 20.0)),
    Line("abd", Crossing(4, 3, 3, ("no result",), ("tb3_0 into tb3_1",), 240.0, 60.0)),
]


def test_what_is_appended_is_loaded_again(tmp_path):
    file = tmp_path / "rows.jsonl"
    for line in LINES:
        nav_study.append(line, file)
    assert nav_study.load(file) == LINES


def test_what_is_in_the_file_is_not_driven_again():
    done = {nav_study.key(line) for line in LINES}
    assert list(nav_study.drive("explore_lite:maze=2", 7, done, "x")) == []
    assert list(nav_study.drive("crossing:4=3-3", 7, done, "x")) == []
    assert list(nav_study.drive("cylinders:2,amcl=3", 7, done, "x")) == []


def test_who_names_no_world_is_told_what_there_is():
    with pytest.raises(RosminiError, match="hous: name one of house, maze, office, cylinders"):
        list(nav_study.drive("hous=0-3", 7, set(), "x"))
