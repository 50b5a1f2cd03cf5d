"""Proxies for the Master and the Parameter Server as in rospy: ``rospy.get_master()``."""

from __future__ import annotations

from collections.abc import Callable, Iterator
from functools import partial
from typing import Any
from urllib.parse import urlsplit

from rosmini.core.errors import ROSException
from rosmini.core.graph import running_graph
from rosmini.core.graph.master_port import METHODS

from .names import resolve_name
from .session import any_node


class MasterProxy:
    """The Master's API with the caller's name added; answers are (code, status, value).

    ``proxy["/rate"]``, ``proxy["/rate"] = 10``, ``"/rate" in proxy``, ``del proxy["/rate"]`` and iteration access
    parameters.
    """

    def __init__(self, uri: str) -> None:
        self.target = uri

    def __getattr__(self, key: str) -> Callable[..., Any]:
        if key not in METHODS:
            raise AttributeError(f"the Master has no method {key}", name=key, obj=self)
        return partial(any_node().master.call, key)

    def __getitem__(self, key: str) -> Any:
        return any_node().get_param(key)

    def __setitem__(self, key: str, val: Any) -> None:
        any_node().set_param(key, val)

    def __delitem__(self, key: str) -> None:
        any_node().delete_param(key)

    def __contains__(self, key: str) -> bool:
        return any_node().has_param(key)

    def __iter__(self) -> Iterator[str]:
        return iter(any_node().param_names())

    def search_param(self, key: str) -> str | None:
        """Return the full name of the nearest parameter with this name upwards from the node, or None."""
        node = any_node()
        mapped = node.remappings.names.get(key, key)
        return node.search_param(resolve_name(mapped) if mapped.startswith("~") else mapped)

    def get_param_cached(self, key: str) -> Any:
        """Return a parameter's value. Raises ``KeyError``."""
        return self[key]


class SlaveProxy:
    """The slave API of the node at ``uri`` (http://wiki.ros.org/ROS/Slave_API): ``proxy.getPid("/me")``.

    Answers are [code, status, value]. A call raises ``TransportException`` if there is no answer.
    """

    def __init__(self, uri: str) -> None:
        self.uri = uri

    @staticmethod
    def accepts(uri: str) -> bool:
        """Return True if this has the form of a node's address."""
        parts = urlsplit(uri)
        return parts.scheme in ("http", "https") and bool(parts.netloc)

    def __getattr__(self, key: str) -> Callable[..., Any]:
        if key.startswith("_"):
            raise AttributeError(f"the slave API has no method {key}", name=key, obj=self)
        return partial(running_graph().transport.call, self.uri, key)


def published_topics(namespace: str) -> list[list[str]]:
    """Return the ``[topic, type]`` pairs of published topics under ``namespace``. Raises ``ROSException``."""
    code, status, value = any_node().master.call("getPublishedTopics", namespace)
    if code != 1:
        raise ROSException(f"unable to get published topics: {status}")
    return [list(pair) for pair in value]
