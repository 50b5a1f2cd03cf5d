"""The Navigation Stack: one folder for each ROS package, named as there (http://wiki.ros.org/navigation)."""
