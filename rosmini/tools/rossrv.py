"""`rosmini rossrv`: definitions of services, as `rosmini rosmsg` does for messages (http://wiki.ros.org/rossrv)."""

from __future__ import annotations

from rosmini.ros.introspection.types import SERVICE

from .rosmsg import tool_of

TOOL = tool_of(SERVICE, "service types: list them, and show their definitions")
