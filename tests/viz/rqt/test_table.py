"""Tables: text, alt text, and a figure for pages."""

from __future__ import annotations

from rosmini.viz.rqt.parts import Row, Rows
from rosmini.viz.rqt.table import Table


def table(columns: tuple[str, ...], *rows: Row) -> Table:
    return Table(Rows(columns, rows, "Things", "no thing"), title="things", noun="thing")


def test_three_forms() -> None:
    made = table(("Name", "Value"), Row(("a", "<1>")), Row(("b", "2"), depth=1), Row(("long", "")))
    assert made.text == "things: 2 things\n  Name  Value\n  a     <1>\n    b   2\n  long"
    assert made.alt == "Table of things, 2 things; columns Name, Value. a, <1>; b, 2; long"
    rows = made.html.partition("</style>")[2]
    assert "<td>&lt;1&gt;</td>" in rows
    assert rows.count("padding-left") == 1
    assert 'scope="col"' in rows
    assert "things (2 things)" in rows
    assert len(made) == 3


def test_a_narrow_page_may_break_long_names() -> None:
    made = table(("Type",), Row(("sensor_msgs/Imu",)))
    assert "<td>sensor_<wbr>msgs/<wbr>Imu</td>" in made.html
    assert "sensor_msgs/Imu" in made.text


def test_a_table_without_rows_says_so() -> None:
    assert table(("Name",)).text == "things: 0 things"
    assert "no thing" in table(("Name",)).html
