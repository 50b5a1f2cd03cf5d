"""What is right in the exercises of chapter 14, The Parameter Server."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

from rosmini.book.checks import exercise, expect
from rosmini.graph import Graph
from rosmini.msgs import message_class

if TYPE_CHECKING:
    from collections.abc import Callable


# ---- 14.1: resolving names ----

NAMES = ["/robot2/wheel/radius", "/robot2/driver/gain", "/use_sim_time"]


@exercise(
    "14.1",
    praise="The same three lines of a program find other values in another namespace.",
    mistakes=[
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
)
def names(answer: Any) -> None:
    """What wheel/radius, ~gain and /use_sim_time mean for /robot2/driver."""
    expect(
        isinstance(answer, list),
        f"names is a {type(answer).__name__}, not a list.",
        '["/...", "/...", "/..."]',
    )
    expect(len(answer) == 3, f"The list has {len(answer)} entries, not three.", "one for each of the names")
    said = ["wheel/radius", "~gain", "/use_sim_time"]
    hints = [
        "the namespace of /robot2/driver is /robot2; a relative name starts there",
        "a private name is below the node's own name",
        "a name that begins with / stays as it is",
    ]
    for short, given, right, hint in zip(said, answer, NAMES, hints, strict=True):
        expect(given == right, f"{short} does not mean {given!r} there.", hint)


# ---- 14.2: the nearest gain ----


def _nearest_with_raw_value(node: Any) -> Any:
    name = node.search_param("gain")
    return 1.0 if name is None else node.get_param(name)


def _nearest_or_one_hundred(node: Any) -> Any:
    name = node.search_param("gain")
    return 100.0 if name is None else float(node.get_param(name))


@exercise(
    "14.2",
    praise="One value for all, exceptions where you need them, and a default if there is neither.",
    mistakes=[
        lambda: lambda node: float(node.get_param("gain", 1.0)),
        lambda: lambda node: float(node.get_param("~gain", 1.0)),
        lambda: lambda node: float(node.get_param("/gain", 1.0)),
        lambda: _nearest_with_raw_value,
        lambda: _nearest_or_one_hundred,
        lambda: lambda node: node.search_param("gain"),
        lambda: lambda _: 1.0,
    ],
)
def gain_of(answer: Any) -> None:
    """The value of the nearest gain upwards, as a float; 1.0 if there is none."""
    with Graph() as graph:
        node = graph.node("driver", namespace="/robot2/base")
        steps = [
            (None, None, 1.0, "nobody has set a gain"),
            ("/gain", 2, 2.0, "/gain is 2"),
            ("/robot2/gain", 3.5, 3.5, "/robot2/gain is 3.5 and /gain is 2"),
            ("/robot2/base/driver/gain", 0, 0.0, "~gain is 0, and others are set above"),
        ]
        for name, value, right, case in steps:
            if name is not None:
                node.set_param(name, value)
            found = answer(node)
            expect(
                isinstance(found, (int, float)) and found == right,
                f"For the node {node.name}, when {case}, it returned {found!r}, not {right}.",
                "search_param returns the full name of the nearest one, or None; get_param its value",
            )
            expect(
                type(found) is float,
                f"When {case}, it returned the {type(found).__name__} {found!r}, not a float.",
                "get_param(name, expect=float), or float(...)",
            )


# ---- 14.3: merging ----


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


@exercise(
    "14.3",
    praise="This is what `rosparam load` and `rosparam set` do with a dictionary.",
    mistakes=[
        lambda: _replace,
        lambda: _merge_one_level,
        lambda: _merge_at_the_root,
        lambda: _merge_lists,
        lambda: lambda *arguments: arguments[2],
    ],
)
def merge(answer: Any) -> None:
    """A dictionary is set in a namespace, and what else is there stays."""
    with Graph() as graph:
        node = graph.node("node")
        node.set_param("/arm", {"name": "left", "joint": {"min": -1.0, "max": 1.0}, "links": [1, 2, 3]})
        answer(node, "/arm", {"joint": {"max": 2.0}, "links": [4], "tool": {"grip": {"force": 5}}})
        found = node.get_param("/arm", {})
        stray = [name for name in node.param_names() if not name.startswith(("/arm", "/ros", "/run_id"))]
    expect(not stray, f"It set {', '.join(stray)}, outside of /arm.", 'the full name is f"{name}/{key}"')
    expect(found.get("name") == "left", "/arm/name is gone.", "do not set the namespace as a whole")
    joint = found.get("joint", {})
    expect(
        joint.get("min") == -1.0,
        "/arm/joint/min is gone.",
        "a dictionary within the dictionary is merged in the same way: let merge call itself",
    )
    expect(joint.get("max") == 2.0, f"/arm/joint/max is {joint.get('max')!r}, not 2.0.", "set_param")
    expect(
        found.get("links") == [4],
        f"/arm/links is {found.get('links')!r}, not [4].",
        "a list is one value, which replaces what was there",
    )
    expect(
        found.get("tool") == {"grip": {"force": 5}},
        f"/arm/tool is {found.get('tool')!r}, not {{'grip': {{'force': 5}}}}.",
        "a new namespace is made by setting what is in it",
    )


# ---- 14.4: a limit that may change ----


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


class _Counted:
    """Counts how often a Master is asked for parameters."""

    def __init__(self, master: Any) -> None:
        self._master = master
        self.count = 0

    def __getattr__(self, name: str) -> Any:
        self.count += name in ("getParam", "hasParam", "searchParam", "getParamNames")
        return getattr(self._master, name)


@exercise(
    "14.4",
    praise="The node asks once and is told the rest: this scales to any number of messages.",
    mistakes=[
        _limiter(_read_once),
        _limiter(_ask_each_time),
        _limiter(_only_changes),
        _limiter(_first_change_only),
        _limiter(_listening, name="limit"),
        _limiter(lambda _: lambda: 1.0),
        lambda: lambda graph: graph.node("limiter"),
    ],
)
def limiter(answer: Any) -> None:
    """A node that limits speeds to a parameter that changes while it runs."""
    float32 = message_class("std_msgs/Float32")
    got: list[float] = []
    with Graph() as graph:
        boss = graph.node("boss")
        boss.set_param("/limit", 1.0)
        answer(graph)
        expect("/limiter" in graph.nodes, "There is no node /limiter.", 'graph.node("limiter")')
        wanted = boss.publisher("wanted", float32)
        boss.subscriber("allowed", float32, lambda message: got.append(message.data))
        graph.run(0.1)
        expect(
            wanted.num_connections(), "Nobody subscribes to /wanted.", "subscriber(...) with the type Float32"
        )
        counted = _Counted(graph.master)
        graph.master = counted  # type: ignore[assignment]
        for limit in (None, 0.5, 2.0):
            if limit is not None:
                boss.set_param("/limit", limit)
                graph.run(0.1)
            counted.count = 0
            for speed in (0.25, 4.0, -4.0):
                wanted.publish(speed)
                graph.run(0.1)
            expect(
                counted.count == 0,
                "The Master is asked for the parameter when a message comes.",
                "on_param tells the node when the parameter changes",
            )
    right = [0.25, 1.0, -4.0, 0.25, 0.5, -4.0, 0.25, 2.0, -4.0]
    expect(
        got == right,
        f"For 0.25, 4 and -4, with the limits 1.0, then 0.5, then 2.0, it published {got or 'nothing'}, not {right}.",
        "min(message.data, limit), with the limit of now: on_param returns the first, and calls back with the others",
    )
