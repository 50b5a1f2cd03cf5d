"""multirobot_map_merge: one map of the maps of several robots (http://wiki.ros.org/multirobot_map_merge)."""
