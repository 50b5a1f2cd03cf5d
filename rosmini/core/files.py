"""Files that users and other programs provide, checked before they are read.

`exists`, `is_file` and `names_in` raise nothing, whatever the path. `check` and `read` raise only `OSError`, never
block on a pipe, and never read more than a given number of bytes.
"""

from __future__ import annotations

import errno
import os
import stat

MAX_BYTES = 64_000_000
"""Maximum size of a file that is read at once [bytes]."""

KINDS = (
    (stat.S_ISDIR, "it is a folder"),
    (stat.S_ISFIFO, "it is a pipe"),
    (stat.S_ISCHR, "it is a device"),
    (stat.S_ISBLK, "it is a device"),
    (stat.S_ISSOCK, "it is a socket"),
)

Path = str | os.PathLike[str]


def exists(path: Path) -> bool:
    """Return whether a path exists; False for a path that is invalid."""
    return os.path.exists(path)  # noqa: PTH110 (Path.exists raises for a name that is too long)


def is_file(path: Path) -> bool:
    """Return whether a path is a regular file."""
    return os.path.isfile(path)  # noqa: PTH113 (Path.is_file raises for a name that is too long)


def names_in(folder: Path) -> list[str]:
    """Return the sorted names in a folder; empty if it is not a folder or not readable."""
    try:
        return sorted(os.listdir(folder))  # noqa: PTH208 (names, of a path of any kind)
    except (OSError, ValueError):
        return []


def path_of(address: str) -> str:
    r"""Return the path of ``file://...`` on this system: ``file:///C:/robot.stl`` is ``C:\robot.stl`` on Windows."""
    from urllib.request import url2pathname

    return url2pathname(address.partition("://")[2])


def check(path: Path, largest: int = MAX_BYTES) -> os.stat_result:
    """Return the `os.stat` of a file.

    Raises `OSError` if it is missing, is a folder, pipe, device or socket, or has more than `largest` bytes.
    """
    try:
        found = os.stat(path)  # noqa: PTH116 (a path of any kind)
    except ValueError as error:  # a NUL, or a character that the file system cannot encode
        raise OSError(errno.EINVAL, "its name contains an invalid character", os.fspath(path)) from error
    for is_kind, what in KINDS:
        if is_kind(found.st_mode):
            raise OSError(errno.EINVAL, what, os.fspath(path))
    if found.st_size > largest:
        raise _too_large(path, largest)
    return found


def read(path: Path, largest: int = MAX_BYTES) -> bytes:
    """Return the bytes of a file. Raises `OSError` if it cannot be read, and in the cases of `check`."""
    size = check(path, largest).st_size
    with open(path, "rb") as file:  # noqa: PTH123 (a path of any kind)
        data = file.read(size + 1)  # read() allocates as much memory as it is asked for
        if len(data) > size:  # some system files report size 0
            data += file.read(largest + 1 - len(data))
    if len(data) > largest:
        raise _too_large(path, largest)
    return data


def _too_large(path: Path, largest: int) -> OSError:
    return OSError(errno.EFBIG, f"it has more than {largest / 1e6:g} MB", os.fspath(path))
