"""The module that scripts import as ``rosservice`` (http://wiki.ros.org/rosservice): services, types, classes."""

from __future__ import annotations

from collections.abc import Iterator
from contextlib import contextmanager
from typing import Any

from rosmini.core.errors import MasterUnreachable, RosminiError, TransportException
from rosmini.core.graph import running_graph
from rosmini.ros.introspection import services
from rosmini.ros.introspection.fields import service_class_of

__all__ = [
    "ROSServiceException",
    "ROSServiceIOException",
    "get_service_class_by_name",
    "get_service_list",
    "get_service_node",
    "get_service_type",
    "rosservice_find",
]


class ROSServiceException(RosminiError):
    """Base class of rosservice's errors."""


class ROSServiceIOException(ROSServiceException):
    """The Master or a service does not answer."""


@contextmanager
def _reached() -> Iterator[None]:
    try:
        yield
    except MasterUnreachable as error:
        raise ROSServiceIOException(f"Unable to communicate with master! {error}") from error
    except TransportException as error:
        raise ROSServiceIOException(f"Unable to communicate with service: {error}") from error


def get_service_type(service_name: str) -> str | None:
    """Return the type of a service, or None if no node offers it. Raises ``ROSServiceIOException``."""
    with _reached():
        return services.type_of(running_graph(), service_name)


def get_service_node(service_name: str) -> str | None:
    """Return the node that offers a service, or None."""
    with _reached():
        return services.node_of(running_graph(), service_name)


def get_service_list(node: str | None = None, namespace: str | None = None, include_nodes: bool = False) -> list[Any]:
    """Return the services, of a node and in a namespace if given: names, or [name, nodes] with ``include_nodes``."""
    with _reached():
        found = services.services(running_graph(), namespace)
    chosen = [each for each in found if node is None or node in each.nodes]
    return [[each.name, list(each.nodes)] if include_nodes else each.name for each in chosen]


def rosservice_find(service_type: str) -> list[str]:
    """Return the services of a type."""
    with _reached():
        return services.by_type(running_graph(), service_type)


def get_service_class_by_name(service_name: str) -> Any:
    """Return the class of a service by the service's name. Raises ``ROSServiceException`` if it is unknown."""
    kind = get_service_type(service_name)
    if kind is None:
        raise ROSServiceException(
            f"Service [{service_name}] is not available. {services.what_next(running_graph(), service_name)}"
        )
    cls = service_class_of(kind)
    if cls is None:
        raise ROSServiceException(
            f"Unable to load type [{kind}].\nHave you typed 'make' in [{kind.partition('/')[0]}]?"
        )
    return cls
