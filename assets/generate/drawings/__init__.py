"""The drawings of prose pages and chapters: the facts in `facts`, and a file for each kind of picture."""

from __future__ import annotations

from collections.abc import Mapping
from types import MappingProxyType

from . import concepts, gazebo_parts, layers, parts, people, rough_ground, rviz_window, stacks, timeline

PAGES: Mapping[str, str] = MappingProxyType(
    {
        "ros_history": timeline.history(),
        "ros_layers": layers.layers(),
        "ros_parts": parts.parts(),
        "ros_community": people.community(),
        "ros_distributions": timeline.distributions(),
        "willow_garage": people.people(),
    }
)
"""The drawings of prose pages as SVG, by the name of their file in `book/static/drawings`."""

CHAPTERS: Mapping[str, str] = MappingProxyType(
    {
        "frames_on_rough_ground": rough_ground.frames_on_rough_ground(),
        "gazebo_libraries": gazebo_parts.gazebo_libraries(),
        "gazebo_processes": gazebo_parts.gazebo_processes(),
        "publish_subscribe": concepts.publish_subscribe(),
        "rviz_window": rviz_window.rviz_window(),
        "stacks_and_packages": stacks.stacks_and_packages(),
    }
)
"""The drawings that chapters show with `rosmini.book.drawing`, by the name of their file in `rosmini/book/drawings`."""
