"""Costmaps: the cost of each position of the robot's centre (http://wiki.ros.org/costmap_2d)."""
