"""Time travel: the same run up to an instant, another one after it, and both side by side."""

from __future__ import annotations

import itertools
from dataclasses import dataclass

import numpy as np
import pytest

from rosmini.core.dynamic_reconfigure import Server
from rosmini.core.parameters import Parameters, parameter
from rosmini.msgs import message_class
from rosmini.ros.bag import Bag
from rosmini.sim.simulator import Simulator
from rosmini.viz.replay.time_travel import TimeTravelError, what_if


@dataclass(frozen=True)
class Settings(Parameters):
    gain: float = parameter(1.0, "how much")


def driving(graph):
    """A robot that drives as fast as a parameter says, until it is stuck at a wall."""
    simulator = Simulator(graph.node("simulator"))
    driver = graph.node("driver")
    twist = message_class("geometry_msgs/Twist")
    speed = driver.publisher("/cmd_vel", twist)
    driver.set_param("/driver/turn", 0.0)

    def drive(_event):
        message = twist()
        message.linear.x, message.angular.z = 0.2, driver.get_param("/driver/turn")
        speed.publish(message)

    driver.timer(0.1, drive)
    return simulator


@pytest.fixture(scope="module")
def fork():
    return what_if(driving, {"/driver/turn": 0.8}, at=2.0, seconds=5.0)


def test_the_runs_are_equal_until_the_change_and_different_after(fork):
    before, after = fork.before, fork.after
    count = before.until_change
    assert count == after.until_change > 50
    assert before.messages[:count] == after.messages[:count]
    assert before.messages[count:] != after.messages[count:]
    assert fork.differs_after == pytest.approx(2.0, abs=0.3)
    assert fork.differs_after >= 2.0 - 0.05
    truth = before.recording.truth, after.recording.truth
    times = before.recording.times
    same = (truth[0] == truth[1]).all(axis=1)
    assert same[times < 1.9].all()
    assert np.abs(truth[0][-1] - truth[1][-1])[:2].max() > 0.05


def test_its_words_say_what_was_changed(fork):
    assert f"{fork.before.until_change} messages are the same to the byte up to 2.00 s" in str(fork)
    assert "/driver/turn = 0.8" in str(fork)


def test_both_are_shown_side_by_side_and_can_be_saved(fork, tmp_path):
    view = fork.replay(title="Straight on, or left")
    titles = [run["title"] for run in view.data["runs"]]
    assert titles == ["as it was", "from 2.0 s: /driver/turn = 0.8"]
    assert [run["title"] for run in fork.replay3d().data["runs"]] == titles
    with Bag(fork.after.save(tmp_path / "after.bag")) as bag:
        assert sum(1 for _ in bag) == len(fork.after.messages)


def test_a_change_without_effect_and_one_that_is_a_function():
    nothing = what_if(driving, {"/other": 1}, at=0.5, seconds=1.0)
    assert nothing.differs_after is None
    assert "changed nothing" in str(nothing)

    def end_the_driver(graph):
        graph.nodes["/driver"].shutdown("the test")

    ended = what_if(driving, end_the_driver, at=0.5, seconds=1.5)
    assert ended.what == "end the driver"
    assert ended.differs_after >= 0.5


def test_a_run_that_is_not_the_same_twice_is_refused():
    counter = itertools.count()

    def unseeded(graph):
        node = graph.node("talker")
        said = message_class("std_msgs/Int32")(data=next(counter))
        talker = node.publisher("/chatter", message_class("std_msgs/Int32"))
        node.timer(0.1, lambda _event: talker.publish(said))

    with pytest.raises(TimeTravelError, match=r"differs when it is repeated: message \d+, on /chatter"):
        what_if(unseeded, {"/a": 1}, at=0.5, seconds=1.0)


@pytest.mark.parametrize("at", [-1.0, 2.0, float("nan")])
def test_the_change_has_to_come_within_the_run(at):
    with pytest.raises(TimeTravelError, match="within the run"):
        what_if(driving, {}, at=at, seconds=1.0)


def test_a_launch_file_is_a_run_too(tmp_path):
    file = tmp_path / "drive.launch"
    node = '<node pkg="rosmini_sim" type="simulator" name="simulator"/>'
    file.write_text(f"<launch>{node}</launch>", encoding="utf-8")
    fork = what_if((str(file),), {"/simulator/none": 3}, at=0.5, seconds=1.0)
    assert fork.before.recording is not None
    assert fork.differs_after is None


def test_a_node_with_dynamic_reconfigure_hears_of_the_change():
    message = []

    def tuned(graph):
        node = graph.node("tuner")
        talker = node.publisher("/gain", message_class("std_msgs/Float64"))
        gain = {"value": 1.0}

        def change(config, _level):
            gain["value"] = config["gain"]
            message.append(config["gain"])
            return config

        Server(node, Settings, change)
        node.timer(0.1, lambda _event: talker.publish(message_class("std_msgs/Float64")(data=gain["value"])))

    fork = what_if(tuned, {"/tuner/gain": 2.5}, at=0.5, seconds=1.0)
    assert message == [1.0, 1.0, 2.5]
    assert fork.differs_after >= 0.5
