"""The bag peer of ``rosmini bench``, with real rosbag: ``rosbag_peer.py WHAT PATH KIND COUNT``."""

from __future__ import annotations

import json
import sys
import time
from typing import Any

import genpy  # type: ignore[import-not-found]  # the system Python has it
import rosbag  # type: ignore[import-not-found]
from sensor_msgs.msg import Image, LaserScan  # type: ignore[import-not-found]
from std_msgs.msg import String  # type: ignore[import-not-found]

PIXELS = bytes(range(250)) * 4000


def message(kind: str) -> Any:
    """Return the message that is written again and again."""
    if kind == "string":
        return String("x" * 100)
    if kind == "scan":
        return LaserScan(ranges=[0.25 * i for i in range(360)], intensities=[1.0] * 360)
    return Image(height=1000, width=1000, encoding="mono8", step=1000, data=PIXELS)


def digest(kind: str, received: Any) -> int:
    """Return a number that stands for the content of a message."""
    if kind == "string":
        return len(received.data)
    if kind == "scan":
        return int(received.ranges[359] * 4) + len(received.intensities)
    return int(sum(received.data[::4096])) & 0xFFFF


def main() -> None:
    """Write or read, and print messages a second."""
    what, path, kind, count = sys.argv[1], sys.argv[2], sys.argv[3], int(sys.argv[4])
    total = 0
    written = message(kind)
    begin = time.perf_counter()
    if what == "write":
        with rosbag.Bag(path, "w") as bag:
            for number in range(count):
                bag.write("/bench", written, genpy.Time(1000 + number // 1000, number % 1000 * 1_000_000))
    else:
        with rosbag.Bag(path) as bag:
            for _, received, _ in bag.read_messages():
                total += digest(kind, received)
    seconds = time.perf_counter() - begin
    if what == "read" and total != count * digest(kind, written):
        sys.exit("what was read is not what was written")
    print(json.dumps(count / seconds))


if __name__ == "__main__":
    main()
