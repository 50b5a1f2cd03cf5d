"""Pictures of chains of causes."""

import xml.etree.ElementTree as ET

from rosmini.ros.introspection.why import Step, Why
from rosmini.viz.why_pictures import MAX_LENGTH, why_picture

SVG = "{http://www.w3.org/2000/svg}"


def texts(why):
    root = ET.fromstring(why_picture(why).svg)
    return ["".join(node.itertext()) for node in root.iter(f"{SVG}text")]


def test_causes_stand_above_what_they_led_to():
    why = Why((Step("b did it", 2.0, "b.py, line 2"), Step("a did it", 1.0)), "and nobody knows why", (Step("c", 0.5),))
    assert texts(why) == [
        "a did it, at 1.000 s",
        "nobody knows why",
        "before that: c, at 0.500 s",
        "b did it, at 2.000 s",
        "b.py, line 2",
    ]


def test_markup_in_names_and_long_lines_do_no_harm():
    why = Why((Step("<b> & 'c'", 1.0, "x" * 1000),), "and </svg>")
    assert texts(why)[0] == "<b> & 'c', at 1.000 s"
    assert all(len(line) <= MAX_LENGTH for line in texts(why))
