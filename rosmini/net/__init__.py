"""The wire of ROS 1: XML-RPC and TCPROS, through the ports that :mod:`rosmini.graph` defines."""

from __future__ import annotations

from .connecting import connect

__all__ = ["connect"]
