"""What real tools printed (`tests/data/transcripts`), and a graph like the one that they saw."""

from __future__ import annotations

import re
from pathlib import Path
from typing import TYPE_CHECKING

from rosmini.msgs.geometry_msgs.msg import PoseStamped, Twist
from rosmini.msgs.nav_msgs.msg import Odometry
from rosmini.msgs.sensor_msgs.msg import LaserScan
from rosmini.msgs.std_msgs.msg import String

if TYPE_CHECKING:
    from rosmini import Graph

FOLDER = Path(__file__).parents[1] / "data" / "transcripts"

_VARYING = (
    (r"http://[^\s/]+:\d+/", "URI"),
    (r"(?<=^Pid: )\d+", "PID"),
    (r" \([\d]+ - [\d.]+:\d+\) \[\d+\]", ""),
    (r"(?<=transport: )\w+", "TRANSPORT"),
    (r"(?<=time=)[\d.]+", "TIME"),
    (r"(?<=ping average: )[\d.]+", "TIME"),
    (r"127\.0\.0\.1", "HOST"),
    (r"^rosmini$", "HOST"),
)


def in_order(name: str) -> list[tuple[str, tuple[str, int]]]:
    """Each command line in a transcript, with what it printed, on both streams, and its exit status."""
    text = (FOLDER / f"{name}.txt").read_text(encoding="utf-8")
    blocks = re.findall(r"^\$ (.*)\n((?:.*\n)*?)\[exit (\d+)\]$", text, re.MULTILINE)
    return [(words, (said, int(status))) for words, said, status in blocks]


def read(name: str) -> dict[str, tuple[str, int]]:
    """The same by command line."""
    return dict(in_order(name))


def masked(text: str) -> str:
    """The text with what differs between two runs, or between two processes and one, put out of sight."""
    for pattern, put in _VARYING:
        text = re.sub(pattern, put, text, flags=re.MULTILINE)
    return text


def talkers(graph: Graph) -> None:
    """The nodes of the transcripts: they are connected, and have published something."""
    listener = graph.node("listener")
    listener.subscriber("chatter", String, lambda _: None)
    talker = graph.node("talker")
    chatter = talker.publisher("chatter", String)
    poser = graph.node("poser")
    poser.publisher("latched", Twist, latch=True).publish(Twist())
    for topic, kind in (("pose", PoseStamped), ("scan", LaserScan), ("odom", Odometry)):
        poser.publisher(topic, kind)
    graph.node("srv_server")
    chatter.wait_for_subscribers()
    graph.run(0.1)
