"""Wrong answers to the exercises of the chapter Bags."""

from __future__ import annotations

import math
from itertools import pairwise

from rosmini.ros.bag import Bag

# ---- longest_silence: the longest silence ----


def _silences(bag: Bag, topic: str) -> list[float]:
    times = [t.to_sec() for _, _, t in bag.read_messages(topic)]
    return [after - before for before, after in pairwise(times)]


def _ends(bag: Bag) -> tuple[float, float]:
    table = bag.table("/odom")
    x, y = table["pose.pose.position.x"], table["pose.pose.position.y"]
    return float(x[-1] - x[0]), float(y[-1] - y[0])


MISTAKES = {
    "message_counts": [
        lambda: lambda bag: {topic: 1 for topic, _, _ in bag.read_messages()},
        lambda: lambda bag: bag.get_message_count(),
        lambda: lambda bag: {"/chatter": bag.get_message_count("/chatter")},
        lambda: lambda bag: [topic for topic, _, _ in bag.read_messages()],
    ],
    "longest_silence": [
        lambda: lambda bag, topic: min(_silences(bag, topic)),
        lambda: lambda bag, topic: sum(_silences(bag, topic)),
        lambda: lambda bag, topic: _silences(bag, topic)[0],
        lambda: lambda bag, _: bag.get_end_time() - bag.get_start_time(),
        lambda: lambda bag, _: max(_silences(bag, "/chatter")),
    ],
    "fast_commands": [
        lambda: "topic == '/cmd_vel'",
        lambda: "m.linear.x > 0.1",
        lambda: "topic == '/cmd_vel' and m.linear.x >= 0.1",
        lambda: "topic == '/cmd_vel' and m.angular.z > 0.1",
        lambda: "topic == '/cmd_vel' and abs(m.linear.x) > 0.1",
        lambda: "topic == '/odom' and m.linear.x > 0.1",
        lambda: 1,
    ],
    "distance_driven": [
        lambda: lambda _: 2.0,
        lambda: lambda bag: len(list(bag.read_messages("/odom"))),
        lambda: lambda bag: math.hypot(*_ends(bag)),
        lambda: lambda bag: sum(_ends(bag)),
    ],
}
