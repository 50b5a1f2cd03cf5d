"""``rosgraph.masterapi``: the Master's API with unpacked answers."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

from rosmini.core.errors import RosminiError
from rosmini.core.graph import running_graph
from rosmini.core.graph.master_port import METHODS
from rosmini.core.names import resolve_for

from .rosenv import get_master_uri


class MasterException(RosminiError):
    """The Master did not carry out a call."""


class MasterFailure(MasterException):
    """The Master failed; its state may be wrong."""


class MasterError(MasterException):
    """The Master refused a call because of its arguments."""


ROSMasterException = MasterException
Error = MasterError
Failure = MasterFailure


class Master:
    """The Master, called in the name of ``caller_id``.

    Methods are those of the Master API (http://wiki.ros.org/ROS/Master_API), such as ``getSystemState()``; they return
    the value of the answer. Raises ``MasterError`` if the Master refuses, ``MasterFailure`` if it fails.
    """

    def __init__(self, caller_id: str, master_uri: str | None = None) -> None:
        self.caller_id = resolve_for(caller_id, "/").rstrip("/") or "/"
        self.master_uri = master_uri or get_master_uri()

    def is_online(self) -> bool:
        """Return True if there is a Master; always true in a process with its own."""
        return True

    def __getattr__(self, name: str) -> Callable[..., Any]:
        if name not in METHODS:
            raise AttributeError(f"the Master has no method {name}", name=name, obj=self)

        def call(*args: Any) -> Any:
            code, status, value = running_graph().ask_as(self.caller_id).call(name, *args)
            if code == 1:
                return value
            raise (MasterError if code == -1 else MasterFailure)(status)

        return call


def is_online(master_uri: str | None = None) -> bool:
    """Return True if there is a Master; always true in a process with its own."""
    return Master("rosgraph", master_uri).is_online()
