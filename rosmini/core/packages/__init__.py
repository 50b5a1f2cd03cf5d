"""ROS packages: where they are, their manifests, files and executables.

A package is a folder with a ``package.xml`` (REP 127, REP 140, REP 149) or, before catkin, with a
``manifest.xml``; a stack is a folder with a ``stack.xml``. The search follows rospack
(http://wiki.ros.org/rospack): it crawls the folders of ``ROS_PACKAGE_PATH`` in order and takes the first package of a
name; it does not enter packages and folders with ``CATKIN_IGNORE`` or ``rospack_nosubdirs``. The packages of
rosmini come last, so that a workspace can overlay them.

We do not use rospkg's crawler, as its order depends on the file system, and a single manifest that is
not XML makes it fail. Manifests are read by catkin_pkg, after defusedxml has checked them.
"""

from .executables import DEVEL_MARKER, NODES_GROUP, SCRIPT_FOLDERS, Executable, built_in_nodes, reconfigure_modules
from .folders import MANIFEST, Crawled, address_of, assets_dir, crawl, own_dirs, package_around, search_paths
from .index import BUILT_IN, MAX_ADDRESS_LENGTH, SCHEME, PackageIndex
from .manifest import Export, Package, Stack, read_package, read_stack

__all__ = [
    "BUILT_IN",
    "DEVEL_MARKER",
    "MANIFEST",
    "MAX_ADDRESS_LENGTH",
    "NODES_GROUP",
    "SCHEME",
    "SCRIPT_FOLDERS",
    "Crawled",
    "Executable",
    "Export",
    "Package",
    "PackageIndex",
    "Stack",
    "address_of",
    "assets_dir",
    "built_in_nodes",
    "crawl",
    "own_dirs",
    "package_around",
    "read_package",
    "read_stack",
    "reconfigure_modules",
    "search_paths",
]
