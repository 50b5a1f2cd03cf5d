"""Gazebo's Master and its topics, separate from those of ROS (http://classic.gazebosim.org/tutorials?tut=components).

In Gazebo, server and client are two programs. They find each other through Gazebo's Master, which gzserver
starts at GAZEBO_MASTER_URI, and exchange Protocol Buffers over sockets. Here server and client share a process: the
client reads the running world, and no message is encoded or sent. `GazeboMaster` lists what each program would publish
and subscribe to, which is everything that `gz topic` shows, and notifies clients at the rates of Gazebo's topics.
"""

from __future__ import annotations

import itertools
import os
import weakref
from collections.abc import Callable, Mapping
from dataclasses import dataclass
from typing import Any

from rosmini.core.errors import nearest
from rosmini.core.graph.graph import Graph
from rosmini.sim.host import Device, Host, Stamp
from rosmini.sim.sdf.document import Pose6

from .errors import GazeboError
from .model import Model
from .running_world import RunningWorld

VARIABLE, DEFAULT = "GAZEBO_MASTER_URI", "http://localhost:11345"

HOST = "GAZEBO_IP"
"""The environment variable with the address at which Gazebo's programs can be reached."""

LOOPBACK, FIRST_PORT = "127.0.0.1", 49152
"""The programs get ports from the first dynamic one on. They share a process, so nothing listens on the ports."""

STATISTICS_RATE = 5.0
"""Rate of ~/world_stats [Hz]."""
POSES_RATE = 60.0
"""Rate of ~/pose/info [Hz]."""

SERVER = "gzserver"

TOPICS = {
    "factory": ("", "", "server"),
    "model/info": ("Model", "server", "client"),
    "model/modify": ("", "", "server"),
    "physics": ("Physics", "server", "server"),
    "pose/info": ("PosesStamped", "server", "client"),
    "request": ("Request", "server client", "server"),
    "response": ("Response", "server", "client"),
    "world_control": ("WorldControl", "client", "server"),
    "world_stats": ("WorldStatistics", "server", "client"),
}
"""For each topic the type of its messages, the programs that publish it, and those that subscribe to it."""

_RUNNING: weakref.WeakKeyDictionary[Graph, dict[str, GazeboMaster]] = weakref.WeakKeyDictionary()


def address() -> str:
    """Return the address of Gazebo's Master."""
    return os.environ.get(VARIABLE) or DEFAULT


def find_master(graph: Graph) -> GazeboMaster | None:
    """Return the Master at the address, if a server of the graph runs there."""
    return _RUNNING.get(graph, {}).get(address())


@dataclass(frozen=True)
class Poses:
    """The poses of all models at one time of the world [s]."""

    time: float
    places: Mapping[str, Pose6]
    """The pose of each model in the world, and of each wheel, `model::link`, in its model."""

    @classmethod
    def of(cls, world: RunningWorld) -> Poses:
        """Return the current poses of a world."""
        places: dict[str, Pose6] = {}
        for name, model in world.models.items():
            places[name] = model.pose
            places |= {f"{name}::{link}": model.link_in_model(link) for link in wheels(model)}
        return cls(world.now, places)


def wheels(model: Model) -> tuple[str, ...]:
    """Return the links of a model that rotate."""
    sides = model.body.sides if model.body is not None else {}
    return tuple(joint.child for joint in model.sdf.joints if joint.name in sides)


@dataclass(frozen=True)
class TopicInfo:
    """The publishers and subscribers of a topic."""

    topic: str
    type: str
    publishers: tuple[str, ...]
    """The names of the programs."""
    subscribers: tuple[str, ...]
    publisher_addresses: tuple[str, ...]
    """Host and port of the same programs, which is all that Gazebo's Master knows of them."""
    subscriber_addresses: tuple[str, ...]


class Periodic(Device):
    """A topic that the server publishes at a fixed rate while a program listens."""

    always = False

    def __init__(self, host: Host, name: str, rate: float, make: Callable[[], Any]) -> None:
        super().__init__(host, name, rate)
        self.listeners: list[Callable[[Any], object]] = []
        self._make = make

    def wanted(self) -> bool:
        """Return True if a program listens."""
        return bool(self.listeners)

    def due(self, _: Stamp, __: int, /) -> None:
        """Publish."""
        self.publish()

    def publish(self) -> None:
        """Call the listeners with the current value."""
        if self.listeners:
            value = self._make()
            for listener in list(self.listeners):
                listener(value)


class GazeboMaster:
    """Gazebo's Master, which a server starts.

    Args:
        world: the running world of the server.
        publish_clock: publishes the time on /clock immediately, after a step or a reset.

    Raises:
        GazeboError: another server of the graph runs at the same address.

    """

    def __init__(self, world: RunningWorld, publish_clock: Callable[[], object]) -> None:
        self.world, self.publish_clock = world, publish_clock
        self.uri = address()
        there = _RUNNING.setdefault(world.node.graph, {})
        if self.uri in there:
            raise GazeboError(
                f"Unable to start server[bind: Address already in use]: {there[self.uri].world.node.name} runs "
                f"at {self.uri}. One server is enough for many robots; for a second world set {VARIABLE} to another "
                "address"
            )
        there[self.uri] = self
        self._prefix = f"/gazebo/{world.name}/".replace(" ", "_")
        self._programs: dict[str, str] = {}
        self._ports = itertools.count(FIRST_PORT)
        self.join(SERVER)
        host = world.host
        self.statistics = host.add(Periodic(host, "~/world_stats", STATISTICS_RATE, lambda: None))
        self.poses = host.add(Periodic(host, "~/pose/info", POSES_RATE, lambda: Poses.of(world)))
        world.on_change.append(lambda *_: self.poses.publish())
        host.on_time.append(self._timed)

    def close(self) -> None:
        """Release the address."""
        _RUNNING.get(self.world.node.graph, {}).pop(self.uri, None)

    def join(self, program: str) -> None:
        """Add a program, at the next port of this host."""
        self._programs[program] = f"{os.environ.get(HOST) or LOOPBACK}:{next(self._ports)}"

    def leave(self, program: str) -> None:
        """Remove a program; harmless when repeated."""
        self._programs.pop(program, None)

    def resolve(self, topic: str) -> str:
        """Return the full name of a topic: `~` means /gazebo/ and the name of the world."""
        return self._prefix + topic[2:] if topic.startswith("~/") else topic

    def topics(self) -> dict[str, str]:
        """Return the topics, sorted, each with its type: `gz topic -l`."""
        return {self._prefix + name: f"gazebo.msgs.{kind}" * bool(kind) for name, (kind, _, _) in TOPICS.items()}

    def info(self, topic: str) -> TopicInfo:
        """Return the publishers and subscribers of a topic: `gz topic -i`. Raises `GazeboError` if it is unknown."""
        topics = self.topics()
        if topic not in topics:
            hint = nearest(topic, topics) or f"there are: {', '.join(topics)}"
            msg = f"Gazebo's Master knows no topic {topic!r}; {hint}. These are not ROS's topics, which rostopic lists"
            raise GazeboError(msg)
        ends = [self._of(kinds) for kinds in TOPICS[topic.removeprefix(self._prefix)][1:]]
        addresses = [tuple(self._programs[name] for name in names) for names in ends]
        return TopicInfo(topic, topics[topic], ends[0], ends[1], addresses[0], addresses[1])

    def _of(self, kinds: str) -> tuple[str, ...]:
        """Return the programs of some kinds: the server, the clients, or both."""
        return tuple(name for name in self._programs if ("server" if name == SERVER else "client") in kinds)

    def _timed(self) -> None:
        self.statistics.publish()
        if self.world.paused:
            self.poses.publish()
