"""Wrong answers to the exercises of the chapter The Parameter Server."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

from rosmini.book.exercises.parameter_server import NAMES
from rosmini.core.graph import Graph
from rosmini.msgs import message_class

if TYPE_CHECKING:
    from collections.abc import Callable

# ---- gain_of: the nearest gain ----


def _nearest_with_raw_value(node: Any) -> Any:
    name = node.search_param("gain")
    return 1.0 if name is None else node.get_param(name)


def _nearest_or_one_hundred(node: Any) -> Any:
    name = node.search_param("gain")
    return 100.0 if name is None else float(node.get_param(name))


# ---- merge: merging ----


def _replace(node: Any, name: str, values: dict[str, Any]) -> None:
    node.set_param(name, values)


def _merge_one_level(node: Any, name: str, values: dict[str, Any]) -> None:
    for key, value in values.items():
        node.set_param(f"{name}/{key}", value)


def _merge_at_the_root(node: Any, name: str, values: dict[str, Any]) -> None:
    for key, value in values.items():
        if isinstance(value, dict):
            _merge_at_the_root(node, f"{name}/{key}", value)
        else:
            node.set_param(f"/{key}", value)


def _merge_lists(node: Any, name: str, values: dict[str, Any]) -> None:
    for key, value in values.items():
        full = f"{name}/{key}"
        if isinstance(value, dict):
            _merge_lists(node, full, value)
        elif isinstance(value, list):
            node.set_param(full, [*node.get_param(full, []), *value])
        else:
            node.set_param(full, value)


# ---- limiter: a limit that may change ----


def _limiter(make: Callable[[Any], Callable[[], float]], name: str = "limiter") -> Callable[[], Any]:
    """A node that limits with what ``make(node)()`` returns for each message."""

    def start(graph: Graph) -> None:
        node = graph.node(name)
        float32 = message_class("std_msgs/Float32")
        allowed = node.publisher("allowed", float32, queue_size=10)
        limit = make(node)
        node.subscriber("wanted", float32, lambda message: allowed.publish(min(message.data, limit())))

    return lambda: start


def _read_once(node: Any) -> Callable[[], float]:
    limit = node.get_param("/limit")
    return lambda: limit


def _ask_each_time(node: Any) -> Callable[[], float]:
    return lambda: node.get_param("/limit")


def _only_changes(node: Any) -> Callable[[], float]:
    limits = [1e9]
    node.on_param("/limit", limits.append)
    return lambda: limits[-1]


def _first_change_only(node: Any) -> Callable[[], float]:
    limits: list[float] = []
    limits.append(node.on_param("/limit", limits.append))
    return lambda: limits[min(1, len(limits) - 1)]


def _listening(node: Any) -> Callable[[], float]:
    limits: list[float] = []
    limits.append(node.on_param("/limit", limits.append))
    return lambda: limits[-1]


MISTAKES = {
    "names": [
        lambda: ["/wheel/radius", *NAMES[1:]],
        lambda: ["/robot2/driver/wheel/radius", *NAMES[1:]],
        lambda: [NAMES[0], "/robot2/gain", NAMES[2]],
        lambda: [NAMES[0], "/robot2/driver/~gain", NAMES[2]],
        lambda: [*NAMES[:2], "/robot2/use_sim_time"],
        lambda: NAMES[::-1],
        lambda: NAMES[:2],
        lambda: tuple(NAMES),
        lambda: ", ".join(NAMES),
        lambda: [name[1:] for name in NAMES],
    ],
    "gain_of": [
        lambda: lambda node: float(node.get_param("gain", 1.0)),
        lambda: lambda node: float(node.get_param("~gain", 1.0)),
        lambda: lambda node: float(node.get_param("/gain", 1.0)),
        lambda: _nearest_with_raw_value,
        lambda: _nearest_or_one_hundred,
        lambda: lambda node: node.search_param("gain"),
        lambda: lambda _: 1.0,
    ],
    "merge": [
        lambda: _replace,
        lambda: _merge_one_level,
        lambda: _merge_at_the_root,
        lambda: _merge_lists,
        lambda: lambda *arguments: arguments[2],
    ],
    "limiter": [
        _limiter(_read_once),
        _limiter(_ask_each_time),
        _limiter(_only_changes),
        _limiter(_first_change_only),
        _limiter(_listening, name="limit"),
        _limiter(lambda _: lambda: 1.0),
        lambda: lambda graph: graph.node("limiter"),
    ],
}
