"""Reads ``<node>``, ``<test>`` and ``<machine>`` elements into the plan."""

from __future__ import annotations

import shlex
from typing import TYPE_CHECKING, Any

from rosmini.core.names import canonicalize, is_legal_name

from .errors import Place
from .plan import TIME_LIMIT_S, Machine, NodePlan, TestPlan
from .settings import read_env, read_param, read_remap, read_rosparam
from .values import flag, positive, seconds

if TYPE_CHECKING:
    from rosmini.core.markup import Element

    from .loading import Loading
    from .scope import Scope

NODE = (
    *("pkg", "type", "machine", "name", "args", "output", "respawn", "respawn_delay", "cwd", "ns", "clear_params"),
    *("launch-prefix", "required"),
)
TEST = (*NODE, "test-name", "time-limit", "retry")
MACHINE = ("name", "address", "env-loader", "ssh-port", "user", "password", "default", "timeout")
MAX_RETRIES = 100
OLD_MACHINE = ("ros-root", "ros-package-path", "ros-ip", "ros-hostname")


def read_node(loading: Loading, element: Element, scope: Scope) -> NodePlan | TestPlan:
    """Return the plan of a ``<node>`` or ``<test>``, and set its parameters. Raises ``LaunchError``."""
    is_test = element.tag == "test"
    loading.check_attributes(element, TEST if is_test else NODE)
    for_test = _test_options(loading, element, scope) if is_test else {}
    name = loading.optional(element, scope, "name") if is_test else loading.required(element, scope, "name")
    name = name or for_test.get("test_name", "")
    if not name:
        raise element.error(f"<{element.tag}>: its name is empty")
    if "/" in name:
        raise element.error(
            f"node name cannot contain a namespace, and this is {name!r}: give the namespace as "
            f'ns="{name.rpartition("/")[0]}"'
        )
    if not is_legal_name(name):
        loading.warn(element, f"illegal <node> name '{name}' (http://wiki.ros.org/Names): other tools will not like it")
    inside = loading.scope_inside(element, scope, name)
    _children(loading, element, scope, inside, name)
    loading.count_copies(element, len(inside.remappings) + len(inside.environment))
    package, kind = (loading.required(element, scope, each) for each in ("pkg", "type"))
    for what, said in (("pkg", package), ("type", kind)):
        if not said.strip():
            raise element.error(f"<{element.tag}>: '{what}' must be non-empty")
    found: dict[str, Any] = {
        "package": package,
        "type": kind,
        "name": name,
        "namespace": inside.namespace,
        "place": Place(element.path, element.line),
        "remappings": tuple(inside.remappings.items()),
        "environment": tuple(inside.environment.items()),
        **_options(loading, element, scope),
    }
    return TestPlan(**found, **for_test) if is_test else NodePlan(**found)


def _children(loading: Loading, element: Element, scope: Scope, inside: Scope, name: str) -> None:
    """Read the children of a node: remappings and environment into the scope ``inside``, and its parameters."""
    own = inside.child(name)
    own.private = {}
    for child in element.children:
        if not loading.applies(child, scope):
            continue
        if child.tag == "remap":
            read_remap(loading, child, inside)
        elif child.tag == "param":
            read_param(loading, child, own, local=True)
        elif child.tag == "rosparam":
            read_rosparam(loading, child, own)
        elif child.tag == "env":
            read_env(loading, child, inside)
        else:
            loading.warn(child, f"unrecognized '{child.tag}' child tag in the parent tag <{element.tag}>")
    for key, setting in {**scope.private, **own.private}.items():
        loading.set(canonicalize(f"{own.namespace}{key}"), setting.value, setting.place, setting.source)


def _test_options(loading: Loading, element: Element, scope: Scope) -> dict[str, Any]:
    """Return the options that a ``<test>`` has in addition to those of a node."""
    for name in ("respawn", "respawn_delay", "output"):
        if name in element.attributes:
            raise element.error(f"<test> tags cannot have '{name}' attribute")
    retry = loading.optional(element, scope, "retry") or "0"
    if not (retry.isascii() and retry.isdecimal()):
        raise element.error(f"'retry' must be a number: [{retry}]")
    limit = loading.optional(element, scope, "time-limit") or None
    return {
        "test_name": loading.required(element, scope, "test-name"),
        "time_limit": positive(element, "time-limit", limit, TIME_LIMIT_S),
        "retry": min(int(retry.lstrip("0")[:9] or "0"), MAX_RETRIES),
    }


def _options(loading: Loading, element: Element, scope: Scope) -> dict[str, Any]:
    machine, args, output, respawn, delay, cwd, prefix, required = (
        loading.optional(element, scope, name)
        for name in ("machine", "args", "output", "respawn", "respawn_delay", "cwd", "launch-prefix", "required")
    )
    options = {
        "respawn": flag(element, "respawn", respawn),
        "required": flag(element, "required", required),
        "respawn_delay": seconds(element, "respawn_delay", delay),
    }
    if options["respawn"] and options["required"]:
        raise element.error("respawn and required cannot both be set to true")
    if output not in (None, "log", "screen"):
        raise element.error(f"output must be one of 'log', 'screen', and this is {output!r}")
    if cwd is not None and cwd.lower() not in ("ros_home", "node", "ros-root", "cwd"):
        raise element.error(f"cwd must be one of 'ROS_HOME', 'node', and this is {cwd!r}")
    for name, text in (("args", args), ("launch-prefix", prefix)):
        try:
            shlex.split(text or "")
        except ValueError as error:
            raise element.error(f'{name}="{text}" cannot be split into words: {error}') from error
    if machine:
        loading.machine_needed(element, machine)
    return {
        **options,
        "machine": machine or loading.default_machine,
        "args": args or "",
        "output": output or "log",
        "cwd": cwd,
        "launch_prefix": prefix or "",
    }


def read_machine(loading: Loading, element: Element, scope: Scope) -> Machine:
    """Return the machine that a ``<machine>`` declares. Raises ``LaunchError``."""
    old = [name for name in OLD_MACHINE if name in element.attributes]
    if old:
        raise element.error(
            f"<machine>: {old[0]}: ros-* attributes are not supported since ROS Fuerte. Please use env-loader instead"
        )
    loading.check_attributes(element, MACHINE)
    for child in element.children:
        if child.tag == "env":
            raise child.error("<machine>: <env> tag is not supported since ROS Fuerte. Please use env-loader instead")
        loading.warn(child, f"unrecognized '{child.tag}' tag in <machine> tag")
    default = (loading.optional(element, scope, "default") or "false").lower()
    if default not in ("true", "false", "never"):
        raise element.error(f'<machine>: default="{default}" is none of true, false, never')
    port = loading.optional(element, scope, "ssh-port") or "22"
    if not (port.isascii() and port.isdecimal() and 0 < int(port) < 65536):
        raise element.error(f'<machine>: ssh-port="{port}" is not the number of a port, 1 to 65535')
    timeout = loading.optional(element, scope, "timeout")
    if timeout == "":
        raise element.error("<machine>: 'timeout' cannot be empty")
    password = loading.optional(element, scope, "password") or ""
    if password:
        loading.warn(element, "a password in a launch file is read by everybody who reads the file: use SSH keys")
    return Machine(
        name=loading.required(element, scope, "name"),
        address=loading.required(element, scope, "address"),
        place=Place(element.path, element.line),
        env_loader=loading.optional(element, scope, "env-loader") or "",
        ssh_port=int(port),
        user=loading.optional(element, scope, "user") or "",
        password=password,
        timeout=positive(element, "timeout", timeout, 10.0),
        is_default=default == "true",
    )
