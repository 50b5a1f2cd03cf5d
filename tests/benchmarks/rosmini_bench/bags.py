"""What is measured of bags: writing and reading them, beside real rosbag, and recording at 10 kHz in wall time.

A figure counts only if the messages that are read are those that were written.
"""

from __future__ import annotations

import json
import shutil
import subprocess
import tempfile
import time
from collections.abc import Callable, Iterator
from pathlib import Path
from typing import Any

from rosmini.core.errors import RosminiError
from rosmini.core.graph import Graph
from rosmini.core.time import Time
from rosmini.msgs import message_class
from rosmini.ros.bag import Bag, Recorder

from . import Measure
from .peer import SYSTEM_PYTHON

PEER = Path(__file__).with_name("rosbag_peer.py")
PIXELS = bytes(range(250)) * 4000
KINDS = {"string": "String of 100 bytes", "scan": "LaserScan of 360 beams", "image": "image of 1 MB"}


def message(kind: str) -> Any:
    """Return the message that is written again and again."""
    if kind == "string":
        return message_class("std_msgs/String")("x" * 100)
    if kind == "scan":
        return message_class("sensor_msgs/LaserScan")(ranges=[0.25 * i for i in range(360)], intensities=[1.0] * 360)
    return message_class("sensor_msgs/Image")(height=1000, width=1000, encoding="mono8", step=1000, data=PIXELS)


def digest(kind: str, received: Any) -> int:
    """Return a number that stands for the content of a message."""
    if kind == "string":
        return len(received.data)
    if kind == "scan":
        return int(received.ranges[359] * 4) + len(received.intensities)
    return int(sum(received.data[::4096])) & 0xFFFF


def write(path: Path, kind: str, count: int) -> float:
    """Return messages a second, written and closed."""
    written = message(kind)
    begin = time.perf_counter()
    with Bag(path, "w") as bag:
        for number in range(count):
            bag.write("/bench", written, Time(1000 + number // 1000, number % 1000 * 1_000_000))
    return count / (time.perf_counter() - begin)


def read(path: Path, kind: str, count: int) -> float:
    """Return messages a second, read in full and added up."""
    total = 0
    begin = time.perf_counter()
    with Bag(path, numpy=False) as bag:
        for _, received, _ in bag.read_messages():
            total += digest(kind, received)
    seconds = time.perf_counter() - begin
    if total != count * digest(kind, message(kind)):
        raise RosminiError(f"what was read of {count} messages ({kind}) is not what was written: there is no figure")
    return count / seconds


def recorded(folder: Path, hertz: int, seconds: float) -> float:
    """Return how many of a hundred messages are in the bag of those published at ``hertz`` in wall time."""
    graph = Graph(simulated=False)
    talker = graph.node("talker")
    publisher = talker.publisher("bench", message_class("std_msgs/String"), queue_size=None)
    recorder = Recorder(graph.node("record"), topics=["/bench"], output_name=str(folder / "record"), quiet=True)
    publisher.wait_for_subscribers()
    count = int(hertz * seconds)

    def talk() -> None:
        rate = talker.rate(hertz)
        for number in range(count):
            publisher.publish(f"{number:06d}" + "x" * 94)
            rate.sleep()

    lane = talker.run(talk)
    graph.run(until=lambda: lane.idle)
    graph.run(0.01)
    recorder.stop()
    graph.shutdown()
    with Bag(recorder.path) as bag:
        found = [int(received.data[:6]) for _, received, _ in bag.read_messages()]
    if found != sorted(set(found)):
        raise RosminiError("the recorder wrote messages twice or out of order: there is no figure")
    return 100 * len(found) / count


class Peer:
    """Real rosbag, in a process of the system's Python."""

    def __init__(self, folder: Path) -> None:
        self._folder = folder

    def measure(self, what: str, kind: str, count: int) -> float:
        """Return the peer's figure. Raises ``RosminiError`` if it fails, or if what it reads is wrong."""
        path = self._folder / f"peer_{kind}.bag"
        done = subprocess.run(
            [SYSTEM_PYTHON, str(PEER), what, str(path), kind, str(count)],
            capture_output=True,
            encoding="utf-8",
            check=False,
            env={"PATH": "/usr/bin:/bin"},
        )
        if done.returncode:
            raise RosminiError(f"the rosbag peer failed at {what} {kind}:\n{done.stderr}")
        return float(json.loads(done.stdout.splitlines()[-1]))


def find_rosbag(folder: Path) -> Peer | None:
    """Return real rosbag, or None where it is not installed."""
    if shutil.which(SYSTEM_PYTHON) is None:
        return None
    probe = [SYSTEM_PYTHON, "-c", "import rosbag, sensor_msgs.msg"]
    found = subprocess.run(probe, capture_output=True, check=False, env={"PATH": "/usr/bin:/bin"})
    return Peer(folder) if found.returncode == 0 else None


class Folder:
    """A temporary folder for the bags of a run."""

    def __init__(self) -> None:
        self.path = Path(tempfile.mkdtemp(prefix="rosmini-bench-bags-"))

    def close(self) -> None:
        """Remove it."""
        shutil.rmtree(self.path, ignore_errors=True)


def measures(folder: Path, peer: Peer | None, scale: float) -> Iterator[Measure]:
    """Yield everything that is measured. Writing comes before reading, which needs the bag."""

    def theirs(what: str, kind: str, count: int) -> Callable[[], float] | None:
        return None if peer is None else lambda: peer.measure(what, kind, count)

    counts = {"string": 40_000, "scan": 10_000, "image": 100}
    for kind, name in KINDS.items():
        count = max(1, int(counts[kind] * scale))
        path = folder / f"{kind}.bag"
        for what, function in (("write", write), ("read", read)):
            yield Measure(
                f"bag: {what} {name}",
                "messages/s",
                lambda function=function, path=path, kind=kind, count=count: (  # type: ignore[misc]
                    function(path, kind, count)
                ),
                theirs(what, kind, count),
                "rosbag",
            )
    yield Measure(
        "bag: recorded of 10,000 messages/s, in wall time", "%", lambda: recorded(folder, 10_000, max(0.1, 2.0 * scale))
    )
