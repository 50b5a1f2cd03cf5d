"""The module that scripts import as ``rosmsg`` (http://wiki.ros.org/rosmsg): definitions, md5 sums, types of packages.

Functions accept the ``rospack`` argument of the real ones, but use the packages that rosmini finds.
"""

from __future__ import annotations

from collections.abc import Iterator
from typing import Any

from rosmini.core.errors import DefinitionError, IllegalName, RosminiError, UnknownPackage, UnknownType
from rosmini.ros.introspection.types import MESSAGE, SERVICE, Kind
from rosmini.ros.rospy.mains import run_tool

__all__ = [
    "MODE_MSG",
    "MODE_SRV",
    "ROSMsgException",
    "get_msg_text",
    "get_srv_text",
    "iterate_packages",
    "list_msgs",
    "list_srvs",
    "list_types",
    "rosmsg_md5",
    "rosmsg_search",
    "rosmsgmain",
]

MODE_MSG = ".msg"
MODE_SRV = ".srv"
_WRONG = (DefinitionError, IllegalName, UnknownPackage, UnknownType)


class ROSMsgException(RosminiError):
    """A type or a mode is unknown."""


def _kind(mode: str) -> Kind:
    kinds = {MODE_MSG: MESSAGE, MODE_SRV: SERVICE}
    if mode not in kinds:
        raise ValueError(f"Unknown mode: {mode}")
    return kinds[mode]


def _text(kind: Kind, type_: str, raw: bool) -> str:
    try:
        return kind.text(type_, raw=raw)
    except _WRONG as error:
        what = "Unable to load msg" if kind is MESSAGE else "Unknown srv type"
        raise ROSMsgException(f"{what} [{type_}]: {error}") from error


def get_msg_text(type_: str, raw: bool = False, rospack: Any = None) -> str:  # noqa: ARG001 - as in ROS
    """Return the definition of a message, or its unchanged file if ``raw``. Raises ``ROSMsgException``."""
    return _text(MESSAGE, type_, raw)


def get_srv_text(type_: str, raw: bool = False, rospack: Any = None) -> str:  # noqa: ARG001 - as in ROS
    """Return the definition of a service, or its unchanged file if ``raw``. Raises ``ROSMsgException``."""
    return _text(SERVICE, type_, raw)


def list_types(package: str, mode: str = MODE_MSG, rospack: Any = None) -> list[str]:  # noqa: ARG001 - as in ROS
    """Return the types of a package. Raises ``UnknownPackage``."""
    return _kind(mode).of_package(package)


def list_msgs(package: str, rospack: Any = None) -> list[str]:
    """Return the messages of a package. Raises ``UnknownPackage``."""
    return list_types(package, MODE_MSG, rospack)


def list_srvs(package: str, rospack: Any = None) -> list[str]:
    """Return the services of a package. Raises ``UnknownPackage``."""
    return list_types(package, MODE_SRV, rospack)


def iterate_packages(rospack: Any, mode: str) -> Iterator[tuple[str, str]]:  # noqa: ARG001 - as in ROS
    """Yield the packages that define types, with the folders of the definitions."""
    from rosmini.core.packages import PackageIndex

    index, kind = PackageIndex(), _kind(mode)
    for package in kind.packages():
        yield package, str(index.path(package) / kind.ending)


def rosmsg_search(rospack: Any, mode: str, base_type: str) -> Iterator[str]:  # noqa: ARG001 - as in ROS
    """Yield the types with this name in any package."""
    yield from _kind(mode).search(base_type)


def rosmsg_md5(mode: str, type_: str) -> str:
    """Return the md5 sum of a type. Raises ``OSError`` if it is unknown, like the real function."""
    try:
        return _kind(mode).md5(type_)
    except _WRONG as error:
        raise OSError(f"cannot load [{type_}]: {error}") from error


def rosmsgmain(mode: str = MODE_MSG) -> None:
    """Run rosmsg or rossrv with ``sys.argv``; raise ``SystemExit`` if it fails."""
    run_tool("rossrv" if mode == MODE_SRV else "rosmsg", None)
