"""The chapter Bags: its script runs as the page lists it."""

from __future__ import annotations

import re

from rosmini.core.time import Time
from rosmini.msgs import message_class
from rosmini.ros.bag import Bag
from rosmini.ros.scripts import ScriptSpec, run_scripts


def test_the_listed_script_runs(prose, tmp_path, monkeypatch, capsys):
    (script,) = re.findall(r"^```python\n(import rosbag\n.*?)^```", prose, re.DOTALL | re.MULTILINE)
    monkeypatch.chdir(tmp_path)
    twist = message_class("geometry_msgs/Twist")()
    twist.linear.x = 0.25
    with Bag("drive.bag", "w") as bag:
        bag.write("/cmd_vel", twist, Time(5))
    assert run_scripts([ScriptSpec("reader", source=script)], prefix=False).status == 0
    assert capsys.readouterr().out == "5.0 0.25\n"
