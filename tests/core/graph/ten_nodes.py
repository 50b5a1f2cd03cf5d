"""A graph of ten nodes that do all that nodes do; run as a program it prints what happened, in order."""

from __future__ import annotations

import json
import sys
from typing import Any

from rosmini.core.graph import Graph
from rosmini.msgs.rospy_tutorials.srv import AddTwoInts
from rosmini.msgs.std_msgs.msg import Int32, String

SECONDS = 5.0


def record() -> list[Any]:
    """Run the graph and return every entry of the scheduler's trace and every message, in order."""
    events: list[Any] = []
    with Graph(seed=7) as graph:
        graph.scheduler.trace = lambda now, lane: events.append([now, lane])

        def note(what: str, value: Any) -> None:
            events.append([graph.scheduler.now_ns(), what, value])

        sensors = [graph.node(f"sensor{number}") for number in range(4)]
        filters = [graph.node(f"filter{number}") for number in range(3)]
        server, logger, anonymous = (graph.node("server"), graph.node("logger"), graph.node("a", anonymous=True))
        note("names", list(graph.nodes))
        server.service("add", AddTwoInts, lambda request: request.a + request.b)
        for number, node in enumerate(sensors):
            random = graph.rng(node.name)
            publisher = node.publisher(f"raw{number % 2}", Int32)
            node.timer(
                0.1 + 0.05 * number,
                lambda _, publisher=publisher, random=random: publisher.publish(int(random.integers(1000))),
            )
        for number, node in enumerate(filters):
            client = node.service_client("add", AddTwoInts, persistent=number == 0)
            out = node.publisher("out", String, latch=True)

            def callback(message: Any, node: Any = node, client: Any = client, out: Any = out) -> None:
                total = client(message.data, 1).sum
                node.sleep(0.01)
                out.publish(f"{node.name} {total}")
                if total % 3 == 0:
                    node.set_param("~last", total)

            node.subscriber(f"raw{number % 2}", Int32, callback, queue_size=1)
        logger.subscriber("out", String, lambda message: note("out", message.data))
        logger.subscriber("/rosout_agg", graph.log_class, lambda message: note("log", message.msg))

        def main() -> None:
            rate = anonymous.rate(3)
            while not anonymous.is_shutdown():
                anonymous.logdebug("quiet")
                anonymous.loginfo(f"at {anonymous.now()}")
                rate.sleep()

        anonymous.run(main)
        graph.run(SECONDS)
    return events


if __name__ == "__main__":
    told = sys.stdout
    sys.stdout = sys.stderr  # what the nodes log
    json.dump(record(), told)
