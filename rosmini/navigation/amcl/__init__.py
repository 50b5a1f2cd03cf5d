"""Where a robot is on a known map: Monte Carlo localisation with as many particles as it takes (http://wiki.ros.org/amcl).

The algorithm is that of Fox (KLD-sampling, 2003) with the recovery of Gutmann and Fox (augmented MCL, 2002), as
Probabilistic Robotics (Thrun, Burgard, Fox, 2005) has it in chapters 5, 6 and 8: `motion`, `laser`, `filter`, apart
from the node.
"""

from __future__ import annotations

from .field import LikelihoodField
from .filter import ParticleFilter, show_steps
from .motion import MODELS, moved

__all__ = ["MODELS", "LikelihoodField", "ParticleFilter", "moved", "show_steps"]
