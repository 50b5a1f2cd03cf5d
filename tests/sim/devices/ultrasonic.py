"""A new sensor in one file: an ultrasonic ranger, which nothing in rosmini knows of."""

import math

import numpy as np

from rosmini.sim.devices.laser import Laser
from rosmini.sim.devices.sensor import Sensor
from rosmini.sim.models import LidarModel

CONE = LidarModel("cone", (0.05, 0.0, 0.1), 31, 10.0, 0.02, 4.0, noise=0.0, angle_min=-0.26, angle_max=0.26)


class Ultrasonic(Sensor):
    """`sensor_msgs/Range`: how near the nearest thing in a cone of 30 degrees is, with noise."""

    message_type = "sensor_msgs/Range"
    default_topic, default_frame = "sonar", "sonar_link"
    default_rate = 10.0
    order = Laser.order + 1  # after the laser
    varying = ("range",)
    saved = ("rng",)

    def __init__(self, *args, noise=0.01, **options):
        super().__init__(*args, **options)
        self.noise, self.rng = noise, self.host.rng(self.name)

    def describe(self, message):
        """Fill in what stays."""
        message.radiation_type = message.ULTRASOUND
        message.field_of_view = CONE.angle_max - CONE.angle_min
        message.min_range, message.max_range = CONE.range_min, CONE.range_max

    def sample(self, _):
        """Return the nearest range, or nothing while there is no echo."""
        nearest = float(np.min(self.host.engine.scan(self.robot.name, lidar=CONE)))
        return (nearest + self.noise * self.rng.standard_normal(),) if math.isfinite(nearest) else None
