"""Clears costmaps around a stuck robot, or beyond it (http://wiki.ros.org/clear_costmap_recovery)."""
