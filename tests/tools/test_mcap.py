"""`rosmini mcap convert`."""

from __future__ import annotations

import pytest

from rosmini.core.time import Time
from rosmini.msgs import message_class
from rosmini.ros.bag import Bag
from rosmini.tools.main import main

reader = pytest.importorskip("mcap.reader")


def test_a_bag_is_converted(tmp_path, capsys):
    with Bag(tmp_path / "a.bag", "w") as bag:
        bag.write("/chatter", message_class("std_msgs/String")(data="hello"), Time(1))
    target = tmp_path / "a.mcap"
    assert main(["mcap", "convert", str(tmp_path / "a.bag"), str(target)]) == 0
    assert capsys.readouterr().out == f"1 messages written to {target}\n"
    with target.open("rb") as file:
        [(_, channel, message)] = reader.make_reader(file).iter_messages()
    assert (channel.topic, message.log_time) == ("/chatter", 10**9)


def test_what_cannot_be_read_is_said(tmp_path, capsys):
    assert main(["mcap", "convert", str(tmp_path / "none.bag"), str(tmp_path / "b.mcap")]) == 1
    assert "none.bag" in capsys.readouterr().err
    assert not (tmp_path / "b.mcap").exists()
