"""The logger levels of a node, through its services."""

import pytest

from rosmini.core.errors import ServiceException
from rosmini.viz.rqt.logger_level import LoggerLevel
from rosmini.viz.view import ViewError


@pytest.fixture
def talker(graph):
    return graph.node("talker")


@pytest.fixture
def levels(graph, talker):
    return LoggerLevel(graph)


def test_a_level_that_is_chosen_holds_in_the_node(levels, talker, graph):
    console = graph.console()
    talker.logdebug("unheard")
    levels.set("node", "/talker")
    levels.set("level/rosout", "Debug")
    talker.logdebug("heard")
    graph.run(0.1)
    assert [message.msg for message in console.messages if message.name == "/talker"] == ["heard"]
    assert "rosout          Debug" in levels.text
    assert "rosout logs from Debug on" in levels.text


def test_refresh_asks_again(levels, talker, graph):
    levels.choose("/talker")
    other = LoggerLevel(graph, "/talker", name="rqt_logger_level_2")
    other.set_level("rosout", "fatal")
    assert levels.loggers["rosout"] == "Info"
    levels.set("refresh")
    assert levels.loggers["rosout"] == "Fatal"


def test_what_makes_no_sense_is_refused(levels, talker):
    with pytest.raises(ViewError, match="no node is chosen"):
        levels.set("refresh")
    with pytest.raises(ViewError, match="did you mean /talker"):
        levels.choose("/talke")
    levels.choose("/talker")
    levels.set_level("rosout", "Warn")
    assert "rosout logs from Warn on" in levels.text
    assert "rq-words rq-bad" not in levels.markup(live=True)
    with pytest.raises(ViewError, match="no level 'Worn'"):
        levels.set_level("rosout", "Worn")
    with pytest.raises(ViewError, match="no logger 'x'"):
        levels.set_level("x", "Warn")
    with pytest.raises(ViewError, match="is one of Debug"):
        levels.set("level/rosout", "Worn")


def test_a_node_that_ended_is_named(levels, talker):
    levels.choose("/talker")
    talker.shutdown()
    with pytest.raises(ServiceException, match="/talker"):
        levels.set("refresh")
    assert "/talker" in levels.text
