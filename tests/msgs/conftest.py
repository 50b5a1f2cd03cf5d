"""A workspace of packages with definitions, and a registry over it."""

from __future__ import annotations

from collections.abc import Callable
from pathlib import Path

import pytest

from rosmini.core.packages import PackageIndex, assets_dir
from rosmini.msgs.registry import Registry
from rosmini.msgs.sources import PackageSource

MANIFEST = """<package format="2"><name>{name}</name><version>0.0.1</version><description>A test.</description>
<maintainer email="a@example.com">A</maintainer><license>Apache-2.0</license></package>
"""


@pytest.fixture
def workspace(tmp_path: Path) -> Callable[[dict[str, str]], Path]:
    """Writes files such as ``{"my_msgs/msg/Pair.msg": "int32 a"}`` with a manifest for each package."""

    def write(files: dict[str, str]) -> Path:
        for name, text in files.items():
            path = tmp_path / name
            path.parent.mkdir(parents=True, exist_ok=True)
            path.write_text(text, encoding="utf-8")
            package = tmp_path / name.partition("/")[0]
            (package / "package.xml").write_text(MANIFEST.format(name=package.name), encoding="utf-8")
        return tmp_path

    return write


@pytest.fixture
def make_registry(workspace: Callable[[dict[str, str]], Path]) -> Callable[[dict[str, str]], Registry]:
    """A registry over such a workspace and the packages that come with rosmini."""

    def make(files: dict[str, str]) -> Registry:
        return Registry(PackageSource(PackageIndex([workspace(files), assets_dir() / "ros"])))

    return make
