"""Checks of the exercises in the chapter Hector mapping."""

from __future__ import annotations

import math
from typing import Any, cast

import numpy as np

from rosmini.book.checks import Script, exercise, expect, expect_type
from rosmini.book.drives import launched
from rosmini.book.trials import Trial, TurtleTrial
from rosmini.core.maps import GridMap
from rosmini.core.tf import Buffer, TransformListener
from rosmini.core.tf.messages import transform_of
from rosmini.core.tf.rigid import from_rpy, rpy
from rosmini.core.time import Time
from rosmini.msgs.geometry_msgs.msg import Twist
from rosmini.msgs.nav_msgs.msg import OccupancyGrid
from rosmini.msgs.sensor_msgs.msg import Imu
from rosmini.navigation.hector_mapping.matching import surface
from rosmini.navigation.hector_mapping.node import HectorMapping
from rosmini.ros.scripts import rosrun

FRAMES = """
<launch>
  <include file="$(find turtlebot3_bringup)/launch/turtlebot3_remote.launch">
    <arg name="model" value="burger"/>
  </include>
</launch>
"""
MAPPER = ("_use_tf_scan_transformation:=false", "_pub_map_odom_transform:=false", "_map_size:=200")


@exercise("slopes", praise="The scan matcher needs exactly these three numbers.")
def slopes(answer: Any) -> None:
    """The value of a bilinear surface between four cells, and both slopes."""
    expect(callable(answer), f"{answer!r} is not a function.", "write def slopes(a, b, c, d, fx, fy)")
    random = np.random.default_rng(38)
    for corners in random.uniform(0.1, 0.9, (5, 2, 2)):
        fx, fy = random.uniform(0.1, 0.9, 2).tolist()
        (a, b), (c, d) = corners.tolist()
        found = answer(a, b, c, d, fx, fy)
        expect(
            isinstance(found, tuple | list | np.ndarray) and len(found) == 3,
            f"It returned {found!r}, not three numbers.",
            "return height, along_x, along_y",
        )
        wanted = surface(corners, fx, fy)
        for name, mine, right in zip(("height", "slope along x", "slope along y"), found, wanted, strict=True):
            expect(
                abs(mine - right) < 1e-6,
                f"The {name} at fx = {fx:.2f}, fy = {fy:.2f} between {a:.2f}, {b:.2f} (below) and {c:.2f}, {d:.2f} "
                f"(above) is {mine:.3f}, but should be {right:.3f}.",
                "the slope along x is b - a at the bottom and d - c at the top; interpolate between them",
            )


def mapper(trial: Trial) -> HectorMapping:
    """Start hector_mapping in a trial, with the laser's frame as the robot's."""
    started = rosrun("hector_mapping", "hector_mapping", *MAPPER, graph=trial.graph, capture_output=True)
    return cast("HectorMapping", cast("Any", started).instance())


@exercise("around", praise="At this speed, mapping from the laser alone keeps the heading.")
def around(answer: Script) -> Any:
    """The robot makes one full turn, slowly enough for hector_mapping, and stops."""
    with Trial("room", "_tf:=false") as trial:
        hector = mapper(trial)
        trial.run(0.5)
        trial.start(answer)
        turned, before = 0.0, trial.robot.truth()[2]
        for _ in range(400):
            trial.run(0.1)
            heading = trial.robot.truth()[2]
            turned, before = turned + math.remainder(heading - before, math.tau), heading
        degrees = abs(math.degrees(turned))
        expect(degrees > 30, f"The robot turned by {degrees:.0f} degrees in 40 s.", "angular.z is in rad/s")
        off = abs(math.degrees(math.remainder(hector.slam.pose[2] - before, math.tau)))
        expect(
            off < 15,
            f"hector_mapping is lost: its heading is {round(off, -1):.0f} degrees off.",
            "turn more slowly: how many degrees are between two of the 5 scans a second?",
        )
        expect(
            330 < degrees < 400,
            f"The robot turned by {degrees:.0f} degrees in 40 s, not by 360.",
            "turn for 2 pi / angular.z seconds, then publish an empty Twist; repeat commands, because each "
            "holds for half a second",
        )
        return trial.view()


@exercise("fits", praise="The map has room where the building is.")
def fits(answer: Any) -> Any:
    """A launch file whose map contains a building of 12 m by 8 m, with the robot at one end."""
    expect_type(answer, str, "fits is", "a text")
    with Trial("floor", "_tf:=false") as trial:
        unit = trial.graph.node("unit")
        buffer = TransformListener(unit, Buffer(unit)).buffer
        maps: list[Any] = []
        unit.subscriber("map", OccupancyGrid, maps.append)
        driver = unit.publisher("cmd_vel", Twist, queue_size=1)
        launched(FRAMES, trial.graph)
        launched(answer, trial.graph)
        expect("/hector_mapping" in trial.graph.nodes, "There is no node /hector_mapping.", "include the launch file")
        ahead = Twist()
        ahead.linear.x = 0.2
        for _ in range(200):
            driver.publish(ahead)
            trial.run(0.1)
        expect(bool(maps), "There is no map on /map.", "keep the topics of turtlebot3_hector.launch")
        found = GridMap.from_message(maps[-1])
        height, width = found.occupancy.shape
        expect(
            width <= 256 and math.isclose(found.resolution, 0.05, abs_tol=1e-6),
            f"The map has {width} x {height} cells of {found.resolution:.3g} m, but at most 256 of 0.05 m are allowed.",
            "map_size is the number of cells along each side",
        )
        _expect_room(found)
        expect(
            buffer.can_transform_core("map", "base_footprint", Time())[0],
            "There is no transform from map to base_footprint.",
            "this robot has no odometry: set odom_frame to the robot's own frame",
        )
        return trial.view()


def _expect_room(found: GridMap) -> None:
    """Expect that the building lies in a map whose origin is where the robot started."""
    height, width = found.occupancy.shape
    for axis, (low, high), cells in ((0, (-1.0, 11.0), width), (1, (-4.0, 4.0), height)):
        start = found.origin[axis]
        end = start + cells * found.resolution
        name = "xy"[axis]
        expect(
            start < low + 0.01 and end > high - 0.01,
            f"Along {name} the map reaches from {start:.1f} m to {end:.1f} m, but the building extends from {low:g} m "
            f"to {high:g} m, seen from the robot.",
            f"map_start_{name} is the robot's position in the map, from 0 to 1",
        )


@exercise("level", praise="The frame stays level when the robot tilts.")
def level(answer: Script) -> None:
    """The transform from base_stabilized to base_link has the IMU's roll and pitch, without its heading."""
    with TurtleTrial(None) as trial:
        unit = trial.graph.node("unit")
        buffer = TransformListener(unit, Buffer(unit)).buffer
        sender = unit.publisher("imu", Imu, queue_size=5)
        trial.start(answer)
        trial.run(2.0)
        for roll, pitch, yaw in ((0.1, -0.2, 1.0), (-0.15, 0.05, -2.0)):
            message = Imu()
            message.header.stamp = unit.now()
            q = message.orientation
            q.x, q.y, q.z, q.w = from_rpy((0.0, 0.0, 0.0), roll, pitch, yaw)[3:]
            sender.publish(message)
            trial.run(0.5)
            expect(
                buffer.can_transform_core("base_stabilized", "base_link", Time())[0],
                "There is no transform from base_stabilized to base_link on tf.",
                "call sendTransform(translation, rotation, time, child, parent)",
            )
            found = rpy(transform_of(buffer.lookup_transform("base_stabilized", "base_link")))
            wrong = abs(math.remainder(found[2], math.tau))
            expect(wrong < 0.01, f"The level frame turns by {wrong:.1f} rad with the robot.", "set yaw to 0")
            expect(
                math.dist(found[:2], (roll, pitch)) < 0.01,
                f"Roll {roll} and pitch {pitch} became {found[0]:.2f} and {found[1]:.2f}.",
                "euler_from_quaternion returns roll, pitch and yaw, in this order",
            )
