"""Controls and the texts of what a panel shows."""

from __future__ import annotations

import pytest

from rosmini.viz.rqt.parts import Bar, Box, Control, Drawing, Row, Rows, Words, controls, text_of, within
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


def test_a_prefix_reaches_every_control():
    parts = (*ALL, Drawing("<svg/>", "a picture", "pick"), Box("b", (), Control("close", "Close", "button")))
    moved = within("7", parts)
    assert [control.key for control in controls(moved)] == ["7/on", "7/rate", "7/go", "7/rate", "7/close"]
    assert [part.key for part in moved if isinstance(part, Drawing)] == ["7/pick"]
    assert text_of(moved) == text_of(parts)


@pytest.mark.parametrize(
    ("control", "given", "taken"),
    [
        (RATE, "3", 3.0),
        (RATE, 10, 10.0),
        (Control("n", "N", "slider", 1.0, minimum=0, maximum=4, whole=True), "4", 4.0),
        (Control("c", "C", "choice", "a", ("a", "b")), "b", "b"),
        (Control("t", "T", "text"), "x", "x"),
        (Control("k", "K", "check", False), True, True),
        (Control("b", "B", "button"), None, True),
    ],
)
def test_a_control_takes_what_fits(control, given, taken):
    assert control.taken(given) == taken


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
