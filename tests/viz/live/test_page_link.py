"""What every page of something live relies on: its messages arrive, in order, whoever drives the graph."""

import pytest

from rosmini.core.errors import RosminiError
from rosmini.viz.live.page_link import PageLink


class Link(PageLink):
    """Keeps what its page says; a message may take some time."""

    acts = frozenset({"act"})
    gone = None

    def __init__(self, node):
        self._node = node
        self.taken = []
        super().__init__((), "nobody", {})
        self.sent = []

    @property
    def node(self):
        return self._node

    def _take(self, kind, content):
        self._node.sleep(content.get("takes", 0.0))
        self.taken.append((kind, content.get("number", 0)))

    def say(self, kind, **more):
        self.receive(self.widget, {"type": kind, **more}, [])

    def keep(self, content, _buffers):
        self.sent.append(content)


@pytest.fixture
def link(graph):
    made = Link(graph.node("panel"))
    made.widget.send = made.keep
    return made


def test_a_message_does_not_overtake_one_that_waits(link, graph):
    def act(_event):
        for number in range(3):
            link.say("act", number=number, takes=0.3 - number / 10)

    graph.node("program").timer(0.1, act, oneshot=True)
    graph.run(2.0)
    assert link.taken == [("act", 0), ("act", 1), ("act", 2)]


def test_a_page_that_a_program_serves_is_heard_between_two_drives(link, graph):
    link.widget.sink = link.keep
    link.say("hello")
    link.say("act", number=1)
    graph.run(0.1)
    assert link.taken == [("hello", 0), ("act", 1)]
    assert link.sent == []


def test_without_a_program_or_an_event_loop_an_action_is_refused_on_the_page(link, graph, monkeypatch):
    def live():
        raise RosminiError("a live graph needs an event loop")

    monkeypatch.setattr(graph, "live", live)
    link.say("act")
    graph.run(0.1)
    assert link.taken == []
    assert [content["type"] for content in link.sent] == ["refused"]
    assert "event loop" in link.sent[0]["text"]
