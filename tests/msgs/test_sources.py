"""Where definitions are read from."""

from __future__ import annotations

from collections.abc import Callable
from pathlib import Path

from rosmini.core.packages import PackageIndex, assets_dir
from rosmini.msgs.sources import PackageSource


def test_a_package_with_headers_only_hides_no_messages(workspace: Callable[[dict[str, str]], Path]) -> None:
    """Debian's libstd-msgs-dev puts a manifest without messages into /usr/share."""
    folder = workspace({"std_msgs/cmake/std_msgs.cmake": ""})
    alone, with_ours = (
        PackageSource(PackageIndex([folder])),
        PackageSource(PackageIndex([folder, assets_dir() / "ros"])),
    )
    assert (alone.has_package("std_msgs"), alone.names("std_msgs", "msg")) == (False, [])
    assert with_ours.has_package("std_msgs")
    assert "String" in with_ours.names("std_msgs", "msg")


def test_messages_of_a_workspace_go_before_ours(workspace: Callable[[dict[str, str]], Path]) -> None:
    folder = workspace({"std_msgs/msg/Mine.msg": "int32 a"})
    assert PackageSource(PackageIndex([folder, assets_dir() / "ros"])).names("std_msgs", "msg") == ["Mine"]
