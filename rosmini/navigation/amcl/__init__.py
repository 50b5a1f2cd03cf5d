"""Monte Carlo localisation on a known map with an adaptive number of particles (http://wiki.ros.org/amcl).

The algorithm is KLD-sampling (Fox, 2003) with the recovery of augmented MCL (Gutmann and Fox, 2002), as described in
chapters 5, 6 and 8 of Probabilistic Robotics (Thrun, Burgard, Fox, 2005): `motion`, `laser` and `filter` are separate
from the node.
"""

from __future__ import annotations

from .field import LikelihoodField
from .filter import ParticleFilter
from .motion import MODELS, sample_motion_model

__all__ = ["MODELS", "LikelihoodField", "ParticleFilter", "sample_motion_model"]
