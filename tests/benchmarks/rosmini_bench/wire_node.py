#!/usr/bin/env python3
"""The two nodes of the wire's figures: one script, run by real rospy and, unchanged, by `rosmini rosrun`.

``wire_node.py listener TOPIC...`` hears the topics and acknowledges; ``wire_node.py talker`` measures: it takes one
command a line from standard input, as JSON, and answers with one line of JSON after "@ ". A talker is never more than a
window ahead of its slowest listener, so that nothing is lost, and a throughput counts from before the first
message until the last listener has said that it has the last.
"""

from __future__ import annotations

import json
import statistics
import sys
import threading
import time
from collections.abc import Callable
from typing import Any

import rospy  # type: ignore[import-not-found]
from roscpp.msg import Logger  # type: ignore[import-not-found]
from roscpp.srv import GetLoggers, GetLoggersResponse  # type: ignore[import-not-found]
from sensor_msgs.msg import Image, LaserScan  # type: ignore[import-not-found]
from std_msgs.msg import String  # type: ignore[import-not-found]

PATIENCE = 100.0
PIXELS = bytes(range(250)) * 4000
SCAN = LaserScan(ranges=[0.25 * i for i in range(360)], intensities=[1.0] * 360)

# What is sent, and after how many messages a listener acknowledges.
KINDS: dict[str, tuple[Any, int]] = {
    "string": (String("x" * 100), 500),
    "scan": (SCAN, 100),
    "image": (Image(height=1000, width=1000, encoding="mono8", step=1000, data=PIXELS), 4),
}


def kind_of(topic: str) -> str:
    """What a topic carries: `/bench/image/echo` carries images."""
    return topic.split("/")[2]


def digest(message: Any) -> int:
    """A number that stands for what a message holds."""
    if isinstance(message, LaserScan):
        return int(message.ranges[359] * 4) + len(message.intensities)
    if isinstance(message, Image):
        return int(sum(message.data[::4096]))
    return len(message.data)


class Ear:
    """Hears one topic; `/bench/KIND/echo` is answered with the same message, others are acknowledged now and then."""

    def __init__(self, topic: str) -> None:
        message, self.every = KINDS[kind_of(topic)]
        self.received = self.total = 0
        self.topic = topic
        self.answers = (
            rospy.Publisher(topic + "/back", type(message), queue_size=None, tcp_nodelay=True)
            if topic.endswith("/echo")
            else rospy.Publisher(topic + "/heard", String, queue_size=None, tcp_nodelay=True)
        )
        take = self.echo if topic.endswith("/echo") else self.count
        rospy.Subscriber(topic, type(message), take, buff_size=2**24, tcp_nodelay=True)

    def echo(self, message: Any) -> None:
        """Send it back."""
        self.answers.publish(message)

    def count(self, message: Any) -> None:
        """Acknowledge."""
        self.received += 1
        self.total += digest(message)
        if self.received % self.every == 0:
            self.answers.publish(f"{rospy.get_name()} {self.received} {self.total}")


class Talker:
    """Measures what it is told to."""

    def __init__(self) -> None:
        self.publishers: dict[tuple[str, int | None], Any] = {}
        self.sent: dict[str, int] = {}
        self.heard: dict[str, dict[str, tuple[int, int]]] = {}
        self.changed = threading.Condition()
        self.back: Any = None

    def ready(self) -> float:
        """How much memory the process has held at most, in MB."""
        import resource  # Windows has none

        peak = resource.getrusage(resource.RUSAGE_SELF).ru_maxrss
        return peak / 2**20 if sys.platform == "darwin" else peak / 2**10

    def publisher(self, topic: str, queue_size: int | None, listeners: int) -> Any:
        """A publisher to whom all listeners are connected, and who hears them all."""
        if (topic, queue_size) not in self.publishers:
            message = KINDS[kind_of(topic)][0]
            self.heard[topic] = {}
            self.sent[topic] = 0
            hears = rospy.Subscriber(
                topic + ("/back" if topic.endswith("/echo") else "/heard"),
                type(message) if topic.endswith("/echo") else String,
                self.take_back if topic.endswith("/echo") else lambda said: self.take(topic, said),
                buff_size=2**24,
                tcp_nodelay=True,
            )
            publisher = rospy.Publisher(topic, type(message), queue_size=queue_size, tcp_nodelay=True)
            self.publishers[topic, queue_size] = publisher, hears
        publisher, hears = self.publishers[topic, queue_size]
        self.wait(lambda: publisher.get_num_connections() == hears.get_num_connections() == listeners, "the listeners")
        return publisher

    def wait(self, condition: Callable[[], bool], what: str) -> None:
        """Wait until a condition holds; what changes it may say so."""
        deadline = time.time() + PATIENCE
        with self.changed:
            while not condition():
                self.changed.wait(0.05)
                if time.time() > deadline:
                    raise RuntimeError("waited in vain for " + what)

    def take(self, topic: str, said: Any) -> None:
        """Note how many a listener has."""
        name, count, total = said.data.split()
        with self.changed:
            self.heard[topic][name] = int(count), int(total)
            self.changed.notify()

    def take_back(self, message: Any) -> None:
        """Note what came back."""
        with self.changed:
            self.back = message
            self.changed.notify()

    def slowest(self, topic: str, listeners: int) -> int:
        """How many messages all listeners have."""
        heard = self.heard[topic]
        return min(count for count, _ in heard.values()) if len(heard) == listeners else 0

    def wait_for(self, topic: str, listeners: int, count: int) -> None:
        """Wait until all listeners have so many messages."""
        self.wait(lambda: self.slowest(topic, listeners) >= count, "messages to arrive")

    def throughput(self, topic: str, count: int, queue_size: int | None = None, listeners: int = 1) -> float:
        """Messages a second that arrived, at all listeners together."""
        message, every = KINDS[kind_of(topic)]
        publisher = self.publisher(topic, queue_size, listeners)
        window = 4 * every
        publish, sent = publisher.publish, self.sent[topic]
        first, last = sent, sent + count
        begin = time.time()
        while sent < last:
            for _ in range(every):
                publish(message)
            sent += every
            self.wait_for(topic, listeners, sent - window + 1)
        self.wait_for(topic, listeners, sent)
        seconds = time.time() - begin
        self.sent[topic] = sent
        expected = sent, sent * digest(message)
        if any(heard != expected for heard in self.heard[topic].values()):
            raise RuntimeError(f"lost or changed: {self.heard[topic]}, not {expected}")
        return (sent - first) * listeners / seconds

    def latency(self, topic: str, count: int) -> float:
        """The median of the microseconds that a message takes: half of there and back, 100 times a second."""
        message = KINDS[kind_of(topic)][0]
        publisher = self.publisher(topic, None, 1)
        seconds: list[float] = []
        for _ in range(count):
            time.sleep(0.01)
            self.back = None
            begin = time.time()
            publisher.publish(message)
            with self.changed:
                while self.back is None:
                    self.changed.wait(PATIENCE)
            seconds.append(time.time() - begin)
            if digest(self.back) != digest(message):
                raise RuntimeError("a message was changed")
        return statistics.median(seconds) / 2 * 1e6

    def calls(self, count: int, persistent: bool) -> float:
        """Calls a second, each after the answer to the one before."""
        rospy.wait_for_service("/bench/service")
        client = rospy.ServiceProxy("/bench/service", GetLoggers, persistent=persistent)
        begin = time.time()
        for _ in range(count):
            if client().loggers[0].level != "x":
                raise RuntimeError("an answer was wrong")
        seconds = time.time() - begin
        client.close()
        return count / seconds

    def obey(self, line: str) -> float:
        """Return the answer to a command."""
        command = json.loads(line)
        answer: float = getattr(self, command.pop("do"))(**command)
        return answer


def main() -> None:
    """Play the role given on the command line."""
    role, *topics = [word for word in sys.argv[1:] if ":=" not in word]
    rospy.init_node("bench_" + role, anonymous=True)
    if role == "listener":
        if "/bench/image" in topics:
            rospy.Service("/bench/service", GetLoggers, lambda _: GetLoggersResponse([Logger("bench", "x")]))
        ears = [Ear(topic) for topic in topics]
        print("@ " + json.dumps(len(ears)), flush=True)
        sys.stdin.read()
        return
    talker = Talker()
    while line := sys.stdin.readline():
        try:
            print("@ " + json.dumps(talker.obey(line)), flush=True)
        except Exception as error:
            print("@ " + json.dumps(f"{type(error).__name__}: {error}"), flush=True)


if __name__ == "__main__":
    main()
