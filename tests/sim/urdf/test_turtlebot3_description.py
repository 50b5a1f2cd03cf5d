"""Our description of the TurtleBot3: whole, and with the numbers of the engine's models."""

import math

import numpy as np
import pytest

from rosmini.sim.models import model
from rosmini.sim.urdf import Cylinder, load
from rosmini.sim.urdf.xacro import expand

NAMES = ("burger", "waffle", "waffle_pi")


@pytest.fixture(scope="module", params=NAMES)
def both(request):
    name = request.param
    return load(f"package://turtlebot3_description/urdf/turtlebot3_{name}.urdf.xacro"), model(name)


def test_nothing_is_doubtful(both):
    robot, known = both
    assert robot.notes == ()
    assert robot.name == f"turtlebot3_{known.name}"
    assert robot.root == "base_footprint"


def test_frames_are_those_of_the_real_package(both):
    robot, known = both
    shared = {"base_footprint", "base_link", "wheel_left_link", "wheel_right_link", "imu_link", "base_scan"}
    rgb = {"camera_link", "camera_rgb_frame", "camera_rgb_optical_frame"}
    depth = {"camera_depth_frame", "camera_depth_optical_frame"}
    casters = {"caster_back_right_link", "caster_back_left_link"}
    more = {"burger": {"caster_back_link"}, "waffle": casters | rgb | depth, "waffle_pi": casters | rgb}
    assert set(robot.links) == shared | more[known.name]


def test_wheels(both):
    robot, known = both
    at = robot.transforms()
    for side in ("left", "right"):
        wheel = robot.link(f"wheel_{side}_link")
        assert wheel.collisions[0].geometry == Cylinder(known.wheel_radius, 0.018)
        assert at[wheel.name][2, 3] == pytest.approx(known.wheel_radius)  # they stand on the ground
        # A positive turn rolls the robot ahead: about y.
        assert at[wheel.name][:3, :3] @ robot.joint(f"wheel_{side}_joint").axis == pytest.approx([0, 1, 0])
    apart = at["wheel_left_link"][1, 3] - at["wheel_right_link"][1, 3]
    assert apart == pytest.approx(
        known.wheel_separation, abs=1.1e-3
    )  # the Waffles': 0.288 in the URDF, 0.287 in the firmware


def test_sensors_are_where_the_model_has_them(both):
    robot, known = both
    at = robot.transforms()
    assert at["base_scan"][:3, 3] == pytest.approx(known.laser.mount)
    assert at["imu_link"][:3, 3] == pytest.approx(known.unit.mount)
    for camera in known.cameras:
        assert at["camera_rgb_frame"][:3, 3] == pytest.approx(camera.mount)
        optical = at["camera_rgb_optical_frame"][:3, :3]
        assert optical == pytest.approx(np.array([[0, 0, 1], [-1, 0, 0], [0, -1, 0]]), abs=1e-12)


def test_mass_and_inertia(both):
    robot, known = both
    at = robot.transforms()
    about = 0.0
    for link in robot.links.values():
        if link.inertial is not None:
            place = at[link.name] @ link.inertial.origin.matrix
            turned = place[:3, :3] @ link.inertial.matrix @ place[:3, :3].T
            about += turned[2, 2] + link.inertial.mass * (place[0, 3] ** 2 + place[1, 3] ** 2)
    assert about == pytest.approx(known.inertia, rel=0.12)
    # What the e-manual weighs has cables and screws; the description of the Waffles leaves out more.
    assert 0.8 * known.mass < robot.mass <= 1.01 * known.mass


def test_what_gazebo_is_told_is_what_the_model_has(both):
    robot, known = both
    plugins = {
        each.get("filename"): each
        for extension in robot.extensions
        for each in extension.element.walk()
        if each.tag == "plugin"
    }
    drive = plugins["libgazebo_ros_diff_drive.so"]
    assert float(drive.word("wheelSeparation")) == known.wheel_separation
    assert float(drive.word("wheelDiameter")) == 2 * known.wheel_radius
    assert float(drive.word("wheelAcceleration")) == known.wheel_acceleration
    assert float(drive.word("updateRate")) == known.rate
    assert float(plugins["libgazebo_ros_imu.so"].word("updateRate")) == known.unit.rate
    sensors = {e.get("name"): e for x in robot.extensions for e in x.element.all("sensor")}
    ray = sensors["lds_lfcd_sensor"]
    assert float(ray.word("update_rate")) == known.laser.rate
    assert int(ray.word("ray/scan/horizontal/samples")) == known.laser.beams
    assert (float(ray.word("ray/range/min")), float(ray.word("ray/range/max"))) == (
        known.laser.range_min,
        known.laser.range_max,
    )
    assert float(ray.word("ray/noise/stddev")) == known.laser.noise
    cameras = [each for each in sensors.values() if each.get("type") in {"camera", "depth"}]
    for element, camera in zip(cameras, known.cameras, strict=True):
        assert int(element.word("camera/image/width")) == camera.width
        assert float(element.word("camera/horizontal_fov")) == camera.horizontal_fov
        assert float(element.word("camera/clip/far")) == camera.far
    references = {each.reference for each in robot.extensions if each.reference}
    assert references <= set(robot.links)


def test_pictures_can_be_smaller():
    file = "package://turtlebot3_description/urdf/turtlebot3_waffle_pi.urdf.xacro"
    assert "<width>160</width>" in expand(file, {"camera_width": 160, "camera_height": 120})


def test_limits_of_the_wheels_allow_the_published_speeds(both):
    robot, known = both
    limit = robot.joint("wheel_left_joint").limit
    fastest = max(known.max_linear, known.max_angular * known.wheel_separation / 2) / known.wheel_radius
    assert limit.velocity == pytest.approx(fastest, abs=0.01)
    assert math.isfinite(limit.effort)
