"""The Navigation Stack: one folder for each ROS package."""
