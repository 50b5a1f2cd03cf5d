"""The exercises of chapter 74: what is new in a graph, who drives, and which nodes end."""

from __future__ import annotations

from typing import Any

from rosmini.book.checks import exercise, expect

State = list[list[list[Any]]]

ROBOT: State = [
    [["/odom", ["/simulator"]], ["/cmd_vel", ["/move_base"]], ["/rosout", ["/simulator", "/move_base"]]],
    [["/cmd_vel", ["/simulator"]], ["/odom", ["/move_base"]]],
    [["/move_base/make_plan", ["/move_base"]]],
]
STEERED: State = [
    [*ROBOT[0][:1], ["/cmd_vel", ["/teleop", "/move_base", "/a_script"]], ["/rosout", ["/teleop"]]],
    [*ROBOT[1], ["/scan", ["/watcher"]]],
    [*ROBOT[2], ["/map_server/get", ["/server"]]],
]


@exercise("74.1", praise="This is what rqt_graph draws in bold.")
def new_nodes(answer: Any) -> None:
    """The nodes that are in the second state only."""
    for before, after, wanted in (
        (ROBOT, STEERED, ["/a_script", "/server", "/teleop", "/watcher"]),
        (STEERED, ROBOT, []),
        ([[], [], []], ROBOT, ["/move_base", "/simulator"]),
    ):
        found = answer(before, after)
        expect(
            found == wanted,
            f"From {len(before[0])} to {len(after[0])} topics that are published, {wanted} came; your function "
            f"returned {found!r}.",
            "look into all three lists, subtract sets, and sort",
        )


@exercise("74.2", praise="Two names in this list are one too many.")
def drivers(answer: Any) -> None:
    """Who publishes on a topic."""
    for state, topic, wanted in (
        (STEERED, "/cmd_vel", ["/a_script", "/move_base", "/teleop"]),
        (ROBOT, "/odom", ["/simulator"]),
        (ROBOT, "/scan", []),
        (STEERED, "/scan", []),
    ):
        found = answer(state, topic)
        expect(
            found == wanted,
            f"On {topic} these publish: {wanted}; your function returned {found!r}.",
            "the publishers are the first list; one who subscribes does not drive",
        )


@exercise("74.3", praise="So the Master does, each time.")
def ended(answer: Any) -> None:
    """Which nodes are ended, in order."""
    stage = ["/move_base_node", "/stageros", "/slam_gmapping"]
    for launches, wanted in (
        ([stage, ["/move_base_node"]], ["/move_base_node"]),
        ([stage, ["/explore"]], []),
        ([["/b"], ["/a"], ["/a", "/b"], ["/a"]], ["/a", "/b", "/a"]),
        ([], []),
    ):
        found = answer(launches)
        expect(
            found == wanted,
            f"After {launches} the Master has ended {wanted}; your function returned {found!r}.",
            "a node that took a name can lose it in turn",
        )
