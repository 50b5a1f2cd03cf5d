"""``roslib.packages``: locations and contents of packages."""

from __future__ import annotations

import os
from pathlib import Path
from typing import Any

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


def get_pkg_subdir(package: str, subdir: str, required: bool = True, env: Any = None) -> str | None:
    """Return a folder of a package; create it if ``required`` and missing. Raises ``InvalidROSPkgException``."""
    home = get_pkg_dir(package, required, ros_package_path=(env or {}).get("ROS_PACKAGE_PATH"))
    if home is None:
        return None
    folder = Path(home) / subdir
    if required:
        try:
            folder.mkdir(parents=True, exist_ok=True)
        except OSError as error:
            raise ROSPkgException(
                f"the folder {folder} of package {package} cannot be made: {error.strerror}"
            ) from error
    return str(folder)
