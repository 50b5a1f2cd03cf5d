"""Modules besides rospy that scripts import: ``genpy``, ``roslib``, ``rosgraph`` ..."""
