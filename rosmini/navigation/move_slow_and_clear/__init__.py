"""Clears costmaps around a stuck robot and limits its speed (http://wiki.ros.org/move_slow_and_clear)."""
