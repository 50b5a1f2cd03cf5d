"""Files from outside: looked at before they are read.

Whatever a path from outside names: testing it raises nothing, and reading it never blocks on a pipe or fills the
memory.
"""

from __future__ import annotations

import errno
import os
import stat

__all__ = ["LARGEST", "check", "exists", "is_file", "names_in", "path_of", "read"]

LARGEST = 64_000_000
"""Bytes of a file that is read at once."""

KINDS = (
    (stat.S_ISDIR, "it is a folder"),
    (stat.S_ISFIFO, "it is a pipe"),
    (stat.S_ISCHR, "it is a device"),
    (stat.S_ISBLK, "it is a device"),
    (stat.S_ISSOCK, "it is a socket"),
)

Path = str | os.PathLike[str]


def exists(path: Path) -> bool:
    """Tell whether there is something at a path; of a path that cannot be one there is nothing."""
    return os.path.exists(path)  # noqa: PTH110 (Path.exists raises for a name that is too long)


def is_file(path: Path) -> bool:
    """Tell whether there is a regular file at a path."""
    return os.path.isfile(path)  # noqa: PTH113 (Path.is_file raises for a name that is too long)


def names_in(folder: Path) -> list[str]:
    """The names of what is in a folder, sorted; nothing if it is no folder, or is not ours to read."""
    try:
        return sorted(os.listdir(folder))  # noqa: PTH208 (names, of a path of any kind)
    except (OSError, ValueError):
        return []


def path_of(address: str) -> str:
    r"""The path that ``file://...`` means, on this system: ``file:///C:/robot.stl`` is ``C:\robot.stl`` on Windows."""
    from urllib.request import url2pathname

    return url2pathname(address.partition("://")[2])


def check(path: Path, largest: int = LARGEST) -> os.stat_result:
    """The `stat` of a file that can be read. Raises `OSError` if it is missing, not a regular file, or too large."""
    try:
        found = os.stat(path)  # noqa: PTH116 (a path of any kind)
    except ValueError as error:  # a NUL in it, or what the file system's encoding has not
        raise OSError(errno.EINVAL, "its name holds what no name can hold", os.fspath(path)) from error
    for is_kind, what in KINDS:
        if is_kind(found.st_mode):
            raise OSError(errno.EINVAL, what, os.fspath(path))
    if found.st_size > largest:
        raise _too_large(path, largest)
    return found


def read(path: Path, largest: int = LARGEST) -> bytes:
    """The bytes of a file. Raises `OSError` as `check` does."""
    size = check(path, largest).st_size
    with open(path, "rb") as file:  # noqa: PTH123 (a path of any kind)
        data = file.read(size + 1)  # as much memory is taken as is asked for
        if len(data) > size:  # some files of the system say that they are empty
            data += file.read(largest + 1 - len(data))
    if len(data) > largest:
        raise _too_large(path, largest)
    return data


def _too_large(path: Path, largest: int) -> OSError:
    return OSError(errno.EFBIG, f"it has more than {largest / 1e6:g} MB", os.fspath(path))
