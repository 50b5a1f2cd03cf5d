"""Log records in ROS's form."""

from __future__ import annotations

import io
import logging

import pytest

from rosmini import Graph, set_default_graph
from rosmini.rospy.aliases.rosgraph import roslogging


@pytest.fixture(autouse=True)
def _graph():
    """A default graph at the beginning of its time."""
    graph = Graph()
    before = set_default_graph(graph)
    yield
    set_default_graph(before)
    graph.shutdown("the test is over")


def record(level, text):
    return logging.LogRecord("rosout", level, "talker.py", 3, text, (), None, "main")


class Terminal(io.StringIO):
    def isatty(self):
        return True


def test_levels_go_to_their_streams_with_the_graphs_time(monkeypatch):
    monkeypatch.delenv("ROSCONSOLE_FORMAT", raising=False)
    out, err = io.StringIO(), io.StringIO()
    handler = roslogging.RosStreamHandler(stdout=out, stderr=err)
    handler.emit(record(logging.INFO, "hello"))
    handler.emit(record(logging.WARNING, "look out"))
    handler.emit(record(logging.CRITICAL, "the end"))
    assert out.getvalue() == "[INFO] [1000.000000]: hello\n"
    assert err.getvalue() == "[WARN] [1000.000000]: look out\n[FATAL] [1000.000000]: the end\n"


def test_a_form_of_ones_own_and_colours(monkeypatch):
    monkeypatch.setenv(
        "ROSCONSOLE_FORMAT", "${time:%H:%M:%S} ${node} ${file}:${line} ${function} ${message} ${what}"
    )
    err = Terminal()
    roslogging.RosStreamHandler(stderr=err).emit(record(logging.ERROR, "x"))
    assert err.getvalue() == "\033[31m00:16:40 /unnamed talker.py:3 main x ${what}\n\033[0m"


def test_what_is_missing_names_the_way_out():
    with pytest.raises(AttributeError, match="set ROS_LOG_DIR"):
        _ = roslogging.configure_logging
