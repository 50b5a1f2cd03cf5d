"""ROS packages: where they are, what their manifests say, which files and executables they hold.

A package is a folder with a ``package.xml`` (REP 127, REP 140, REP 149) or, of the time before catkin, with a
``manifest.xml``; a stack is a folder with a ``stack.xml``. Packages are looked for as rospack does
(http://wiki.ros.org/rospack): below each folder of ``ROS_PACKAGE_PATH`` in turn, the first package of a name wins, a
folder with ``CATKIN_IGNORE`` or ``rospack_nosubdirs`` is not entered, and neither is a package. After them come the
packages that rosmini brings, so that a workspace can overlay them.

The crawl is ours and not rospkg's, whose order depends on the file system, and which gives up altogether over one
manifest that is not XML. Manifests are read by catkin_pkg, after defusedxml has found no harm in them.
"""

from .executables import (
    DEVEL_MARKER,
    NODES_GROUP,
    SCRIPT_FOLDERS,
    Executable,
    built_in_nodes,
    reconfigure_modules,
)
from .folders import MANIFEST, Crawled, address_of, assets_dir, crawl, own_dirs, package_around, search_paths
from .index import BUILT_IN, LONGEST, SCHEME, PackageIndex
from .manifest import Export, Package, Stack, read_package, read_stack

__all__ = [
    "BUILT_IN",
    "DEVEL_MARKER",
    "LONGEST",
    "MANIFEST",
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
