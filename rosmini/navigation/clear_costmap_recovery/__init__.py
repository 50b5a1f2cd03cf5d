"""Clears costmaps near or far from a stuck robot (http://wiki.ros.org/clear_costmap_recovery)."""
