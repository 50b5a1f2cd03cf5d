"""What is beside a node or a topic in rqt_graph."""

import pytest

from rosmini.viz import ViewError
from rosmini.viz.rqt.graph import rqt_graph
from rosmini.viz.rqt.graph_state import GraphState

STATE = GraphState.of(
    [
        [["/ab", ["/a"]], ["/ba", ["/b"]], ["/bc", ["/b"]]],
        [["/ab", ["/b"]], ["/ba", ["/a"]], ["/bc", ["/c"]]],
        [["/d/get_loggers", ["/d"]]],
    ]
)


@pytest.mark.parametrize(
    ("mode", "name", "text"),
    [
        ("nodes_only", "/b", "highlighted: /b; it is heard by /c; both ways /a"),
        ("nodes_only", "/c", "highlighted: /c; it hears /b"),
        ("nodes_only", "/bc", "highlighted: /bc; it hears /b; it is heard by /c"),
        ("nodes_only", "/d", "highlighted: /d; nothing is beside it"),
        ("nodes_topics_all", "/b", "highlighted: /b; it hears /ab; it is heard by /ba, /bc"),
        ("nodes_topics_all", "/ab", "highlighted: /ab; it hears /a; it is heard by /b"),
    ],
)
def test_what_is_beside_a_name(mode, name, text):
    picture = rqt_graph(STATE, mode=mode, highlight=name)
    assert picture.text.splitlines()[-1] == text
    assert text[1:] in picture.alt


def test_the_drawing_has_the_chosen_one_its_neighbours_and_pales_the_rest():
    plain, lit = rqt_graph(STATE).svg, rqt_graph(STATE, highlight="/c").svg
    assert plain is not None
    assert lit is not None
    assert "rm-pale" not in plain
    body = lit.partition("</style>")[2]
    assert {kind: body.count(f" rm-{kind}") for kind in ("chosen", "in", "out", "pale")} == {
        "chosen": 1, "in": 2, "out": 0, "pale": 4,
    }  # fmt: skip


def test_what_is_not_drawn_is_refused():
    with pytest.raises(ViewError, match="draws no '/e' that could be highlighted"):
        rqt_graph(STATE, highlight="/e")
