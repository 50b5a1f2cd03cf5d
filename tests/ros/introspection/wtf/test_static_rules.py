"""The rules on the environment and on packages."""

from __future__ import annotations

import sys
from pathlib import Path

import pytest

from rosmini.core.packages import PackageIndex, search_paths
from rosmini.ros.introspection.wtf.static_rules import RULES

MANIFEST = """<package format="2"><name>{}</name><version>1.0.0</version><description>x</description>
<maintainer email="ada@example.org">A</maintainer><license>BSD</license>{}</package>"""


@pytest.fixture
def package(tmp_path: Path) -> Path:
    folder = tmp_path / "src" / "mine"
    (folder / "scripts").mkdir(parents=True)
    (folder / "package.xml").write_text(
        MANIFEST.format("mine", "<depend>rospy</depend><depend>my_msgs</depend>"), encoding="utf-8"
    )
    return folder


def found(*roots: Path) -> dict[str, tuple[str, ...]]:
    path = ":".join(map(str, roots)) if sys.platform != "win32" else ";".join(map(str, roots))
    index = PackageIndex([*roots, *search_paths({})])
    environ = {"ROS_PACKAGE_PATH": path}
    return {each.rule: each.where for rule in RULES for each in rule(environ, index)}


def script(package: Path, content: bytes, mode: int = 0o755, name: str = "run.py") -> None:
    path = package / "scripts" / name
    path.write_bytes(content)
    path.chmod(mode)


def test_a_workspace_that_is_well(package: Path) -> None:
    script(package, b"#!/usr/bin/env python3\nimport rospy\n")
    script(package, b"import rospy\n", 0o644, "module.py")
    script(package, b"#!/bin/sh\n", name="not_python")
    index = found(package.parent)
    assert index.pop("missing_dependencies") == ("mine: my_msgs",)
    assert index == {}


def test_a_folder_that_is_not_there(package: Path, tmp_path: Path) -> None:
    assert found(package.parent, tmp_path / "gone")["missing_folders"] == (str(tmp_path / "gone"),)


@pytest.mark.parametrize("text", ["<package>", MANIFEST.format("mine", "<version>2</version>")])
def test_a_manifest_that_cannot_be_read(package: Path, text: str) -> None:
    (package / "package.xml").write_text(text, encoding="utf-8")
    where = found(package.parent)["broken_manifests"]
    assert len(where) == 1
    assert "package.xml" in where[0]
