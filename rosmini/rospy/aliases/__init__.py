"""The small modules beside rospy that scripts import: ``genpy``, ``roslib``, ``rosgraph``, as far as scripts use them."""
