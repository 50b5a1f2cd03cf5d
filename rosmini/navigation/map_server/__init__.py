"""The nodes that publish maps from files and save them (http://wiki.ros.org/map_server)."""
