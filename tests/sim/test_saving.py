"""What was saved is restored: all three simulators go on then as they did, message by message."""

from __future__ import annotations

import pickle
from collections.abc import Iterator
from dataclasses import replace
from pathlib import Path
from typing import Any

import pytest

from rosmini import Graph
from rosmini.core.errors import RosminiError
from rosmini.core.time import Duration
from rosmini.msgs import message_class, service_class
from rosmini.sim.gazebo import GazeboServer
from rosmini.sim.sdf import ORIGIN
from rosmini.sim.simulator import Simulator
from rosmini.sim.stage.node import Stageros

from .gazebo.conftest import DIFF_DRIVE, LASER, box, urdf

Twist = message_class("geometry_msgs/Twist")
SECOND = 1_000_000_000
NODES = ("simulator", "stageros", "gzserver")

ROBOT = """position( size [0.35 0.35 0.25] localization "odom" odom_error [0.03 0.03 0 0.05]
  ranger( sensor( range [0 9] fov 270 samples 91 noise [0.05 0.01 0] ) ) camera( resolution [6 4] ) pose [%s 0 0 0] )
"""
STAGE = ROBOT % 0 + ROBOT % 2 + 'model( name "box" gripper_return 1 mass 2 size [0.3 0.3 0.3] pose [0.5 0 0 0] )'
NOISY = LASER.replace("<range>", "<noise><type>gaussian</type><stddev>0.05</stddev></noise><range>")
TRUTH = """<gazebo><plugin name="truth" filename="libgazebo_ros_p3d.so"><bodyName>base_footprint</bodyName>
  <topicName>truth</topicName><gaussianNoise>0.02</gaussianNoise><updateRate>20</updateRate></plugin></gazebo>"""
GAZEBO_ROBOT = urdf(DIFF_DRIVE + NOISY + TRUTH)


class Bench:
    """A simulator with two robots and something to push, and a node that hears all and drives."""

    def __init__(self, graph: Graph, kind: str, folder: Path) -> None:
        self.graph, self.kind = graph, kind
        self.sim: Any = getattr(self, f"_{kind}")(folder)
        self.node = graph.node("ears")
        self.heard: list[tuple[str, bytes]] = []
        self._drivers = [self.node.publisher(f"{name}/cmd_vel", Twist) for name in self.robots]
        for topic, named in graph.master.getPublishedTopics("/ears", "")[2]:
            if topic not in ("/rosout", "/rosout_agg") and "parameter" not in topic:
                self.node.subscriber(topic, message_class(named), self._ear(topic))
        for driver in self._drivers:
            driver.wait_for_subscribers()

    def _simulator(self, _: Path) -> Simulator:
        self.robots = ("tb3_0", "tb3_1")
        node = self.graph.node("simulator")
        for name, value in {"robots": 2, "board": True, "obstacles": True}.items():
            node.set_param(f"~{name}", value)
        return Simulator(node, world="arena")

    def _stageros(self, folder: Path) -> Stageros:
        self.robots = ("robot_0", "robot_1")
        (folder / "a.world").write_text(STAGE, encoding="utf-8")
        return Stageros(self.graph.node("stageros"), str(folder / "a.world"))

    def _gzserver(self, _: Path) -> GazeboServer:
        self.robots = ("a", "b")
        server = GazeboServer(self.graph.node("gazebo"), "empty")
        server.spawn(GAZEBO_ROBOT, "a", namespace="a")
        server.spawn(box(mass=0.5), "crate", (0.6, 0.0, 0.0))
        server.spawn(GAZEBO_ROBOT, "b", (0.0, 2.0, 0.0), namespace="b")
        server.spawn(box(static=True), "wall", (3.0, 0.0, 0.0))
        return server

    def _ear(self, topic: str) -> Any:
        def hear(message: Any) -> None:
            told = type(message)._thaw_numpy(type(message)._freeze(message))
            parts = [told, *getattr(told, "transforms", ()), *getattr(told, "markers", ())]
            for header in (each.header for each in parts if hasattr(each, "header")):
                header.seq = 0
                if self.kind == "simulator":  # whose stamps are the node's time, which does not go back
                    header.stamp.secs = header.stamp.nsecs = 0
            self.heard.append((topic, type(told)._encode(told)))

        return hear

    def drive(self, seconds: float) -> None:
        """Drive both robots, each its own way."""
        for i, (v, w) in enumerate([(0.2, 0.3), (-0.1, 1.0), (0.22, 0.0), (0.1, -2.0)]):
            for k, driver in enumerate(self._drivers):
                message = Twist()
                message.linear.x, message.angular.z = v, w + 0.1 * k
                driver.publish(message)
            self.graph.run(seconds / 4 + 0.01 * i)

    def to(self, time_ns: int) -> None:
        """Let the graph go on until exactly then."""
        self.graph.scheduler.run(time_ns, None)

    def goes_on(self) -> list[tuple[str, bytes]]:
        """What is heard while both drive on."""
        self.heard = []
        self.drive(1.6)
        heard, self.heard = self.heard, []
        return heard


@pytest.fixture
def graph() -> Iterator[Graph]:
    with Graph(seed=3) as made:
        yield made


@pytest.mark.parametrize("kind", NODES)
def test_every_message_is_the_same_after_restoring(graph: Graph, tmp_path: Path, kind: str) -> None:
    there = Bench(graph, kind, tmp_path)
    there.drive(0.8)
    graph.run(0.1421)  # no message is on its way then
    state = pickle.loads(pickle.dumps(there.sim.save()))
    first = there.goes_on()
    graph.run(0.0021)  # messages in transit arrive
    there.sim.restore(state)
    assert len(first) > 100
    assert {topic.split("/")[1] for topic, _ in first} >= set(there.robots)
    assert there.goes_on() == first
    with Graph(seed=3) as other:
        again = Bench(other, kind, tmp_path)
        other.run(0.0021)
        again.sim.restore(state)
        again.heard = []
        assert again.goes_on() == first


@pytest.mark.parametrize("kind", NODES)
def test_what_is_on_its_way_when_it_is_saved_belongs_to_the_graph(graph: Graph, tmp_path: Path, kind: str) -> None:
    there = Bench(graph, kind, tmp_path)
    start = graph.scheduler.now_ns() - round(there.sim.host.now * SECOND)
    there.drive(0.9)
    there.to(start + SECOND)
    there.heard = []
    state = pickle.loads(pickle.dumps(there.sim.save()))  # just after a step, whose messages have not arrived
    assert there.sim.host.now == pytest.approx(1.0)
    graph.run(0.0001)
    under_way, there.heard = there.heard, []
    # Stage's step came before the run's end at the same instant, so its messages have arrived
    expected = set() if kind == "stageros" else set(there.robots)
    assert {topic.split("/")[1] for topic, _ in under_way} & set(there.robots) == expected
    there.drive(0.9)
    there.to(start + 2 * SECOND)
    first = there.heard
    there.sim.restore(state)
    there.heard = []
    graph.run(0.0001)
    late, there.heard = there.heard, []  # of the moment before it was restored
    assert sorted(topic for topic, _ in late) == sorted(topic for topic, _ in under_way)
    assert late != under_way or not expected
    there.drive(0.9)
    there.to(start + 3 * SECOND)
    assert there.heard == first


@pytest.mark.parametrize("kind", NODES)
def test_what_is_no_state_of_it_is_refused(graph: Graph, tmp_path: Path, kind: str) -> None:
    there = Bench(graph, kind, tmp_path)
    with Graph() as elsewhere:
        other = Bench(elsewhere, NODES[NODES.index(kind) - 1], tmp_path).sim.save()
    graph.run(0.5)
    now = there.sim.host.now
    for state in (None, 3, other, there.sim.save().__dict__):
        with pytest.raises(RosminiError, match=r"can only be restored from|other devices|a state of the world"):
            there.sim.restore(state)
    assert there.sim.host.now == now
    there.heard = []
    graph.run(0.5)
    assert there.heard


def test_a_state_of_another_world_is_refused(graph: Graph, tmp_path: Path) -> None:
    state = GazeboServer(graph.node("gazebo"), "room").save()
    with Graph() as other, pytest.raises(RosminiError, match="'room' cannot be restored in the world 'empty'"):
        GazeboServer(other.node("gazebo"), "empty").restore(state)
    for name, text in (("one", STAGE), ("two", STAGE)):
        (tmp_path / f"{name}.world").write_text(text, encoding="utf-8")
    with Graph() as other:
        state = Stageros(other.node("stageros"), str(tmp_path / "one.world")).save()
    with Graph() as other, pytest.raises(RosminiError, match="cannot be restored in the world"):
        Stageros(other.node("stageros"), str(tmp_path / "two.world")).restore(state)


def test_models_of_gazebo_come_and_go_with_the_state(graph: Graph, tmp_path: Path) -> None:
    there = Bench(graph, "gzserver", tmp_path)
    server = there.sim
    there.drive(0.8)
    graph.run(0.1421)
    state = pickle.loads(pickle.dumps(server.save()))
    first = there.goes_on()
    graph.run(0.0021)
    for name in ("a", "crate", "wall", "b"):
        server.delete(name)
    server.spawn(box(mass=3.0), "crate", (0.0, 0.0, 0.3))
    server.spawn(urdf(), "new", (-1.0, 0.0, 0.0), namespace="new")
    server.spawn(GAZEBO_ROBOT, "b", (0.0, 2.0, 0.0), namespace="b")
    graph.run(0.3)
    server.pause()
    server.restore(state)
    assert list(server.world.models) == ["a", "crate", "b", "wall"]
    assert not any(topic.startswith("/new") for topic, _ in graph.master.getPublishedTopics("/ears", "")[2])
    graph.run(0.1)  # what came back is connected
    server.unpause()
    assert there.goes_on() == first


def test_a_force_that_acts_on_a_model_of_gazebo_is_saved_too(graph: Graph, tmp_path: Path) -> None:
    server = Bench(graph, "gzserver", tmp_path).sim
    request = service_class("gazebo_msgs/ApplyBodyWrench")._request_class()
    request.wrench.force.y, request.duration = 4.0, Duration(1)
    server.world.wrenches.apply(server.world.model("crate"), "link", ORIGIN, request)
    graph.run(0.3021)
    state = pickle.loads(pickle.dumps(server.save()))
    graph.run(2.0)  # it has ended
    first = server.truth("crate")
    server.restore(state)
    graph.run(2.0)
    assert first[1] > 1.0
    assert server.truth("crate") == first


def test_physics_of_gazebo_come_back_with_their_parameters(graph: Graph) -> None:
    server = GazeboServer(graph.node("gazebo"), "empty")
    state = server.save()
    server.set_physics(replace(server.world.physics, time_step=0.002, gravity_z=-1.6))
    server.restore(state)
    assert (server.world.physics.time_step, server.engine.surface.gravity) == (0.001, 9.8)
    assert server.node.get_param("~gravity_z") == -9.8
