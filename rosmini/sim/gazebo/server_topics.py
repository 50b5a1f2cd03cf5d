"""The server's end of Gazebo's own topics: time, poses, models, scans of ray sensors; orders of clients and of `gz`."""

from __future__ import annotations

import copy
from collections.abc import Callable
from dataclasses import replace
from typing import Any

from rosmini.errors import RosminiError
from rosmini.sim.host import Device, Host, Stamp
from rosmini.sim.sdf import Pose6

from .model import Model, Sensor
from .model_messages import Wheel, model_message, wheels
from .msgs import (
    Factory,
    LaserScan,
    LaserScanStamped,
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
from .physics_properties import PhysicsProperties
from .ros_plugins.lasers import lidar_of
from .running_world import RunningWorld
from .snapshot import Snapshot, pose_of
from .spawning import spawn_text
from .transport import GazeboMaster, Publication, TransportNode

RAYS = ("ray", "gpu_ray", "lidar", "gpu_lidar")
STATISTICS_RATE = 5.0
POSES_RATE = 60.0
"""How often the server publishes time and poses [Hz], as Gazebo's does."""


class _Telling(Device):
    """Something published while somebody hears it."""

    always = False

    def __init__(
        self, host: Host, name: str, rate: float, publication: Publication[Any], tell: Callable[[], None]
    ) -> None:
        super().__init__(host, name, rate)
        self._publication, self._tell = publication, tell

    def wanted(self) -> bool:
        return self._publication.heard

    def due(self, _: Stamp, __: int, /) -> None:
        self._tell()


class _Scan(Device):
    """`~/MODEL/LINK/SENSOR/scan` of a ray sensor, whether a plugin publishes it on a ROS topic or not.

    It is measured only while somebody listens, with noise of its own: what ROS hears does not depend on it.
    """

    always = False

    def __init__(self, node: TransportNode, sensor: Sensor) -> None:
        self._sensor = sensor
        self._lidar = lidar_of(sensor)
        model = sensor.model
        super().__init__(model.world.host, f"{sensor.device_name}/gazebo", self._lidar.rate)
        topic = f"~/{model.name}/{sensor.link}/{sensor.name}/scan"
        self._publication = node.advertise(topic, LaserScanStamped)
        self._rng = model.world.host.rng(self.name)
        self._deviation = self._lidar.noise * model.world.noise

    def wanted(self) -> bool:
        return self._publication.heard

    def due(self, _: Stamp, __: int, /) -> None:
        lidar, model = self._lidar, self._sensor.model
        noise = self._rng.standard_normal(lidar.beams) * self._deviation if self._deviation else None
        ranges = model.world.engine.scan(model.name, noise, lidar=lidar)
        first, last, step = lidar.message_angles
        scan = LaserScan(
            frame=f"{model.name}::{self._sensor.link}",
            world_pose=Pose.of("", 0, model.link_pose(self._sensor.link)),
            angle_min=first,
            angle_max=last,
            angle_step=step,
            range_min=lidar.range_min,
            range_max=lidar.range_max,
            count=lidar.beams,
            ranges=tuple(ranges.tolist()),
        )
        self._publication.publish(LaserScanStamped(Time.of(model.world.now), scan))

    def state(self) -> Any:
        return copy.deepcopy(self._rng)

    def restore(self, state: Any) -> None:
        self._rng = copy.deepcopy(state)

    def close(self) -> None:
        self._publication.close()


class ServerTopics:
    """The server's end of Gazebo's own topics.

    Args:
        world: the running world.
        master: the Master that the server started.
        set_physics: changes how the world is stepped.
        tell_clock: publishes the time on /clock at once, after a step or a reset.

    """

    def __init__(
        self,
        world: RunningWorld,
        master: GazeboMaster,
        set_physics: Callable[[PhysicsProperties], object],
        tell_clock: Callable[[], object],
    ) -> None:
        self.world = world
        self._set_physics, self._tell_clock = set_physics, tell_clock
        self._started_ns = world.host.clock.now_ns()
        lane = world.node.spawn(f"{world.node.name} transport")
        self.node = node = TransportNode(master, "gzserver", lane)
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
        node.subscribe("~/physics", self._physics_changed)
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
            host.add(_Telling(host, name, rate, publication, tell))
        world.on_change.append(self._changed)
        world.host.on_time.append(self._timed)
        self._scans: dict[str, list[_Scan]] = {}
        for model in world.models.values():
            self._add_scans(model)

    def close(self) -> None:
        """Leave all topics."""
        self.node.close()

    # -- what is published ---------------------------------------------------------------------------------------

    def number(self, name: str) -> int:
        """The number of a model in messages."""
        return self._numbers.setdefault(name, len(self._numbers) + 1)

    def statistics(self) -> WorldStatistics:
        """How time goes on."""
        world = self.world
        now = Time.of(world.now)
        real = Time.of((world.host.clock.now_ns() - self._started_ns) * 1e-9)
        iterations = round(world.now / world.physics.time_step)
        return WorldStatistics(now, Time(), real, world.paused, iterations, len(world.models))

    def tell_statistics(self) -> None:
        """Publish how time goes on."""
        self._statistics.publish(self.statistics())

    def poses(self) -> PosesStamped:
        """The poses of all models, and of links that turn, seen from their models."""
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
        """Publish the poses of all models."""
        self._poses.publish(self.poses())

    def model(self, model: Model) -> ModelMessage:
        """All there is to know of a model."""
        return model_message(model, self.number)

    def scene(self) -> Scene:
        """The whole scene."""
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
            self._add_scans(model)
            self._models.publish(self.model(model))
        elif what == "delete":
            for scan in self._scans.pop(model.name, []):
                self.world.host.remove(scan)
            self._wheels.pop(model.name, None)
            self._told.pop(model.name, None)
            self._responses.publish(Response(0, "entity_delete", "success", "string", model.name))
        elif self.world.paused:
            self.tell_poses()

    def _add_scans(self, model: Model) -> None:
        for sensor in model.sensors:
            if sensor.type in RAYS:
                try:
                    scan = _Scan(self.node, sensor)
                except RosminiError as error:  # a laser that is not simulated
                    self.world.node.logwarn(str(error))
                else:
                    self._scans.setdefault(model.name, []).append(self.world.host.add(scan))

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
                world.host.reset_time()
            self._tell_clock()
        if message.pause is not None:
            (world.host.pause if message.pause else world.host.unpause)()
        if message.step or message.multi_step:
            world.step(message.multi_step or 1)
            self._tell_clock()

    def _physics_changed(self, message: Physics) -> None:
        gravity = message.gravity
        try:
            physics = replace(
                self.world.physics,
                time_step=message.max_step_size,
                max_update_rate=message.real_time_update_rate,
                gravity_x=gravity.x,
                gravity_y=gravity.y,
                gravity_z=gravity.z,
            )
            self._set_physics(physics)
        except RosminiError as error:
            self.world.node.logerr(f"Gazebo's ~/physics: {error}")
