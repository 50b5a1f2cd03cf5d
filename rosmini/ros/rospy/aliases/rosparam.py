"""The module that scripts import as ``rosparam``: YAML files, the Parameter Server (http://wiki.ros.org/rosparam)."""

from __future__ import annotations

import sys
from collections.abc import Sequence
from pathlib import Path
from typing import Any

from rosmini.core.names import join
from rosmini.core.rosparam import NS, RosParamException, RosParamIOException, assignments, documents, dumps, parse
from rosmini.ros.rospy.aliases.rosgraph.masterapi import Master
from rosmini.ros.rospy.aliases.rosgraph.names import GLOBALNS, get_ros_namespace, make_global_ns
from rosmini.ros.rospy.mains import run_tool

__all__ = [
    "NAME",
    "NS",
    "RosParamException",
    "RosParamIOException",
    "delete_param",
    "dump_params",
    "get_param",
    "get_param_server",
    "list_params",
    "load_file",
    "load_str",
    "print_params",
    "set_param",
    "set_param_raw",
    "upload_params",
    "yamlmain",
]

NAME = "rosparam"


def load_file(
    filename: str | None, default_namespace: str | None = None, verbose: bool = False
) -> list[tuple[Any, str]]:
    """Return (parameters, namespace) for each document of a YAML file; ``-`` is stdin. Raises ``RosParamException``."""
    if not filename or filename == "-":
        _say(verbose, "reading parameters from stdin")
        return load_str(sys.stdin.read(), filename, default_namespace, verbose)
    if not Path(filename).is_file():
        raise RosParamException(f"file [{filename}] does not exist")
    _say(verbose, f"reading parameters from [{filename}]")
    return _pairs(documents.load_file(filename, default_namespace or get_ros_namespace()), verbose)


def load_str(
    str: str, filename: str | None, default_namespace: str | None = None, verbose: bool = False
) -> list[tuple[Any, str]]:
    """Return (parameters, namespace) of each document. Raises ``RosParamException`` that names ``filename``."""
    return _pairs(documents.load_str(str, filename or "", default_namespace or get_ros_namespace()), verbose)


def _pairs(found: list[documents.Document], verbose: bool) -> list[tuple[Any, str]]:
    for document in found:
        _say(verbose and document.own_namespace, f"reading parameters into namespace [{document.namespace}]")
    return [(document.values, document.namespace) for document in found]


def get_param_server() -> Master:
    """Return the Master, called in the name of ``/rosparam``."""
    return Master("/rosparam")


def get_param(param: str) -> Any:
    """Return a parameter's value, or a namespace as a dictionary. Raises ``rosgraph.MasterError`` if it is not set."""
    return get_param_server().getParam(param)


def set_param_raw(param: str, value: Any, verbose: bool = False) -> None:
    """Set a parameter; a dictionary is merged into the existing ones. Raises ``RosParamException``."""
    server = get_param_server()
    for name, item in list(assignments(param, value)):
        server.setParam(name, item)
        _say(verbose, f"set parameter [{name}] to [{item}]")


def set_param(param: str, value: str, verbose: bool = False) -> None:
    """Set a parameter to the value of a YAML text. Raises ``RosParamException``."""
    set_param_raw(param, parse(value), verbose)


def upload_params(ns: str, values: Any, verbose: bool = False) -> None:
    """Set the parameters that :func:`load_file` returned. Raises ``RosParamException``."""
    if ns == GLOBALNS and not isinstance(values, dict):
        raise RosParamException("global / can only be set to a dictionary")
    if verbose:
        print_params(values, ns)
    set_param_raw(ns, values)


def dump_params(filename: str | None, param: str, verbose: bool = False) -> None:
    """Write a namespace to a YAML file; without a name, to standard output. Raises ``rosgraph.MasterError``."""
    tree = get_param(param)
    if verbose:
        print_params(tree, param)
    text = dumps(tree)
    if filename:
        Path(filename).write_text(text, encoding="utf-8")
    else:
        sys.stdout.write(text)


def delete_param(param: str, verbose: bool = False) -> None:
    """Delete a parameter or a namespace, or the contents of the root ``/``. Raises ``rosgraph.MasterError``."""
    if param == GLOBALNS:
        get_param_server().setParam(GLOBALNS, {})
        _say(verbose, "deleted ENTIRE parameter server")
        return
    get_param_server().deleteParam(param)
    _say(verbose, f"deleted parameter [{param}]")


def list_params(ns: str) -> list[str]:
    """Return the names of all parameters in a namespace, sorted."""
    within = make_global_ns(ns)
    return sorted(name for name in get_param_server().getParamNames() if name.startswith(within))


def print_params(params: Any, ns: str) -> None:
    """Print a line ``name=value`` for each parameter in a dictionary."""
    if not isinstance(params, dict):
        print(params)
        return
    for key, value in params.items():
        name = join(ns, key)
        if isinstance(value, dict):
            print_params(value, name)
        else:
            print(f"{name}={value}")


def yamlmain(argv: Sequence[str] | None = None) -> None:
    """Run a rosparam command line, ``sys.argv`` if None; raise ``SystemExit`` if it fails."""
    run_tool("rosparam", argv)


def _say(verbose: bool, text: str) -> None:
    if verbose:
        print(text)
