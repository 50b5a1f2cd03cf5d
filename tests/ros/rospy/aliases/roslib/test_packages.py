"""Where packages are."""

from __future__ import annotations

import pytest

from rosmini.core.errors import UnknownPackage
from rosmini.ros.rospy.aliases.roslib import packages

MANIFEST = (
    "<package><name>mine</name><version>1.0.0</version><description>.</description>"
    "<maintainer email='a@b.c'>a</maintainer><license>x</license></package>"
)


@pytest.fixture
def package(tmp_path, monkeypatch):
    """The folder of a package on the path."""
    home = tmp_path / "src" / "mine"
    home.mkdir(parents=True)
    (home / "package.xml").write_text(MANIFEST, encoding="utf-8")
    monkeypatch.setenv("ROS_PACKAGE_PATH", str(tmp_path / "src"))
    return home


def test_folders(package):
    assert packages.get_pkg_dir("mine") == str(package)


def test_another_package_path(package, monkeypatch):
    monkeypatch.delenv("ROS_PACKAGE_PATH")
    assert packages.get_pkg_dir("mine", required=False) is None
    assert packages.get_pkg_dir("mine", ros_package_path=str(package.parent)) == str(package)


def test_no_package():
    with pytest.raises(packages.InvalidROSPkgException) as caught:
        packages.get_pkg_dir("no_such_package")
    assert isinstance(caught.value, packages.ROSPkgException)
    assert isinstance(caught.value, UnknownPackage)
