"""Clears costmaps around a stuck robot and lets it drive on slowly (http://wiki.ros.org/move_slow_and_clear)."""
