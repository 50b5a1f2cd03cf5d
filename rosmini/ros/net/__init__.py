"""Wire protocols of ROS 1: XML-RPC and TCPROS, behind the ports that :mod:`rosmini.core.graph` defines."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

if TYPE_CHECKING:
    from .connecting import connect

__all__ = ["connect"]


def __getattr__(name: str) -> Any:
    """Import names on first use: a tool that only needs an address can do without the graph."""
    if name not in __all__:
        raise AttributeError(f"module {__name__!r} has no attribute {name!r}")
    from .connecting import connect

    return connect
