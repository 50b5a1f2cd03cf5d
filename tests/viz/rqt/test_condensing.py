"""Large graphs are drawn in groups, which lose nothing and say what they stand for."""

from __future__ import annotations

import re
from dataclasses import replace

import pytest
from hypothesis import given
from hypothesis import strategies as st

from rosmini.viz import rqt_graph
from rosmini.viz.rqt.condensing import LIMIT, condensed
from rosmini.viz.rqt.graph_state import graph_state
from rosmini.viz.rqt.selection import Selection, select

MODES = ("nodes_only", "nodes_topics_active", "nodes_topics_all")


def everybody_hears(publishers, subscribers):
    pubs = [[f"/topic{i}", [name]] for i, name in enumerate(publishers)]
    return [pubs, [[topic, list(subscribers)] for topic, _ in pubs], []]


def members(selection, name):
    return selection.bundles.get(name, (name,))


@pytest.mark.parametrize("mode", MODES)
def test_fifty_nodes_that_all_hear_twenty_of_them(mode):
    """The graph whose picture took 18 s: those that only listen, and the topics that all hear, become one each."""
    names = [f"/node{i:02}" for i in range(50)]
    picture = rqt_graph(everybody_hears(names[:20], names), mode=mode)
    assert "50 nodes drawn as " in picture.text
    assert re.search(r"/node20 … node49 \(30 nodes\) stands for /node20, .*/node49", picture.text)
    assert len(picture.text.splitlines()) < 200


def test_a_small_graph_is_drawn_as_it_is():
    state = graph_state(everybody_hears(["/a"], [f"/b{i}" for i in range(100)]))
    selection = select(state)
    assert condensed(selection) is selection


def test_robots_of_one_kind_become_one():
    robots = [f"/robot{i}" for i in range(120)]
    pubs = [[f"{robot}/scan", [f"{robot}/laser"]] for robot in robots]
    subs = [[f"{robot}/scan", [f"{robot}/{name}" for name in ("amcl", "move_base", "slam")]] for robot in robots]
    picture = rqt_graph([pubs, subs, []])
    assert picture.text.startswith("rqt_graph: 480 nodes drawn as 2, 120 topics drawn as 1")
    assert "/robot0/laser … /robot99/laser (120 nodes) -> /robot0/scan … /robot99/scan (120 topics) -> " in picture.text


@pytest.mark.parametrize("mode", MODES)
def test_a_thousand_nodes_and_five_thousand_arrows_end_below_the_limit(mode):
    names = [f"/{chr(97 + i % 26)}{chr(97 + i // 26 % 26)}{chr(97 + i // 676)}" for i in range(1_000)]
    state = graph_state(
        [
            [[f"/t{i}", [names[i * 7919 % 1_000]]] for i in range(5_000)],
            [[f"/t{i}", [names[i * 104_729 % 1_000 - 1]]] for i in range(5_000)],
            [],
        ]
    )
    small = condensed(select(state, mode))
    arrows = small.connections if mode == "nodes_only" else (*small.publications, *small.subscriptions)
    assert len(small.nodes) + len(arrows) <= LIMIT
    assert sorted(one for name in small.nodes for one in members(small, name)) == sorted(names)


NAMES = st.sampled_from([f"/{space}{word}{i}" for space in ("", "x/", "y/") for word in "ab" for i in range(3)])
TOPICS = [*(f"/t{i}" for i in range(6)), "/a1", "/x/b2"]  # a node and a topic may have one name
ENDS = st.dictionaries(st.sampled_from(TOPICS), st.sets(NAMES, max_size=6), max_size=8)


@given(ENDS, ENDS, st.sampled_from(MODES), st.integers(1, 40))
def test_nothing_is_lost_and_nothing_invented(publishers, subscribers, mode, limit):
    state = graph_state([[[t, sorted(n)] for t, n in side.items()] for side in (publishers, subscribers)] + [[]])
    whole = select(state, mode)
    small = condensed(whole, limit)
    assert sorted(one for name in small.nodes for one in members(small, name)) == sorted(whole.nodes)
    assert sorted(one for name in small.topics for one in members(small, name)) == sorted(whole.topics)
    for end in ("publications", "subscriptions"):
        before = {(home(small, node, "nodes"), home(small, topic, "topics")) for node, topic in getattr(whole, end)}
        assert set(getattr(small, end)) == before
    if mode == "nodes_only":
        before = {
            (home(small, p, "nodes"), home(small, t, "topics"), home(small, s, "nodes"))
            for p, t, s in whole.connections
        }
        assert set(small.connections) == before


def home(selection: Selection, name: str, noun: str) -> str:
    """The box in which a node or a topic ended."""
    boxes = (box for box, inside in selection.bundles.items() if name in inside and box.endswith(f"{noun})"))
    return next(boxes, name)


def test_a_node_that_does_not_answer_marks_its_group():
    selection = select(graph_state(everybody_hears(["/a"], [f"/b{i}" for i in range(400)])))
    small = condensed(replace(selection, unreachable=frozenset({"/b7"})))
    assert small.unreachable == {"/b0 … b99 (400 nodes)"}
