"""Checks of the exercises in the chapter Publish and subscribe."""

from __future__ import annotations

from contextlib import redirect_stdout
from io import StringIO
from typing import TYPE_CHECKING, Any

from rosmini.book.checks import exercise, expect, expect_heard, expect_node, expect_type
from rosmini.core.graph import Graph
from rosmini.msgs.std_msgs.msg import Float32, Int32, String

if TYPE_CHECKING:
    from collections.abc import Sequence


# ---- better_service: a better event service ----


@exercise("better_service", praise="An error in one subscriber affects neither the publisher nor other subscribers.")
def better_service(answer: Any) -> None:
    """An event service that survives its subscribers."""
    with redirect_stdout(StringIO()):  # it may print anything about a failed callback
        _examine(answer())


def _examine(service: Any) -> None:
    got: list[tuple[str, Any]] = []

    def first(event: Any) -> None:
        got.append(("first", event))
        service.unsubscribe("news", first)

    def second(event: Any) -> None:
        got.append(("second", event))
        raise ValueError(event)

    def third(event: Any) -> None:
        got.append(("third", event))

    try:
        service.publish("empty", 0)
    except Exception as error:
        expect(False, f"publish on a topic without subscribers raised {type(error).__name__}.", "dict.get")
    for callback in (first, second, third):
        service.subscribe("news", callback)
    service.subscribe("other", lambda event: got.append(("other", event)))
    for event in (1, 2):
        try:
            service.publish("news", event)
        except ValueError:
            expect(
                False, "A callback failed, and its exception reached the publisher.", "use try and except in publish"
            )
        if event == 1:
            called = [name for name, _ in got]
            expect("other" not in called, "A subscriber of another topic was called.", "keep a list for each topic")
            expect(
                "third" in called,
                "A callback failed, and the callbacks after it were not called.",
                "put try inside the loop",
            )
            expect(
                "second" in called,
                "A callback unsubscribed itself, and the next one was skipped.",
                "iterate over a copy of the list",
            )
            expect(
                called == ["first", "second", "third"],
                f"The calls were {called}.",
                "call them in the order of subscription",
            )
    expect(
        got[3:] == [("second", 2), ("third", 2)],
        f"After first had unsubscribed, the next event went to {[name for name, _ in got[3:]]}.",
        "remove the callback from its topic's list in unsubscribe",
    )


# ---- arrived: predict ----


def _worked_on(queue: int, count: int, gap: float, work: float) -> list[int]:
    """Run a slow subscriber; return the numbers that it processes."""
    arrived: list[int] = []
    with Graph() as graph:
        slow = graph.node("slow")

        def look(message: Any) -> None:
            arrived.append(message.data)
            slow.sleep(work)

        slow.subscriber("number", Int32, look, queue_size=queue)
        numbers = graph.node("fast").publisher("number", Int32, queue_size=count)
        numbers.wait_for_subscribers()
        for value in range(1, count + 1):
            numbers.publish(value)
            graph.run(gap)
        graph.run(count * work)
    return arrived


@exercise(
    "arrived",
    praise="A full queue drops its oldest message, and the subscriber continues with the oldest remaining one.",
)
def arrived(answer: Any) -> None:
    """The messages that pass through a queue of three."""
    expect_type(answer, (list, tuple), "arrived is", "a list", "[1, ...]")
    right = _worked_on(3, 10, 1.0, 3.3)
    for place, (found, expected) in enumerate(zip(answer, right, strict=False), start=1):
        expect(
            found == expected,
            f"The first {place - 1} entries are right, but {found} is not processed next.",
            "write down the queue each time the subscriber finishes a message",
        )
    expect(
        len(answer) == len(right),
        f"The entries are right, but {len(answer)} are too {'few' if len(answer) < len(right) else 'many'}.",
        "messages in the queue at the end are still processed",
    )


# ---- start_history: the last few ----


@exercise("start_history", praise="A latched topic keeps one message; your node keeps any number.")
def start_history(answer: Any) -> None:
    """A node that sends the last messages to each new subscriber."""
    heard: dict[str, list[str]] = {"early": [], "late": [], "later": []}

    def listen(name: str) -> None:
        graph.node(name).subscriber("history", String, lambda message: heard[name].append(message.data))
        graph.run(0.1)

    with Graph() as graph:
        answer(graph, 3)
        expect_node(graph, "/history")
        listen("early")
        news = graph.node("reporter").publisher("news", String, queue_size=10)
        graph.run(0.1)
        expect_heard(news)
        for word in ("one", "two"):
            news.publish(word)
        graph.run(0.1)
        listen("late")
        for word in ("three", "four", "five"):
            news.publish(word)
        graph.run(0.1)
        graph.nodes["/reporter"].shutdown()
        listen("later")
    for name, right in (("late", ["one", "two"]), ("later", ["three", "four", "five"])):
        when = "the second" if name == "late" else "the fifth"
        expect(
            heard[name] == right,
            f"With a size of 3, a subscriber that started after {when} message received "
            f"{heard[name] or 'nothing'}, not {right}.",
            "keep the last messages, oldest first, and send them only to the new subscriber (publish_to)",
        )
    expect(
        heard["early"] == [],
        f"A subscriber that started before all messages received {heard['early']} on /history.",
        "send the stored messages only to the new subscriber: publish_to",
    )


# ---- start_alarm: say it once ----


@exercise("start_alarm", praise="Your node stores one bit about the past, and that is enough.")
def start_alarm(answer: Any) -> None:
    """A filter that passes on a message when the temperature rises above the limit."""
    for limit, values, right in (
        (30.0, (25.0, 30.0, 31.0, 32.0, 30.0, 33.0, 20.0), [31.0, 33.0]),
        (10.0, (12.0, 11.0, 9.0, 10.5), [12.0, 10.5]),
    ):
        got = _alarms(answer, limit, values)
        expect(
            got == right,
            f"With the limit {limit:g} and the temperatures {_listed(values)} it passed on "
            f"{_listed(got) or 'nothing'}, "
            f"not {_listed(right)}.",
            "pass on a value above the limit if the previous one was not; exactly the limit is not above it",
        )


def _alarms(answer: Any, limit: float, values: Sequence[float]) -> list[float]:
    got: list[float] = []
    with Graph() as graph:
        answer(graph, limit)
        expect_node(graph, "/alarm")
        graph.node("siren").subscriber("alarm", Float32, lambda message: got.append(message.data))
        temperature = graph.node("roof").publisher("temperature", Float32, queue_size=10)
        graph.run(0.1)
        expect_heard(temperature)
        for value in values:
            temperature.publish(value)
            graph.run(1.0)
    return got


def _listed(values: Sequence[float]) -> str:
    return ", ".join(f"{value:g}" for value in values)
