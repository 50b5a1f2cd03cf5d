"""Type stubs of rosmini's messages and services: `rosmini/msgs/<package>/msg.pyi`, written by `build_hook.py`.

Type checkers and editors find them there. For packages of a workspace, `rosmini stubs` writes some.
"""

from __future__ import annotations

from pathlib import Path

from rosmini.core.packages import PackageIndex, assets_dir
from rosmini.msgs.registry import Registry
from rosmini.msgs.sources import PackageSource
from rosmini.msgs.stubs import package_stubs

HEAD = "# Written by assets/generate/build_hook.py; do not edit.\n"


def stub_files(registry: Registry) -> dict[str, str]:
    """Return the texts of all stub files by their path below ``rosmini/msgs``, sorted."""
    files = {
        f"{package}/{name}": text
        for package in registry.source.packages()
        for name, text in package_stubs(registry, package, HEAD, "rosmini.msgs.{}".format).items()
    }
    return dict(sorted(files.items()))


def write_stubs(root: Path) -> list[Path]:
    """Write the stubs of rosmini's packages into a folder, and remove those of packages that no longer exist.

    Returns the changed paths: none if the stubs were up to date.
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
