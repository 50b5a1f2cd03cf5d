"""Names of topics in a namespace and of frames with a prefix."""

from __future__ import annotations


def within(namespace: str, topic: str) -> str:
    """Return a topic's name in a namespace; a name that begins with a slash is unchanged.

    >>> within("tb3_0", "odom"), within("", "odom"), within("/tb3_0/", "odom"), within("tb3_0", "/tf")
    ('tb3_0/odom', 'odom', '/tb3_0/odom', '/tf')
    """
    if not namespace or topic.startswith("/"):
        return topic
    return f"{namespace.rstrip('/')}/{topic}"


def prefixed(prefix: str, frame: str) -> str:
    """Return a frame's name with a tf_prefix. tf2 allows no leading slash: it is removed, and no prefix is added.

    See http://wiki.ros.org/geometry/CoordinateFrameConventions.

    >>> prefixed("tb3_0", "odom"), prefixed("", "odom"), prefixed("/tb3_0/", "odom"), prefixed("tb3_0", "/map")
    ('tb3_0/odom', 'odom', 'tb3_0/odom', 'map')
    """
    prefix = prefix.strip("/")
    if not prefix or frame.startswith("/"):
        return frame.lstrip("/")
    return f"{prefix}/{frame}"
