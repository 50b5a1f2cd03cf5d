"""Checks of the exercises in the chapter The Parameter Server."""

from __future__ import annotations

from typing import Any

from rosmini.book.checks import exercise, expect, expect_heard, expect_node, expect_type
from rosmini.core.graph import Graph
from rosmini.msgs.std_msgs.msg import Float32

# ---- names: resolving names ----

NAMES = ["/robot2/wheel/radius", "/robot2/driver/gain", "/use_sim_time"]


@exercise("names", praise="In another namespace, the same three lines read other parameters.")
def names(answer: Any) -> None:
    """The full names of wheel/radius, ~gain and /use_sim_time for /robot2/driver."""
    expect_type(answer, list, "names is", "a list", '["/...", "/...", "/..."]')
    expect(len(answer) == 3, f"The list has {len(answer)} entries, not three.", "write one for each name")
    said = ["wheel/radius", "~gain", "/use_sim_time"]
    hints = [
        "the namespace of /robot2/driver is /robot2; a relative name starts there",
        "a private name starts with the node's full name",
        "a name that begins with / stays as it is",
    ]
    for short, given, right, hint in zip(said, answer, NAMES, hints, strict=True):
        expect(given == right, f"{short} does not resolve to {given!r} there.", hint)


# ---- gain_of: the nearest gain ----


@exercise("gain_of", praise="One value serves all nodes, a nearer one makes an exception; a default remains.")
def gain_of(answer: Any) -> None:
    """The value of the nearest gain above the node, as a float; 1.0 by default."""
    with Graph() as graph:
        node = graph.node("driver", namespace="/robot2/base")
        steps = [
            (None, None, 1.0, "no gain is set"),
            ("/gain", 2, 2.0, "/gain is 2"),
            ("/robot2/gain", 3.5, 3.5, "/robot2/gain is 3.5 and /gain is 2"),
            ("/robot2/base/driver/gain", 0, 0.0, "~gain is 0, and other gains are set above it"),
        ]
        for name, value, right, case in steps:
            if name is not None:
                node.set_param(name, value)
            found = answer(node)
            expect(
                isinstance(found, (int, float)) and found == right,
                f"For the node {node.name}, when {case}, it returned {found!r}, not {right}.",
                "search_param returns the full name of the nearest one, or None; get_param returns its value",
            )
            expect(
                type(found) is float,
                f"When {case}, it returned the {type(found).__name__} {found!r}, not a float.",
                "use get_param(name, expect=float), or float(...)",
            )


# ---- merge: merging ----


@exercise("merge", praise="`rosparam load` and `rosparam set` treat a dictionary in the same way.")
def merge(answer: Any) -> None:
    """Merge a dictionary into a namespace and keep its other parameters."""
    with Graph() as graph:
        node = graph.node("node")
        node.set_param("/arm", {"name": "left", "joint": {"min": -1.0, "max": 1.0}, "links": [1, 2, 3]})
        answer(node, "/arm", {"joint": {"max": 2.0}, "links": [4], "tool": {"grip": {"force": 5}}})
        found = node.get_param("/arm", {})
        stray = [name for name in node.param_names() if not name.startswith(("/arm", "/ros", "/run_id"))]
    expect(not stray, f"It set {', '.join(stray)}, outside /arm.", 'the full name is f"{name}/{key}"')
    expect(
        found.get("name") == "left",
        "/arm/name is gone.",
        "setting the whole namespace deletes the rest; set each parameter",
    )
    joint = found.get("joint", {})
    expect(joint.get("min") == -1.0, "/arm/joint/min is gone.", "merge a nested dictionary in the same way")
    expect(joint.get("max") == 2.0, f"/arm/joint/max is {joint.get('max')!r}, not 2.0.", "use set_param")
    expect(
        found.get("links") == [4],
        f"/arm/links is {found.get('links')!r}, not [4].",
        "a list is one value; it replaces the old one",
    )
    expect(
        found.get("tool") == {"grip": {"force": 5}},
        f"/arm/tool is {found.get('tool')!r}, not {{'grip': {{'force': 5}}}}.",
        "to make a namespace, set the parameters in it",
    )


# ---- limiter: a limit that may change ----


class _Counted:
    """A Master that counts the requests for parameters."""

    def __init__(self, master: Any) -> None:
        self._master = master
        self.count = 0

    def __getattr__(self, name: str) -> Any:
        self.count += name in ("getParam", "hasParam", "searchParam", "getParamNames")
        return getattr(self._master, name)


@exercise("limiter", praise="The node asks once and is notified of changes, so messages cost nothing.")
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
                "The node asks the Master for the parameter at every message.",
                "on_param notifies the node when the parameter changes",
            )
    right = [0.25, 1.0, -4.0, 0.25, 0.5, -4.0, 0.25, 2.0, -4.0]
    expect(
        got == right,
        f"For 0.25, 4 and -4, with the limits 1.0, then 0.5, then 2.0, it published {got or 'nothing'}, not {right}.",
        "use min(message.data, limit) with the current limit: on_param returns the first one and passes each "
        "new one to your callback",
    )
