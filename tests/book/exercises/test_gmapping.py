"""The chapter GMapping: its outputs are what the text says of them."""

from __future__ import annotations

import re

from .conftest import printed


def test_the_served_map_has_whole_blocks(cells):
    assert "192 x 192 cells" in printed(cells, "map_saver -f room")


def test_the_hill_of_scores_has_its_summit_where_the_text_says(cells):
    rows = [line.split() for line in printed(cells, "def score").splitlines()]
    steps, marks = rows[0][1:], {row[1]: [int(mark) for mark in row[2:]] for row in rows[1:]}
    assert marks["0.0"][steps.index("0.6")] == max(max(row) for row in marks.values())
    assert "[0.6 " in printed(cells, "def climb")


def test_gmapping_is_better_than_odometry_alone(cells):
    alone, better = (float(n) for n in re.findall(r"(\d\.\d) m on average", printed(cells, "def off")))
    assert alone > 3 * better


def test_fewer_particles_and_resamplings(cells):
    lines = [line.split() for line in printed(cells, "for count in").splitlines()[1:]]
    assert [line[0] for line in lines] == ["1", "5", "30"]
    assert lines[0][3] == "0", "of one particle there is nothing to choose"
    assert int(lines[2][3]) >= 2
