"""Log records in ROS's form."""

from __future__ import annotations

import io
import logging
import os
from pathlib import Path

import pytest

from rosmini import Graph, set_default_graph
from rosmini.ros.rospy.aliases.rosgraph import roslogging
from rosmini.ros.scripts import run_source


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


def test_a_form_of_ones_own_and_colours(monkeypatch):
    monkeypatch.setenv("ROSCONSOLE_FORMAT", "${time:%H:%M:%S} ${node} ${file}:${line} ${function} ${message} ${what}")
    err = Terminal()
    roslogging.RosStreamHandler(stderr=err).emit(record(logging.ERROR, "x"))
    assert err.getvalue() == "\033[31m00:16:40 /unnamed talker.py:3 main x ${what}\n\033[0m"


@pytest.fixture
def root():
    """Python's root logger, as it was before the test."""
    found = logging.getLogger()
    before, level = list(found.handlers), found.level
    yield found
    for handler in set(found.handlers) - set(before):
        found.removeHandler(handler)
        handler.close()
    found.setLevel(level)


def test_records_are_written_to_ros_log_folder(tmp_path, monkeypatch, root):
    monkeypatch.setenv("ROS_LOG_FILENAME", "")  # so that what it becomes is taken back
    env = {"ROS_HOME": str(tmp_path)}
    path = roslogging.configure_logging("talker", logging.WARNING, "run/talker.log", env)
    logging.getLogger("own").info("not this")
    logging.getLogger("own").warning("but this")
    assert path == str(tmp_path / "log" / "run" / "talker.log") == os.environ["ROS_LOG_FILENAME"]
    lines = Path(path).read_text(encoding="utf-8").splitlines()
    assert len(lines) == 1
    assert lines[0].startswith("[own][WARNING] ")
    assert lines[0].endswith(": but this")
    assert Path(roslogging.configure_logging("", env={"ROS_LOG_DIR": str(tmp_path)}) or "").name.startswith("unknown-")


def test_a_folder_that_cannot_be_is_reported(tmp_path, capsys):
    (tmp_path / "log").write_text("", encoding="utf-8")
    with pytest.raises(roslogging.LoggingException, match="is in the way"):
        roslogging.configure_logging("talker", env={"ROS_HOME": str(tmp_path)})
    assert roslogging.configure_logging("talker", filename="run/a.log", env={"ROS_HOME": str(tmp_path)}) is None
    assert "set ROS_LOG_DIR to a writable location" in capsys.readouterr().err


def test_a_script_writes_the_records_of_its_own_logging(tmp_path, root):
    out = io.StringIO()
    text = f"""
import logging, os
from rosgraph.roslogging import configure_logging
print(configure_logging("script", filename="a.log", env={{"ROS_LOG_DIR": {str(tmp_path)!r}}}))
logging.getLogger("mine").info("of a script")
"""
    before = list(root.handlers)
    assert run_source(text, stdout=out, prefix=False).status == 0
    assert out.getvalue().strip() == str(tmp_path / "a.log")
    assert "[mine][INFO]" in (tmp_path / "a.log").read_text(encoding="utf-8")
    assert root.handlers == before
