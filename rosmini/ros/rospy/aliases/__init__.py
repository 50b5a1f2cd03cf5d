"""The small modules beside rospy that scripts import: ``genpy``, ``roslib``, ``rosgraph`` ..."""
