"""The engine: what moves, touches and pushes, with no node in it."""

from .engine import Engine, RobotGone

__all__ = ["Engine", "RobotGone"]
