"""``roslib.packages``: locations of packages."""

from __future__ import annotations

import os

from rosmini.core.errors import RosminiError, UnknownPackage
from rosmini.core.packages import PackageIndex

MANIFEST_FILE = "manifest.xml"
PACKAGE_FILE = "package.xml"


class ROSPkgException(RosminiError):
    """A problem with a package."""


class InvalidROSPkgException(ROSPkgException, UnknownPackage):
    """There is no package of this name."""


def get_pkg_dir(
    package: str, required: bool = True, ros_root: str | None = None, ros_package_path: str | None = None
) -> str | None:
    """Return the folder of a package. Raises ``InvalidROSPkgException``, or returns None unless ``required``.

    ``ros_package_path`` replaces the environment's search path.
    """
    del ros_root  # older than the package path
    try:
        return str(PackageIndex(ros_package_path.split(os.pathsep) if ros_package_path else None).path(package))
    except UnknownPackage as error:
        if not required:
            return None
        raise InvalidROSPkgException(str(error)) from error
