"""The engine: motion, contacts and pushing, without a node."""

from .engine import Engine, RobotGone

__all__ = ["Engine", "RobotGone"]
