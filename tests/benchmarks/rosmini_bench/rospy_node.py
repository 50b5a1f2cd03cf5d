"""The peer of ``rosmini bench``, run by the system's Python with real rospy: ``rospy_node.py ROLE FUNCTION COUNT``.

The listener measures and prints the figure as its last line. A throughput counts from just before the first publish
call, whose time the first message carries, to the last callback.
"""

from __future__ import annotations

import json
import statistics
import sys
import threading
import time
from typing import Any

import rospy  # type: ignore[import-not-found]  # the system Python has it
from roscpp.msg import Logger  # type: ignore[import-not-found]
from roscpp.srv import GetLoggers, GetLoggersResponse  # type: ignore[import-not-found]
from sensor_msgs.msg import Image  # type: ignore[import-not-found]
from std_msgs.msg import String  # type: ignore[import-not-found]

PIXELS = bytes(range(250)) * 4000


def wait_for_listener(publisher: Any) -> None:
    """Block until the subscriber is connected, and a little longer."""
    while publisher.get_num_connections() == 0:
        time.sleep(0.01)
    time.sleep(0.1)


def first_message(like: Any) -> Any:
    """Return a message that carries the time now."""
    if isinstance(like, Image):
        return Image(encoding=repr(time.time()))
    return String(repr(time.time()))


def talk(function: str, count: int) -> None:
    """Publish what ``function`` measures."""
    if function == "image_throughput":
        publisher = rospy.Publisher("bench", Image, queue_size=None)
        message = Image(height=1000, width=1000, encoding="mono8", step=1000, data=PIXELS)
    else:
        publisher = rospy.Publisher("bench", String, queue_size=None)
        message = String("x" * 100)
    wait_for_listener(publisher)
    if function == "string_latency":
        rate = rospy.Rate(500)
        for _ in range(count):
            message.data = repr(time.time()).ljust(100)
            publisher.publish(message)
            rate.sleep()
    else:
        publisher.publish(first_message(message))
        for _ in range(count):
            publisher.publish(message)
    time.sleep(0.5)


def serve(count: int) -> None:
    """Answer so many calls."""
    calls = 0
    enough = threading.Event()

    def handle(_: Any) -> Any:
        nonlocal calls
        calls += 1
        if calls == count:
            enough.set()
        return GetLoggersResponse([Logger("bench", str(calls))])

    rospy.Service("bench", GetLoggers, handle)
    enough.wait()
    time.sleep(0.5)


def call(count: int) -> float:
    """Make so many calls, each after the answer to the one before; return how many a second."""
    rospy.wait_for_service("bench")
    client = rospy.ServiceProxy("bench", GetLoggers, persistent=True)
    begin = time.time()
    for number in range(1, count + 1):
        if client().loggers[0].level != str(number):
            sys.exit("an answer was wrong")
    return count / (time.time() - begin)


class Listener:
    """Measures; one callback for each function."""

    def __init__(self, function: str, count: int) -> None:
        self.function = function
        self.count = count
        self.received = 0
        self.total = 0
        self.delays: list[float] = []
        self.begin: float | None = None
        self.figure: float | None = None
        kind = Image if function == "image_throughput" else String
        rospy.Subscriber("bench", kind, getattr(self, function), buff_size=2**24, tcp_nodelay=True)

    def string_throughput(self, message: Any) -> None:
        """Count characters."""
        if self.begin is None:
            self.begin = float(message.data)
            return
        self.received += 1
        self.total += len(message.data)
        if self.received == self.count:
            self.finish(self.total == 100 * self.count, self.count / (time.time() - self.begin))

    def string_latency(self, message: Any) -> None:
        """Compare clocks, which both processes share."""
        self.delays.append(time.time() - float(message.data))
        if len(self.delays) == self.count:
            self.finish(True, statistics.median(self.delays) * 1e6)

    def image_throughput(self, message: Any) -> None:
        """Add some pixels up."""
        if self.begin is None:
            self.begin = float(message.encoding)
            return
        self.received += 1
        self.total += sum(message.data[::4096])
        if self.received == self.count:
            right = self.total == self.count * sum(PIXELS[::4096])
            self.finish(right, self.count / (time.time() - self.begin))

    def finish(self, right: bool, figure: float) -> None:
        """Note the figure, if what was received is right, and end."""
        self.figure = figure if right else None
        rospy.signal_shutdown("measured")


def main() -> None:
    """Play the role given on the command line."""
    role, function, count = sys.argv[1], sys.argv[2], int(sys.argv[3])
    rospy.init_node("bench_" + role, anonymous=True, disable_signals=True)
    if function == "service_calls":
        if role == "talker":
            serve(count)
        else:
            print(json.dumps(call(count)))
        return
    if role == "talker":
        talk(function, count)
        return
    listener = Listener(function, count)
    rospy.spin()
    if listener.figure is None:
        sys.exit("messages were lost or changed")
    print(json.dumps(listener.figure))


if __name__ == "__main__":
    main()
