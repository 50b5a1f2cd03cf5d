"""``roslib.packages``: locations and contents of packages."""

from __future__ import annotations

import os
from collections.abc import Callable
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


class MultipleNodesException(ROSPkgException):
    """A package has several nodes with the same name."""


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


def get_dir_pkg(d: str) -> tuple[str | None, str | None]:
    """Return the folder and name of the package that contains a path; (None, None) outside of packages."""
    place = Path(d).resolve()
    for folder in (place, *place.parents):
        if (folder / PACKAGE_FILE).exists() or (folder / MANIFEST_FILE).exists():
            return str(folder), folder.name
    return None, None


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


def resource_file(package: str, subdir: str, resource_name: str) -> str:
    """Return the path of a file in a package folder, existing or not. Raises ``InvalidROSPkgException``."""
    folder = get_pkg_subdir(package, subdir, required=False)
    if folder is None:
        raise InvalidROSPkgException(f"there is no package {package}")
    return str(Path(folder) / resource_name)


def find_resource(
    pkg: str, resource_name: str, filter_fn: Callable[[str], bool] | None = None, rospack: Any = None
) -> list[str]:
    """Return the paths of a package's files of this name that pass ``filter_fn``. Raises ``InvalidROSPkgException``."""
    home = str(get_pkg_dir(pkg)) if rospack is None else rospack.get_path(pkg)
    found = []
    for folder, inner, files in os.walk(home):
        inner[:] = sorted(name for name in inner if not name.startswith("."))
        path = str(Path(folder) / resource_name)
        if resource_name in files and (filter_fn is None or filter_fn(path)):
            found.append(path)
    return found


def find_node(pkg: str, node_type: str, rospack: Any = None) -> list[str]:
    """Return the paths of the executable files of this name in a package. Raises ``InvalidROSPkgException``."""
    return find_resource(pkg, node_type, lambda path: os.access(path, os.R_OK | os.X_OK), rospack)
