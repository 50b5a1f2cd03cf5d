"""`yocs_velocity_smoother`: limits commands to velocities that a robot can follow."""

from .smoother import Limits, VelocitySmoother, limited, towards

__all__ = ["Limits", "VelocitySmoother", "limited", "towards"]
