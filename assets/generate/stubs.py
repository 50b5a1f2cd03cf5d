"""Type stubs for the messages and services that come with rosmini: `rosmini/msgs/<package>/msg.pyi`.

Type checkers and editors find them there. Packages of a workspace have none; their classes are `Any` to a type checker.
"""

from __future__ import annotations

from pathlib import Path

from rosmini.msgs.definition import BYTES, INTEGER_RANGES, Field, MessageSpec
from rosmini.msgs.registry import Registry
from rosmini.msgs.sources import PackageSource
from rosmini.packages import PackageIndex, assets_dir

HEAD = "# Written by python -m assets.generate; do not edit.\n"


def stub_files(registry: Registry) -> dict[str, str]:
    """The texts of all stub files by their path below ``rosmini/msgs``, sorted."""
    files: dict[str, str] = {}
    for package in registry.source.packages():
        messages, services = registry.messages(package), registry.services(package)
        if not messages and not services:
            continue
        modules = [name for name, found in (("msg", messages), ("srv", services)) if found]
        imports = "".join(f"from . import {module} as {module}\n" for module in modules)
        files[f"{package}/__init__.pyi"] = HEAD + imports
        if messages:
            files[f"{package}/msg.pyi"] = _module(registry, [f"{package}/{name}" for name in messages], [])
        if services:
            halves = [f"{package}/{name}{half}" for name in services for half in ("Request", "Response")]
            files[f"{package}/srv.pyi"] = _module(registry, halves, services)
    return dict(sorted(files.items()))


def write_stubs(root: Path) -> list[Path]:
    """Write the stubs of the packages that come with rosmini into a folder, and remove those of packages that are gone.

    Returns the paths that changed: none if the stubs were fresh.
    """
    files = stub_files(_bundled())
    changed = []
    for path in sorted(root.glob("*/*.pyi")):
        if path.relative_to(root).as_posix() not in files:
            path.unlink()
            changed.append(path)
    for name, text in files.items():
        path = root / name
        if not path.exists() or path.read_text(encoding="utf-8") != text:
            path.parent.mkdir(parents=True, exist_ok=True)
            path.write_text(text, encoding="utf-8", newline="\n")
            changed.append(path)
    return changed


def _bundled() -> Registry:
    return Registry(PackageSource(PackageIndex([assets_dir() / "ros"])))


def _module(registry: Registry, messages: list[str], services: list[str]) -> str:
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
        bases.append(f"from rosmini.time import {', '.join(f'{name} as _{name}' for name in times)}")
    imports = [f"from rosmini.msgs.{other} import msg as _{other}" for other in sorted(others)]
    typing = "from typing import Any, ClassVar, Sequence, overload\n"
    return HEAD + typing + "\n".join(sorted([*bases, *imports])) + "\n\n" + text


def _message(spec: MessageSpec, own_module: str, others: set[str]) -> str:
    lines = [f"class {spec.short_name}(_Message):"]
    lines += [
        f"    {constant.name}: ClassVar[{type(constant.value).__name__}]" for constant in spec.constants
    ]
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
    """What a field holds, and what a constructor takes for it.

    An array may hold a list (yours), a tuple (received) or a numpy array (from the object API), which no one type
    covers: it reads as ``Any`` for numbers, and as a list for the rest.
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
