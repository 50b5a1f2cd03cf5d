"""What is measured of the computation graph: topics in one process, in wall time, and the cost of importing rosmini."""

from __future__ import annotations

import statistics
import subprocess
import sys
import time
from collections.abc import Callable, Iterator
from typing import TYPE_CHECKING, Any

from rosmini.core.errors import RosminiError
from rosmini.core.graph import Graph, Node, Publisher
from rosmini.msgs import message_class, service_class

from . import Measure

if TYPE_CHECKING:
    from .peer import Rospy

BURST = 100
"""So many messages are published before the subscriber's turn; a rospy publisher fills its socket's buffer likewise."""


def _connected(type_name: str, callback: Callable[[Any], object]) -> tuple[Graph, Node, Publisher]:
    """Return a graph in wall time with a connected publisher and subscriber in two nodes."""
    graph = Graph(simulated=False)
    talker, listener = graph.node("talker"), graph.node("listener")
    cls = message_class(type_name)
    publisher = talker.publisher("bench", cls, queue_size=None)
    listener.subscriber("bench", cls, callback, numpy=False)
    publisher.wait_for_subscribers()
    return graph, talker, publisher


def string_throughput(count: int, burst: int, *, is_recorded: bool = False) -> float:
    """Return messages a second: 100-byte Strings, the subscriber counts their characters."""
    characters = 0

    def callback(message: Any) -> None:
        nonlocal characters
        characters += len(message.data)

    graph, _, publisher = _connected("std_msgs/String", callback)
    if is_recorded:
        graph.record()
    message = publisher.message_class(data="x" * 100)
    begin = time.perf_counter()
    for sent in range(burst, count + 1, burst):
        for _ in range(burst):
            publisher.publish(message)
        graph.run(until=lambda wanted=100 * sent: characters >= wanted)  # type: ignore[misc]
    seconds = time.perf_counter() - begin
    graph.shutdown()
    _check(characters, 100 * (count // burst) * burst)
    return count / seconds


def string_latency(count: int) -> float:
    """Return the median of the microseconds from a publish call to the callback, at 500 messages a second."""
    delays: list[float] = []
    sent = 0.0

    def callback(message: Any) -> None:
        delays.append(time.perf_counter() - sent)
        _check(len(message.data), 100)

    graph, talker, publisher = _connected("std_msgs/String", callback)
    message = publisher.message_class(data="x" * 100)

    def talk() -> None:
        nonlocal sent
        rate = talker.rate(500)
        for _ in range(count):
            sent = time.perf_counter()
            publisher.publish(message)
            rate.sleep()

    lane = talker.run(talk)
    graph.run(until=lambda: lane.idle)
    graph.shutdown()
    _check(len(delays), count)
    return statistics.median(delays) * 1e6


def image_throughput(count: int, *, numpy: bool) -> float:
    """Return megabytes a second of images of 1 MB (1,000 x 1,000, mono8); the subscriber adds some pixels up."""
    total = 0

    def callback(message: Any) -> None:
        nonlocal total
        total += sum(message.data[::4096])

    graph, _, publisher = _connected("sensor_msgs/Image", callback)
    pixels: Any = bytes(range(250)) * 4000
    expected = sum(pixels[::4096])
    if numpy:
        import numpy as np

        pixels = np.frombuffer(pixels, dtype=np.uint8).copy()
    message = publisher.message_class(height=1000, width=1000, encoding="mono8", step=1000, data=pixels)
    begin = time.perf_counter()
    for sent in range(1, count + 1):
        publisher.publish(message)
        graph.run(until=lambda wanted=sent * expected: total >= wanted)  # type: ignore[misc]
    seconds = time.perf_counter() - begin
    graph.shutdown()
    _check(total, count * expected)
    return count / seconds


def service_calls(count: int) -> float:
    """Return calls a second of one persistent client, each answered before the next; every answer is looked at."""
    graph = Graph(simulated=False)
    service, logger = service_class("roscpp/GetLoggers"), message_class("roscpp/Logger")
    calls = 0

    def handle(_: Any) -> Any:
        nonlocal calls
        calls += 1
        return {"loggers": [logger("bench", str(calls))]}

    graph.node("server").service("bench", service, handle)
    client = graph.node("client").service_client("bench", service, persistent=True)
    client.wait_for_service()
    right = 0
    begin = time.perf_counter()
    for number in range(1, count + 1):
        right += client().loggers[0].level == str(number)
    seconds = time.perf_counter() - begin
    graph.shutdown()
    _check(right, count)
    return count / seconds


def import_seconds(python: str, module: str) -> float:
    """Return the seconds that a fresh interpreter takes to start and import ``module``, less those of starting."""

    def timed(code: str) -> float:
        begin = time.perf_counter()
        subprocess.run([python, "-c", code], check=True)
        return time.perf_counter() - begin

    return max(timed(f"import {module}") - timed("pass"), 1e-4)


def _check(found: int, expected: int) -> None:
    if found != expected:
        msg = (
            f"the benchmark's subscriber found {found}, not {expected}: messages were lost or changed, so there is no "
            "figure"
        )
        raise RosminiError(msg)


def measures(rospy: Rospy | None, scale: float) -> Iterator[Measure]:
    """Yield everything that is measured."""

    def peer(function: str, *arguments: int) -> Callable[[], float] | None:
        return None if rospy is None else lambda: rospy.measure(function, *arguments)

    def times(count: int) -> int:
        return max(int(count * scale) // BURST * BURST, BURST)

    many, some, few = times(200_000), times(1_000), times(500)
    strings, sends = many // 5, some
    yield Measure(
        "String of 100 bytes, publish to callback, in bursts of 100",
        "messages/s",
        lambda: string_throughput(many, BURST),
        peer("string_throughput", strings),
    )
    yield Measure(
        "the same, each received before the next is sent", "messages/s", lambda: string_throughput(strings, 1), None
    )
    yield Measure(
        "the same in bursts of 100, while the graph records",
        "messages/s",
        lambda: string_throughput(max(strings, BURST), BURST, is_recorded=True),
        lambda: string_throughput(max(strings, BURST), BURST),
        peer_name="unrecorded",
    )
    yield Measure(
        "String of 100 bytes, latency, median at 500 Hz",
        "us",
        lambda: string_latency(sends),
        peer("string_latency", sends),
        more_is_better=False,
    )
    yield Measure(
        "image of 1 MB as bytes",
        "MB/s",
        lambda: image_throughput(times(2_000), numpy=False),
        peer("image_throughput", few),
    )
    yield Measure(
        "image of 1 MB as a numpy array, copied",
        "MB/s",
        lambda: image_throughput(few, numpy=True),
        peer("image_throughput", few),
    )
    yield Measure(
        "service calls of a persistent client, one after the other",
        "calls/s",
        lambda: service_calls(times(20_000)),
        peer("service_calls", times(4_000)),
    )
    yield Measure(
        "import rosmini; import rospy",
        "s",
        lambda: import_seconds(sys.executable, "rosmini"),
        None if rospy is None else lambda: import_seconds(rospy.python, "rospy"),
        more_is_better=False,
    )
    yield Measure(
        "import rosmini.ros.rospy; import rospy",
        "s",
        lambda: import_seconds(sys.executable, "rosmini.ros.rospy"),
        None if rospy is None else lambda: import_seconds(rospy.python, "rospy"),
        more_is_better=False,
    )
