"""The drawings of the prose pages: the facts in `facts`, and a file for each kind of picture."""

from __future__ import annotations

from collections.abc import Mapping
from types import MappingProxyType

from . import layers, parts, people, timeline

DRAWINGS: Mapping[str, str] = MappingProxyType(
    {
        "ros_history": timeline.history(),
        "ros_layers": layers.layers(),
        "ros_parts": parts.parts(),
        "ros_community": people.community(),
        "ros_distributions": timeline.distributions(),
        "willow_garage": people.people(),
    }
)
"""The pictures as SVG, by the name of their file in `book/static/drawings`."""
