"""``dynamic_reconfigure.encoding``: what the modules of ``.cfg`` files, and scripts, import from there."""

from __future__ import annotations

from typing import Any

from rosmini.dynamic_reconfigure.encoding import Config

__all__ = ["Config", "extract_params"]


def extract_params(group: Any) -> list[Any]:
    """Return the parameters of a group's dictionary and of those within, whose ``groups`` are a list or a dictionary."""
    inner = group["groups"]
    found = list(group["parameters"])
    for one in inner.values() if isinstance(inner, dict) else inner:
        found += extract_params(one)
    return found
