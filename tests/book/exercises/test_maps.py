"""The chapter Maps: what the text says of its maps and drives is what its cells print."""

from __future__ import annotations

from .conftest import all_printed, printed


def test_the_cells_print_what_the_text_says(cells):
    said = all_printed(cells)
    assert "door: row 142, column 150 is 100\n" in said
    assert "trinary  100  100   -1   -1   -1    0    0    0\n" in said
    assert "image: ~/maps/house.pgm\n" in said


def test_with_the_right_map_the_way_is_less_than_half_as_long(cells):
    long_way, short_way = (float(printed(cells, f"rosmini.wait({seconds})").split()[-2]) for seconds in (62, 25))
    assert short_way < long_way / 2
