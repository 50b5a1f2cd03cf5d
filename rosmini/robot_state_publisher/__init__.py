"""`robot_state_publisher`: where the links of a robot are, told to tf (http://wiki.ros.org/robot_state_publisher)."""
