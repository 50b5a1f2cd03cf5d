"""The parameters of `gmapping/slam_gmapping` (http://wiki.ros.org/gmapping#Parameters)."""

from __future__ import annotations

from dataclasses import dataclass

from rosmini.core.parameters import Parameters, parameter

from .matching import Matcher
from .slam import Settings

Text = str
"""An alias of `str`, which is also the name of a parameter."""


@dataclass(frozen=True)
class GmappingParameters(Parameters):
    """The private parameters of `slam_gmapping`."""

    allowed = ("inverted_laser", "enovation")
    """Names in files for real robots that slam_gmapping ignores since it reads the laser's mounting from tf."""

    base_frame: Text = parameter("base_link", "the robot's frame")
    map_frame: Text = parameter("map", "the map's frame")
    odom_frame: Text = parameter("odom", "the odometry's frame")
    throttle_scans: int = parameter(1, "use only every n-th scan", limits=(1, None))
    map_update_interval: float = parameter(5.0, "interval between two maps", unit="s")
    transform_publish_period: float = parameter(
        0.05, "interval between two transforms from map to odom; 0: none", unit="s", limits=(-1e6, 1e6)
    )
    tf_delay: float | None = parameter(
        None,
        "how far the transforms are dated in the future; by default transform_publish_period",
        unit="s",
        limits=(-1e6, 1e6),
    )
    maxRange: float | None = parameter(
        None,
        "longer ranges count as no hit; by default 1 cm less than the scan's range_max",
        unit="m",
        limits=(0.0, None),
    )
    maxUrange: float | None = parameter(
        None, "maximum range that is used; by default maxRange", unit="m", limits=(0.0, None)
    )
    minimumScore: float = parameter(0.0, "a match with a lower score is rejected")
    sigma: float = parameter(0.05, "the matcher's tolerance of ends", limits=(1e-6, None))
    kernelSize: int = parameter(1, "number of cells to search around an end", limits=(None, 10))
    lstep: float = parameter(0.05, "the matcher's first step", unit="m")
    astep: float = parameter(0.05, "the matcher's first turn", unit="rad")
    iterations: int = parameter(5, "how often steps are halved", limits=(0, 50))
    lsigma: float = parameter(0.075, "the likelihood's tolerance of ends", limits=(1e-6, None))
    ogain: float = parameter(3.0, "how much likelihoods are smoothed", limits=(1e-6, None))
    lskip: int = parameter(0, "number of beams to skip after each one; negative: skip all")
    srr: float = parameter(0.1, "error of translation from translation")
    srt: float = parameter(0.2, "error of rotation from translation")
    str: float = parameter(0.1, "error of translation from rotation")
    stt: float = parameter(0.2, "error of rotation from rotation")
    linearUpdate: float = parameter(1.0, "a scan is processed after this much driving", unit="m")
    angularUpdate: float = parameter(0.5, "a scan is processed after this much turning", unit="rad")
    temporalUpdate: float = parameter(-1.0, "a scan is processed after this much time; negative: never", unit="s")
    resampleThreshold: float = parameter(0.5, "resample when the effective fraction of particles is below this")
    particles: int = parameter(30, "the number of paths, each with a map", minimum=1, limits=(None, 10_000))
    xmin: float = parameter(-100.0, "lower bound of the initial map", unit="m", limits=(-1e6, 1e6))
    ymin: float = parameter(-100.0, "lower bound of the initial map", unit="m", limits=(-1e6, 1e6))
    xmax: float = parameter(100.0, "upper bound of the initial map", unit="m", limits=(-1e6, 1e6))
    ymax: float = parameter(100.0, "upper bound of the initial map", unit="m", limits=(-1e6, 1e6))
    delta: float = parameter(0.05, "the side of a cell", unit="m", minimum=1e-9, limits=(1e-3, None))
    llsamplerange: float = parameter(0.01, "has no effect, as in ROS", unit="m")
    llsamplestep: float = parameter(0.01, "has no effect, as in ROS", unit="m")
    lasamplerange: float = parameter(0.005, "has no effect, as in ROS", unit="rad")
    lasamplestep: float = parameter(0.005, "has no effect, as in ROS", unit="rad")
    occ_thresh: float = parameter(0.25, "a cell is occupied if more than this fraction of its visits were ends")

    def settings(self, range_max: float) -> Settings:
        """Return the filter's settings for a laser with this maximum range [m]."""
        longest = range_max - 0.01 if self.maxRange is None else self.maxRange
        matcher = Matcher(
            self.sigma,
            self.kernelSize,
            self.lstep,
            self.astep,
            self.iterations,
            self.lsigma,
            self.lskip % 2**32,  # unsigned in the original
            self.minimumScore,
        )
        return Settings(
            particles=self.particles,
            delta=self.delta,
            max_range=longest,
            max_urange=longest if self.maxUrange is None else self.maxUrange,
            linear_update=self.linearUpdate,
            angular_update=self.angularUpdate,
            temporal_update=self.temporalUpdate,
            resample_threshold=self.resampleThreshold,
            ogain=self.ogain,
            srr=self.srr,
            srt=self.srt,
            str_=self.str,
            stt=self.stt,
            matcher=matcher,
        )
