"""Sequence diagrams."""

import xml.etree.ElementTree as ET

import pytest

from rosmini.viz import ViewError, sequence_diagram, style
from rosmini.viz.metrics import text_width

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


def test_what_one_sends_to_itself_is_a_loop_with_room_for_its_label():
    label = "a name that is longer than the distance of two lines"
    picture = sequence_diagram([("a", "b", "f", None), ("b", "b", label, None)])
    assert picture.text.endswith(f"  b -> b: {label}")
    [loop] = [each for each in ET.fromstring(picture.svg).iter(f"{SVG}g") if "".join(each.itertext()) == label]
    [words] = loop.iter(f"{SVG}text")
    assert float(words.get("x")) + text_width(label, style.LABEL_SIZE) < width(picture)


def width(picture):
    return float(ET.fromstring(picture.svg).get("viewBox").split()[2])


def test_a_diagram_needs_calls():
    with pytest.raises(ViewError, match="at least one"):
        sequence_diagram([], title="it")
