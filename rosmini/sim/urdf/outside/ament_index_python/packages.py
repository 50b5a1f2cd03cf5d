"""Look-up of packages by name."""

from __future__ import annotations

__all__ = ["PackageNotFoundError", "get_package_share_directory"]


class PackageNotFoundError(KeyError):
    """No package has this name."""

    # KeyError shows the repr of its argument, which would put quotes and "\n" into our sentences.
    __str__ = Exception.__str__


def get_package_share_directory(package_name: str) -> str:
    """Return the folder of a package. Raises `PackageNotFoundError`, with the searched folders."""
    from rosmini.core.errors import UnknownPackage
    from rosmini.core.packages import PackageIndex

    try:
        return str(PackageIndex().path(package_name))
    except UnknownPackage as error:
        raise PackageNotFoundError(str(error)) from error
