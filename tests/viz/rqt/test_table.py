"""Tables: text, alt text, and a figure for pages."""

from rosmini.viz.rqt.parts import Row, Rows
from rosmini.viz.rqt.table import Table


def table(columns, *rows):
    return Table(Rows(columns, rows, "Things", "no thing"), title="things", noun="thing")


def test_three_forms():
    made = table(("Name", "Value"), Row(("a", "<1>")), Row(("b", "2"), depth=1), Row(("long", "")))
    assert made.text == "things: 2 things\n  Name  Value\n  a     <1>\n    b   2\n  long"
    assert "2 things" in made.alt and "Name, Value. a, <1>; b, 2; long" in made.alt
    rows = made.html.partition("</style>")[2]
    assert "<td>&lt;1&gt;</td>" in rows
    assert rows.count("padding-left") == 1
    assert 'scope="col"' in rows
    assert "things (2 things)" in rows
    assert len(made) == 3
