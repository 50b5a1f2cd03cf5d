"""The ROS Master: which nodes publish, subscribe and offer services, and the Parameter Server.

The Master introduces nodes to each other and then steps aside: no message goes through it. Each method is one call of
the Master API (http://wiki.ros.org/ROS/Master_API) or of the Parameter Server API
(http://wiki.ros.org/ROS/Parameter%20Server%20API). It has the same name and arguments, and returns the same list of

- a code: 1 success, 0 failure (the call had a bad effect), -1 error (the call had no effect);
- a human-readable status text;
- a value, or a dummy of its type if the call failed.

A call never raises: wrong arguments give the code -1. The :class:`~rosmini.core.graph.notices.Notices` inform other
nodes; they only post events, so a method of the Master may call them while it works.
"""

# ruff: noqa: ARG002 - every call has a caller_id, whether it needs one or not
from __future__ import annotations

import functools
import os
import threading
from dataclasses import dataclass, field
from typing import TYPE_CHECKING, Any, Concatenate, ParamSpec

from rosmini.core.errors import ParameterError
from rosmini.core.names import resolve_for

from .master_port import METHODS, MasterPort
from .parameters import ParameterTree, closed, updates, wire_copy

if TYPE_CHECKING:
    from collections.abc import Callable, Mapping

    from .notices import Notices

    Check = Callable[[Any, str], Any]

Triple = list[Any]
P = ParamSpec("P")


# ---- argument checks; each returns the argument, resolved if it is a name ----


class _Invalid(Exception):
    """An argument breaks the API's rules; the text becomes the status of the response."""


def _text(argument: str) -> Check:
    def check(value: Any, _caller: str) -> str:
        if not value:
            raise _Invalid(f"ERROR: parameter [{argument}] must be specified and non-empty")
        if not isinstance(value, str):
            raise _Invalid(f"ERROR: parameter [{argument}] must be a string")
        return value

    return check


def _key(value: Any, caller: str) -> str:
    return resolve_for(_text("key")(value, caller), caller)


def _given(value: Any, _caller: str) -> Any:
    if value is None:
        raise _Invalid("ERROR: parameter [value] must be specified")
    return value


def _anything(value: Any, _caller: str) -> Any:
    return value


def _uri(argument: str) -> Check:
    def check(value: Any, _caller: str) -> str:
        if not value or not isinstance(value, str):
            raise _Invalid(f"ERROR: parameter [{argument}] is not an XMLRPC URI")
        if not value.startswith(("http://", "rosrpc://")):
            raise _Invalid(f"ERROR: parameter [{argument}] is not an RPC URI")
        return value

    return check


def _name(argument: str, *, may_be_root: bool = False) -> Check:
    def check(value: Any, caller: str) -> str:
        if not value or not isinstance(value, str):
            raise _Invalid(f"ERROR: parameter [{argument}] must be a non-empty string")
        if ":" in value or " " in value:
            raise _Invalid(f"ERROR: parameter [{argument}] contains illegal chars")
        if value == "/" and not may_be_root:
            raise _Invalid(f"ERROR: parameter [{argument}] cannot be the global namespace")
        return resolve_for(value, caller)

    return check


def _type(value: Any, _caller: str) -> str:
    if not value or not isinstance(value, str):
        raise _Invalid("ERROR: parameter [topic_type] must be a non-empty string")
    if value != "*" and value.count("/") != 1:
        raise _Invalid("ERROR: parameter [topic_type] is not a valid package resource name")
    return value


def _subgraph(value: Any, caller: str) -> str:
    if not isinstance(value, str):
        raise _Invalid("ERROR: parameter [subgraph] must be a string")
    return resolve_for(value, caller) if value else ""


def _api(
    on_error: Any, *checks: Check
) -> Callable[[Callable[Concatenate[Master, P], Triple]], Callable[Concatenate[Master, P], Triple]]:
    """Decorate an API method: check the arguments after ``caller_id``, and return the value ``on_error`` for errors."""

    def failed(code: int, status: str) -> Triple:
        return [code, status, wire_copy(on_error)]

    def decorate(method: Callable[Concatenate[Master, P], Triple]) -> Callable[Concatenate[Master, P], Triple]:
        call: Callable[..., Triple] = method

        @functools.wraps(method)
        def answer(self: Master, /, *arguments: P.args, **keywords: P.kwargs) -> Triple:
            if not arguments:
                return failed(-1, "missing required caller_id parameter")
            caller, *rest = arguments
            if len(rest) != len(checks) or keywords:
                return failed(-1, "Error: bad call arity")
            if not isinstance(caller, str):
                return failed(-1, "caller_id must be a string")
            try:
                checked = [check(value, caller) for check, value in zip(checks, rest, strict=True)]
                with self._lock:
                    return call(self, caller, *checked)
            except _Invalid as error:
                return failed(-1, str(error))
            except ParameterError as error:
                return failed(-1, f"Error: invalid arguments: {error}")
            except ValueError as error:
                return failed(0, f"Internal failure: {error}")

        return answer

    return decorate


# ---- registries ----


@dataclass
class _Registered:
    """A node and its registrations: pairs of a registry's name and a key. A node without registrations is forgotten."""

    api: str
    holds: set[tuple[str, str]] = field(default_factory=set)


class _Registry:
    """The registrations for each key: ``{key: [(caller_id, caller_api), ...]}``, in the order of registration."""

    def __init__(self, name: str) -> None:
        self.name = name
        self.entries: dict[str, list[tuple[str, str]]] = {}

    def apis(self, key: str) -> list[str]:
        return [api for _, api in self.entries.get(key, [])]

    def state(self) -> list[list[Any]]:
        return [[key, [caller for caller, _ in entries]] for key, entries in self.entries.items()]

    def add(self, key: str, entry: tuple[str, str]) -> None:
        entries = self.entries.setdefault(key, [])
        if entry not in entries:
            entries.append(entry)

    def remove(self, key: str, entry: tuple[str, str]) -> bool:
        entries = self.entries.get(key, [])
        if entry not in entries:
            return False
        entries.remove(entry)
        if not entries:
            del self.entries[key]
        return True

    def forget(self, caller_id: str) -> None:
        kept = {key: [entry for entry in entries if entry[0] != caller_id] for key, entries in self.entries.items()}
        self.entries = {key: entries for key, entries in kept.items() if entries}


class Master(MasterPort):
    """A ROS Master with its Parameter Server: a plain object, to be called directly or served over XML-RPC.

    Args:
        uri: the address that ``getUri`` returns.
        notifier: sends notices to other nodes.
        parameters: the Parameter Server's tree; an empty one if not given.

    """

    is_local = True

    def __init__(self, uri: str, notifier: Notices, parameters: ParameterTree | None = None) -> None:
        self.uri = uri
        self.shutdown_reason: str | None = None
        self._lock = threading.RLock()  # nodes in real threads call it too
        self._notifier = notifier
        self._parameters = ParameterTree() if parameters is None else parameters
        self._nodes: dict[str, _Registered] = {}
        self._topic_types: dict[str, str] = {}
        self._publishers = _Registry("publisher")
        self._subscribers = _Registry("subscriber")
        self._services = _Registry("service")
        self._param_subscribers = _Registry("parameter")
        # Node and address of each service; None until the first service is registered: until then unregisterService
        # returns another status, as in ROS.
        self._service_apis: dict[str, tuple[str, str]] | None = None

    def call(self, method: str, caller_id: str, *arguments: Any) -> Triple:
        """Call an API method by its name; an unknown name gives code -1."""
        if method not in METHODS:
            return [-1, f'method "{method}" is not supported', 0]
        answer: Triple = getattr(self, method)(caller_id, *arguments)
        return answer

    def move(self, addresses: Mapping[str, str]) -> None:
        """Replace old addresses of nodes and of their services by new ones, without notifying other nodes."""

        def now(entry: tuple[str, str]) -> tuple[str, str]:
            return entry[0], addresses.get(entry[1], entry[1])

        with self._lock:
            for node in self._nodes.values():
                node.api = addresses.get(node.api, node.api)
            for registry in (self._publishers, self._subscribers, self._services, self._param_subscribers):
                registry.entries = {key: [now(each) for each in entries] for key, entries in registry.entries.items()}
            if self._service_apis is not None:
                self._service_apis = {key: now(entry) for key, entry in self._service_apis.items()}

    def forget_nodes(self) -> None:
        """Forget all nodes and their registrations without notifying any; parameters stay."""
        with self._lock:
            self._nodes.clear()
            self._service_apis = None
            for registry in (self._publishers, self._subscribers, self._services, self._param_subscribers):
                registry.entries.clear()

    # ---- the Master itself ----

    @_api(0, _anything)
    def shutdown(self, caller_id: str, msg: str) -> Triple:
        """Stop the Master: set ``shutdown_reason``, which the code that serves it checks."""
        self.shutdown_reason = f"external shutdown request from [{caller_id}]: {msg}"
        return [1, "shutdown", 0]

    @_api("")
    def getUri(self, caller_id: str) -> Triple:
        """Return the Master's address."""
        return [1, "", self.uri]

    @_api(-1)
    def getPid(self, caller_id: str) -> Triple:
        """Return the id of the Master's process."""
        return [1, "", os.getpid()]

    # ---- topics ----

    @_api([], _name("topic"), _type, _uri("caller_api"))
    def registerPublisher(self, caller_id: str, topic: str, topic_type: str, caller_api: str) -> Triple:
        """Register a publisher and notify its topic's subscribers. Returns their addresses."""
        self._register(self._publishers, topic, caller_id, caller_api)
        if topic_type != "*" or topic not in self._topic_types:
            self._topic_types[topic] = topic_type
        self._tell_subscribers(topic)
        return [1, f"Registered [{caller_id}] as publisher of [{topic}]", self._subscribers.apis(topic)]

    @_api(0, _name("topic"), _uri("caller_api"))
    def unregisterPublisher(self, caller_id: str, topic: str, caller_api: str) -> Triple:
        """Remove a publisher and notify its topic's subscribers. Returns how many were removed (0 or 1)."""
        answer = self._unregister(self._publishers, topic, caller_id, caller_api)
        if answer[2]:
            self._tell_subscribers(topic)
        return answer

    @_api([], _name("topic"), _type, _uri("caller_api"))
    def registerSubscriber(self, caller_id: str, topic: str, topic_type: str, caller_api: str) -> Triple:
        """Register a subscriber. Returns the addresses of the topic's publishers."""
        self._register(self._subscribers, topic, caller_id, caller_api)
        if topic_type != "*":
            self._topic_types.setdefault(topic, topic_type)
        return [1, f"Subscribed to [{topic}]", self._publishers.apis(topic)]

    @_api(0, _name("topic"), _uri("caller_api"))
    def unregisterSubscriber(self, caller_id: str, topic: str, caller_api: str) -> Triple:
        """Remove a subscriber. Returns how many were removed (0 or 1)."""
        return self._unregister(self._subscribers, topic, caller_id, caller_api)

    # ---- services ----

    @_api(0, _name("service"), _uri("service_api"), _uri("caller_api"))
    def registerService(self, caller_id: str, service: str, service_api: str, caller_api: str) -> Triple:
        """Register a service at ``service_api``, replacing one of the same name."""
        self._register(self._services, service, caller_id, caller_api)
        self._services.entries[service] = [(caller_id, caller_api)]
        self._service_apis = {**(self._service_apis or {}), service: (caller_id, service_api)}
        return [1, f"Registered [{caller_id}] as provider of [{service}]", 1]

    @_api(0, _name("service"), _uri("service_api"))
    def unregisterService(self, caller_id: str, service: str, service_api: str) -> Triple:
        """Remove a service if it is still at ``service_api``. Returns how many were removed (0 or 1)."""
        if caller_id not in self._nodes:
            return [1, f"[{caller_id}] is not a registered node", 0]
        if self._service_apis is None:
            return [1, f"[{caller_id}] is not a provider of [{service}]", 0]
        if self._service_apis.get(service) != (caller_id, service_api):
            return [1, f"[{service_api}] is no longer the current service api handle for [{service}]", 0]
        del self._service_apis[service]
        del self._services.entries[service]
        self._let_go(caller_id, self._services, service)
        return [1, f"Unregistered [{caller_id}] as provider of [{service}]", 1]

    @_api("", _name("service"))
    def lookupService(self, caller_id: str, service: str) -> Triple:
        """Return the ``rosrpc`` URI of a service; the code is -1 if no node offers it."""
        _, uri = (self._service_apis or {}).get(service, (None, None))
        return [1, f"rosrpc URI: [{uri}]", uri] if uri else [-1, "no provider", ""]

    # ---- the state of the graph ----

    @_api("", _name("node", may_be_root=True))
    def lookupNode(self, caller_id: str, node_name: str) -> Triple:
        """Return the XML-RPC URI of a node; the code is -1 for an unknown node."""
        node = self._nodes.get(node_name)
        return [1, "node api", node.api] if node else [-1, f"unknown node [{node_name}]", ""]

    @_api(0, _subgraph)
    def getPublishedTopics(self, caller_id: str, subgraph: str) -> Triple:
        """Return ``[topic, type]`` for each published topic in the namespace ``subgraph`` (``""``: in all)."""
        within = subgraph if subgraph.endswith("/") or not subgraph else subgraph + "/"
        topics = [[topic, self._topic_types[topic]] for topic in self._publishers.entries if topic.startswith(within)]
        return [1, "current topics", topics]

    @_api([])
    def getTopicTypes(self, caller_id: str) -> Triple:
        """Return ``[topic, type]`` for each topic that was ever registered with a type."""
        return [1, "current system state", [list(pair) for pair in self._topic_types.items()]]

    @_api([[], [], []])
    def getSystemState(self, caller_id: str) -> Triple:
        """Return publishers, subscribers and services, each as a list of ``[name, [node, ...]]``."""
        registries = (self._publishers, self._subscribers, self._services)
        return [1, "current system state", [registry.state() for registry in registries]]

    # ---- the Parameter Server ----

    @_api(0, _key, _given)
    def setParam(self, caller_id: str, key: str, value: Any) -> Triple:
        """Set a parameter; a dictionary replaces the whole namespace ``key``."""
        self._parameters.set(key, value)
        self._tell_param_subscribers(key, wire_copy(value, key), setter=caller_id)
        return [1, f"parameter {key} set", 0]

    @_api(0, _key)
    def getParam(self, caller_id: str, key: str) -> Triple:
        """Return a parameter, or the namespace ``key`` as a dictionary; the code is -1 if it is not set."""
        try:
            return [1, f"Parameter [{key}]", self._parameters.get(key)]
        except KeyError:
            return [-1, f"Parameter [{key}] is not set", 0]

    @_api(False, _key)
    def hasParam(self, caller_id: str, key: str) -> Triple:
        """Return True if ``key`` is a parameter that is set, or a namespace."""
        return [1, key, key in self._parameters]

    @_api(0, _key)
    def deleteParam(self, caller_id: str, key: str) -> Triple:
        """Delete a parameter, or the whole namespace ``key``; the code is -1 if it is not set."""
        try:
            self._parameters.delete(key)
        except KeyError:
            return [-1, f"parameter [{key}] is not set", 0]
        self._tell_param_subscribers(key, {})
        return [1, f"parameter {key} deleted", 0]

    @_api(0, _text("key"))
    def searchParam(self, caller_id: str, key: str) -> Triple:
        """Return the full name of the nearest ``key``, going up from the caller's own name, or the code -1."""
        found = self._parameters.search(caller_id, key)
        if found is None:
            return [-1, f"Cannot find parameter [{key}] in an upwards search", ""]
        return [1, f"Found [{found}]", found]

    @_api([])
    def getParamNames(self, caller_id: str) -> Triple:
        """Return the names of all parameters."""
        return [1, "Parameter names", self._parameters.names()]

    @_api(0, _uri("caller_api"), _key)
    def subscribeParam(self, caller_id: str, caller_api: str, key: str) -> Triple:
        """Return a parameter (``{}`` if it is not set), and notify the caller of its changes from now on."""
        value = self._parameters.get(key) if key in self._parameters else {}
        self._register(self._param_subscribers, closed(key), caller_id, caller_api)
        return [1, f"Subscribed to parameter [{key}]", value]

    @_api(0, _uri("caller_api"), _key)
    def unsubscribeParam(self, caller_id: str, caller_api: str, key: str) -> Triple:
        """Stop notifying the caller of a parameter. ROS returns 1 even if there was no subscription."""
        self._unregister(self._param_subscribers, closed(key), caller_id, caller_api)
        return [1, f"Unsubscribe to parameter [{key}]", 1]

    # ---- implementation ----

    def _register(self, registry: _Registry, key: str, caller_id: str, caller_api: str) -> None:
        known = self._nodes.get(caller_id)
        if known is None or known.api != caller_api:
            # A node of this name at another address is a new node: the old one must shut down.
            self._nodes[caller_id] = _Registered(caller_api)
            if known is not None:
                self._forget(caller_id)
                self._notifier.shutdown(known.api, f"[{caller_id}] Reason: new node registered with same name")
        self._nodes[caller_id].holds.add((registry.name, key))
        registry.add(key, (caller_id, caller_api))
        self._notifier.registrations_changed()

    def _unregister(self, registry: _Registry, key: str, caller_id: str, caller_api: str) -> Triple:
        if caller_id not in self._nodes:
            return [1, f"[{caller_id}] is not a registered node", 0]
        if not registry.remove(key, (caller_id, caller_api)):
            return [1, f"[{caller_id}] is not a known provider of [{key}]", 0]
        self._let_go(caller_id, registry, key)
        self._notifier.registrations_changed()
        return [1, f"Unregistered [{caller_id}] as provider of [{key}]", 1]

    def _let_go(self, caller_id: str, registry: _Registry, key: str) -> None:
        node = self._nodes[caller_id]
        node.holds.discard((registry.name, key))
        if not node.holds:
            del self._nodes[caller_id]

    def _forget(self, caller_id: str) -> None:
        for registry in (self._publishers, self._subscribers, self._services, self._param_subscribers):
            registry.forget(caller_id)
        if self._service_apis:
            self._service_apis = {key: entry for key, entry in self._service_apis.items() if entry[0] != caller_id}

    def _tell_subscribers(self, topic: str) -> None:
        publishers = self._publishers.apis(topic)
        for api in self._subscribers.apis(topic):
            self._notifier.publisher_update(api, topic, list(publishers))

    def _tell_param_subscribers(self, key: str, value: Any, setter: str | None = None) -> None:
        subscribed = self._param_subscribers.entries
        for name, changed, part in updates(list(subscribed), key, value):
            # ROS does not notify the setter of the value that it set, but does notify it of the parts of a dictionary.
            spared = setter if changed == closed(key) else None
            for caller, api in subscribed[name]:
                if caller != spared:
                    self._notifier.param_update(api, changed, wire_copy(part))
