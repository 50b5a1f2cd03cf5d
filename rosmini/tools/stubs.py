"""`rosmini stubs`: type stubs of what scripts import, for editors and type checkers.

An editor sees no `rospy` and no `std_msgs.msg`: rosmini makes them when a script runs. With these files VS Code
completes `from std_msgs.msg import String`, and mypy checks scripts (`MYPYPATH=typings mypy talker.py`). `typings` is
where VS Code looks. Packages on ROS_PACKAGE_PATH are included.
"""

from __future__ import annotations

import argparse
import ast
import importlib.util
import sys
from pathlib import Path

from rosmini.core import files
from rosmini.core.errors import RosminiError

HEAD = "# Written by rosmini stubs; changes here are lost.\n"


def add_parser(subparsers: argparse._SubParsersAction[argparse.ArgumentParser]) -> argparse.ArgumentParser:
    """Add `stubs`."""
    parser = subparsers.add_parser(
        "stubs",
        help="write type stubs of rospy and of messages, for editors",
        description=__doc__,
        epilog="for example, in the folder that is open in VS Code: rosmini stubs",
        formatter_class=argparse.RawDescriptionHelpFormatter,
    )
    parser.add_argument(
        "folder", nargs="?", type=Path, default=Path("typings"), help="where to write them (default: typings)"
    )
    return parser


def main(args: argparse.Namespace) -> int:
    """Write the stubs; return 1 if the types of a package could not be read."""
    texts, problems = stub_files()
    written = write(args.folder, texts)
    for problem in problems:
        print(problem, file=sys.stderr)
    print(f"{written} files written, {len(texts) - written} up to date in {args.folder}")
    return 1 if problems else 0


def stub_files() -> tuple[dict[str, str], list[str]]:
    """Return the stub files by path, and the problems of packages, which are then omitted."""
    from rosmini.core.packages import PackageIndex, assets_dir
    from rosmini.msgs.registry import registry
    from rosmini.msgs.sources import PackageSource
    from rosmini.msgs.stubs import package_stubs
    from rosmini.ros.rospy.importer import homes

    own = {*PackageSource(PackageIndex([assets_dir() / "ros"])).packages()}
    modules = homes()
    texts: dict[str, str] = {}
    problems: list[str] = []
    types = registry()
    for package in types.source.packages():
        if package in own:
            kinds = [("msg", types.messages(package)), ("srv", types.services(package))]
            modules |= {f"{package}.{kind}": f"rosmini.msgs.{package}.{kind}" for kind, names in kinds if names}
            continue
        try:
            found = package_stubs(
                types, package, HEAD, lambda other: f"rosmini.msgs.{other}" if other in own else other
            )
        except RosminiError as error:
            problems.append(f"{package} is left out: {error}")
            continue
        texts |= {f"{package}/{name}": text for name, text in found.items()}
    return {**aliases(modules), **texts}, problems


def aliases(modules: dict[str, str]) -> dict[str, str]:
    """Return stub files, by path, for modules that ROS knows under another name."""
    packages = {name.rpartition(".")[0] for name in modules} - {""}
    texts = {}
    for name in sorted({*modules, *packages}):
        inside = sorted(each for each in modules if each.rpartition(".")[0] == name)
        lines = [f"from {modules[name]} import *"] if name in modules else []
        has = exported(modules[name]) if inside and name in modules else set()
        names = [last for each in inside if (last := each.rpartition(".")[2]) not in has]
        lines += [f"from . import {last} as {last}" for last in names]
        path = name.replace(".", "/") + ("/__init__.pyi" if inside else ".pyi")
        texts[path] = HEAD + "".join(f"{line}\n" for line in lines)
    return texts


def exported(module: str) -> set[str]:
    """Return the imported names that ``from module import *`` binds; empty if the module is not found."""
    found = importlib.util.find_spec(module)
    if found is None or found.origin is None or not found.origin.endswith(".py"):
        return set()
    tree = ast.parse(files.read(found.origin))
    for node in tree.body:
        if isinstance(node, ast.Assign) and any(isinstance(to, ast.Name) and to.id == "__all__" for to in node.targets):
            return set(ast.literal_eval(node.value))
    imports = (node for node in tree.body if isinstance(node, (ast.Import, ast.ImportFrom)))
    return {name.asname or name.name for node in imports for name in node.names}


def write(folder: Path, texts: dict[str, str]) -> int:
    """Write the files that are missing or outdated, and return their number.

    Raises ``RosminiError``, without writing any, if another file is in the way.
    """
    changed = {}
    for name, text in texts.items():
        path = folder / name
        before = path.read_text(encoding="utf-8") if path.is_file() else HEAD
        if not before.startswith(HEAD):
            raise RosminiError(f"{path} is not of rosmini's making: move it away, or name another folder")
        if before != text:
            changed[path] = text
    try:
        for path, text in changed.items():
            path.parent.mkdir(parents=True, exist_ok=True)
            path.write_text(text, encoding="utf-8", newline="\n")
    except OSError as error:
        raise RosminiError(f"cannot write {error.filename}: {error.strerror}") from error
    return len(changed)
