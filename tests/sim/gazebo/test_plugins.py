"""Plugins that users write."""

from __future__ import annotations

from dataclasses import dataclass

import pytest

from rosmini.core.markup import MarkupError, parse
from rosmini.sim.gazebo import plugins
from rosmini.sim.gazebo.plugin_tags import Tags, tag
from rosmini.sim.gazebo.plugins import ModelPlugin, SensorPlugin, WorldPlugin

from .conftest import DIFF_DRIVE, LASER, box, urdf


@pytest.fixture(autouse=True)
def own_registry(monkeypatch):
    """What a test registers is gone after it."""
    monkeypatch.setattr(plugins, "_CLASSES", dict(plugins._CLASSES))


def world_with(plugin):
    return (
        f'<sdf version="1.6"><world name="w"><include><uri>model://ground_plane</uri></include>{plugin}</world></sdf>'
    )


def load(text):
    from rosmini.sim import sdf

    return sdf.load(text).worlds[0]


def test_a_server_loads_a_plugin_of_its_arguments(bench):
    loaded = []

    class Worldly(WorldPlugin, filename="libworldly.so"):
        def load(self, world, sdf):
            loaded.append(world.name)

    bench("empty", "-s", "libworldly.so", "-s", "libgazebo_ros_api_plugin.so")
    assert loaded == ["empty"]


def test_the_three_kinds_of_plugins_hear_what_happens(bench):
    heard = []

    class Worldly(WorldPlugin, filename="libworldly.so"):
        def load(self, world, sdf):
            heard.append(f"load {world.name} {sdf.word('say')}")

        def reset(self):
            heard.append("reset")

        def close(self):
            heard.append("close")
            super().close()

    class Modelled(ModelPlugin, filename="libmodelled.so"):
        def load(self, model, sdf):
            heard.append(f"load {model.name}")
            self.every(2.0, lambda now: heard.append(f"{model.name} at {now:.1f}"))

    class Sensing(SensorPlugin, filename="libsensing.so"):
        def load(self, sensor, sdf):
            heard.append(f"load {sensor.device_name} {sensor.type} at {sensor.mount[2]:.1f} m")

    there = bench(world=load(world_with('<plugin name="p" filename="libworldly.so"><say>hello</say></plugin>')))
    laser = LASER.replace("libgazebo_ros_laser.so", "libsensing.so").replace(
        "<topicName>scan</topicName><frameName>laser</frameName>", ""
    )
    there.spawn(urdf(laser + '<gazebo><plugin name="m" filename="libmodelled.so"/></gazebo>'), "r")
    there.graph.run(1.1)
    there.call("delete_model", "gazebo_msgs/DeleteModel", model_name="r")
    there.graph.run(2.0)
    there.call("reset_world", "std_srvs/Empty")
    there.server.node.shutdown("enough")
    assert heard == ["load w hello", "load r/lidar ray at 0.2 m", "load r", "r at 0.5", "r at 1.0", "reset", "close"]


def test_what_a_plugin_raises_is_told_and_all_goes_on(bench, capsys):
    class Broken(ModelPlugin, filename="libbroken.so"):
        def load(self, model, sdf):
            self.every(10.0, self.fail)

        def fail(self, now):
            raise ValueError("this plugin is broken")

    there = bench()
    there.spawn(box(extra='<plugin name="b" filename="libbroken.so"/>'), "crate")
    with pytest.raises(Exception, match="this plugin is broken"):
        there.graph.run(0.5)
    now = there.server.world.now
    there.call("delete_model", "gazebo_msgs/DeleteModel", model_name="crate")
    there.graph.run(0.5)
    assert there.server.world.now > now


def test_a_plugin_that_cannot_begin_takes_its_model_away_again(bench):
    class Broken(ModelPlugin, filename="libbroken.so"):
        def load(self, model, sdf):
            self.every(10, lambda _: None)
            raise KeyError("speed")

        def close(self):
            super().close()
            raise ValueError("nor can it end")

    there = bench()
    there.graph.strict = False
    topics = there.graph.master.getPublishedTopics("/test", "")[2]
    before = [device.name for device in there.server.world.host.devices]
    extra = '<plugin name="broken" filename="libbroken.so"/>'
    for xml, fields, said in (
        (box(extra=extra), {}, "a plugin raised KeyError: 'speed'"),
        (urdf(), {"robot_namespace": "9 lives"}, "illegal topic"),
        (urdf(DIFF_DRIVE.replace("cmd_vel", "cmd vel") + LASER), {}, "illegal topic"),
    ):
        answer = there.spawn(xml, "model", **fields)
        assert not answer.success
        assert said in answer.status_message
        assert [device.name for device in there.server.world.host.devices] == before
        assert there.graph.master.getPublishedTopics("/test", "")[2] == topics
    assert there.spawn(urdf(), "model").success
    there.graph.run(0.5)


def test_a_plugin_in_a_file_is_found(bench, tmp_path, monkeypatch, capsys):
    (tmp_path / "nudge.py").write_text(
        "from rosmini.sim.gazebo.plugins import ModelPlugin\n"
        "class Nudge(ModelPlugin, filename='libnudge.so'):\n"
        "    def load(self, model, sdf):\n"
        "        model.set_pose((7.0, 0.0, 0.0, 0.0, 0.0, 0.0))\n",
        encoding="utf-8",
    )
    (tmp_path / "broken.py").write_text("1 / 0\n", encoding="utf-8")
    monkeypatch.setenv("GAZEBO_PLUGIN_PATH", str(tmp_path))
    there = bench()
    assert there.spawn(box(extra='<plugin name="n" filename="libnudge.so"/>'), "crate").success
    assert there.pose("crate")[0] == 7.0
    assert there.spawn(box(extra='<plugin name="n" filename="libbroken.so"/>'), "other").success
    assert "cannot be loaded: ZeroDivisionError: division by zero" in "".join(capsys.readouterr())


@dataclass(frozen=True, kw_only=True)
class Some(Tags):
    name: str = tag("name", meaning="its name")
    size: float = tag("size", 1.5, "how large", unit="m")
    on: bool = tag("on", False, "whether it is on")
    count: int = tag("count", 2, "how many")


def test_tags_are_read_and_checked():
    complaints = []
    found = Some.read(
        parse("<p><name>n</name><on>TRUE</on><count>3</count><siz>2</siz><robotNamespace/></p>"), complaints.append
    )
    assert found == Some(name="n", on=True, count=3)
    assert len(complaints) == 1
    assert "did you mean size?" in complaints[0]
    with pytest.raises(MarkupError, match="the plugin needs a <name>"):
        Some.read(parse("<p/>"), complaints.append)
    with pytest.raises(MarkupError, match="is not a number"):
        Some.read(parse("<p><name>n</name><size>big</size></p>"), complaints.append)
