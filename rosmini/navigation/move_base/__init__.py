"""Brings a robot to a goal: the node that ties planners, costmaps and recoveries together (http://wiki.ros.org/move_base)."""
