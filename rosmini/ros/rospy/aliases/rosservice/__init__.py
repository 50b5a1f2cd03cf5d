"""The module that scripts import as ``rosservice`` (http://wiki.ros.org/rosservice): services, types, calls by name."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from contextlib import contextmanager
from typing import Any

from rosmini.core.errors import (
    MasterUnreachable,
    MessageException,
    RosminiError,
    SerializationError,
    ServiceException,
    TransportException,
)
from rosmini.core.graph import running_graph
from rosmini.ros.introspection import services
from rosmini.ros.introspection.fields import service_class_of
from rosmini.ros.rospy.aliases.genpy.message import fill_message_args, get_printable_message_args
from rosmini.ros.rospy.aliases.rosgraph.names import script_resolve_name
from rosmini.ros.rospy.mains import run_tool

__all__ = [
    "NAME",
    "ROSServiceException",
    "ROSServiceIOException",
    "call_service",
    "get_service_args",
    "get_service_class_by_name",
    "get_service_headers",
    "get_service_list",
    "get_service_node",
    "get_service_type",
    "get_service_uri",
    "has_service_args",
    "rosservice_find",
    "rosservicemain",
]

NAME = "rosservice"


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


def get_service_headers(service_name: str, service_uri: str) -> dict[str, str]:
    """Return the header that a service's server sends. Raises ``ROSServiceIOException``."""
    with _reached():
        return services.headers(running_graph(), service_name, service_uri)


def get_service_type(service_name: str) -> str | None:
    """Return the type of a service, or None if no node offers it. Raises ``ROSServiceIOException``."""
    with _reached():
        return services.type_of(running_graph(), service_name)


def get_service_uri(service_name: str) -> str | None:
    """Return the address of a service, or None if no node offers it."""
    with _reached():
        return services.uri_of(running_graph(), service_name)


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


def call_service(service_name: str, service_args: Any, service_class: Any = None) -> tuple[Any, Any]:
    """Call a service with plain values; return the request and the response. Calls init_node if needed.

    Raises ``ROSServiceException`` for invalid values, and if the call fails.
    """
    from rosmini.msgs.std_msgs.msg import Header
    from rosmini.ros.rospy import ServiceProxy, get_rostime, init_node
    from rosmini.ros.rospy.session import current_node

    if current_node() is None:
        init_node(NAME, anonymous=True)
    cls = get_service_class_by_name(service_name) if service_class is None else service_class
    request, now = cls._request_class(), get_rostime()
    try:
        fill_message_args(request, service_args, {"now": now, "auto": Header(stamp=now)})
        return request, ServiceProxy(service_name, cls)(request)
    except SerializationError as error:
        raise ROSServiceException(
            f"Unable to send request. One of the fields has an incorrect type:\n  {error}"
        ) from error
    except (MessageException, ValueError) as error:
        arguments = get_printable_message_args(cls._request_class())
        raise ROSServiceException(
            f"Incompatible arguments to call service:\n{error}\nService arguments are: [{arguments}]"
        ) from error
    except ServiceException as error:
        raise ROSServiceException(str(error)) from error


def has_service_args(service_name: str, service_class: Any = None) -> bool:
    """Return True if the requests of a service have fields."""
    if service_class is None:
        service_class = get_service_class_by_name(script_resolve_name(NAME, service_name))
    return bool(service_class._request_class.__slots__)


def get_service_args(service_name: str) -> str:
    """Return the field names of a service's requests, on one line."""
    cls = get_service_class_by_name(script_resolve_name(NAME, service_name))
    return " ".join(cls._request_class.__slots__)


def rosservicemain(argv: Sequence[str] | None = None) -> None:
    """Run a rosservice command line, ``sys.argv`` if None; raise ``SystemExit`` if it fails."""
    run_tool("rosservice", argv)
