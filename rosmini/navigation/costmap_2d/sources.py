"""Observation sources: topics whose messages become observations once their transforms are available."""

from __future__ import annotations

from collections.abc import Callable
from functools import partial
from typing import Any

from rosmini.core.errors import RosminiError
from rosmini.core.graph import Node
from rosmini.core.tf import Buffer, TransformException
from rosmini.core.tf.message_filter import MessageFilter
from rosmini.core.tf.rigid import transform_points
from rosmini.msgs import message_class

from .observations import Floats, Observation, ObservationBuffer, cloud2_points, cloud_points, scan_cloud
from .parameters import SourceParameters, parameter_above

QUEUE_SIZE = 50
"""Maximum number of messages waiting for their transforms."""
TOLERANCE = 0.05
"""A message also waits until its transform is known this long after its stamp [s]."""
PROJECTIONS: dict[str, Callable[[Any], Floats]] = {
    "LaserScan": scan_cloud,
    "PointCloud": cloud_points,
    "PointCloud2": cloud2_points,
}


class ObservationSource:
    """One source of an obstacle layer, described by the parameters in `namespace`."""

    def __init__(self, node: Node, buffer: Buffer, namespace: str, name: str, global_frame: str) -> None:
        self.node, self.buffer, self.name = node, buffer, name
        self.global_frame = global_frame
        settings = self.settings = SourceParameters.read(node, namespace)
        self.topic = settings.topic or name
        self.obstacle_range = parameter_above(node, namespace, "obstacle_range", float, 2.5)
        self.raytrace_range = parameter_above(node, namespace, "raytrace_range", float, 3.0)
        self.observations = ObservationBuffer(
            persistence_ns=round(settings.observation_persistence * 1e9),
            expected_ns=round(settings.expected_update_rate * 1e9),
            min_height=settings.min_obstacle_height,
            max_height=settings.max_obstacle_height,
        )
        self.observations.updated_ns = node.clock.now_ns()
        if settings.inf_is_valid and settings.data_type != "LaserScan":
            node.logwarn(f"obstacle_layer: inf_is_valid option is not applicable to {settings.data_type} observations.")
        self._project = (
            partial(scan_cloud, inf_is_valid=True)
            if settings.inf_is_valid and settings.data_type == "LaserScan"
            else PROJECTIONS[settings.data_type]
        )
        self._subscriber: Any = None
        self._filter: MessageFilter | None = None
        self.activate()

    def activate(self) -> None:
        """Subscribe to the topic."""
        if self._subscriber is not None:
            return
        sensor = self.settings.sensor_frame.lstrip("/")
        self._filter = MessageFilter(
            self.buffer,
            (self.global_frame, sensor) if sensor else (self.global_frame,),
            self._on_message,
            queue_size=QUEUE_SIZE,
            tolerance=TOLERANCE,
            failed=self._on_drop,
        )
        self._subscriber = self.node.subscriber(
            self.topic, message_class(f"sensor_msgs/{self.settings.data_type}"), self._filter.add, queue_size=QUEUE_SIZE
        )

    def deactivate(self) -> None:
        """Unsubscribe from the topic."""
        if self._subscriber is not None and self._filter is not None:
            self._subscriber.unregister()
            self._filter.close()
        self._subscriber = self._filter = None

    def is_current(self) -> bool:
        """Return True if messages arrive at the expected rate, otherwise log a warning."""
        late = self.observations.late_by(self.node.clock.now_ns())
        if late is None:
            return True
        self.node.logwarn(
            f"The {self.topic} observation buffer has not been updated for {late * 1e-9:.2f} seconds, and it should be "
            f"updated every {self.settings.expected_update_rate:.2f} seconds.",
            throttle=1.0,
        )
        return False

    def _on_message(self, message: Any) -> None:
        frame = message.header.frame_id.lstrip("/")
        stamp = message.header.stamp.to_nsec()
        try:
            points = self._project(message)
            cloud_transform = self.buffer.tree.lookup(self.global_frame, frame, stamp).transform
            sensor = self.settings.sensor_frame.lstrip("/")
            origin = self.buffer.tree.lookup(self.global_frame, sensor, stamp).transform if sensor else cloud_transform
        except TransformException as error:
            self.node.logerr(
                f"TF Exception that should never happen for sensor frame: {self.settings.sensor_frame}, cloud frame: "
                f"{frame}, {error}"
            )
            return
        except (RosminiError, ValueError) as error:
            self.node.logwarn(f"a message on {self.topic} is malformed and is ignored: {error}", throttle=1.0)
            return
        self.observations.add(
            Observation(
                origin[:3], transform_points(cloud_transform, points), stamp, self.obstacle_range, self.raytrace_range
            ),
            self.node.clock.now_ns(),
        )

    def _on_drop(self, message: Any, reason: str) -> None:
        self.node.logwarn(
            f"MessageFilter [target={self.global_frame}]: a message of {self.topic} from "
            f"{message.header.stamp.to_sec():.3f} s in the frame '{message.header.frame_id}' was dropped: {reason}",
            throttle=15.0,
        )
