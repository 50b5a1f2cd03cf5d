"""rqt_console: which messages pass, and what the table says."""

import re

import pytest

from rosmini import Graph, Time
from rosmini.msgs.rosgraph_msgs.msg import Log
from rosmini.viz import ViewError
from rosmini.viz.rqt.console import rqt_console


def message(level, name, text, *, at=1000.0, topics=("/rosout",)):
    made = Log(level=level, name=name, msg=text, file="/home/user/ws/src/robot/talk.py", line=7, function="speak")
    made.header.stamp = Time.from_sec(at)
    made.topics = list(topics)
    return made


LOG = [
    message(1, "/talker", "starting", at=1000.0),
    message(2, "/talker", "Battery at 80 %", at=1000.5, topics=("/rosout", "/chatter")),
    message(4, "/camera", "battery low", at=1001.0),
    message(8, "/robot1/motor", "stalled:\nno current", at=1002.25, topics=("/rosout", "/odom")),
    message(16, "/robot2/motor", "burnt <out> & gone", at=1003.0),
]


@pytest.mark.parametrize(
    ("filters", "shown"),
    [
        ({}, [0, 1, 2, 3, 4]),
        ({"level": "warn"}, [2, 3, 4]),
        ({"level": ["INFO", "FATAL"]}, [1, 4]),
        ({"level": []}, []),
        ({"node": "/talker"}, [0, 1]),
        ({"node": "/robot.*, /camera"}, [2, 3, 4]),
        ({"node": "-/robot.*"}, [0, 1, 2]),
        ({"text": "battery"}, [1, 2]),
        ({"text": "battery", "regex": True}, [2]),
        ({"text": r"^\w+ing$", "regex": True}, [0]),
        ({"text": "%"}, [1]),
        ({"exclude": "BATTERY"}, [0, 3, 4]),
        ({"exclude": "a", "regex": True, "level": "WARN"}, [4]),
        ({"topic": "/chatter"}, [1]),
        ({"topic": "/odom,/chatter"}, [1, 3]),
        ({"location": "talk.py:7"}, [0, 1, 2, 3, 4]),
        ({"location": "other.py"}, []),
        ({"start": 1000.5, "end": 1002.25}, [1, 2, 3]),
        ({"start": Time.from_sec(1002)}, [3, 4]),
        ({"limit": 2}, [3, 4]),
        ({"limit": 0}, []),
        ({"level": "WARN", "limit": 9}, [2, 3, 4]),
    ],
)
def test_filters(filters, shown):
    table = rqt_console(LOG, **filters)
    assert [message.msg for message in table.messages] == [LOG[number].msg for number in shown]
    assert len(table) == len(shown)
    for number, entry in enumerate(LOG):
        first = entry.msg.partition("\n")[0]
        assert (first in table.text) == (number in shown)


def test_the_text_is_an_aligned_table():
    table = rqt_console(LOG, level="WARN", highlight="stalled", title="Figure 1")
    assert table.text == (
        "Figure 1: 3 of 5 messages\n"
        "  1001.000  WARN   /camera        battery low         talk.py:7 speak\n"
        "* 1002.250  ERROR  /robot1/motor  stalled:            talk.py:7 speak\n"
        "                                  no current\n"
        "  1003.000  FATAL  /robot2/motor  burnt <out> & gone  talk.py:7 speak"
    )
    assert rqt_console([]).text == "rqt_console: 0 messages"
    chosen = rqt_console(LOG, columns=("message", "topics"), node="/talker")
    assert chosen.text.splitlines()[2] == "  Battery at 80 %  /rosout, /chatter"


def test_forms(tmp_path):
    table = rqt_console(LOG)
    data, _ = table._repr_mimebundle_()
    assert list(data) == ["text/plain", "text/html"]
    assert "<table>" in table.save(tmp_path / "log.html").read_text(encoding="utf-8")
    assert "stalled" in table.save(tmp_path / "log.txt").read_text(encoding="utf-8")
    with pytest.raises(ViewError, match=r"no form for the suffix '\.png'.*\.html, \.txt"):
        table.save(tmp_path / "log.png")


@pytest.mark.parametrize(
    ("filters", "said"),
    [
        ({"level": "WARNING"}, "no level 'WARNING': did you mean WARN"),
        ({"columns": ("mesage",)}, "no column 'mesage': did you mean message"),
        ({"text": "(", "regex": True}, r"'\(' is not a regular expression"),
        ({"node": "/a("}, "neither a name nor a regular expression"),
    ],
)
def test_filters_that_are_wrong(filters, said):
    with pytest.raises(ViewError, match=said):
        rqt_console(LOG, **filters)


@pytest.mark.parametrize("source", [5, "text", [5], object()])
def test_what_is_no_log(source):
    with pytest.raises(ViewError, match="has no log messages: give what"):
        rqt_console(source)


def test_a_graph_shows_its_log():
    with Graph() as graph:
        node, console = graph.node("node"), graph.console()
        graph.run(0.1)
        node.loginfo("hello")
        graph.run(0.1)
        shown = console.show(title="Log")
    assert re.fullmatch(
        r"Log: 1 message\n  1000\.100  INFO  /node  hello  test_console\.py:\d+ test_a_graph_shows_its_log", shown.text
    )
