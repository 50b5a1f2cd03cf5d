"""In which sequence devices are served, and how names are put together."""

from __future__ import annotations

from collections.abc import Iterable

from rosmini.errors import RosminiError, nearest

SEQUENCE = (
    "clock",
    "drive",
    "transforms",
    "joints",
    "truth",
    "laser",
    "imu",
    "battery",
    "bumper",
    "sensor_state",
    "camera",
)


def order(what: str) -> int:
    """The place of a kind of devices in the sequence in which those are served that are due at the same instant; others come last, at 100."""
    return SEQUENCE.index(what)


def within(namespace: str, topic: str) -> str:
    """A topic in a namespace; one that begins with a slash stays as it is.

    >>> within("tb3_0", "odom"), within("", "odom"), within("/tb3_0/", "odom"), within("tb3_0", "/tf")
    ('tb3_0/odom', 'odom', '/tb3_0/odom', '/tf')
    """
    if not namespace or topic.startswith("/"):
        return topic
    return f"{namespace.rstrip('/')}/{topic}"


def prefixed(prefix: str, frame: str) -> str:
    """A frame with a tf_prefix. No frame begins with a slash (tf2), and one that did has no prefix (http://wiki.ros.org/geometry/CoordinateFrameConventions).

    >>> prefixed("tb3_0", "odom"), prefixed("", "odom"), prefixed("/tb3_0/", "odom"), prefixed("tb3_0", "/map")
    ('tb3_0/odom', 'odom', 'tb3_0/odom', 'map')
    """
    prefix = prefix.strip("/")
    if not prefix or frame.startswith("/"):
        return frame.lstrip("/")
    return f"{prefix}/{frame}"


def one_of(what: str, value: str, values: Iterable[str]) -> str:
    """Return `value`. Raises `RosminiError`, with the nearest, if it is none of `values`."""
    known = tuple(values)
    if value not in known:
        hint = nearest(value, known) or f"it is one of {', '.join(known)}"
        msg = f"there is no {what} {value!r}; {hint}"
        raise RosminiError(msg)
    return value
