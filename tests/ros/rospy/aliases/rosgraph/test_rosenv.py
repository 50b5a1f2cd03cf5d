"""Where the Master is, as scripts ask."""

from __future__ import annotations

import pytest

from rosmini.ros.rospy.aliases.rosgraph import Master, get_master_uri


def test_the_masters_uri(sim, monkeypatch):
    monkeypatch.delenv("ROS_MASTER_URI", raising=False)
    assert get_master_uri() == sim.master_uri
    monkeypatch.setenv("ROS_MASTER_URI", "http://robot:11311")
    assert get_master_uri() == Master("/here").master_uri == "http://robot:11311"
    assert get_master_uri(env={"ROS_MASTER_URI": "http://other:1"}) == "http://other:1"
    assert get_master_uri(argv=["prog", "__master:=http://third:1"]) == "http://third:1"
    assert Master("/here", "http://fourth:1").master_uri == "http://fourth:1"
    with pytest.raises(ValueError, match="__master"):
        get_master_uri(argv=["__master:="])
