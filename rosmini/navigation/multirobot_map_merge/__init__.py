"""multirobot_map_merge: merges the maps of several robots (http://wiki.ros.org/multirobot_map_merge)."""
