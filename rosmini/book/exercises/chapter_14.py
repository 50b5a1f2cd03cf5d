"""What is right in the exercises of chapter 14, The Parameter Server."""

from __future__ import annotations

from typing import Any

from rosmini.book.checks import exercise, expect, expect_heard, expect_node, expect_type
from rosmini.core.graph import Graph
from rosmini.msgs.std_msgs.msg import Float32

# ---- 14.1: resolving names ----

NAMES = ["/robot2/wheel/radius", "/robot2/driver/gain", "/use_sim_time"]


@exercise("14.1", praise="The same three lines of a program find other values in another namespace.")
def names(answer: Any) -> None:
    """What wheel/radius, ~gain and /use_sim_time mean for /robot2/driver."""
    expect_type(answer, list, "names is", "a list", '["/...", "/...", "/..."]')
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


@exercise(
    "14.2", praise="One value for all, exceptions where you need them, and a default if there is neither."
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


@exercise("14.3", praise="This is what `rosparam load` and `rosparam set` do with a dictionary.")
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


class _Counted:
    """Counts how often a Master is asked for parameters."""

    def __init__(self, master: Any) -> None:
        self._master = master
        self.count = 0

    def __getattr__(self, name: str) -> Any:
        self.count += name in ("getParam", "hasParam", "searchParam", "getParamNames")
        return getattr(self._master, name)


@exercise("14.4", praise="The node asks once and is told the rest: this scales to any number of messages.")
def limiter(answer: Any) -> None:
    """A node that limits speeds to a parameter that changes while it runs."""
    got: list[float] = []
    with Graph() as graph:
        boss = graph.node("boss")
        boss.set_param("/limit", 1.0)
        answer(graph)
        expect_node(graph, "/limiter")
        wanted = boss.publisher("wanted", Float32)
        boss.subscriber("allowed", Float32, lambda message: got.append(message.data))
        graph.run(0.1)
        expect_heard(wanted)
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
