"""``tf2_ros.buffer_client``: looks up transforms in the buffer of another node."""

from __future__ import annotations

from typing import Any

from rosmini.core.actionlib.spec import Timeout
from rosmini.core.actionlib.states import Status
from rosmini.core.tf.errors import TimeoutException, TransformException
from rosmini.core.time import Duration, Time
from rosmini.msgs import message_class
from rosmini.ros.rospy.aliases.actionlib import SimpleActionClient
from rosmini.ros.rospy.session import require_node

from .buffer_interface import AT_ONCE, BufferInterface
from .buffer_server import ERRORS


class BufferClient(BufferInterface):
    """Queries the buffer server at the action ``ns``; it stores no transforms.

    ``timeout_padding`` (2 s) is added to the timeout of a lookup when waiting for the answer. Raises
    ``ROSInitException`` before ``init_node``.
    """

    def __init__(self, ns: str, check_frequency: Any = None, timeout_padding: Duration | None = None) -> None:
        super().__init__()
        if check_frequency is not None:
            require_node("tf2_ros.BufferClient").logwarn("check_frequency is not used: the server checks")
        self.client = SimpleActionClient(ns, message_class("tf2_msgs/LookupTransformAction"))
        self.timeout_padding = Duration(2) if timeout_padding is None else timeout_padding

    def wait_for_server(self, timeout: Timeout = None) -> bool:
        """Block until the server is available; return False after ``timeout`` (None or 0: no limit)."""
        return self.client.wait_for_server(timeout)

    def lookup_transform(self, target_frame: str, source_frame: str, time: Time, timeout: Any = AT_ONCE) -> Any:
        """Return the pose of ``source_frame`` in ``target_frame``, as a ``geometry_msgs/TransformStamped``.

        Raises the error of the lookup at the server, and ``TimeoutException`` if no answer comes.
        """
        return self._ask(target_frame=target_frame, source_frame=source_frame, source_time=time, timeout=timeout)

    def lookup_transform_full(
        self,
        target_frame: str,
        target_time: Time,
        source_frame: str,
        source_time: Time,
        fixed_frame: str,
        timeout: Any = AT_ONCE,
    ) -> Any:
        """Return a transform between two times through ``fixed_frame``."""
        return self._ask(
            target_frame=target_frame,
            target_time=target_time,
            source_frame=source_frame,
            source_time=source_time,
            fixed_frame=fixed_frame,
            timeout=timeout,
            advanced=True,
        )

    def can_transform(self, target_frame: str, source_frame: str, time: Time, timeout: Any = AT_ONCE) -> bool:
        """Return True if a lookup succeeds."""
        return _answers(lambda: self.lookup_transform(target_frame, source_frame, time, timeout))

    def can_transform_full(
        self,
        target_frame: str,
        target_time: Time,
        source_frame: str,
        source_time: Time,
        fixed_frame: str,
        timeout: Any = AT_ONCE,
    ) -> bool:
        """Return True if a lookup with a fixed frame succeeds."""
        names = target_frame, target_time, source_frame, source_time, fixed_frame
        return _answers(lambda: self.lookup_transform_full(*names, timeout))

    def _ask(self, **fields: Any) -> Any:
        goal = message_class("tf2_msgs/LookupTransformGoal")(**fields)
        client, server = self.client, self.client.action_client.ns
        client.send_goal(goal)
        if not client.wait_for_result(goal.timeout + self.timeout_padding):
            raise TimeoutException(f"the buffer server at {server} has not answered in time: does it run?")
        if client.get_state() != Status.SUCCEEDED:
            raise TimeoutException(f"the buffer server at {server} gave up the lookup: {client.get_goal_status_text()}")
        result = client.get_result()
        if result.error.error:
            raise ERRORS.get(result.error.error, TransformException)(result.error.error_string)
        return result.transform


def _answers(ask: Any) -> bool:
    try:
        ask()
    except TransformException:
        return False
    return True
