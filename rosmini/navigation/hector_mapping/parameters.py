"""The parameters of `hector_mapping/hector_mapping` (http://wiki.ros.org/hector_mapping#Parameters)."""

from __future__ import annotations

from dataclasses import dataclass, fields

from rosmini.core.parameters import Parameters, parameter

from .scans import Limits
from .slam import Settings


@dataclass(frozen=True)
class HectorMappingParameters(Parameters):
    """The private parameters."""

    allowed = ("pub_drawings", "pub_debug_output", "static_laser_frame_ids")
    """Names in files for real robots: debugging output of the original, and its own cache of transforms."""

    base_frame: str = parameter("base_link", "the robot's frame, level with the ground")
    map_frame: str = parameter("map", "the map's frame")
    odom_frame: str = parameter("odom", "the odometry's frame; without odometry, the same as base_frame")
    map_resolution: float = parameter(0.025, "the side of a cell of the finest map", unit="m", minimum=1e-3)
    map_size: int = parameter(1024, "cells along a side of it", minimum=2, maximum=16384)
    map_start_x: float = parameter(0.5, "where the robot begins: 0 left, 1 right", minimum=0.0, maximum=1.0)
    map_start_y: float = parameter(0.5, "where the robot begins: 0 bottom, 1 top", minimum=0.0, maximum=1.0)
    map_multi_res_levels: int = parameter(
        3, "maps, each half as fine as the one before", minimum=1, maximum=12
    )
    map_update_distance_thresh: float = parameter(0.4, "the maps change after so much driving", unit="m")
    map_update_angle_thresh: float = parameter(0.9, "or so much turning", unit="rad")
    map_pub_period: float = parameter(2.0, "between two maps", unit="s", minimum=1e-3)
    update_factor_free: float = parameter(
        0.4, "how likely a cell is occupied that a beam passes; less than 0.5", minimum=1e-6, maximum=0.999999
    )
    update_factor_occupied: float = parameter(
        0.9, "and one in which a beam ends; more than 0.5", minimum=1e-6, maximum=0.999999
    )
    laser_min_dist: float = parameter(0.4, "nearer ends are left out", unit="m")
    laser_max_dist: float = parameter(30.0, "and farther ones", unit="m")
    laser_z_min_value: float = parameter(-1.0, "and lower ones, above the laser", unit="m")
    laser_z_max_value: float = parameter(1.0, "and higher ones", unit="m")
    pub_map_odom_transform: bool = parameter(True, "say on tf where odom_frame is in map_frame")
    pub_map_scanmatch_transform: bool = parameter(True, "say on tf where the robot is in map_frame")
    tf_map_scanmatch_transform_frame_name: str = parameter("scanmatcher_frame", "the robot's name in that")
    pub_odometry: bool = parameter(False, "the pose on scanmatch_odom, too")
    advertise_map_service: bool = parameter(True, "offer dynamic_map")
    use_tf_scan_transformation: bool = parameter(
        True, "ask tf where the laser is; otherwise the robot is its laser"
    )
    use_tf_pose_start_estimate: bool = parameter(
        False, "begin the search where tf has the robot, not where it was"
    )
    map_with_known_poses: bool = parameter(False, "take that pose as it is, and only make a map")
    output_timing: bool = parameter(False, "log the time that a scan takes")
    scan_subscriber_queue_size: int = parameter(5, "scans that wait", minimum=0)
    scan_topic: str = parameter("scan", "where scans are heard")
    sys_msg_topic: str = parameter("syscommand", "where `reset` is heard")
    pose_update_topic: str = parameter("poseupdate", "where the pose goes, with its covariance")

    def settings(self) -> Settings:
        """Return the mapper's settings."""
        return Settings(**{one.name: getattr(self, one.name) for one in fields(Settings)})

    def limits(self) -> Limits:
        """Return the limits of the beam ends that are used."""
        return Limits(
            self.laser_min_dist, self.laser_max_dist, self.laser_z_min_value, self.laser_z_max_value
        )
