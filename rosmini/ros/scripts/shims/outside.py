"""``subprocess`` and ``xmlrpc.client`` as one script sees them: where the graph is online, it goes on meanwhile.

A child process of a script may be a tool that asks a node of this graph, and a call by XML-RPC may go to such a node:
both would wait for ever if the graph stood still. Where the graph is not online, nobody can reach it, and the modules
block as ever.
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

    from rosmini.ros.scripts.script import Script

_CALLS = ("run", "call", "check_call", "check_output", "getoutput", "getstatusoutput")


def _going_on(context: Script, function: Callable[..., Any]) -> Callable[..., Any]:
    """Return a function that does the same and lets the graph go on meanwhile."""

    @functools.wraps(function)
    def call(*args: Any, **kwargs: Any) -> Any:
        return context.outside(functools.partial(function, *args, **kwargs))

    return call


def make_subprocess(context: Script) -> ModuleType:
    """Make a ``subprocess`` whose functions and whose ``Popen.wait`` and ``communicate`` let the graph go on."""
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


def make_xmlrpc(context: Script) -> ModuleType:  # noqa: ARG001 - the signature of all makers
    """Make the package ``xmlrpc`` of one script."""
    return copy_of(xmlrpc)


def make_xmlrpc_client(context: Script) -> ModuleType:
    """Make an ``xmlrpc.client`` whose calls let the graph go on."""
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
