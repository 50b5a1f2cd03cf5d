"""``actionlib.exceptions``."""

from __future__ import annotations

from rosmini.actionlib.errors import ActionException

__all__ = ["ActionException"]
