"""Monte Carlo localisation on a known map with an adaptive number of particles (http://wiki.ros.org/amcl).

The algorithm is KLD-sampling (Fox, 2003) with the recovery of augmented MCL (Gutmann and Fox, 2002), as described in
chapters 5, 6 and 8 of Probabilistic Robotics (Thrun, Burgard, Fox, 2005): `motion`, `laser` and `filter` are separate
from the node.
"""
