"""The module that scripts import as ``rosparam``: YAML files, the Parameter Server (http://wiki.ros.org/rosparam)."""

from __future__ import annotations

from .api import *  # noqa: F403
from .command import yamlmain as yamlmain
