"""Checks of the exercises in the chapter How rosmini works."""

from __future__ import annotations

from itertools import count
from typing import TYPE_CHECKING, Any

from rosmini.book.checks import exercise, expect, expect_type
from rosmini.core.graph import Graph

if TYPE_CHECKING:
    from collections.abc import Callable

# ---- event_queue: a scheduler ----


@exercise("event_queue", praise="Time, then order of creation: that is all a scheduler needs.")
def event_queue(answer: Any) -> None:
    """A function that runs events in the order of time and creation, and also those that events add."""
    ran: list[tuple[str, Any]] = []

    def event(name: str, *new: tuple[float, Callable[[float], Any]]) -> Callable[[float], Any]:
        def run(now: float) -> Any:
            ran.append((name, now))
            return list(new)

        return run

    later = (2.0, event("added later for 2.0"))
    end = answer([(2.0, event("second at 2.0")), (1.0, event("first", later)), (2.0, event("third at 2.0"))])
    names = [name for name, _ in ran]
    wanted = ["first", "second at 2.0", "third at 2.0", "added later for 2.0"]
    expect(
        sorted(names) == sorted(wanted),
        f"Of the four events it ran {names}.",
        "add the events that a function returns to the queue, and continue until it is empty",
    )
    expect(names == wanted, f"It ran the events in this order: {names}.", "sort by time, then by a running number")
    expect(
        [now for _, now in ran] == [1.0, 2.0, 2.0, 2.0],
        "It did not call each function with the time of its event.",
        "call function(when)",
    )
    expect(end == 2.0, f"It returned {end!r}; the last event was at 2.0.", "return the time of the last event")


# ---- lane_order: two lanes ----


@exercise("lane_order", praise="Two events at the same time run in the order in which they were added.")
def lane_order(answer: Any) -> None:
    """The order in which two lanes print."""
    expect_type(answer, str, "The answer is", "a string")
    wanted = _printed()
    words = answer.replace(",", " ").split()
    expect(sorted(words) == sorted(wanted), f"The words should be {', '.join(sorted(wanted))}, each of them once.")
    different = next((i for i, (one, other) in enumerate(zip(words, wanted, strict=True)) if one != other), None)
    expect(
        different is None,
        f"The first {different} of your words are right." if different else "The first word is wrong.",
        "write down when each sleep ends, and when it began",
    )


def _printed() -> list[str]:
    """Return what the two functions of the exercise print."""
    said: list[str] = []
    with Graph(rosout=False) as graph:
        node = graph.node("node")

        def a() -> None:
            said.append("a1")
            node.sleep(1.0)
            said.append("a2")

        def b() -> None:
            said.append("b1")
            node.sleep(0.5)
            said.append("b2")
            node.sleep(0.5)
            said.append("b3")

        node.run(a)
        node.run(b)
        graph.run()
    return said


# ---- first_difference: two runs ----

RUNS = (
    ([["start", "scan", "stop"]] * 2, None),
    ([["start", "scan", "stop"], ["start", "scan", "go"]], 2),
    ([["start", "scan"], ["start", "scan", "stop"]], 2),
    ([["go", "scan", "stop"], ["start", "scan"]], 0),
    ([["start"], []], 0),
    ([["start", None], ["start"]], 1),
)


@exercise("first_difference", praise="With the first event that differs, the cause is usually one line away.")
def first_difference(answer: Any) -> None:
    """A function that finds the first event in which two runs differ."""
    for runs, wanted in RUNS:
        calls = count()
        found = answer(lambda runs=runs, calls=calls: list(runs[next(calls) % 2]))
        done = next(calls)
        expect(done == 2, f"It called make() {done} times, not twice.", "each call is another run")
        expect(
            found == wanted and type(found) is type(wanted),
            f"For the runs {runs[0]} and {runs[1]} it returned {found!r}, not {wanted}.",
            "compare event by event, even after one of the lists has ended",
        )
