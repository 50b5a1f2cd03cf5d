"""The node `gazebo_ros/gzclient`: a view of a running server.

All it knows of the server is the address of Gazebo's Master. There it finds the server's topics: it asks for the
scene on ~/request, hears poses on ~/pose/info, and draws what it knows. The simulation goes on whether a client looks
or not.
"""

from __future__ import annotations

from dataclasses import replace

from rosmini.errors import ScriptError
from rosmini.graph import Node
from rosmini.sim.world import World

from .msgs import (
    Model,
    Pose,
    PosesStamped,
    Request,
    Response,
    Scene,
    Time,
    WorldControl,
    WorldReset,
    WorldStatistics,
)
from .snapshot import Pictured, Snapshot
from .transport import TransportNode, address, find_master

WAIT_S = 30.0
"""How long a client waits for a server."""

IGNORED = ("--verbose", "-g", "--gui-plugin", "--gui-client-plugin")


class GazeboClient(Pictured):
    """A view of a running server.

    Args:
        node: the started node.
        args: those of gzclient: --verbose, -g PLUGIN; neither changes anything here.

    Raises:
        ScriptError: other arguments.
        ROSException: no server runs at the address of Gazebo's Master.

    """

    node_name = "gazebo_gui"

    def __init__(self, node: Node, *args: str) -> None:
        wrong = [word for word in args if word.startswith("-") and word not in IGNORED]
        if wrong:
            raise ScriptError(f"gzclient: there is no option {wrong[0]}; it has {', '.join(IGNORED)}")
        self.node = node
        graph = node.graph
        node.wait_until(
            lambda: find_master(graph) is not None,
            WAIT_S,
            "Gazebo's server",
            lambda: f"no server runs at {address()}: start one with `rosrun gazebo_ros gzserver`",
        )
        master = find_master(graph)
        if master is None:
            raise ScriptError(f"the server at {address()} has ended")
        self.master = master
        self.transport = TransportNode(master, f"gzclient {node.name}", node.spawn(f"{node.name} transport"))
        self._models: dict[str, Model] = {}
        self._poses: dict[str, Pose] = {}
        self._scene: Scene | None = None
        self.statistics: WorldStatistics | None = None
        """The last world statistics of the server."""
        self.time = Time()
        """Of the last poses."""
        self._to_request = self.transport.advertise("~/request", Request)
        self._to_control = self.transport.advertise("~/world_control", WorldControl)
        self.transport.subscribe("~/response", self._response)
        self.transport.subscribe("~/model/info", self._model)
        self.transport.subscribe("~/pose/info", self._moved)
        self.transport.subscribe("~/world_stats", self._told)
        node.on_shutdown(self.transport.close)
        self._to_request.publish(Request(1, "scene_info"))
        node.wait_until(
            lambda: self._scene is not None,
            WAIT_S,
            "the scene",
            lambda: f"the server at {master.uri} does not answer",
        )

    def __repr__(self) -> str:
        return f"<GazeboClient {self.node.name}: {self.text}>"

    # -- what the server says ------------------------------------------------------------------------------------

    def _response(self, message: Response) -> None:
        if message.response != "success":
            return
        if isinstance(message.serialized_data, Scene):
            self._scene = message.serialized_data
            self.node.graph.changes.notify()
            self._models = {model.name: model for model in self._scene.model}
            self._poses = {model.name: model.pose for model in self._scene.model if model.pose is not None}
        elif message.request == "entity_delete":
            name = str(message.serialized_data)
            self._models.pop(name, None)
            for each in [each for each in self._poses if each.partition("::")[0] == name]:
                del self._poses[each]

    def _model(self, message: Model) -> None:
        self._models[message.name] = message
        if message.pose is not None:
            self._poses[message.name] = message.pose

    def _moved(self, message: PosesStamped) -> None:
        self.time = message.time
        self._poses.update((pose.name, pose) for pose in message.pose)

    def _told(self, message: WorldStatistics) -> None:
        self.statistics = message

    # -- what it shows -------------------------------------------------------------------------------------------

    @property
    def models(self) -> tuple[str, ...]:
        """The names of the models it knows."""
        return tuple(self._models)

    @property
    def text(self) -> str:
        """What it shows, in words: the position of each model that is not static."""
        name = self._scene.name if self._scene is not None else "?"
        moving = [
            f"{model.name} at ({self._poses[model.name].position.x:.2f}, {self._poses[model.name].position.y:.2f})"
            for model in self._models.values()
            if not model.is_static and model.name in self._poses
        ]
        count = len(self._models)
        there = f"{count} model{'' if count == 1 else 's'} in {name}"
        return f"{there}: {', '.join(moving)}" if moving else there

    def snapshot(self) -> Snapshot:
        """What it knows: the models, their poses, and the time."""
        scene = replace(self._scene or Scene("default"), model=tuple(self._models.values()))
        time = self.time.sec + self.time.nsec * 1e-9
        return Snapshot.of(
            scene, self._poses, time, paused=self.statistics is not None and self.statistics.paused
        )

    def world(self) -> World:
        """Everything solid it knows, as a flat world."""
        return self.snapshot().world()

    # -- its buttons ---------------------------------------------------------------------------------------------

    def _press(self, order: WorldControl) -> None:
        """Send an order, and go on when the server has carried it out."""
        self._to_control.publish(order)
        self.node.scheduler.give_way()

    def pause(self) -> None:
        """Press pause."""
        self._press(WorldControl(pause=True))

    def play(self) -> None:
        """Press play."""
        self._press(WorldControl(pause=False))

    def step(self, count: int = 1) -> None:
        """Press the step button `count` times."""
        self._press(WorldControl(multi_step=count))

    def reset(self) -> None:
        """Choose Edit, Reset World."""
        self._press(WorldControl(reset=WorldReset(all=True)))
