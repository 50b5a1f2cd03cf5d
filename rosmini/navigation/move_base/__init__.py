"""The node that drives a robot to a goal with planners, costmaps and recoveries (http://wiki.ros.org/move_base)."""
