"""``roslib.names``, an older name of ``rosgraph.names``."""

from rosmini.ros.rospy.aliases.rosgraph.names import *  # noqa: F403
