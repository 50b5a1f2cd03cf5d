"""Mapping from odometry and a laser with a Rao-Blackwellised particle filter (http://wiki.ros.org/gmapping).

Grisetti, Stachniss and Burgard, Improved techniques for grid mapping with Rao-Blackwellized particle filters (IEEE
Transactions on Robotics, 2007). Each particle is a path with the map that follows from it: `matching` matches a scan
with a map, `maps` stores all maps without duplicates, and `slam` is the filter; the node is separate.
"""
