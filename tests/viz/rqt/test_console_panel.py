"""The console that goes on: filters, highlights, pause."""

import pytest

from rosmini.viz.rqt.console import LogConsole
from rosmini.viz.view import ViewError


@pytest.fixture
def console(graph):
    return LogConsole(graph)


@pytest.fixture
def say(graph, console):
    node = graph.node("talker")
    graph.run(0.1)  # a connection takes a moment

    def say(*texts):
        for text in texts:
            (node.logwarn if "!" in text else node.loginfo)(text)
        graph.run(0.1)

    return say


def shown(console):
    return [line.split()[3] for line in console.text.splitlines() if line[0] in "*1" and "/talker" in line]


def test_messages_are_shown_as_they_come(console, say):
    assert "no message passes the filters" in console.text
    say("one", "two!")
    assert shown(console) == ["one", "two!"]
    assert "2 messages" in console.text


@pytest.mark.parametrize(
    ("key", "value", "left"),
    [("level", "WARN", ["two!"]), ("text", "ON", ["one"]), ("exclude", "one", ["two!"]), ("node", "-/talker", [])],
)
def test_the_page_filters(console, say, key, value, left):
    say("one", "two!")
    console.set(key, value)
    assert shown(console) == left
    assert f"{len(left)} of 2 messages" in console.text


def test_what_is_highlighted_is_marked(console, say):
    say("one", "two!")
    console.set("regex", True)
    console.set("highlight", "^t")
    assert [line[0] for line in console.text.splitlines() if "/talker" in line] == ["1", "*"]
    assert 'class="WARN marked"' in console.markup(live=True)


def test_pause_and_clear(console, say):
    say("one")
    console.set("pause", True)
    say("two!")
    assert shown(console) == ["one"]
    assert "1 message, paused" in console.text
    console.set("pause", False)
    assert shown(console) == ["one", "two!"]
    console.set("clear")
    assert shown(console) == []


def test_a_filter_that_is_none_is_refused_and_the_old_one_holds(console, say):
    say("one")
    console.set("regex", True)
    with pytest.raises(ViewError, match="not a regular expression"):
        console.set("text", "(")
    with pytest.raises(ViewError, match="no filter colour"):
        console.filter(colour="red")
    assert shown(console) == ["one"]
