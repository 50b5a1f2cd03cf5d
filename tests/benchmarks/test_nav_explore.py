"""What the study of exploration counts, and one short run of it."""

import numpy as np
import pytest
from rosmini_bench import nav_explore
from rosmini_bench.nav_explore import Explored, table
from rosmini_bench.nav_study import Line, append, drive, key, load
from rosmini_bench.nav_trial import place

from rosmini.sim.worlds import world


def test_the_share_of_a_map_that_knows_all_half_or_nothing():
    grid, _, _ = place("room")
    start = world("room").starts[0]
    message = grid.to_message()
    message.info.origin.position.x -= start[0]
    message.info.origin.position.y -= start[1]
    assert nav_explore.share(message, start, "room") == pytest.approx(1.0)
    cells = np.asarray(message.data).reshape(message.info.height, message.info.width).copy()
    cells[: message.info.height // 2] = -1
    message.data = cells.ravel()
    assert 0.2 < nav_explore.share(message, start, "room") < 0.8
    message.data = np.full(cells.size, -1, dtype=np.int8)
    assert nav_explore.share(message, start, "room") == 0.0


def test_the_table():
    runs = [
        Explored("maze", "explore_lite", 1, "Exploration stopped.", 400.0, 80.0, 0.99, 60, 0, 20.0),
        Explored("maze", "explore_lite", 2, "", 2400.0, 100.0, 0.5, 90, 1, 40.0),
    ]
    head, _, row = table(runs)
    assert "saw all" in head
    assert row.startswith('| <a id="maze-explore-lite"></a>maze, explore_lite | 1 of 2 |')
    assert row.endswith("| 1 of 2 | 74% (50%) | 1400 s | 90 m | 75 | 1 |")


@pytest.mark.nightly
def test_a_run_that_is_cut_short():
    one = nav_explore.explore("maze", "explore_lite", 1, longest=12.0)
    assert not one.ended
    assert 0.0 < one.share < 0.9
    assert one.goals >= 1
    assert one.driven > 0.2


def test_a_run_without_the_doors_is_another_row(tmp_path):
    """Doors that open and shut are walls to who comes past at the wrong time: the study can tell what they cost."""
    runs = [
        Explored("office", "explore_lite", 1, "", 2400.0, 80.0, 0.78, 60, 0, 20.0),
        Explored("office", "explore_lite", 1, "", 2400.0, 80.0, 0.99, 60, 0, 20.0, "door"),
    ]
    _, _, row, other = table(runs)
    assert "</a>office, explore_lite |" in row
    assert "</a>office without doors, explore_lite |" in other
    lines = [Line("abc", one) for one in runs]
    for line in lines:
        append(line, tmp_path / "study.jsonl")
    assert load(tmp_path / "study.jsonl") == lines
    assert {key(line) for line in lines} == {(("explore_lite", "office", each), 1) for each in ("", "door")}
    assert list(drive("explore_lite:office,walkers=1", 7, {key(lines[1])}, "abc")) == []
