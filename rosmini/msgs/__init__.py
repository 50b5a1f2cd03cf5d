"""Message, service and action classes, made from ``.msg``, ``.srv`` and ``.action`` files as in ROS 1.

    from rosmini.msgs.std_msgs.msg import String        # always
    from std_msgs.msg import String                     # after rosmini.msgs.install()
    String = rosmini.msgs.message_class("std_msgs/String")

All three return the same class. Classes exist for every package on the path (those of rosmini and
those on ROS_PACKAGE_PATH), and are made on first use. ``define_message`` makes a class from a text that
is not in a file.
"""

from __future__ import annotations

from typing import Any

from .importer import enable_own_imports, install, installed, uninstall
from .message import Message
from .registry import define_action, define_message, define_service
from .registry import registry as _registry

__all__ = [
    "Message",
    "action_class",
    "define_action",
    "define_message",
    "define_service",
    "install",
    "installed",
    "message_class",
    "service_class",
    "uninstall",
]

enable_own_imports()


def message_class(name: str) -> type[Any]:
    """Return the class of a message type such as "std_msgs/String".

    Raises ``UnknownType`` or ``UnknownPackage`` with similar names, and
    :class:`~rosmini.core.errors.DefinitionError` with file and line if a definition is wrong.
    """
    return _registry().message_class(name)


def service_class(name: str) -> type[Any]:
    """Return the class of a service type such as "std_srvs/SetBool"; raises as :func:`message_class` does."""
    return _registry().service_class(name)


def action_class(name: str) -> type[Any]:
    """Return the class of an action such as "move_base_msgs/MoveBase"; raises as :func:`message_class` does."""
    return _registry().action_class(name)


def __getattr__(name: str) -> Any:
    if name.startswith("_"):
        raise AttributeError(f"module '{__name__}' has no attribute '{name}'")
    from importlib import import_module

    return import_module(f"{__name__}.{name}")


def __dir__() -> list[str]:
    return [*__all__, *_registry().source.packages()]
