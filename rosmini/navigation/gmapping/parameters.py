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
    """The private parameters."""

    allowed = ("inverted_laser", "enovation")
    """Names in files for real robots that slam_gmapping ignores since it reads the laser's mounting from tf."""

    base_frame: Text = parameter("base_link", "the robot's frame")
    map_frame: Text = parameter("map", "the map's frame")
    odom_frame: Text = parameter("odom", "the odometry's frame")
    throttle_scans: int = parameter(1, "one of so many scans is looked at", minimum=1)
    map_update_interval: float = parameter(5.0, "between two maps", unit="s")
    transform_publish_period: float = parameter(
        0.05, "between two transforms from the map to the odometry's frame; 0: none", unit="s", minimum=0.0
    )
    tf_delay: float | None = parameter(
        None, "by so much they are dated into the future; without it transform_publish_period", unit="s"
    )
    maxRange: float | None = parameter(
        None, "ranges from here on hit nothing; without it 1 cm less than the scan's range_max", unit="m"
    )
    maxUrange: float | None = parameter(None, "ranges are used up to here; without it maxRange", unit="m")
    minimumScore: float = parameter(0.0, "a match that scores less is not taken")
    sigma: float = parameter(0.05, "the matcher's tolerance of ends", minimum=1e-6)
    kernelSize: int = parameter(1, "so many cells around an end are looked at", minimum=0, maximum=10)
    lstep: float = parameter(0.05, "the matcher's first step", unit="m", minimum=0.0)
    astep: float = parameter(0.05, "the matcher's first turn", unit="rad", minimum=0.0)
    iterations: int = parameter(5, "so often steps are halved", minimum=0, maximum=50)
    lsigma: float = parameter(0.075, "the likelihood's tolerance of ends", minimum=1e-6)
    ogain: float = parameter(3.0, "how much likelihoods are smoothed", minimum=1e-6)
    lskip: int = parameter(0, "so many beams are left out after each")
    srr: float = parameter(0.1, "translation's error by translation", minimum=0.0)
    srt: float = parameter(0.2, "rotation's error by translation", minimum=0.0)
    str: float = parameter(0.1, "translation's error by rotation", minimum=0.0)
    stt: float = parameter(0.2, "rotation's error by rotation", minimum=0.0)
    linearUpdate: float = parameter(1.0, "a scan is taken in after so much driving", unit="m")
    angularUpdate: float = parameter(0.5, "or so much turning", unit="rad")
    temporalUpdate: float = parameter(-1.0, "or after so much time; below 0: never", unit="s")
    resampleThreshold: float = parameter(0.5, "resample when fewer than this share of the particles count")
    particles: int = parameter(30, "the number of paths, each with a map", minimum=1, maximum=10_000)
    xmin: float = parameter(-100.0, "the map reaches from here", unit="m")
    ymin: float = parameter(-100.0, "the map reaches from here", unit="m")
    xmax: float = parameter(100.0, "to here at first", unit="m")
    ymax: float = parameter(100.0, "to here at first", unit="m")
    delta: float = parameter(0.05, "the side of a cell", unit="m", minimum=1e-3)
    llsamplerange: float = parameter(0.01, "as in the original it is read, and changes nothing", unit="m")
    llsamplestep: float = parameter(0.01, "as in the original it is read, and changes nothing", unit="m")
    lasamplerange: float = parameter(0.005, "as in the original it is read, and changes nothing", unit="rad")
    lasamplestep: float = parameter(0.005, "as in the original it is read, and changes nothing", unit="rad")
    occ_thresh: float = parameter(0.25, "a cell is occupied if more than this share of its visits were ends")

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
            max(0, self.lskip),
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
