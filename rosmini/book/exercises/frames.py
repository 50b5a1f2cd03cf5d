"""Checks of the exercises in the chapter Frames: scripts that publish transforms, and a robot that uses them."""

from __future__ import annotations

import math
from typing import Any

from rosmini.book.checks import Script, exercise, expect
from rosmini.book.trials import Trial
from rosmini.core.tf import Buffer, TransformException, TransformListener
from rosmini.core.tf.messages import transform_of
from rosmini.core.tf.rigid import rpy, transform_points
from rosmini.core.time import Time
from rosmini.msgs.nav_msgs.msg import Odometry
from rosmini.msgs.sensor_msgs.msg import LaserScan

FOLLOW = """
import math
import rospy
import tf2_ros
from geometry_msgs.msg import Twist

def drive(event):
    try:
        found = buffer.lookup_transform("base_footprint", rospy.get_param("~goal"), rospy.Time(0))
    except tf2_ros.TransformException:
        return
    place = found.transform.translation
    command = Twist()
    if math.hypot(place.x, place.y) > 0.3:
        command.linear.x = 0.2
        command.angular.z = math.atan2(place.y, place.x)
    cmd_vel.publish(command)

rospy.init_node("deliver")
buffer = tf2_ros.Buffer()
listener = tf2_ros.TransformListener(buffer)
cmd_vel = rospy.Publisher("cmd_vel", Twist, queue_size=1)
rospy.Timer(rospy.Duration(0.1), drive)
rospy.spin()
"""

FACE = """
import math
import rospy
import tf2_ros
from geometry_msgs.msg import PointStamped, Twist
from sensor_msgs.msg import LaserScan
from tf2_geometry_msgs import do_transform_point

def on_scan(scan):
    nearest = scan.ranges.index(min(scan.ranges))
    angle = scan.angle_min + nearest * scan.angle_increment
    point = PointStamped()
    point.point.x = scan.ranges[nearest] * math.cos(angle)
    point.point.y = scan.ranges[nearest] * math.sin(angle)
    try:
        found = buffer.lookup_transform("base_link", scan.header.frame_id, rospy.Time(0))
    except tf2_ros.TransformException:
        return
    seen = do_transform_point(point, found).point
    command = Twist()
    command.angular.z = 0.5 * math.atan2(seen.y, seen.x)
    cmd_vel.publish(command)

rospy.init_node("face")
buffer = tf2_ros.Buffer()
listener = tf2_ros.TransformListener(buffer)
cmd_vel = rospy.Publisher("cmd_vel", Twist, queue_size=1)
rospy.Subscriber("flipped_scan", LaserScan, on_scan)
rospy.spin()
"""


def listen(trial: Trial) -> Buffer:
    """Return the buffer of a new node of the trial."""
    return TransformListener(trial.graph.node("check")).buffer


# ---- carrot: a frame that hangs on the robot ----

AHEAD, SWING = 0.5, 0.4
"""Position of the carrot ahead of the robot, and its largest distance to the left [m]."""


def edge_of(buffer: Buffer, frame: str, advice: str) -> Any:
    """Return the edge to a frame from its parent. Raises `Wrong` if no node publishes it."""
    edge = buffer.tree.edges.get(frame)
    expect(edge is not None, f"No node publishes the frame {frame}.", f'child_frame_id is "{frame}"; {advice}')
    return edge


@exercise("carrot", praise="The carrot moves with the robot, because the robot is its parent.")
def carrot(answer: Script) -> Any:
    """A frame ahead of the robot swings, and the robot follows it without reaching it."""
    with Trial("arena") as trial:
        buffer = listen(trial)
        trial.start(answer)
        trial.run(1.0)
        parent = edge_of(buffer, "carrot", "tf2 ignores a quaternion of zeros").newest.parent
        expect(
            parent == "base_footprint",
            f"The parent of carrot is {parent}, so the robot does not carry the carrot along.",
            "the parent is header.frame_id",
        )
        for _ in range(4):
            trial.run(0.9)
            edge = buffer.tree.edges["carrot"]
            stamp = edge.newest_ns / 1e9
            expect(
                trial.graph.now().to_sec() - stamp < 0.15,
                f"It is {trial.graph.now().to_sec():.1f} s, and the last carrot has the stamp {stamp:.1f} s.",
                "header.stamp is the time at which the transform holds: rospy.Time.now()",
            )
            x, y, z, *_ = transform_of(buffer.lookup_transform("base_footprint", "carrot", Time(0)))
            expect(
                math.isclose(x, AHEAD, abs_tol=1e-6) and abs(z) < 1e-6,
                f"The carrot is at x = {x:.2f}, z = {z:.2f}, not at x = 0.50, z = 0.00.",
                "x points ahead",
            )
            right = SWING * math.sin(stamp)
            expect(
                abs(y - right) < 1e-3,
                f"At the time {stamp:.2f} s the carrot is at y = {y:.2f}, not at 0.4 sin(t) = {right:.2f}.",
                "t is the time of the stamp: header.stamp.to_sec()",
            )
        trial.start(Script("deliver.py", FOLLOW), "_goal:=carrot")
        trial.run(20.0)
        trial.expect_no_errors()
        return trial.view()


# ---- upside_down: a laser upside down ----

MOUNT = (0.1, 0.0, 0.3)
"""Position of the laser in base_link [m]."""


@exercise("upside_down", praise="The robot turned to the nearest object, although its laser takes left for right.")
def upside_down(answer: Script) -> Any:
    """A static transform turns a laser about its x axis, and a robot faces what the laser sees."""
    with Trial("room", "_x:=0.4", "_y:=1.0") as trial:
        buffer = listen(trial)
        node = trial.graph.node("laser")
        flipped = node.publisher("flipped_scan", LaserScan, queue_size=1)

        def flip(scan: Any) -> None:
            turned = LaserScan(
                header=scan.header,
                angle_min=scan.angle_min,
                angle_max=scan.angle_max,
                angle_increment=scan.angle_increment,
                range_min=scan.range_min,
                range_max=scan.range_max,
                ranges=(scan.ranges[0], *scan.ranges[:0:-1]),
            )
            turned.header.frame_id = "flipped"
            flipped.publish(turned)

        node.subscriber("scan", LaserScan, flip)
        trial.start(answer)
        trial.start(Script("face.py", FACE))
        trial.run(1.0)
        edge = edge_of(buffer, "flipped", "a StaticTransformBroadcaster also reaches later nodes")
        parent = edge.newest.parent
        expect(parent == "base_link", f"The parent of flipped is {parent}, not base_link.", "set header.frame_id")
        trial.run(20.0)
        mounted = transform_of(buffer.lookup_transform("base_link", "flipped", Time(0)))
        expect(edge.static, "The transform is sent on /tf.", "the mounting never moves: StaticTransformBroadcaster")
        place = mounted[:3]
        expect(
            all(abs(a - b) < 1e-6 for a, b in zip(place, MOUNT, strict=True)),
            f"The laser is at {tuple(round(v, 3) for v in place)} in base_link, not at {MOUNT}.",
            "translation.x points ahead and translation.z up",
        )
        x, y, z = transform_points((0.0, 0.0, 0.0, *mounted[3:]), (1.0, 2.0, 3.0)).tolist()
        angles = ", ".join(f"{math.degrees(angle):.0f}" for angle in rpy(mounted))
        expect(
            abs(x - 1) + abs(y + 2) + abs(z + 3) < 1e-2,
            f"Roll, pitch and yaw of your transform are {angles} degrees; the laser is turned about its x axis.",
            "the turn about x is the roll, and 180 degrees are math.pi",
        )
        trial.expect_no_errors()
        return trial.view()


# ---- localise: correct the odometry ----

DRIVER = """
import rospy
from geometry_msgs.msg import Twist

rospy.init_node("driver")
cmd_vel = rospy.Publisher("cmd_vel", Twist, queue_size=1)
command = Twist()
command.linear.x, command.angular.z = 0.2, 0.5
while not rospy.is_shutdown():
    cmd_vel.publish(command)
    rospy.sleep(0.1)
"""

LATE_S = 0.4
"""Delay of the true pose, as from a localisation that needs time [s]."""


@exercise("localise", praise="amcl publishes exactly this transform.")
def localise(answer: Script) -> Any:
    """The transform from map to odom, from a late true pose and the odometry of its time."""
    true: dict[int, tuple[float, float]] = {}
    with Trial("arena", "_x:=0.6", "_y:=-0.4", "_yaw:=0.8") as trial:
        buffer = listen(trial)

        def remember(truth: Any) -> None:
            point = truth.pose.pose.position
            true[truth.header.stamp.to_nsec()] = (point.x, point.y)

        trial.graph.node("witness").subscriber("base_pose_ground_truth", Odometry, remember)
        trial.start(Script("driver.py", DRIVER))
        trial.start(answer)
        trial.run(0.5)
        trial.graph.faults.disturb("/base_pose_ground_truth", delay=LATE_S)
        trial.run(8.0)
        edge = buffer.tree.edges.get("odom")
        expect(edge is not None, "No node publishes a transform with the child odom.", "send map -> odom")
        assert edge is not None  # noqa: S101 - expect has raised
        expect(edge.newest.parent == "map", f"The parent of odom is {edge.newest.parent}, not map.")
        late = (trial.graph.now().to_nsec() - edge.newest_ns) / 1e9
        expect(
            edge.newest_ns > 0 and late < 1.0,
            f"The last transform has the stamp {edge.newest_ns / 1e9:.1f} s, and it is "
            f"{trial.graph.now().to_sec():.1f} s.",
            "give it the stamp of the true pose",
        )
        stamp = max((at for at in true if at <= edge.newest_ns), default=0)
        try:
            x, y, *_ = transform_of(buffer.lookup_transform("map", "base_footprint", Time.from_nsec(stamp)))
        except TransformException as error:
            expect(False, f"map -> base_footprint is unknown: {error}", "send the transform for every message")
            raise
        off = math.hypot(x - true[stamp][0], y - true[stamp][1])
        expect(
            off < 0.02,
            f"In map the robot is {off:.2f} m from where it really is.",
            "look up the odometry at truth.header.stamp, and check the order of the two transforms",
        )
        trial.expect_no_errors()
        return trial.view()
