"""SDF, the format of Gazebo's worlds and models (http://sdformat.org): reading, and conversion to flat worlds."""

from .convert import converted, to_obstacles
from .errors import SdfError
from .poses import placed_links
from .reader import load

__all__ = ["SdfError", "converted", "load", "placed_links", "to_obstacles"]
