"""The nodes that publish maps from files and write them (http://wiki.ros.org/map_server)."""
