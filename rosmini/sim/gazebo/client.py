"""The node `gazebo_ros/gzclient`: a view of a running server.

It knows nothing of the server but the address of Gazebo's Master. There it finds the server's topics: it asks for the scene on ~/request, hears where
all is on ~/pose/info, and draws what it knows. The simulation goes on whether a client looks or not.
"""

from __future__ import annotations

from dataclasses import replace
from typing import Any

from rosmini.errors import ScriptError
from rosmini.graph import Node
from rosmini.sim.world import World

from .master import address, find_master
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
from .snapshot import Snapshot
from .transport import TransportNode

WAIT_S = 30.0
"""How long a client waits for a server."""

IGNORED = ("--verbose", "-g", "--gui-plugin", "--gui-client-plugin")


class GazeboClient:
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
        self.transport = TransportNode(master, f"gzclient {node.name}", master.namespace)
        self._models: dict[str, Model] = {}
        self._poses: dict[str, Pose] = {}
        self._scene: Scene | None = None
        self._asked = 0
        self.statistics: WorldStatistics | None = None
        """How time goes on, as the server said last."""
        self.time = Time()
        """Of the last places."""
        self._to_request = self.transport.advertise("~/request", Request)
        self._to_control = self.transport.advertise("~/world_control", WorldControl)
        self.transport.subscribe("~/response", self._response)
        self.transport.subscribe("~/model/info", self._model)
        self.transport.subscribe("~/pose/info", self._moved)
        self.transport.subscribe("~/world_stats", self._told)
        self._ask("scene_info")
        node.on_shutdown(self.transport.close)

    def __repr__(self) -> str:
        return f"<GazeboClient {self.node.name}: {self.text}>"

    # -- what the server says ------------------------------------------------------------------------------------

    def _ask(self, request: str, data: str = "") -> None:
        self._asked += 1
        self._to_request.publish(Request(self._asked, request, data))

    def _response(self, message: Response) -> None:
        if message.response != "success":
            return
        if isinstance(message.serialized_data, Scene):
            self._scene = message.serialized_data
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
        """The names of the models that it knows of."""
        return tuple(self._models)

    @property
    def text(self) -> str:
        """What is to be seen, in words: where each model is that is not static."""
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
        """What it knows: the models, where they are, and what time it is there."""
        scene = replace(self._scene or Scene("default"), model=tuple(self._models.values()))
        time = self.time.sec + self.time.nsec * 1e-9
        return Snapshot.of(
            scene, self._poses, time, paused=self.statistics is not None and self.statistics.paused
        )

    def world(self) -> World:
        """What it knows to be solid, as a flat world."""
        return self.snapshot().world()

    def show(self, **options: Any) -> Any:
        """A picture of what it knows, from above.

        Options, with what they are unless given:
            robot=None: where the robot is that `scan`, `trail` and `odom` belong to: x [m], y [m], heading [rad]; None: where that of `name` is
            model=None: what robot it is; None: as Gazebo has it
            scan=None: what its laser measured: a `sensor_msgs/LaserScan`, or ranges [m]
            scan_from=None: where it was then; None: where it is
            trail=None: where it was, (n, 2) or (n, 3)
            odom=None: where its odometry believes that it was, likewise
            others=(): more robots, each an `Other`
            name='': of the model that is drawn as the first robot; '': the first that drives
            title=None: a caption under the picture, and the first words of its text form
            size=(660.0, 540.0): the largest width and height [CSS px]
        """
        return self.snapshot().show(**options)

    def show3d(self, **options: Any) -> Any:
        """What it knows in three dimensions.

        Options, with what they are unless given:
            focus='world': what the camera looks at: 'world', or the name of a model
            collisions=False: show what is solid in place of what one sees
            distance=None: of the camera from what it looks at [m]; None: what shows it well
            azimuth=None: from where it looks [deg]: at 0 from the side of x, at 90 from the side of y; None: what shows it well
            elevation=None: how high from [deg]; None: what shows it well
            title=None: a caption under the picture, and the first words of its text form
            height=420: of the viewer [CSS px]
        """
        return self.snapshot().show3d(**options)

    # -- its buttons ---------------------------------------------------------------------------------------------

    def pause(self) -> None:
        """Press pause."""
        self._to_control.publish(WorldControl(pause=True))

    def play(self) -> None:
        """Press play."""
        self._to_control.publish(WorldControl(pause=False))

    def step(self, count: int = 1) -> None:
        """Press the button for a step, so many times."""
        self._to_control.publish(WorldControl(multi_step=count))

    def reset(self) -> None:
        """Choose Edit, Reset World."""
        self._to_control.publish(WorldControl(reset=WorldReset(all=True)))
