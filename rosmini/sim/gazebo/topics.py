"""What the server says and hears on Gazebo's own topics: how time goes, where all is, what comes and goes; orders of clients and of `gz`."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import replace
from typing import TYPE_CHECKING, Any

from rosmini.errors import RosminiError
from rosmini.sim.host import Device, Host, Stamp
from rosmini.sim.sdf import Pose6

from .model import Model
from .msgs import (
    Factory,
    Physics,
    Pose,
    PosesStamped,
    Request,
    Response,
    Scene,
    Time,
    Vector3d,
    WorldControl,
    WorldStatistics,
)
from .msgs import Model as ModelMessage
from .scenes import Wheel, model_message, wheels
from .sensor_topics import SensorTopics
from .snapshot import Snapshot, pose_of
from .transport import TransportNode

if TYPE_CHECKING:
    from .server import GazeboServer

STATISTICS_RATE = 5.0
POSES_RATE = 60.0
"""How often the server tells of time and of places [Hz], as Gazebo's does."""


class _Telling(Device):
    """Something that is told while somebody hears it."""

    always = False

    def __init__(
        self, host: Host, name: str, rate: float, wanted: Callable[[], bool], tell: Callable[[], None]
    ) -> None:
        super().__init__(host, name, rate)
        self.wanted = wanted  # type: ignore[method-assign]
        self._tell = tell

    def due(self, _: Stamp, __: int, /) -> None:
        self._tell()


class ServerTopics:
    """The server's end of Gazebo's own topics."""

    def __init__(self, server: GazeboServer, namespace: str) -> None:
        self.server = server
        self.world = world = server.world
        self.node = node = TransportNode(server.master, "gzserver", namespace)
        self._statistics = node.advertise("~/world_stats", WorldStatistics)
        self._poses = node.advertise("~/pose/info", PosesStamped)
        self._models = node.advertise("~/model/info", ModelMessage)
        self._requests = node.advertise("~/request", Request)
        self._responses = node.advertise("~/response", Response)
        self._physics = node.advertise("~/physics", Physics)
        node.subscribe("~/request", self._request)
        node.subscribe("~/factory", self._factory)
        node.subscribe("~/model/modify", self._modify)
        node.subscribe("~/world_control", self._control)
        node.subscribe("~/physics", self._set_physics)
        self._numbers: dict[str, int] = {}
        self._wheels: dict[str, tuple[Wheel, ...]] = {}
        self._told: dict[
            str, tuple[Pose6, Pose]
        ] = {}  # of each model its last pose, which is told again if it stands
        host = world.host
        for name, rate, publication, tell in (
            ("~/world_stats", STATISTICS_RATE, self._statistics, self.tell_statistics),
            ("~/pose/info", POSES_RATE, self._poses, self.tell_poses),
        ):
            host.add(_Telling(host, name, rate, lambda publication=publication: publication.heard, tell))  # type: ignore[misc]
        world.on_change.append(self._changed)
        world.on_time.append(self._timed)
        self._sensors = SensorTopics(world, node)

    def close(self) -> None:
        """Leave all topics."""
        self.node.close()

    # -- what is said --------------------------------------------------------------------------------------------

    def number(self, name: str) -> int:
        """The number by which messages speak of a model."""
        return self._numbers.setdefault(name, len(self._numbers) + 1)

    def statistics(self) -> WorldStatistics:
        """How time goes on."""
        world = self.world
        now = Time.of(world.now)
        real = Time.of((world.host.clock.now_ns() - self.server.started_ns) * 1e-9)
        return WorldStatistics(now, Time(), real, world.paused, world.iterations, len(world.models))

    def tell_statistics(self) -> None:
        """Say how time goes on."""
        self._statistics.publish(self.statistics())

    def poses(self) -> PosesStamped:
        """Where all models are, and, seen from their models, the links that turn."""
        there: list[Pose] = []
        for name, model in self.world.models.items():
            told = self._told.get(name)
            at = model.pose if model.fixed is None else model.fixed
            if told is None or (told[0] is not at and told[0] != at):
                told = self._told[name] = (at, Pose.of(name, self.number(name), model.pose))
            there.append(told[1])
            if model.body is not None:
                if name not in self._wheels:
                    self._wheels[name] = wheels(model, self.number)
                there += [wheel.pose for wheel in self._wheels[name]]
        return PosesStamped(Time.of(self.world.now), tuple(there))

    def tell_poses(self) -> None:
        """Say where all models are."""
        self._poses.publish(self.poses())

    def model(self, model: Model) -> ModelMessage:
        """What there is to know of a model."""
        return model_message(model, self.number)

    def scene(self) -> Scene:
        """All that there is."""
        models = tuple(self.model(model) for model in self.world.models.values())
        return Scene(self.world.name, models, replace(self.world.flat, obstacles=()))

    def snapshot(self) -> Snapshot:
        """The world as it is now."""
        world = self.world
        world.host.catch_up()
        poses = {pose.name: pose for pose in self.poses().pose}
        return Snapshot.of(self.scene(), poses, world.now, paused=world.paused)

    def _changed(self, what: str, model: Model) -> None:
        if what == "insert":
            self._models.publish(self.model(model))
        elif what == "delete":
            self._wheels.pop(model.name, None)
            self._told.pop(model.name, None)
            self._responses.publish(Response(0, "entity_delete", "success", "string", model.name))
        elif self.world.paused:
            self.tell_poses()

    def _timed(self) -> None:
        if self._statistics.heard:
            self.tell_statistics()
        if self.world.paused and self._poses.heard:
            self.tell_poses()

    # -- what is heard -------------------------------------------------------------------------------------------

    def _request(self, message: Request) -> None:
        try:
            kind, data = self._answer(message)
        except RosminiError as error:
            self._responses.publish(
                Response(message.id, message.request, "nonexistent", "string", str(error))
            )
        else:
            self._responses.publish(Response(message.id, message.request, "success", kind, data))
        if message.request == "scene_info":  # who asks is new, and time may stand
            self.tell_statistics()
            self.tell_poses()

    def _answer(self, message: Request) -> tuple[str, Any]:
        if message.request == "scene_info":
            return Scene.TYPE, self.scene()
        if message.request == "entity_list":
            return "gazebo.msgs.Model_V", tuple(self.world.models)
        if message.request == "entity_info":
            return ModelMessage.TYPE, self.model(self.world.model(message.data))
        if message.request == "entity_delete":
            self.world.delete(message.data)
            return "string", message.data
        if message.request == "physics_info":
            physics = self.world.physics
            rate, gravity = physics.max_update_rate, Vector3d(*physics.gravity)
            return Physics.TYPE, Physics("ODE", physics.time_step, rate, physics.speed, gravity)
        return "string", f"nobody answers {message.request!r}"

    def _factory(self, message: Factory) -> None:
        from .spawning import spawn_text

        try:
            pose = None if message.pose is None else pose_of(message.pose)
            spawn_text(self.world, message.sdf, message.edit_name, pose)
        except RosminiError as error:
            self.world.node.logerr(f"Gazebo's ~/factory: {error}")
            self._responses.publish(Response(0, "factory", "error", "string", str(error)))

    def _modify(self, message: ModelMessage) -> None:
        try:
            if message.pose is not None:
                self.world.move(self.world.model(message.name), pose_of(message.pose))
        except RosminiError as error:
            self.world.node.logerr(f"Gazebo's ~/model/modify: {error}")

    def _control(self, message: WorldControl) -> None:
        world = self.world
        if message.reset is not None:
            if message.reset.all or message.reset.model_only:
                world.reset_models()
            if message.reset.all or message.reset.time_only:
                world.reset_time()
            self.server.clock.tell()
        if message.pause is not None:
            (world.pause if message.pause else world.unpause)()
        if message.step or message.multi_step:
            world.step(message.multi_step or 1)
            self.server.clock.tell()

    def _set_physics(self, message: Physics) -> None:
        gravity = message.gravity
        try:
            physics = replace(
                self.world.physics,
                time_step=message.max_step_size,
                max_update_rate=message.real_time_update_rate,
                gravity=(gravity.x, gravity.y, gravity.z),
            )
            self.server.set_physics(physics)
        except RosminiError as error:
            self.world.node.logerr(f"Gazebo's ~/physics: {error}")
