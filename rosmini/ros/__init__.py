"""What makes scripts, files and tools of real ROS work: rospy, the wire, bags, launch files and catkin."""
