"""Support for scripts, files and tools of real ROS: rospy, the wire protocols, bags, launch files and catkin."""
