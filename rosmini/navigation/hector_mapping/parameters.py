"""The parameters of `hector_mapping/hector_mapping` (http://wiki.ros.org/hector_mapping#Parameters)."""

from __future__ import annotations

from dataclasses import dataclass, fields

from rosmini.core.parameters import Parameters, parameter

from .scans import Limits
from .slam import Settings


@dataclass(frozen=True)
class HectorMappingParameters(Parameters):
    """The private parameters of `hector_mapping`."""

    allowed = ("pub_drawings", "pub_debug_output", "static_laser_frame_ids")
    """Names in files for real robots: debugging output of the original, and its own cache of transforms."""

    base_frame: str = parameter("base_link", "the robot's frame, level with the ground")
    map_frame: str = parameter("map", "the map's frame")
    odom_frame: str = parameter("odom", "the odometry's frame; without odometry, the same as base_frame")
    map_resolution: float = parameter(0.025, "the side of a cell of the finest map", unit="m", minimum=1e-9)
    map_size: int = parameter(1024, "number of cells along each side of the finest map", minimum=0, limits=(2, 16384))
    map_start_x: float = parameter(0.5, "the start in the map: 0 left, 1 right", limits=(0.0, 1.0))
    map_start_y: float = parameter(0.5, "the start in the map: 0 bottom, 1 top", limits=(0.0, 1.0))
    map_multi_res_levels: int = parameter(3, "number of maps, each half as fine as the previous one", minimum=1)
    map_update_distance_thresh: float = parameter(0.4, "the maps are updated after this much driving", unit="m")
    map_update_angle_thresh: float = parameter(0.9, "the maps are updated after this much turning", unit="rad")
    map_pub_period: float = parameter(2.0, "interval between two maps", unit="s", limits=(0.01, None))
    update_factor_free: float = parameter(
        0.4, "occupancy probability of a cell that a beam passes; less than 0.5", limits=(1e-6, 0.999999)
    )
    update_factor_occupied: float = parameter(
        0.9, "occupancy probability of a cell where a beam ends; more than 0.5", limits=(1e-6, 0.999999)
    )
    laser_min_dist: float = parameter(0.4, "nearer beam ends are ignored", unit="m")
    laser_max_dist: float = parameter(30.0, "farther beam ends are ignored", unit="m")
    laser_z_min_value: float = parameter(-1.0, "lower beam ends are ignored; relative to the laser", unit="m")
    laser_z_max_value: float = parameter(1.0, "higher beam ends are ignored; relative to the laser", unit="m")
    pub_map_odom_transform: bool = parameter(True, "publish the transform from map_frame to odom_frame")
    pub_map_scanmatch_transform: bool = parameter(True, "publish the transform from map_frame to the robot")
    tf_map_scanmatch_transform_frame_name: str = parameter(
        "scanmatcher_frame", "the robot's frame in the transform of pub_map_scanmatch_transform"
    )
    pub_odometry: bool = parameter(False, "also publish the pose on scanmatch_odom")
    advertise_map_service: bool = parameter(True, "offer dynamic_map")
    use_tf_scan_transformation: bool = parameter(
        True, "look up the laser's pose on tf; otherwise the robot's frame is the laser's"
    )
    use_tf_pose_start_estimate: bool = parameter(False, "start the search at the pose from tf, not at the last one")
    map_with_known_poses: bool = parameter(False, "use the pose from tf without matching, and only map")
    output_timing: bool = parameter(False, "log the processing time of each scan")
    scan_subscriber_queue_size: int = parameter(5, "queue size for scans; 0 or less: unlimited")
    scan_topic: str = parameter("scan", "the topic of scans")
    sys_msg_topic: str = parameter("syscommand", "the topic for the command `reset`")
    pose_update_topic: str = parameter("poseupdate", "the topic of the pose with covariance")

    def settings(self) -> Settings:
        """Return the mapper's settings."""
        return Settings(**{one.name: getattr(self, one.name) for one in fields(Settings)})

    def limits(self) -> Limits:
        """Return the limits of the beam ends that are used."""
        return Limits(
            abs(self.laser_min_dist), abs(self.laser_max_dist), self.laser_z_min_value, self.laser_z_max_value
        )
