"""`rosmini rosservice`: the verbs of ROS's tool, with its options and output (http://wiki.ros.org/rosservice).

In a terminal they act on the graph of the Master at ``ROS_MASTER_URI``; in Python on a graph of this process, where
they return data: ``TOOL.run("call", "/set_bool", "true", graph=graph).response.success``.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING, Any, ClassVar

from rosmini.core.errors import MessageException, ROSException, SerializationError, ServiceException, TransportException
from rosmini.core.verbs import Call, Lines, Overview, Parser, Result, Tool, VerbError, global_name, tool_node
from rosmini.ros.introspection import services

from .values import WrongYaml, fields_of, fill, parse

if TYPE_CHECKING:
    from optparse import Values

    from rosmini.core.graph import Node

TOOL = Tool(
    "rosservice", "services: list them, show their types and nodes; call one", example="call",
    purpose="calling and listing ROS Services", overview=Overview(has_heading=False), failure_status=2,
)  # fmt: skip


def _parser(usage: str, description: str, example: str) -> Parser:
    return Parser("rosservice", f"%prog {usage}", description, example=f"  rosmini rosservice {example}")


def _one_service(parser: Parser, given: Values) -> str:
    """Return the only service named on a command line. Raises ``UsageError``."""
    if not given.words:
        parser.error("service must be specified")
    if len(given.words) > 1:
        parser.error("you may only specify one input service")
    return global_name(given.words[0])


def _failed(text: str) -> VerbError:
    return VerbError(f"ERROR: {text}", status=2)


def _type_of(call: Call, name: str) -> str | None:
    """Return the type of a service, or None. Raises ``VerbError`` if its server does not answer."""
    try:
        return services.type_of(call.peers, name)
    except TransportException as error:
        uri = services.uri_of(call.peers, name)
        raise _failed(
            f"Unable to communicate with service [{name}], address [{uri}]\n{error}\nIf its node has crashed, "
            "`rosnode cleanup` takes it off the Master's list."
        ) from error


def _class_of(call: Call, name: str) -> Any:
    """Return the class of a service. Raises ``VerbError`` if no node offers it, or its type is unknown."""
    from rosmini.ros.introspection.fields import service_class_of

    kind = _type_of(call, name)
    if kind is None:
        if services.uri_of(call.peers, name) is not None:
            raise _failed(f"Unable to determine type of service [{name}].")
        raise _failed(f"Service [{name}] is not available.\n{services.what_next(call.peers, name)}")
    cls = service_class_of(kind) or service_class_of(kind.removesuffix("Request"))  # so says roscpp of some
    if cls is None:
        package, _, short = kind.partition("/")
        raise _failed(
            f"Unable to load type [{kind}].\nHave you typed 'make' in [{package}]?\n"
            f"The package {package} must be in a folder on ROS_PACKAGE_PATH, with srv/{short}.srv in it."
        )
    return cls


# -- args ------------------------------------------------------------------------------------------------------------


def _args_parser() -> Parser:
    return _parser("args /service", "List the arguments of a service.", "args /set_bool")


@TOOL.verb("print service arguments", parser=_args_parser, only_asks=True, takes="service")
def args(given: Values, call: Call) -> Lines:
    """List the fields of a service's request."""
    cls = _class_of(call, _one_service(_args_parser(), given))
    return Arguments(lines=(" ".join(cls._request_class.__slots__),))


@dataclass(frozen=True, kw_only=True)
class Arguments(Lines):
    """The fields of a request, on one line."""

    always_printed: ClassVar[bool] = True


# -- call ------------------------------------------------------------------------------------------------------------


@dataclass(frozen=True, kw_only=True)
class Called(Result):
    """The last request that was sent, and the response."""

    request: Any
    response: Any
    text: str
    always_printed: ClassVar[bool] = True

    def __str__(self) -> str:
        return self.text


def _call_parser() -> Parser:
    text = "Call a service. A value that begins with a minus sign comes after a lone --."
    parser = _parser("call /service [args...]", text, "call /set_bool 'data: true'")
    parser.flag("-v", dest="verbose", help="print the request, too")
    parser.flag("--wait", dest="wait", help="wait until somebody offers the service")
    return parser


@TOOL.verb("call the service with the provided args", name="call", parser=_call_parser, takes="service")
def call_(given: Values, call: Call) -> Result:
    """Call a service."""
    usage = _call_parser()
    if not given.words:
        usage.error("service must be specified")
    name = global_name(given.words[0])
    try:
        values = [parse(text) if text else "" for text in given.words[1:]]
    except WrongYaml as error:
        usage.error(f"Argument error: {error}")
    with tool_node(call.graph, "rosservice") as node:
        if given.wait:
            try:
                node.wait_for_service(name)
            except KeyboardInterrupt:
                return Result()  # as ROS does
            except ROSException as error:  # for instance, no event is left in the graph
                raise _failed(str(error)) from error
        cls = _class_of(call, name)
        if not values and cls._request_class.__slots__:
            usage.error(f"Please specify service arguments\n{name} takes: {fields_of(cls._request_class)}")
        return _called(node, name, cls, values, verbose=given.verbose)


def _called(node: Node, name: str, cls: Any, values: list[Any], *, verbose: bool) -> Called:
    from rosmini.core.time import Time

    request = cls._request_class()
    try:
        fill(request, values, Time.from_nsec(node.scheduler.now_ns()))
    except (MessageException, ValueError) as error:
        given = "\n".join(f" * {value} (type {type(value).__name__})" for value in values)
        raise _failed(
            f"Incompatible arguments to call service:\n{error}\nProvided arguments are:\n{given}\n\n"
            f"Service arguments are: [{fields_of(cls._request_class)}]"
        ) from error
    try:
        response = node.service_client(name, cls, numpy=False).call(request)
    except SerializationError as error:
        from rosmini.ros.introspection.types import SERVICE

        raise _failed(
            f"Unable to send request. One of the fields has an incorrect type:\n  {error}\n\n"
            f"srv file:\n{SERVICE.text(cls._type)}"
        ) from error
    except ServiceException as error:
        raise _failed(str(error)) from error
    text = f"{request}\n---\n{response}" if verbose else str(response)
    return Called(request=request, response=response, text=text)


# -- find, info, list ------------------------------------------------------------------------------------------------


@dataclass(frozen=True, kw_only=True)
class ServiceList(Result):
    """Services, sorted by name; with their nodes in the text if requested."""

    services: tuple[services.Service, ...]
    with_nodes: bool = False

    @property
    def names(self) -> tuple[str, ...]:
        """Names of the services."""
        return tuple(each.name for each in self.services)

    def __str__(self) -> str:
        if not self.with_nodes:
            return "\n".join(self.names)
        return "\n".join(f"{each.name} {','.join(each.nodes)}" for each in self.services)


@dataclass(frozen=True, kw_only=True)
class Found(Lines):
    """The services of a type."""

    always_printed: ClassVar[bool] = True

    @property
    def names(self) -> tuple[str, ...]:
        """Names of the services."""
        return self.lines


def _find_parser() -> Parser:
    return _parser("find msg-type", "List the services of a type.", "find std_srvs/Empty")


@TOOL.verb("find services by service type", parser=_find_parser, only_asks=True, takes="srv")
def find(given: Values, call: Call) -> Found:
    """List the services of a type."""
    if not given.words:
        _find_parser().error("please specify a message type")
    if len(given.words) > 1:
        _find_parser().error("you may only specify one message type")
    wanted = given.words[0]
    names = services.by_type(call.peers, wanted)
    if names:
        return Found(lines=tuple(names))
    from rosmini.core.errors import nearest
    from rosmini.ros.introspection.fields import service_class_of
    from rosmini.ros.introspection.types import SERVICE

    hint = None if service_class_of(wanted) else nearest(wanted, SERVICE.all())
    return Found(complaints=(hint,) if hint else ())


def _info_parser() -> Parser:
    return _parser("info /service", "Say who offers a service, where, of which type.", "info /set_bool")


@dataclass(frozen=True, kw_only=True)
class ServiceInfo(Result):
    """The node that offers a service, its address, its type and the fields of its request."""

    node: str
    uri: str
    type: str
    args: str

    def __str__(self) -> str:
        return f"Node: {self.node}\nURI: {self.uri}\nType: {self.type}\nArgs: {self.args}"


@TOOL.verb("print information about service", parser=_info_parser, only_asks=True, takes="service")
def info(given: Values, call: Call) -> ServiceInfo:
    """Describe a service."""
    if not given.words:
        _info_parser().error("you must specify a service name")
    if len(given.words) > 1:
        _info_parser().error("you may only specify one service")
    name = global_name(given.words[0])
    node = services.node_of(call.peers, name)
    if node is None:
        raise VerbError(f"ERROR: unknown service\n{services.what_next(call.peers, name)}")
    uri, kind = services.uri_of(call.peers, name), _type_of(call, name)
    if uri is None or kind is None:
        raise VerbError(f"Node: {node}\nERROR: service is no longer available", status=0)
    return ServiceInfo(node=node, uri=uri, type=kind, args=" ".join(_class_of(call, name)._request_class.__slots__))


def _list_parser() -> Parser:
    parser = _parser("list [/namespace]", "List the services, or those in a namespace.", "list -n /talker")
    parser.flag("-n", "--nodes", dest="print_nodes", help="with the nodes that offer them")
    return parser


@TOOL.verb("list active services", name="list", parser=_list_parser, only_asks=True, takes="service")
def list_(given: Values, call: Call) -> ServiceList:
    """List services."""
    if len(given.words) > 1:
        _list_parser().error("you may only specify one input namespace")
    found = services.services(call.peers, global_name(given.words[0]) if given.words else None)
    return ServiceList(services=tuple(sorted(found)), with_nodes=given.print_nodes)


# -- type, uri, node -------------------------------------------------------------------------------------------------


def _type_parser() -> Parser:
    return _parser("type /service", "Print the type of a service.", "type /set_bool")


@TOOL.verb("print service type", name="type", parser=_type_parser, only_asks=True, takes="service")
def type_(given: Values, call: Call) -> Lines:
    """Return the type of a service."""
    name = _one_service(_type_parser(), given)
    kind = _type_of(call, name)
    if kind is None:
        raise VerbError(f"Unknown service [{name}]\n{services.what_next(call.peers, name)}")
    return Lines(lines=(kind,))


def _uri_parser() -> Parser:
    return _parser("uri /service", "Print the address of a service.", "uri /set_bool")


@TOOL.verb("print service ROSRPC uri", parser=_uri_parser, only_asks=True, takes="service")
def uri(given: Values, call: Call) -> Lines:
    """Return the address of a service."""
    name = _one_service(_uri_parser(), given)
    return _known(services.uri_of(call.peers, name), name, call)


def _known(found: str | None, name: str, call: Call) -> Lines:
    if found is None:
        raise VerbError(f"Unknown service: {name}\n{services.what_next(call.peers, name)}")
    return Lines(lines=(found,))
