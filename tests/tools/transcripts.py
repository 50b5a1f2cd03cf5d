"""What real tools printed (`tests/data/transcripts`), and a graph like the one that they saw.

What ours print where the real ones print something else is in `tests/data/golden`, one file per tool.
`ROSMINI_WRITE_GOLDEN=1 uv run pytest -n0 tests/tools` runs the command lines in these files and writes what they print;
read the diff.
"""

from __future__ import annotations

import os
import re
import shlex
from pathlib import Path
from typing import TYPE_CHECKING

from rosmini.core.errors import UsageError
from rosmini.core.verbs import Tool, VerbError
from rosmini.msgs.geometry_msgs.msg import PoseStamped, Twist
from rosmini.msgs.nav_msgs.msg import Odometry
from rosmini.msgs.sensor_msgs.msg import LaserScan
from rosmini.msgs.std_msgs.msg import String

if TYPE_CHECKING:
    from collections.abc import Callable

    from rosmini import Graph

FOLDER = Path(__file__).parents[1] / "data" / "transcripts"
GOLDEN = FOLDER.with_name("golden")

_VARYING = (
    (r"http://[^\s/]+:\d+/", "URI"), (r"(?<=^Pid: )\d+", "PID"), (r" \([\d]+ - [\d.]+:\d+\) \[\d+\]", ""),
    (r"(?<=transport: )\w+", "TRANSPORT"), (r"(?<=time=)[\d.]+", "TIME"), (r"(?<=ping average: )[\d.]+", "TIME"),
    (r"127\.0\.0\.1", "HOST"), (r"^rosmini$", "HOST"),
)  # fmt: skip


def in_order(name: str) -> list[tuple[str, tuple[str, int]]]:
    """Each command line in a transcript, with what it printed, on both streams, and its exit status."""
    text = (FOLDER / f"{name}.txt").read_text(encoding="utf-8")
    blocks = re.findall(r"^\$ (.*)\n((?:.*\n)*?)\[exit (\d+)\]$", text, re.MULTILINE)
    return [(words, (said, int(status))) for words, said, status in blocks]


def read(name: str) -> dict[str, tuple[str, int]]:
    """The same by command line."""
    return dict(in_order(name))


def printed(tool: Tool, graph: Graph | None, line: str) -> tuple[str, int]:
    """What a terminal would show of both streams, and the exit status."""
    said: list[str] = []
    try:
        result = tool.run(*shlex.split(line)[1:], graph=graph, say=said.append)
    except VerbError as error:
        return f"{error}\n", error.status
    except UsageError as error:
        return f"{error}\n", tool.usage_status
    text = str(result)
    said += [text] if text or result.always_printed else []
    return "".join(f"{part}\n" for part in [*said, *result.complaints]), result.status


def assert_golden(name: str, run: Callable[[str], tuple[str, int]]) -> None:
    """Assert that each command line in the golden file of a tool prints what it did."""
    path = GOLDEN / f"{name}.txt"
    lines = re.findall(r"^\$ (.*)$", path.read_text(encoding="utf-8"), re.MULTILINE)
    assert lines
    blocks = ((line, *run(line)) for line in lines)
    found = "".join(f"$ {line}\n{text}[exit {status}]\n" for line, text, status in blocks)
    if os.environ.get("ROSMINI_WRITE_GOLDEN") == "1":
        path.write_text(found, encoding="utf-8")
    assert found == path.read_text(encoding="utf-8")


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
