"""Checks of the exercises in the chapter Beyond: new nodes, the publishers of a topic, and nodes that end."""

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


@exercise("new_nodes", praise="rqt_graph draws the same nodes in bold.")
def new_nodes(answer: Any) -> None:
    """The nodes that are only in the second state."""
    for before, after, wanted in (
        (ROBOT, STEERED, ["/a_script", "/server", "/teleop", "/watcher"]),
        (STEERED, ROBOT, []),
        ([[], [], []], ROBOT, ["/move_base", "/simulator"]),
    ):
        found = answer(before, after)
        expect(
            found == wanted,
            f"Between {len(before[0])} and {len(after[0])} published topics, {wanted} are new; your function "
            f"returned {found!r}.",
            "collect the nodes of all three lists, subtract the sets, and sort",
        )


@exercise("drivers", praise="If this list has two names, two nodes fight over the robot.")
def drivers(answer: Any) -> None:
    """The publishers of a topic."""
    for state, topic, wanted in (
        (STEERED, "/cmd_vel", ["/a_script", "/move_base", "/teleop"]),
        (ROBOT, "/odom", ["/simulator"]),
        (ROBOT, "/scan", []),
        (STEERED, "/scan", []),
    ):
        found = answer(state, topic)
        expect(
            found == wanted,
            f"The publishers of {topic} are {wanted}; your function returned {found!r}.",
            "the first list contains the publishers; ignore the subscribers",
        )


@exercise("ended", praise="The Master does the same for each duplicate name.")
def ended(answer: Any) -> None:
    """The nodes that the Master ends, in order."""
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
            "a node that took over a name can lose it again",
        )
