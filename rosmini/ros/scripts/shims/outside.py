"""``subprocess`` and ``xmlrpc.client`` for one script: a graph that is online runs on during their calls.

A child process of a script may be a tool that calls a node of this graph, and an XML-RPC call may go to such a node:
both would wait for ever if the graph did not run. If the graph is not online, no process can reach it, and the
modules block as usual.
"""

from __future__ import annotations

import functools
import subprocess as real_subprocess
import xmlrpc
import xmlrpc.client as real_client
from typing import TYPE_CHECKING, Any

from . import copy_of

if TYPE_CHECKING:
    from collections.abc import Callable
    from types import ModuleType

    from rosmini.ros.scripts.context import ScriptContext

_CALLS = ("run", "call", "check_call", "check_output", "getoutput", "getstatusoutput")


def _going_on(context: ScriptContext, function: Callable[..., Any]) -> Callable[..., Any]:
    """Return a function that does the same while the graph runs."""

    @functools.wraps(function)
    def call(*args: Any, **kwargs: Any) -> Any:
        return context.outside(functools.partial(function, *args, **kwargs))

    return call


def make_subprocess(context: ScriptContext) -> ModuleType:
    """Create a ``subprocess`` whose functions, ``Popen.wait`` and ``communicate`` let the graph run."""
    module = copy_of(real_subprocess)

    class Popen(real_subprocess.Popen):  # type: ignore[type-arg]
        def __init__(self, *args: Any, **kwargs: Any) -> None:
            super().__init__(*args, **kwargs)
            context.keep_pace(lambda: self.poll() is None)

        wait = _going_on(context, real_subprocess.Popen.wait)
        communicate = _going_on(context, real_subprocess.Popen.communicate)

    module.__dict__["Popen"] = Popen
    for name in _CALLS:
        module.__dict__[name] = _going_on(context, getattr(real_subprocess, name))
    return module


def make_xmlrpc(context: ScriptContext) -> ModuleType:  # noqa: ARG001 - the signature of all makers
    """Create the package ``xmlrpc`` of one script."""
    return copy_of(xmlrpc)


def make_xmlrpc_client(context: ScriptContext) -> ModuleType:
    """Create an ``xmlrpc.client`` whose calls let the graph run."""
    module = copy_of(real_client)

    class Transport(real_client.Transport):
        request = _going_on(context, real_client.Transport.request)

    class ServerProxy(real_client.ServerProxy):
        def __init__(self, uri: str, transport: Any = None, *args: Any, **kwargs: Any) -> None:
            if transport is None and not uri.startswith("https:"):
                options = {key: kwargs[key] for key in ("use_datetime", "use_builtin_types") if key in kwargs}
                transport = Transport(**options)
            super().__init__(uri, transport, *args, **kwargs)

    module.__dict__.update(Transport=Transport, ServerProxy=ServerProxy, Server=ServerProxy)
    return module
