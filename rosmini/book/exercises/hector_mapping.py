"""Checks of the exercises in the chapter Hector mapping."""

from __future__ import annotations

import math
from typing import Any, cast

import numpy as np

from rosmini.book.checks import Script, exercise, expect
from rosmini.book.trials import Trial, TurtleTrial
from rosmini.core.tf import Buffer, TransformListener
from rosmini.core.tf.messages import transform_of
from rosmini.core.tf.rigid import from_rpy, rpy
from rosmini.core.time import Time
from rosmini.msgs.sensor_msgs.msg import Imu
from rosmini.navigation.hector_mapping import surface
from rosmini.navigation.hector_mapping.node import HectorMapping
from rosmini.ros.scripts import rosrun

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


@exercise("begin", praise="Two maps with chosen origins can be compared.")
def begin(answer: Script) -> None:
    """The map is reset with the robot at (1, 0.5), facing along y."""
    with Trial("room", "_tf:=false", is_shown=False) as trial:
        hector = mapper(trial)
        trial.run(2.0)
        old = hector.slam.maps
        trial.start(answer)
        trial.run(3.0)
        expect(hector.slam.maps is not old, "The map was not reset.", "use ServiceProxy(name, ResetMapping)")
        x, y, heading = hector.slam.pose
        expect(
            math.dist((x, y), (1.0, 0.5)) < 0.1,
            f"The robot is at ({x:.1f}, {y:.1f}), not at (1.0, 0.5).",
            "set the position of initial_pose, a geometry_msgs/Pose",
        )
        expect(
            abs(math.degrees(heading) - 90) < 5,
            f"The robot's heading is {math.degrees(heading):.0f} degrees, not 90.",
            "a quarter turn has z = sin(45 degrees) and w = cos(45 degrees)",
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
