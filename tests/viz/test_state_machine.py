"""Pictures of state machines."""

import xml.etree.ElementTree as ET

from rosmini.core.actionlib import Status
from rosmini.viz import action_states
from rosmini.viz.state_machine import server_transitions, state_machine

SVG = "{http://www.w3.org/2000/svg}"


def groups(picture, kind):
    root = ET.fromstring(picture.svg)
    return ["".join(group.itertext()) for group in root.iter(f"{SVG}g") if group.get("class") == kind]


def test_the_server_has_all_its_steps():
    picture = action_states("server", title="Figure 1: it")
    assert sorted(groups(picture, "rm-state")) == sorted(one.name for one in Status if one is not Status.LOST)
    assert len(groups(picture, "rm-step")) == len(server_transitions()) == 14
    assert picture.text.splitlines()[0] == "Figure 1: it: 9 states"
    assert "  PENDING -> RECALLING: cancel request" in picture.text.splitlines()
    assert "  final: ABORTED, PREEMPTED, RECALLED, REJECTED, SUCCEEDED" in picture.text.splitlines()
    assert picture.caption == "Figure 1: it"


def test_the_way_of_one_goal_stands_out():
    picture = action_states(visited=[Status.PENDING, "ACTIVE", Status.PREEMPTING, Status.PREEMPTED])
    assert sorted(groups(picture, "rm-visited")) == ["ACTIVE", "PENDING", "PREEMPTED", "PREEMPTING"]
    assert len(groups(picture, "rm-taken")) == 3
    assert picture.text.endswith("visited: PENDING -> ACTIVE -> PREEMPTING -> PREEMPTED")
    assert "came through PENDING, ACTIVE" in picture.alt


def test_a_machine_without_an_end():
    picture = state_machine([("day", "dusk", "night"), ("night", "dawn", "day")], title="t")
    assert "final" not in picture.text
    assert "day, night" in picture.alt


def test_a_picture_begins_at_its_first_state():
    """Of a circle any state could be above; a reader looks there for the one where it begins."""
    steps = [
        ("PLANNING", "plan", "CONTROLLING"),
        ("CONTROLLING", "stuck", "CLEARING"),
        ("CLEARING", "done", "PLANNING"),
    ]
    for first in ("PLANNING", "CONTROLLING", "CLEARING"):
        picture = state_machine(steps, title="a circle", first=first)
        root = ET.fromstring(picture.svg)
        tops = {
            "".join(g.itertext()): float(g[0].get("y")) for g in root.iter(f"{SVG}g") if g.get("class") == "rm-state"
        }
        assert min(tops, key=tops.get) == first
