"""Type stubs of messages and services, whose generated classes type checkers and editors cannot see."""

from __future__ import annotations

from typing import TYPE_CHECKING

from .definition import BYTES, INTEGER_RANGES, Field, MessageSpec

if TYPE_CHECKING:
    from collections.abc import Callable

    from .registry import Registry


def package_stubs(registry: Registry, package: str, head: str, module_of: Callable[[str], str]) -> dict[str, str]:
    """Return the stub files of a package, by their path in its folder; none if it has no definitions.

    ``head`` is their first line; ``module_of`` returns the module that contains another package's stubs. Raises as
    :meth:`Registry.definition` does.
    """
    messages, services = registry.messages(package), registry.services(package)
    modules = [name for name, found in (("msg", messages), ("srv", services)) if found]
    files = {}
    if modules:
        files["__init__.pyi"] = head + "".join(f"from . import {module} as {module}\n" for module in modules)
    if messages:
        files["msg.pyi"] = head + _module(registry, [f"{package}/{name}" for name in messages], [], module_of)
    if services:
        halves = [f"{package}/{name}{half}" for name in services for half in ("Request", "Response")]
        files["srv.pyi"] = head + _module(registry, halves, services, module_of)
    return files


def _module(registry: Registry, messages: list[str], services: list[str], module_of: Callable[[str], str]) -> str:
    specs = [registry.definition(name) for name in messages]
    others: set[str] = set()
    own_module = "srv" if services else "msg"
    body = [_message(spec, own_module, others) for spec in specs]
    body += [
        f"class {name}(_Service):\n"
        f"    _request_class: ClassVar[type[{name}Request]]\n"
        f"    _response_class: ClassVar[type[{name}Response]]\n"
        for name in services
    ]
    bases = ["from rosmini.msgs.message import Message as _Message"]
    bases += ["from rosmini.msgs.registry import Service as _Service"] if services else []
    text = "\n".join(body)
    times = [name for name in ("Duration", "Time") if f"_{name}" in text]
    if times:
        bases.append(f"from rosmini.core.time import {', '.join(f'{name} as _{name}' for name in times)}")
    imports = [f"from {module_of(other)} import msg as _{other}" for other in sorted(others)]
    typing = "from typing import Any, ClassVar, Sequence, overload\n"
    return typing + "\n".join(sorted([*bases, *imports])) + "\n\n" + text


def _message(spec: MessageSpec, own_module: str, others: set[str]) -> str:
    lines = [f"class {spec.short_name}(_Message):"]
    lines += [f"    {constant.name}: ClassVar[{type(constant.value).__name__}]" for constant in spec.constants]
    types = [(field.name, *_types(field, spec.package, own_module, others)) for field in spec.fields]
    lines += [f"    {name}: {read}" for name, read, _ in types]
    by_position = ", ".join(f"{name}: {write} | None" for name, _, write in types)
    by_keyword = ", ".join(f"{name}: {write} | None = ..." for name, _, write in types)
    if not types:
        lines.append("    def __init__(self) -> None: ...")
    else:
        lines.append("    @overload")
        lines.append(f"    def __init__(self, *, {by_keyword}) -> None: ...")
        lines.append("    @overload")
        lines.append(f"    def __init__(self, {by_position}, /) -> None: ...")
    return "\n".join(lines) + "\n"


def _types(field: Field, package: str, own_module: str, others: set[str]) -> tuple[str, str]:
    """Return the type of a field, and the type that the constructor accepts for it.

    An array may be a list (yours), a tuple (received) or a numpy array (object API), for which there is no common
    type: it is annotated as ``Any`` for numbers, and as a list otherwise.
    """
    base = field.base
    if base in INTEGER_RANGES:
        single = "int"
    elif base in ("float32", "float64"):
        single = "float"
    elif base == "bool":
        single = "bool"
    elif base == "string":
        single = "str"
    elif base in ("time", "duration"):
        single = f"_{base.capitalize()}"
    else:
        owner, _, short = base.partition("/")
        if owner == package and own_module == "msg":
            single = short
        else:
            others.add(owner)
            single = f"_{owner}.{short}"
    if field.size is None:
        return single, single
    if base in BYTES:
        return "Any", "bytes | Sequence[int] | Any"
    if base in INTEGER_RANGES or base in ("float32", "float64", "bool"):
        return "Any", f"Sequence[{single}] | Any"
    return f"list[{single}]", f"Sequence[{single}]"
