"""Turns a stuck robot once around, so that it sees what is there (http://wiki.ros.org/rotate_recovery)."""
