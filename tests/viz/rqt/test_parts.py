"""Controls and the texts of what a panel shows."""

import pytest

from rosmini.viz.rqt.parts import Bar, Box, Control, Row, Rows, Words, text_of
from rosmini.viz.view import ViewError

RATE = Control("rate", "Rate", "number", 2.5, minimum=0.0, maximum=10.0)
ALL = (
    Bar((Control("on", "On", "check", True), RATE, Control("go", "Go", "button"), "two")),
    Box("Inside", (Rows(("A", "B"), (Row(("x", "1")), Row(("yy", RATE), depth=1, is_marked=True)), "Numbers"),)),
    Words("that is all"),
)


def test_the_text_has_values_and_no_buttons():
    assert text_of(ALL).splitlines() == [
        "[x] On  Rate: 2.5  two",
        "[Inside]",
        "  A      B",
        "  x      1",
        "    *yy  2.5",
        "that is all",
    ]


@pytest.mark.parametrize(
    ("control", "given", "why"),
    [
        (RATE, "10.1", "a number from 0 to 10"),
        (RATE, "nan", "a number"),
        (RATE, "fast", "a number"),
        (RATE, None, "a number"),
        (RATE, [1], "a number"),
        (Control("n", "N", "number", 1.0, whole=True), "1.5", "a whole number"),
        (Control("c", "C", "choice", "a", ("a", "b")), "c", "one of a, b"),
        (Control("c", "C", "choice", "a", ("a", "b")), ["a"], "one of a, b"),
        (Control("k", "K", "check", False), "true", "True or False"),
    ],
)
def test_a_control_refuses_what_does_not(control, given, why):
    with pytest.raises(ViewError, match=why):
        control.taken(given)
