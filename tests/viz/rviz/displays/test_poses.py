"""Pose, PoseWithCovariance, PoseArray, Odometry, Path, PointStamped, Polygon: where they are."""

import math

import numpy as np
import pytest

from rosmini.msgs.geometry_msgs.msg import (
    Point32,
    PolygonStamped,
    Pose,
    PoseArray,
    PoseStamped,
    PoseWithCovarianceStamped,
)
from rosmini.msgs.nav_msgs.msg import Odometry, Path
from rosmini.viz.rviz.primitives import Lines

NAN = float("nan")


def pose(x=0.0, y=0.0, yaw=0.0):
    made = Pose()
    made.position.x, made.position.y = x, y
    made.orientation.z, made.orientation.w = math.sin(yaw / 2), math.cos(yaw / 2)
    return made


def extent(mesh):
    return mesh.placed.min(axis=0), mesh.placed.max(axis=0)


def test_an_arrow_points_along_x_and_is_as_long_as_asked(stage):
    scene, display = stage.display("Pose", "/goal", more={"Shaft Length": 2.0, "Head Length": 1.0})
    stage.publish("/goal", PoseStamped(pose=pose(1.0, 2.0, math.pi / 2)), "map")
    (mesh,) = scene.update()[0].primitives
    low, high = extent(mesh)
    assert (low[1], high[1]) == pytest.approx((2.0, 5.0), abs=1e-6)
    display["Shape"] = "Axes"
    x, y, z = scene.update()[0].primitives
    assert x.colours[:3].tolist() == [1, 0, 0]
    assert extent(x)[1][1] == pytest.approx(3.0, abs=1e-6)
    assert extent(y)[0][0] == pytest.approx(0.0, abs=1e-6)
    assert extent(z)[1][2] == pytest.approx(1.0, abs=1e-6)


def test_a_pose_that_is_none(stage, statuses):
    scene, display = stage.display("Pose", "/goal")
    stage.publish("/goal", PoseStamped(pose=pose(NAN)), "map")
    assert scene.update()[0].primitives == ()
    said = "Message contained invalid floating point values (nans or infs)"
    assert statuses(display)["Topic"] == ("Error", said)
    zeros = PoseStamped()
    zeros.pose.orientation.w = 0.0
    stage.publish("/goal", zeros, "map")
    assert len(scene.update()[0].primitives) == 1
    level, text = statuses(display)["Message"]
    assert level == "Warn" and "quaternion" in text
    stage.publish("/goal", PoseStamped(pose=pose()), "map")
    scene.update()
    assert "Message" not in statuses(display)


def covariance(x, y, yaw):
    made = np.zeros((6, 6))
    made[0, 0], made[1, 1], made[5, 5] = x, y, yaw
    return made.ravel().tolist()


def test_an_ellipsoid_has_the_standard_deviations_as_half_axes(stage, statuses):
    scene, display = stage.display("PoseWithCovariance", "/amcl_pose")
    message = PoseWithCovarianceStamped()
    message.pose.pose, message.pose.covariance = pose(yaw=math.pi / 2), covariance(0.25, 0.04, 0.09)
    stage.publish("/amcl_pose", message, "map")
    _, ellipsoid, fan = scene.update()[0].primitives
    low, high = extent(ellipsoid)
    assert high[:2] - low[:2] == pytest.approx([0.4, 1.0], rel=0.02)  # turned with the pose
    assert high[2] - low[2] < 0.01
    ends = fan.placed[1:]
    angles = np.arctan2(ends[:, 1], ends[:, 0])
    assert (angles.min(), angles.max()) == pytest.approx((math.pi / 2 - 0.3, math.pi / 2 + 0.3))
    message.pose.covariance = covariance(-1.0, 1.0, 0.0)
    stage.publish("/amcl_pose", message, "map")
    scene.update()
    level, text = statuses(display)["Topic"]
    assert level == "Error" and "negative variances" in text
    display["Covariance"] = False
    assert len(scene.update()[0].primitives) == 1


def test_a_huge_variance_means_unknown(stage, statuses):
    scene, display = stage.display("PoseWithCovariance", "/amcl_pose", more={"Covariance/Orientation": False})
    message = PoseWithCovarianceStamped()
    message.pose.pose, message.pose.covariance = pose(), covariance(0.25, 1e12, 0.0)
    stage.publish("/amcl_pose", message, "map")
    _, ellipsoid = scene.update()[0].primitives
    assert extent(ellipsoid)[1][1] < 0.01
    assert "unknown" in statuses(display)["Message"][1]


def odometry(x, yaw=0.0):
    made = Odometry()
    made.pose.pose = pose(x, 0.0, yaw)
    return made


def test_odometry_drops_an_arrow_after_each_step_and_keeps_the_last(stage):
    scene, display = stage.display("Odometry", "/odom", Keep=3, Covariance=False)
    for x in (0.0, 0.05, 0.09, 0.11, 0.15, 0.25, 0.4):
        stage.publish("/odom", odometry(x), "map")
    assert [each.pose[0, 3] for each in scene.update()[0].primitives] == pytest.approx([0.11, 0.25, 0.4])
    stage.publish("/odom", odometry(0.4, 0.2), "map")
    assert len(scene.update()[0].primitives) == 3
    display["Keep"] = 0
    for x in range(5):
        stage.publish("/odom", odometry(1.0 + x), "map")
    assert len(scene.update()[0].primitives) == 8
    assert display["Shape/Color"] == (255, 25, 0)


def test_a_path_is_a_line_and_its_poses_are_shown_if_asked(stage, statuses):
    scene, display = stage.display("Path", "/plan", Offset=(0.0, 0.0, 1.0))
    path = Path(poses=[PoseStamped(pose=pose(x)) for x in (0.0, 1.0, 2.0)])
    stage.publish("/plan", path, "map")
    (line,) = scene.update()[0].primitives
    assert line.points == pytest.approx(np.array([(0, 0, 1), (1, 0, 1), (2, 0, 1)]))
    assert line.width == 0.0
    display["Line Style"], display["Pose Style"] = "Billboards", "Arrows"
    line, *arrows = scene.update()[0].primitives
    assert (line.width, len(arrows)) == (0.03, 3)
    stage.publish("/plan", Path(), "map")
    scene.update()
    assert statuses(display)["Path"] == ("Warn", "0 poses")
    stage.publish("/plan", Path(poses=[PoseStamped(pose=pose(NAN))]), "map")
    scene.update()
    assert statuses(display)["Topic"][0] == "Error"


def test_particles_are_one_primitive_or_solid_ones_in_bounds(stage, statuses):
    scene, display = stage.display("PoseArray", "/particlecloud")
    stage.publish("/particlecloud", PoseArray(poses=[pose(float(i)) for i in range(1200)]), "map")
    (lines,) = scene.update()[0].primitives
    assert isinstance(lines, Lines)
    assert len(lines.segments()) == 3600
    display["Shape"] = "Arrow (3D)"
    assert len(scene.update()[0].primitives) == 400
    assert statuses(display)["Poses"] == ("Warn", "Showing [400] of [1200] poses")
    stage.publish("/particlecloud", PoseArray(), "map")
    display["Shape"] = "Arrow (Flat)"
    assert scene.update()[0].primitives == ()


def test_a_polygon_is_closed(stage, statuses):
    scene, display = stage.display("Polygon", "/footprint")
    message = PolygonStamped()
    message.polygon.points = [Point32(x=x, y=y) for x, y in ((0, 0), (1, 0), (1, 1))]
    stage.place("map", "base", (5.0, 0.0, 0.0))
    stage.publish("/footprint", message, "base")
    (line,) = scene.update()[0].primitives
    assert line.points[:, 0].tolist() == [5, 6, 6, 5]
    message.polygon.points[0].x = math.inf
    stage.place("map", "base", (5.0, 0.0, 0.0))
    stage.publish("/footprint", message, "base")
    scene.update()
    assert statuses(display)["Topic"][0] == "Error"
    message.polygon.points = []
    stage.publish("/footprint", message, "map")
    (line,) = scene.update()[0].primitives
    assert len(line.points) == 0
