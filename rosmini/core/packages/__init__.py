"""ROS packages: where they are, their manifests, files and executables.

A package is a folder with a ``package.xml`` (REP 127, REP 140, REP 149). The search follows rospack
(http://wiki.ros.org/rospack): it crawls the folders of ``ROS_PACKAGE_PATH`` in order and takes the first package of a
name; it does not enter packages and folders with ``CATKIN_IGNORE`` or ``rospack_nosubdirs``. The packages of
rosmini come last, so that a workspace can overlay them. Packages from before catkin (``manifest.xml``) are not found.

We do not use rospkg's crawler, as its order depends on the file system, and a single manifest that is
not XML makes it fail. Manifests are read by catkin_pkg, after defusedxml has checked them.
"""

from .executables import DEVEL_MARKER, SCRIPT_FOLDERS, Executable, reconfigure_modules
from .folders import MANIFEST, address_of, assets_dir, crawl, own_dirs, package_around, search_paths
from .index import BUILT_IN, SCHEME, PackageIndex
from .manifest import Package, read_package

__all__ = [
    "BUILT_IN",
    "DEVEL_MARKER",
    "MANIFEST",
    "SCHEME",
    "SCRIPT_FOLDERS",
    "Executable",
    "Package",
    "PackageIndex",
    "address_of",
    "assets_dir",
    "crawl",
    "own_dirs",
    "package_around",
    "read_package",
    "reconfigure_modules",
    "search_paths",
]
