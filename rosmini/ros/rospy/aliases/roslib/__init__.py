"""The module that old scripts import as ``roslib``; it has nothing to set up any more."""

from __future__ import annotations

from rosmini.ros.rospy.aliases.genpy import message

from . import names, packages, scriptutil

__all__ = ["is_interactive", "load_manifest", "message", "names", "packages", "scriptutil", "set_interactive"]


def load_manifest(package_name: str, bootstrap_version: str = "0.7") -> None:
    """Do nothing: packages are found without it. Old scripts call ``roslib.load_manifest('their_package')``."""


def set_interactive(interactive: bool) -> None:
    """Do nothing: rospy does not handle signals here."""


def is_interactive() -> bool:
    """Return False."""
    return False
