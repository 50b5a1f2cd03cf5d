"""The parameters of `amcl/amcl`, with Noetic's names, ranges and defaults (http://wiki.ros.org/amcl#Parameters)."""

from __future__ import annotations

import math
from dataclasses import dataclass

from rosmini.core.parameters import Parameters, parameter

from .motion import MODELS

MAX_COORDINATE = 1e6
"""Maximum absolute value of a coordinate; larger values are mistakes."""
LASERS = ("beam", "likelihood_field", "likelihood_field_prob")


@dataclass(frozen=True)
class AmclConfig(Parameters):
    """The private parameters of amcl that can change at run time."""

    dynamic = True

    odom_model_type: str = parameter("diff", "how the robot moves", choices=MODELS)
    odom_alpha1: float = parameter(0.2, "rotation's error by rotation", minimum=0.0, maximum=10.0)
    odom_alpha2: float = parameter(0.2, "rotation's error by translation", minimum=0.0, maximum=10.0)
    odom_alpha3: float = parameter(0.2, "translation's error by translation", minimum=0.0, maximum=10.0)
    odom_alpha4: float = parameter(0.2, "translation's error by rotation", minimum=0.0, maximum=10.0)
    odom_alpha5: float = parameter(0.2, "sideways translation's error (omni only)", minimum=0.0, maximum=10.0)
    odom_frame_id: str = parameter("odom", "the odometry's frame")
    base_frame_id: str = parameter("base_link", "the robot's frame")
    global_frame_id: str = parameter("map", "the map's frame")
    update_min_d: float = parameter(0.2, "distance driven before an update", unit="m", minimum=0.0, maximum=5.0)
    update_min_a: float = parameter(
        math.pi / 6, "angle turned before an update", unit="rad", minimum=0.0, maximum=math.tau
    )
    min_particles: int = parameter(100, "minimum number of particles", minimum=0, maximum=1000)
    max_particles: int = parameter(5000, "maximum number of particles", minimum=0, maximum=10000)
    kld_err: float = parameter(
        0.01, "maximum divergence between the true and the estimated distribution", minimum=0.0, maximum=1.0
    )
    kld_z: float = parameter(
        0.99, "normal quantile of the probability that the divergence is below kld_err", minimum=0.0, maximum=1.0
    )
    resample_interval: int = parameter(2, "number of updates between resamplings", minimum=0, maximum=20)
    selective_resampling: bool = parameter(
        False, "resample only when the effective number is below half of the particles"
    )
    recovery_alpha_slow: float = parameter(
        0.0, "decay rate of the long-term average likelihood; 0: no recovery", minimum=0.0, maximum=0.5
    )
    recovery_alpha_fast: float = parameter(
        0.0, "decay rate of the short-term average likelihood; 0: no recovery", minimum=0.0, maximum=1.0
    )
    laser_model_type: str = parameter("likelihood_field", "the measurement model of scans", choices=LASERS)
    laser_min_range: float = parameter(
        -1.0,
        "beams up to this length count as the longest; -1: the scan's range_min",
        unit="m",
        minimum=-1.0,
        maximum=1000.0,
    )
    laser_max_range: float = parameter(
        -1.0, "longer beams count as no hit; -1: the scan's range_max", unit="m", minimum=-1.0, maximum=1000.0
    )
    laser_max_beams: int = parameter(30, "number of beams of a scan that are used", minimum=0, maximum=250)
    laser_z_hit: float = parameter(0.95, "share of beams that hit an obstacle in the map", minimum=0.0, maximum=1.0)
    laser_z_short: float = parameter(0.1, "share of beams that end early (beam only)", minimum=0.0, maximum=1.0)
    laser_z_max: float = parameter(0.05, "share of beams without a hit (beam only)", minimum=0.0, maximum=1.0)
    laser_z_rand: float = parameter(0.05, "share of beams that end anywhere", minimum=0.0, maximum=1.0)
    laser_sigma_hit: float = parameter(0.2, "deviation of a beam that hits", unit="m", minimum=0.0, maximum=10.0)
    laser_lambda_short: float = parameter(
        0.1, "decay of beams that end early (beam only)", unit="1/m", minimum=0.0, maximum=10.0
    )
    laser_likelihood_max_dist: float = parameter(
        2.0, "upper bound of the distance to an obstacle", unit="m", minimum=0.0, maximum=20.0
    )
    do_beamskip: bool = parameter(False, "ignore beams that most particles cannot explain (likelihood_field_prob only)")
    beam_skip_distance: float = parameter(
        0.5,
        "a beam agrees with a particle if it ends within this distance of an obstacle",
        unit="m",
        minimum=0.0,
        maximum=2.0,
    )
    beam_skip_threshold: float = parameter(0.3, "share of particles a beam has to agree with", minimum=0.0, maximum=1.0)
    tf_broadcast: bool = parameter(True, "publish the transform from the map to the odometry's frame")
    transform_tolerance: float = parameter(
        0.1, "how far the published transform is dated in the future", unit="s", minimum=0.0, maximum=2.0
    )
    force_update_after_initialpose: bool = parameter(
        False, "use the next scan after an initial pose even if the robot has not moved"
    )
    force_update_after_set_map: bool = parameter(
        False, "use the next scan after a new map even if the robot has not moved"
    )
    gui_publish_rate: float = parameter(
        -1.0,
        "maximum rate of publishing scans and paths for display; -1: no limit",
        unit="Hz",
        minimum=-1.0,
        maximum=100.0,
    )
    save_pose_rate: float = parameter(
        0.5, "rate at which the pose is written to the parameters", unit="Hz", minimum=-1.0, maximum=10.0
    )
    use_map_topic: bool = parameter(False, "subscribe to map instead of calling static_map")
    first_map_only: bool = parameter(False, "use only the first map")
    restore_defaults: bool = parameter(False, "reset all parameters to their initial values")


@dataclass(frozen=True)
class AmclParameters(AmclConfig):
    """All private parameters of amcl."""

    allowed = ("bag_scan_period", "tf_prefix")

    recovery_candidates: int = parameter(
        1,
        "number of random poses from which the scan's likelihood chooses each random particle (rosmini's own; 1: as "
        "in the original)",
        minimum=1,
        maximum=100,
    )
    beam_skip_error_threshold: float = parameter(0.9, "if a larger fraction of beams would be ignored, all are used")
    std_warn_level_x: float = parameter(
        0.2, "standard deviation above which `/diagnostics` warns; negative: never", unit="m"
    )
    std_warn_level_y: float = parameter(
        0.2, "standard deviation along y above which `/diagnostics` warns; negative: never", unit="m"
    )
    std_warn_level_yaw: float = parameter(
        0.1, "standard deviation of the heading above which `/diagnostics` warns; negative: never", unit="rad"
    )
    initial_pose_x: float = parameter(
        0.0, "x of the robot at the start", unit="m", minimum=-MAX_COORDINATE, maximum=MAX_COORDINATE
    )
    initial_pose_y: float = parameter(
        0.0, "y of the robot at the start", unit="m", minimum=-MAX_COORDINATE, maximum=MAX_COORDINATE
    )
    initial_pose_a: float = parameter(
        0.0, "heading of the robot at the start", unit="rad", minimum=-MAX_COORDINATE, maximum=MAX_COORDINATE
    )
    initial_cov_xx: float = parameter(0.25, "variance of x at the start", unit="m2", minimum=0.0, maximum=1e6)
    initial_cov_yy: float = parameter(0.25, "variance of y at the start", unit="m2", minimum=0.0, maximum=1e6)
    initial_cov_aa: float = parameter(
        (math.pi / 12) ** 2, "variance of the heading at the start", unit="rad2", minimum=0.0, maximum=1e6
    )
