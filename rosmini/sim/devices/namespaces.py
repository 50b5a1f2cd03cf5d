"""Topics in a namespace, and frames with a prefix."""

from __future__ import annotations


def within(namespace: str, topic: str) -> str:
    """Return a topic in a namespace; one that begins with a slash stays as it is.

    >>> within("tb3_0", "odom"), within("", "odom"), within("/tb3_0/", "odom"), within("tb3_0", "/tf")
    ('tb3_0/odom', 'odom', '/tb3_0/odom', '/tf')
    """
    if not namespace or topic.startswith("/"):
        return topic
    return f"{namespace.rstrip('/')}/{topic}"


def prefixed(prefix: str, frame: str) -> str:
    """Return a frame with a tf_prefix. No frame begins with a slash (tf2), and one that did gets no prefix.

    See http://wiki.ros.org/geometry/CoordinateFrameConventions.

    >>> prefixed("tb3_0", "odom"), prefixed("", "odom"), prefixed("/tb3_0/", "odom"), prefixed("tb3_0", "/map")
    ('tb3_0/odom', 'odom', 'tb3_0/odom', 'map')
    """
    prefix = prefix.strip("/")
    if not prefix or frame.startswith("/"):
        return frame.lstrip("/")
    return f"{prefix}/{frame}"
