"""``roslib.message``: message and service classes by name."""

from __future__ import annotations

from rosmini.rospy.aliases.genpy.message import Message, get_message_class, get_service_class, strify_message

__all__ = ["Message", "get_message_class", "get_service_class", "strify_message"]
