"""What is right in the exercises of chapter 38, hector_mapping."""

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


@exercise("38.1", praise="With these three numbers a scan finds its way.")
def slopes(answer: Any) -> None:
    """The height of a bilinear surface between four cells, and both slopes."""
    expect(callable(answer), f"{answer!r} is no function.", "def slopes(a, b, c, d, fx, fy)")
    random = np.random.default_rng(38)
    for corners in random.uniform(0.1, 0.9, (5, 2, 2)):
        fx, fy = random.uniform(0.1, 0.9, 2).tolist()
        (a, b), (c, d) = corners.tolist()
        found = answer(a, b, c, d, fx, fy)
        expect(
            isinstance(found, tuple | list | np.ndarray) and len(found) == 3,
            f"It returned {found!r}, and not three numbers.",
            "return height, along_x, along_y",
        )
        wanted = surface(corners, fx, fy)
        for name, mine, right in zip(
            ("height", "slope along x", "slope along y"), found, wanted, strict=True
        ):
            expect(
                abs(mine - right) < 1e-6,
                f"The {name} at fx = {fx:.2f}, fy = {fy:.2f} between {a:.2f}, {b:.2f} (below) and {c:.2f}, {d:.2f} "
                f"(above) is {mine:.3f}, and should be {right:.3f}.",
                "the slope along x is b - a at the bottom and d - c at the top; in between, it is in between",
            )


def mapper(trial: Trial) -> HectorMapping:
    """Start hector_mapping in a trial, for a robot that is its laser."""
    started = rosrun("hector_mapping", "hector_mapping", *MAPPER, graph=trial.graph, capture_output=True)
    return cast("HectorMapping", cast("Any", started).instance())


@exercise("38.2", praise="Whoever maps by laser alone turns like somebody who carries a full cup.")
def around(answer: Script) -> Any:
    """The robot turns once around, slowly enough for hector_mapping, and stops."""
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
        expect(degrees > 30, f"The robot turned by {degrees:.0f} degrees in 40 s.", "angular.z in rad/s")
        off = abs(math.degrees(math.remainder(hector.slam.pose[2] - before, math.tau)))
        expect(
            off < 15,
            f"hector_mapping is lost: its heading is {round(off, -1):.0f} degrees off.",
            "at 5 scans a second, how many degrees are between two of them?",
        )
        expect(
            330 < degrees < 400,
            f"The robot turned by {degrees:.0f} degrees in 40 s, and not once around.",
            "seconds = 2 pi / turn, then an empty Twist; a command holds for half a second only",
        )
        return trial.view()


@exercise("38.3", praise="A map that begins where you say can be laid beside another.")
def begin(answer: Script) -> None:
    """The map is begun again with the robot at (1, 0.5), looking along y."""
    with Trial("room", "_tf:=false", is_shown=False) as trial:
        hector = mapper(trial)
        trial.run(2.0)
        old = hector.slam.maps
        trial.start(answer)
        trial.run(3.0)
        expect(
            hector.slam.maps is not old, "The map is the old one.", "rospy.ServiceProxy(name, ResetMapping)"
        )
        x, y, heading = hector.slam.pose
        expect(
            math.dist((x, y), (1.0, 0.5)) < 0.1,
            f"The robot is at ({x:.1f}, {y:.1f}), and not at (1.0, 0.5).",
            "initial_pose is a geometry_msgs/Pose",
        )
        expect(
            abs(math.degrees(heading) - 90) < 5,
            f"The robot's heading is {math.degrees(heading):.0f} degrees, and not 90.",
            "a quarter of a turn is z = sin(45 degrees), w = cos(45 degrees)",
        )


@exercise("38.4", praise="Level at last, whatever the robot does.")
def level(answer: Script) -> None:
    """Roll and pitch of an IMU, without its heading, as the transform from base_stabilized to base_link."""
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
                "Nobody says on tf where base_link is in base_stabilized.",
                "sendTransform(translation, rotation, time, child, parent)",
            )
            found = rpy(transform_of(buffer.lookup_transform("base_stabilized", "base_link")))
            wrong = abs(math.remainder(found[2], math.tau))
            expect(wrong < 0.01, f"The level frame turns by {wrong:.1f} rad with the robot.", "yaw is 0")
            expect(
                math.dist(found[:2], (roll, pitch)) < 0.01,
                f"Roll {roll} and pitch {pitch} became {found[0]:.2f} and {found[1]:.2f}.",
                "euler_from_quaternion gives roll, pitch, yaw, in this order",
            )
