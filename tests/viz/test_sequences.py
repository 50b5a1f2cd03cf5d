"""Sequence diagrams."""

import xml.etree.ElementTree as ET

import pytest

from rosmini.viz import ViewError, sequence_diagram

SVG = "{http://www.w3.org/2000/svg}"
CALLS = [
    ("listener", "Master", "registerSubscriber", "[TALKER]"),
    ("listener", "talker", "requestTopic", "TCPROS"),
    ("talker", "listener", "a message", None),
]


def groups(picture, kind):
    root = ET.fromstring(picture.svg)
    return ["".join(group.itertext()) for group in root.iter(f"{SVG}g") if group.get("class") == kind]


def test_each_call_is_an_arrow_and_each_answer_one_back():
    picture = sequence_diagram(CALLS, title="Figure 1: it")
    assert groups(picture, "rm-actor") == ["listener", "Master", "talker"]
    assert groups(picture, "rm-call") == ["registerSubscriber", "requestTopic", "a message"]
    assert groups(picture, "rm-answer") == ["[TALKER]", "TCPROS"]
    assert picture.caption == "Figure 1: it"
    assert picture.text.splitlines() == [
        "Figure 1: it: 3 calls between 3",
        "  listener -> Master: registerSubscriber",
        "  listener <- Master: [TALKER]",
        "  listener -> talker: requestTopic",
        "  listener <- talker: TCPROS",
        "  talker -> listener: a message",
    ]
    for said in (
        "listener, Master, talker",
        "Master: registerSubscriber",
        "talker: requestTopic",
        "listener: a message",
    ):
        assert said in picture.alt


def test_names_are_text_and_no_markup():
    picture = sequence_diagram([("<a>", "b & c", "</svg>", None)], title="it")
    assert groups(picture, "rm-actor") == ["<a>", "b & c"]


@pytest.mark.parametrize(("calls", "said"), [([], "at least one"), ([("a", "a", "f", None)], "itself")])
def test_what_cannot_be_drawn_is_refused(calls, said):
    with pytest.raises(ViewError, match=said):
        sequence_diagram(calls, title="it")
