"""Rotates a stuck robot by 360 degrees, so that its sensors see all sides (http://wiki.ros.org/rotate_recovery)."""
