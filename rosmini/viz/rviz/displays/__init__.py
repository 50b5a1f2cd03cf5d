"""The displays, one module each: the entry point `rviz/*` of the group `rosmini.plugins` finds them by their names."""
