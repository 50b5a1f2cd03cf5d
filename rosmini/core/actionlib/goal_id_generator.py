"""Ids for goals that arrive without one, such as those sent with ``rostopic pub``."""

from __future__ import annotations

from itertools import count
from typing import TYPE_CHECKING, Any

from rosmini.msgs import message_class

if TYPE_CHECKING:
    from collections.abc import Iterator

    from rosmini.core.graph import Node

__all__ = ["GoalIDGenerator", "numbers_of"]


def numbers_of(node: Node, of: str) -> Iterator[int]:
    """Return a node's counter (1, 2, ...) of one kind of id, shared by all its clients and servers."""
    numbers: Iterator[int] = vars(node).setdefault(f"_{of}_numbers", count(1))
    return numbers


class GoalIDGenerator:
    """Makes ids of the form ``name-number-secs.nsecs``, stamped with the node's time.

    ``name`` is the node's name by default.
    """

    def __init__(self, node: Node, name: str | None = None) -> None:
        self._node = node
        self.name = node.name if name is None else name

    def set_name(self, name: str) -> None:
        """Start ids with ``name`` from now on."""
        self.name = name

    def generate_ID(self) -> Any:
        """Return a new ``actionlib_msgs/GoalID``."""
        now = self._node.now()
        number = next(numbers_of(self._node, "made_goal"))
        goal_id = message_class("actionlib_msgs/GoalID")(stamp=now)
        goal_id.id = f"{self.name}-{number}-{now.secs}.{now.nsecs}"
        return goal_id
