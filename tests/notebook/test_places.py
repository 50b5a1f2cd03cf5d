"""Paths as the book shows them, and back."""

import io
import os

import pytest

from rosmini.core.errors import UnknownPackage
from rosmini.core.packages import PackageIndex
from rosmini.notebook.places import OutsideHome, Places, ShownStream


@pytest.fixture
def places(tmp_path):
    return Places(tmp_path)


def test_paths_are_shown_as_on_a_robot(places):
    share = PackageIndex().path("turtlebot3_description")
    text = f'{places.home}: {places.home / "ws" / "src"}, "{share}"; {places.home}-other'
    assert places.shown(text) == (f'~: ~/ws/src, "/opt/ros/noetic/share/turtlebot3_description"; {places.home}-other')


def test_a_stream_can_be_dropped_after_what_is_behind_it(places):
    """Python 3.13 and later complain of what a stream's end raises."""
    target = io.StringIO()
    stream = ShownStream(target, places)
    target.close()
    stream.close()


def test_folders_that_are_one_on_a_robot_are_listed_once(places):
    with pytest.raises(UnknownPackage) as caught:
        PackageIndex().path("no_such_package")
    shown = places.shown(str(caught.value))
    assert shown.count("/opt/ros/noetic/share") == 1
    assert shown.startswith("there is no package 'no_such_package'")


def test_and_back(places):
    home = str(places.home)
    assert places.real("~/a/b") == home + "/a/b"
    assert places.real("_map:=~/map.yaml") == f"_map:={home}/map.yaml"
    assert places.real("/opt/ros/noetic/share/x") == f"{places.shares[0]}/x"
    for package in ("rospy", "std_msgs"):
        path = str(PackageIndex().path(package))
        shown = f"/opt/ros/noetic/share/{package}"
        assert (places.shown(path), places.real(shown)) == (shown, path)
    for same in ("~rate", "/~", "data: ~", "/opt/ros/noetic/shared"):
        assert places.real(same) == same


def test_nothing_outside_is_reached(places):
    inside = places.home / "ws"
    inside.mkdir()
    assert places.find("..", inside) == places.home
    assert places.find("~/new/file", inside, writes=True) == places.home / "new" / "file"
    for word in ("/etc/passwd", "../..", "~/../x", "/", "src/../../../x"):
        with pytest.raises(OutsideHome, match="Permission denied"):
            places.find(word, inside)
    with pytest.raises(OutsideHome, match="read-only"):
        places.find("/opt/ros/noetic/share/std_msgs/x", inside, writes=True)
    assert places.find("/opt/ros/noetic/share/std_msgs", inside).is_dir()


@pytest.mark.skipif(os.name == "nt", reason="a link needs permission there")
def test_a_link_that_leads_out_is_not_followed(places):
    (places.home / "out").symlink_to("/etc")
    with pytest.raises(OutsideHome):
        places.find("out/passwd", places.home)


def test_a_stream_shows_them(places, capsys):
    import sys

    stream = ShownStream(sys.stdout, places)
    print("in", places.home / "x", file=stream)
    assert capsys.readouterr().out == "in ~/x\n"
