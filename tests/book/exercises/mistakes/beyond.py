"""Wrong answers to the exercises of the chapter Beyond."""

from __future__ import annotations

from typing import Any

State = list[list[list[Any]]]


def _of_publishers(before: State, after: State) -> list[str]:
    return sorted({n for _, names in after[0] for n in names} - {n for _, names in before[0] for n in names})


def _both_ways(before: State, after: State) -> list[str]:
    first, second = ({n for part in state for _, names in part for n in names} for state in (before, after))
    return sorted(first ^ second)


def _once(launches: list[list[str]]) -> list[str]:
    names = [name for launch in launches for name in launch]
    return sorted({name for name in names if names.count(name) > 1})


MISTAKES = {
    "new_nodes": [lambda: _of_publishers, lambda: _both_ways],
    "drivers": [
        lambda: lambda state, topic: dict(state[0])[topic],
        lambda: (
            lambda state, topic: sorted(n for part in state for name, nodes in part if name == topic for n in nodes)
        ),
    ],
    "ended": [lambda: _once, lambda: lambda launches: launches[-1] if launches else []],
}
