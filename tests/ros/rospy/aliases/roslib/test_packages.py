"""Where packages are, and what is in them."""

from __future__ import annotations

import os

import pytest

from rosmini.core.errors import UnknownPackage
from rosmini.ros.rospy.aliases.roslib import packages

MANIFEST = (
    "<package><name>mine</name><version>1.0.0</version><description>.</description>"
    "<maintainer email='a@b.c'>a</maintainer><license>x</license></package>"
)


@pytest.fixture
def package(tmp_path, monkeypatch):
    """A package with an executable, a file beside it, and a folder of data."""
    home = tmp_path / "src" / "mine"
    (home / "scripts").mkdir(parents=True)
    (home / "package.xml").write_text(MANIFEST, encoding="utf-8")
    for name, mode in (("talker", 0o755), ("notes", 0o644)):
        (home / "scripts" / name).write_text("", encoding="utf-8")
        (home / "scripts" / name).chmod(mode)
    monkeypatch.setenv("ROS_PACKAGE_PATH", str(tmp_path / "src"))
    return home


def test_folders(package):
    assert packages.get_pkg_dir("mine") == str(package)
    assert packages.get_dir_pkg(str(package / "scripts" / "talker")) == (str(package.resolve()), "mine")
    assert packages.get_dir_pkg("/") == (None, None)
    assert packages.get_pkg_subdir("mine", "maps", required=False) == str(package / "maps")
    assert not (package / "maps").exists()
    packages.get_pkg_subdir("mine", "maps")
    assert (package / "maps").is_dir()
    assert packages.resource_file("mine", "maps", "a.yaml") == str(package / "maps" / "a.yaml")


def test_another_package_path(package, monkeypatch):
    monkeypatch.delenv("ROS_PACKAGE_PATH")
    assert packages.get_pkg_dir("mine", required=False) is None
    assert packages.get_pkg_dir("mine", ros_package_path=str(package.parent)) == str(package)


@pytest.mark.skipif(os.name == "nt", reason="Windows has no bit that says what can be run")
def test_what_is_in_a_package(package):
    assert packages.find_node("mine", "talker") == [str(package / "scripts" / "talker")]
    assert packages.find_node("mine", "notes") == []
    assert packages.find_resource("mine", "notes") == [str(package / "scripts" / "notes")]


def test_no_package():
    for ask in (
        packages.get_pkg_dir,
        lambda name: packages.resource_file(name, "a", "b"),
        lambda name: packages.find_node(name, "x"),
    ):
        with pytest.raises(packages.InvalidROSPkgException) as caught:
            ask("no_such_package")
        assert isinstance(caught.value, packages.ROSPkgException)
        assert isinstance(caught.value, UnknownPackage)
