"""``roslib.packages``: where packages are."""

from __future__ import annotations

from rosmini.errors import UnknownPackage
from rosmini.packages import PackageIndex

__all__ = ["InvalidROSPkgException", "get_pkg_dir"]


class InvalidROSPkgException(UnknownPackage):
    """No package of this name is there."""


def get_pkg_dir(
    package: str, required: bool = True, ros_root: str | None = None, ros_package_path: str | None = None
) -> str | None:
    """Return the folder of a package. Raises ``InvalidROSPkgException``, or returns None unless ``required``."""
    del ros_root, ros_package_path  # of the days before the package path
    try:
        return str(PackageIndex().path(package))
    except UnknownPackage as error:
        if not required:
            return None
        raise InvalidROSPkgException(str(error)) from error
