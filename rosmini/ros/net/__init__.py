"""The wire of ROS 1: XML-RPC and TCPROS, through the ports that :mod:`rosmini.core.graph` defines."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

if TYPE_CHECKING:
    from .connecting import connect

__all__ = ["connect"]


def __getattr__(name: str) -> Any:
    """Import what is asked for on first use: a tool that only asks for an address needs no graph."""
    if name not in __all__:
        raise AttributeError(f"module {__name__!r} has no attribute {name!r}")
    from .connecting import connect

    return connect
