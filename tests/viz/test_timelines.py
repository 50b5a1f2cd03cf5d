"""Timelines of states."""

from enum import Enum
from types import SimpleNamespace

import pytest

from rosmini.viz import ViewError
from rosmini.viz.timelines import Span, spans_of, timeline

Lamp = Enum("Lamp", ["RED", "GREEN"])


def history(*times):
    colours = [Lamp.RED, Lamp.GREEN]
    return [
        SimpleNamespace(time=time, before=colours[number % 2], after=colours[(number + 1) % 2])
        for number, time in enumerate(times)
    ]


def test_a_state_lasts_from_one_transition_to_the_next():
    assert spans_of(history(1.0, 2.5, 4.0)) == [Span("GREEN", 1.0, 2.5), Span("RED", 2.5, 4.0)]
    assert spans_of(history(1.0)) == []
    assert spans_of(history(1.0), begin=0.5) == [Span("RED", 0.5, 1.0)]


def test_it_says_what_it_draws_from_its_first_transition_on():
    picture = timeline(
        history(1000.0, 1002.0, 1006.0, 1007.0),
        states=["RED", "GREEN"],
        marks=[(1002.0, "a bus")],
        title="Figure 1: A lamp",
    )
    assert picture.text == (
        "Figure 1: A lamp: 7.0 s\n  RED: 1 x, together 4.0 s\n  GREEN: 2 x, together 3.0 s\n  2.0 s: a bus"
    )
    for word in ("RED", "GREEN", "a bus", "time [s]"):
        assert word in picture.svg


@pytest.mark.parametrize(("times", "states"), [((1.0,), ["RED", "GREEN"]), ((1.0, 2.0), ["RED"])])
def test_too_little_to_draw(times, states):
    with pytest.raises(ViewError):
        timeline(history(*times), states=states)
