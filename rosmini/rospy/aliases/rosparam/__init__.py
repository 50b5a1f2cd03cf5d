"""What scripts import from ``rosparam``: YAML files and the Parameter Server (http://wiki.ros.org/rosparam)."""

from __future__ import annotations

from .api import (
    NAME,
    NS,
    RosParamException,
    RosParamIOException,
    delete_param,
    dump_params,
    get_param,
    get_param_server,
    list_params,
    load_file,
    load_str,
    print_params,
    set_param,
    set_param_raw,
    upload_params,
)
from .command import yamlmain

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
