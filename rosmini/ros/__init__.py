"""Scripts, files and tools of real ROS: rospy, script isolation, the wire protocols, bags, launch files, catkin."""
