"""Type stubs for the messages and services that come with rosmini: `rosmini/msgs/<package>/msg.pyi`.

Type checkers and editors find them there. Packages of a workspace have none; their classes are `Any` to a type checker.
"""

from __future__ import annotations

from pathlib import Path

from rosmini.core.packages import PackageIndex, assets_dir
from rosmini.msgs.registry import Registry
from rosmini.msgs.sources import PackageSource
from rosmini.msgs.stubs import package_stubs

HEAD = "# Written by python -m assets.generate; do not edit.\n"


def stub_files(registry: Registry) -> dict[str, str]:
    """The texts of all stub files by their path below ``rosmini/msgs``, sorted."""
    files = {
        f"{package}/{name}": text
        for package in registry.source.packages()
        for name, text in package_stubs(registry, package, HEAD, "rosmini.msgs.{}".format).items()
    }
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
