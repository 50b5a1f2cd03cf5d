"""Workspaces to build."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from pathlib import Path

import pytest

from rosmini.ros.catkin import NewPackage, Report, Workspace, create_package, make

MESSAGES = """cmake_minimum_required(VERSION 3.0.2)
project({name})
find_package(catkin REQUIRED COMPONENTS rospy std_msgs message_generation)
add_message_files(FILES Num.msg)
add_service_files(FILES Add.srv)
generate_messages(DEPENDENCIES std_msgs)
catkin_package(CATKIN_DEPENDS std_msgs message_runtime)
catkin_install_python(PROGRAMS scripts/talker.py DESTINATION ${{CATKIN_PACKAGE_BIN_DESTINATION}})
"""
SCRIPT = "#!/usr/bin/env python3\nprint(__file__, __name__)\n"


class Bench:
    """A workspace, and what is done with it."""

    def __init__(self, base: Path) -> None:
        self.base = base
        (base / "src").mkdir(parents=True)
        self.said: list[str] = []

    def package(self, name: str, *needs: str) -> Path:
        """A package with a message, a service and a script."""
        needed = ("rospy", "std_msgs", "message_generation", "message_runtime", *needs)
        create_package(NewPackage(name, needed), self.base / "src", self.said.append)
        folder = self.base / "src" / name
        files = {
            "CMakeLists.txt": MESSAGES.format(name=name),
            "msg/Num.msg": "Header header\nint64 num\n",
            "srv/Add.srv": "int64 a\nint64 b\n---\nint64 sum\n",
            "scripts/talker.py": SCRIPT,
        }
        for path, text in files.items():
            self.write(name, path, text)
        (folder / "scripts/talker.py").chmod(0o755)
        return folder

    def write(self, package: str, path: str, text: str) -> Path:
        """Write a file of a package."""
        file = self.base / "src" / package / path
        file.parent.mkdir(parents=True, exist_ok=True)
        file.write_bytes(text.encode())
        return file

    def change(self, package: str, path: str, old: str, new: str) -> None:
        """Replace a text in a file of a package."""
        file = self.base / "src" / package / path
        text = file.read_text(encoding="utf-8")
        assert old in text
        self.write(package, path, text.replace(old, new))

    def make(self, *only: str, environ: Mapping[str, str] | None = None, **options: bool) -> Report:
        """Build it."""
        return make(Workspace.at(self.base), only, environ=environ or {}, say=self.said.append, **options)


@pytest.fixture
def bench(tmp_path: Path) -> Bench:
    return Bench(tmp_path / "ws")


@pytest.fixture
def benches(tmp_path: Path) -> Callable[[str], Bench]:
    return lambda name: Bench(tmp_path / name)
