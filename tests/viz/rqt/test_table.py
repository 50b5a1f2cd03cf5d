"""Tables: text, alt text, and a figure for pages."""

from __future__ import annotations

import pytest

from rosmini.viz import ViewError
from rosmini.viz.rqt.table import Table


def test_three_forms() -> None:
    table = Table(("Name", "Value"), [("a", "<1>"), ("  b", "2"), ("long", "")], title="things", noun="thing")
    assert table.text == "things: 2 things\n  Name  Value\n  a     <1>\n    b   2\n  long"
    assert table.alt == "Table of things, 2 things; columns Name, Value. a, <1>; b, 2; long"
    assert "<td>&lt;1&gt;</td>" in table.html
    assert table.html.count("padding-left") == 1 + table.html.count(
        "padding-left", 0, table.html.index("</style>")
    )
    assert 'scope="col"' in table.html
    assert len(table) == 3


def test_a_narrow_page_may_break_long_names() -> None:
    table = Table(("Type",), [("sensor_msgs/Imu",)], title="types", noun="type")
    assert "<td>sensor_<wbr>msgs/<wbr>Imu</td>" in table.html
    assert "sensor_msgs/Imu" in table.text


def test_a_table_without_rows_says_so() -> None:
    table = Table(("Name",), [], title="things", noun="thing")
    assert table.text == "things: 0 things"
    assert "no thing" in table.html


def test_a_row_of_another_length_is_refused() -> None:
    with pytest.raises(ViewError, match="2 cells"):
        Table(("a", "b"), [("1",)], title="t", noun="row")
