"""`robot_state_publisher`: publishes transforms of a robot's links (http://wiki.ros.org/robot_state_publisher)."""
