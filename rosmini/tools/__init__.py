"""The `rosmini` command and the commands of ROS, such as `rostopic` and `rosbag`."""
