"""Errors of Gazebo's part of the simulator."""

from __future__ import annotations

from rosmini.core.errors import RosminiError


class GazeboError(RosminiError):
    """A request to a running server cannot be fulfilled; the simulation continues."""


class UnknownEntity(GazeboError):
    """The world has no model, link or joint of this name."""


class SpawnError(GazeboError):
    """A model cannot be inserted into the world."""


class UnknownPlugin(GazeboError):
    """No plugin has this file name."""
