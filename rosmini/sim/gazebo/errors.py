"""What can go wrong in Gazebo's part of the simulator."""

from __future__ import annotations

from rosmini.core.errors import RosminiError


class GazeboError(RosminiError):
    """Something that was asked of a running server is not possible; the simulation goes on."""


class UnknownEntity(GazeboError):
    """There is no model, link or joint of this name in the world."""


class SpawnError(GazeboError):
    """A model cannot come into the world."""


class UnknownPlugin(GazeboError):
    """No plugin has this file name."""
