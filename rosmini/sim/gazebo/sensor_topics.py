"""What ray sensors measure, on Gazebo's own topics: `~/MODEL/LINK/SENSOR/scan`, whether a plugin tells ROS of it or not.

It is measured only while somebody hears it, and has noise of its own: what ROS hears is not changed by it.
"""

from __future__ import annotations

import copy
from typing import TYPE_CHECKING, Any

from rosmini.errors import RosminiError
from rosmini.sim.host import Device, Stamp

from .model import Model, Sensor
from .msgs import LaserScan, LaserScanStamped, Pose, Time
from .ros_plugins.sensors import lidar_of
from .transport import TransportNode

if TYPE_CHECKING:
    from .world import GazeboWorld

RAYS = ("ray", "gpu_ray", "lidar", "gpu_lidar")


class SensorTopics:
    """The topics of all ray sensors of a world."""

    def __init__(self, world: GazeboWorld, node: TransportNode) -> None:
        self._world, self._node = world, node
        self._there: dict[str, list[_Scan]] = {}
        for model in world.models.values():
            self._add(model)
        world.on_change.append(self._changed)

    def _changed(self, what: str, model: Model) -> None:
        if what == "insert":
            self._add(model)
        elif what == "delete":
            for scan in self._there.pop(model.name, []):
                self._world.host.remove(scan)

    def _add(self, model: Model) -> None:
        for sensor in model.sensors:
            if sensor.type in RAYS:
                try:
                    scan = _Scan(self._node, sensor)
                except RosminiError as error:  # a laser that is not simulated
                    self._world.node.logwarn(str(error))
                else:
                    self._there.setdefault(model.name, []).append(self._world.host.add(scan))


class _Scan(Device):
    """The topic of one sensor."""

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
        scan = LaserScan(
            frame=f"{model.name}::{self._sensor.link}",
            world_pose=Pose.of("", 0, model.link_pose(self._sensor.link)),
            angle_min=lidar.angle_min,
            angle_max=lidar.last_angle,
            angle_step=lidar.increment,
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
