"""Drives and sensors come from the plugins' and sensors' tags, never from a model's name."""

import math
from dataclasses import replace

import numpy as np
import pytest

from ..conftest import DIFF_DRIVE, LASER, box, husky, urdf

PLANAR = """<gazebo><plugin name="move" filename="libgazebo_ros_planar_move.so"><commandTopic>go</commandTopic>
  <odometryTopic>where</odometryTopic><odometryRate>10</odometryRate></plugin></gazebo>"""


def test_a_differential_drive_goes_as_its_tags_say(bench):
    there = bench()
    there.spawn(urdf(), "r", robot_namespace="/a/")
    odom = there.hear("/a/odom", "nav_msgs/Odometry")
    joints = there.hear("/a/joint_states", "sensor_msgs/JointState")
    there.drive("/a/cmd_vel", 0.2, 0.5)
    there.graph.run(3.0)
    assert len(odom) in (59, 60)  # updateRate 20
    message = odom[-1]
    assert (message.header.frame_id, message.child_frame_id) == ("a/odom", "a/base_footprint")
    assert message.twist.twist.linear.x == pytest.approx(0.2)
    assert message.twist.twist.angular.z == pytest.approx(0.5)
    assert joints[-1].name == ["left_wheel", "right_wheel"]
    # the wheels' rims go 0.2 -+ 0.5 * 0.15 m/s and have a radius of 5 cm
    assert joints[-1].velocity == pytest.approx([2.5, 5.5], abs=0.01)
    # on a circle of the radius v / w, but for the beginning, in which the wheels gather speed
    x, y, theta = there.pose("r")
    assert theta == pytest.approx(0.5 * 3.0, abs=0.1)
    assert math.hypot(x, y - 0.4) == pytest.approx(0.4, abs=0.03)


def test_odometry_of_the_world_and_of_the_encoders(bench):
    there = bench()
    there.spawn(urdf(), "world", 1.0, 2.0, robot_namespace="w")
    there.spawn(urdf(DIFF_DRIVE.replace(">world<", ">encoder<")), "encoder", 1.0, 4.0, robot_namespace="e")
    of_world, of_encoder = (there.hear("/w/odom", "nav_msgs/Odometry"), there.hear("/e/odom", "nav_msgs/Odometry"))
    for name in "we":
        there.drive(f"/{name}/cmd_vel", 0.3)
    there.graph.run(2.0)
    position = of_world[-1].pose.pose.position
    assert (position.x, position.y) == pytest.approx((there.pose("world")[0], 2.0), abs=0.02)
    position = of_encoder[-1].pose.pose.position
    assert (position.x, position.y) == pytest.approx((there.pose("encoder")[0] - 1.0, 0.0), abs=0.02)


def test_an_axle_that_is_not_at_the_origin(bench):
    there = bench()
    there.spawn(urdf(axle=0.2), "r", 1.0, 0.0, math.pi / 2)
    assert there.pose("r") == pytest.approx((1.0, 0.0, math.pi / 2))
    there.drive("/cmd_vel", 0.0, 1.0)
    there.graph.run(2.0)
    x, y, theta = there.pose("r")
    # it turns about its axle, which stays at (1.0, 0.2)
    assert (x + 0.2 * math.cos(theta), y + 0.2 * math.sin(theta)) == pytest.approx((1.0, 0.2), abs=1e-9)
    vx, vy, w = there.server.world.model("r").velocity
    assert w == pytest.approx(1.0)
    assert (vx, vy) == pytest.approx((0.2 * math.sin(theta), -0.2 * math.cos(theta)), abs=1e-9)


@pytest.mark.parametrize(
    ("exchange", "legacy", "warned"),
    [(False, "false", False), (False, "true", True), (True, "true", False), (True, "false", True)],
)
def test_which_wheel_is_the_left_one_is_seen_and_gazebos_legacy_mode_warned_of(bench, capsys, exchange, legacy, warned):
    there = bench()
    text = DIFF_DRIVE.replace(">false</legacyMode>", f">{legacy}</legacyMode>")
    if exchange:
        text = (
            text.replace("left_wheel", "x").replace("right_wheel", "left_wheel").replace("x</left", "right_wheel</left")
        )
    assert there.spawn(urdf(text), "r").success
    there.drive("/cmd_vel", 0.2, 0.5)
    there.graph.run(1.0)
    x, _, theta = there.pose("r")
    assert x > 0.1
    assert theta > 0.3
    assert ("would turn the other way round" in "".join(capsys.readouterr())) is warned
    left, right = (
        there.call("get_joint_properties", "gazebo_msgs/GetJointProperties", joint_name=name).rate[0]
        for name in ("left_wheel", "right_wheel")
    )
    assert left < right


def test_transforms_of_wheels(bench):
    there = bench()
    there.spawn(
        urdf(DIFF_DRIVE.replace("<updateRate>", "<publishWheelTF>true</publishWheelTF><updateRate>")),
        "r",
        robot_namespace="n",
    )
    heard = there.hear("/tf", "tf2_msgs/TFMessage")
    there.drive("/n/cmd_vel", 0.1)
    there.graph.run(1.0)
    told = {each.child_frame_id: each for message in heard for each in message.transforms}
    assert set(told) == {"n/base_footprint", "n/left", "n/right"}
    assert told["n/left"].header.frame_id == "n/base_footprint"
    assert told["n/left"].transform.translation.y == pytest.approx(0.15)
    assert told["n/left"].transform.rotation.z != pytest.approx(0.0, abs=1e-3)  # it has turned


def test_a_planar_move_goes_aside(bench):
    there = bench()
    there.spawn(urdf(PLANAR), "r", 0.0, 0.0, math.pi / 2)
    odom = there.hear("/where", "nav_msgs/Odometry")
    there.drive("/go", 0.1, 0.0, 0.3)
    there.graph.run(1.01)
    assert there.pose("r")[:2] == pytest.approx((-0.3, 0.1), abs=0.01)
    assert odom[-1].twist.twist.linear.y == pytest.approx(0.3)
    assert odom[-1].pose.pose.position.x == pytest.approx(-0.3, abs=0.01)


def test_a_laser_sees_what_is_there(bench):
    there = bench()
    there.spawn(urdf(LASER), "r")  # a laser without a drive
    there.spawn(box(static=True), "wall", 2.2)
    there.spawn(box(static=True, size=0.15), "low", 1.0, 1.0)  # the beam goes 5 cm above it
    scans = there.hear("/scan", "sensor_msgs/LaserScan")
    there.graph.run(1.0)
    assert len(scans) in (9, 10)
    scan = scans[-1]
    assert scan.header.frame_id == "laser"
    assert (scan.range_min, scan.range_max) == pytest.approx((0.1, 8.0))
    assert (scan.angle_min, scan.angle_max) == pytest.approx((-math.pi / 2, math.pi / 2))
    assert scan.angle_increment == pytest.approx(math.pi / 180)
    ranges = np.array(scan.ranges)
    assert ranges[90] == pytest.approx(2.0)
    assert np.isinf(ranges[135])


def test_noise_is_that_of_the_tag_and_each_robot_has_its_own(bench):
    there = bench()
    noisy = LASER.replace("<range>", "<noise><type>gaussian</type><mean>0</mean><stddev>0.05</stddev></noise><range>")
    there.spawn(box(static=True, size=4.0), "wall", 4.0)
    for i in range(2):
        there.spawn(urdf(noisy), f"r{i}", 0.0, -1.0 + 2 * i, robot_namespace=f"r{i}")
    heard = [there.hear(f"/r{i}/scan", "sensor_msgs/LaserScan") for i in range(2)]
    there.graph.run(20.0)
    errors = [np.array([scan.ranges[90] - 2.0 for scan in scans]) for scans in heard]
    for error in errors:
        assert abs(error.mean()) < 0.02
        assert error.std() == pytest.approx(0.05, rel=0.2)
    assert abs(np.corrcoef(*errors)[0, 1]) < 0.3


def test_frames_begin_with_tf_prefix_if_it_is_set(bench):
    there = bench()
    there.node.set_param("/ns/tf_prefix", "other")
    there.spawn(urdf(), "r", robot_namespace="/ns/")
    scans = there.hear("/ns/scan", "sensor_msgs/LaserScan")
    there.graph.run(0.3)
    assert scans[-1].header.frame_id == "other/laser"


def test_a_laser_of_one_ray_looks_ahead_whatever_its_fan_is(bench):
    there = bench()
    one = LASER.replace("<samples>181</samples>", "<samples>1</samples>")
    there.spawn(urdf(one), "r")
    there.spawn(box(static=True), "wall", 2.2)
    heard = there.hear("/scan", "sensor_msgs/LaserScan")
    there.graph.run(0.3)
    assert list(heard[-1].ranges) == pytest.approx([2.0])
    assert (heard[-1].angle_min, heard[-1].angle_increment) == (0.0, 0.0)


IMU = """<gazebo><plugin name="imu" filename="libgazebo_ros_imu.so"><bodyName>laser</bodyName><topicName>imu</topicName>
  <serviceName>imu_service</serviceName><updateRate>50</updateRate>
    <gaussianNoise>{noise}</gaussianNoise>{more}</plugin></gazebo>"""
IMU_SENSOR = """<gazebo reference="laser"><sensor type="imu" name="imu">
  <pose>{pose}</pose>{own}<plugin name="imu" filename="libgazebo_ros_imu_sensor.so">
  <topicName>imu</topicName><updateRateHZ>50</updateRateHZ><gaussianNoise>0</gaussianNoise>{more}</plugin>
    </sensor></gazebo>"""


def imu(noise=0.0, more=""):
    """A robot with the model's plugin."""
    return urdf(DIFF_DRIVE + IMU.format(noise=noise, more=more))


def imu_sensor(more="", pose="0 0 0 0 0 0", own=""):
    """A robot with a sensor of type imu."""
    return urdf(DIFF_DRIVE + IMU_SENSOR.format(more=more, pose=pose, own=own))


def vector(part):
    return (part.x, part.y, part.z)


def yaw(message):
    return 2 * math.atan2(message.orientation.z, message.orientation.w)


TURNED_LINK = imu().replace(
    '<child link="laser"/><origin xyz="0 0 0.2"/>', '<child link="laser"/><origin xyz="0.1 0 0.2" rpy="0 0 1.5707963"/>'
)
IGNORED = (
    "<xyzOffset>0.5 0 0</xyzOffset><imu><noise><type>gaussian</type><rate><stddev>1</stddev></rate>"
    "<accel><stddev>1</stddev></accel></noise></imu>"
)
AS_REFERENCE = "<initialOrientationAsReference>true</initialOrientationAsReference>"


@pytest.mark.parametrize(
    ("robot", "rate", "acceleration", "ahead"),
    [
        # On a circle the acceleration is v w to the middle. The model's plugin knows no gravity,
        (imu(), 0.5, (0, 0.1, 0), 0.0),
        # ignores what Gazebo's ignores,
        (imu(more=IGNORED), 0.5, (0, 0.1, 0), 0.0),
        # and is at the origin of the link that its own became part of: turned, but without -x w w.
        (TURNED_LINK, 0.5, (0.1, 0, 0), math.pi / 2),
        # The sensor feels gravity and where it sits, in its own axes.
        (imu_sensor(pose="0.2 0 0 0 0 0"), 0.5, (-0.2 * 0.25, 0.1, 9.8), 0.0),
        (imu_sensor(pose="0 0 0 3.14159265 0 0"), -0.5, (0, -0.1, -9.8), None),
        (imu_sensor(AS_REFERENCE), 0.5, (0, 0.1, 9.8), -1.0),
        (imu_sensor("<rpyOffset>0 0 0.5</rpyOffset>"), 0.5, (0, 0.1, 9.8), 0.5),
    ],
)
def test_inertial_units_measure_turning_acceleration_and_heading(bench, robot, rate, acceleration, ahead):
    there = bench()
    assert there.spawn(robot, "r", 0.0, 0.0, 1.0).success
    heard = there.hear("/imu", "sensor_msgs/Imu")
    there.drive("/cmd_vel", 0.2, 0.5)
    there.graph.run(2.0)
    assert len(heard) in (99, 100)
    message = heard[-1]
    assert message.header.frame_id == ("base_footprint" if "imu_sensor.so" in robot else "laser")
    assert vector(message.angular_velocity) == pytest.approx((0, 0, rate), abs=1e-6)
    assert vector(message.linear_acceleration) == pytest.approx(acceleration, abs=1e-5)
    if ahead is not None:
        assert yaw(message) == pytest.approx(there.pose("r")[2] + ahead, abs=0.02)


def test_the_sensors_unit_feels_the_gravity_of_its_world(bench):
    there = bench()
    there.server.set_physics(replace(there.server.world.physics, gravity_z=-1.6))
    there.spawn(imu_sensor(), "r")
    heard = there.hear("/imu", "sensor_msgs/Imu")
    there.graph.run(0.1)
    assert heard[-1].linear_acceleration.z == pytest.approx(1.6)


OWN_NOISE = "<imu><angular_velocity><z><noise type='gaussian'><stddev>0.3</stddev></noise></z></angular_velocity></imu>"


@pytest.mark.parametrize(
    ("robot", "noise"),
    [
        (imu(noise=0.2), {"angular_velocity": 0.2, "linear_acceleration": 0.2, "orientation": 0.0}),
        (imu_sensor("<gaussianNoise>0.01</gaussianNoise>"), {"orientation": 0.01}),
        (imu_sensor(own=OWN_NOISE), {"angular_velocity": 0.3}),
    ],
)
def test_noise_of_inertial_units_is_on_what_the_tags_say(bench, robot, noise):
    there = bench()
    there.spawn(robot, "r")
    heard = there.hear("/imu", "sensor_msgs/Imu")
    there.graph.run(8.0)
    for part, size in noise.items():
        last = np.array([getattr(message, part).z for message in heard])
        assert last.std() == pytest.approx(size, rel=0.3)
        assert last.mean() == pytest.approx(0.0, abs=size / 4)
    if "linear_acceleration" in noise:
        assert heard[0].linear_acceleration_covariance[0] == pytest.approx(0.04)


CAMERA = """<gazebo reference="laser"><sensor type="{type}" name="cam"><update_rate>5</update_rate><camera>
  <horizontal_fov>1.0</horizontal_fov><image><width>32</width><height>24</height></image><clip><near>0.05</near>
    <far>20</far></clip>
  </camera><plugin name="c" filename="{plugin}"><cameraName>cam</cameraName><frameName>optical</frameName>
  <imageTopicName>rgb/image_raw</imageTopicName><cameraInfoTopicName>rgb/camera_info</cameraInfoTopicName>
  <depthImageTopicName>depth/image_raw</depthImageTopicName></plugin></sensor></gazebo>"""


def test_a_camera_shows_images_and_numbers(bench):
    there = bench()
    plugin = "libgazebo_ros_camera.so"
    text = CAMERA.format(type="camera", plugin=plugin).replace(
        "<depthImageTopicName>depth/image_raw</depthImageTopicName>", ""
    )
    there.spawn(urdf(text), "r", robot_namespace="r")
    there.spawn(box(static=True, size=1.0), "wall", 2.0)
    images = there.hear("/r/cam/rgb/image_raw", "sensor_msgs/Image")
    infos = there.hear("/r/cam/rgb/camera_info", "sensor_msgs/CameraInfo")
    there.graph.run(1.0)
    image, info = images[-1], infos[-1]
    assert (image.width, image.height, image.encoding, image.header.frame_id) == (32, 24, "rgb8", "r/optical")
    assert len(images) in (4, 5)
    assert info.K[0] == pytest.approx(32 / (2 * math.tan(0.5)))
    pixels = np.frombuffer(bytes(image.data), np.uint8).reshape(24, 32, 3)
    assert len({tuple(each) for each in pixels.reshape(-1, 3).tolist()}) > 2  # sky, floor, wall


def test_a_depth_camera_measures(bench):
    there = bench()
    there.spawn(urdf(CAMERA.format(type="depth", plugin="libgazebo_ros_openni_kinect.so")), "r")
    there.spawn(box(static=True, size=1.0), "wall", 2.0)
    depths = there.hear("/cam/depth/image_raw", "sensor_msgs/Image")
    there.graph.run(0.5)
    pixels = np.frombuffer(bytes(depths[-1].data), np.float32).reshape(24, 32)
    assert depths[-1].encoding == "32FC1"
    assert pixels[11, 16] == pytest.approx(1.5, abs=0.01)


BUMPER = """<gazebo reference="base_footprint"><sensor type="contact" name="bumper"><update_rate>20</update_rate>
  <contact><collision>base_footprint_fixed_joint_lump__base_link_collision</collision></contact>
  <plugin name="b" filename="libgazebo_ros_bumper.so"><bumperTopicName>bumper</bumperTopicName></plugin>
    </sensor></gazebo>"""


def test_a_bumper_feels_a_wall(bench):
    there = bench()
    there.spawn(urdf(DIFF_DRIVE + BUMPER), "r")
    there.spawn(box(static=True), "wall", 0.6)
    heard = there.hear("/bumper", "gazebo_msgs/ContactsState")
    there.graph.run(0.2)
    assert heard[-1].states == []
    there.drive("/cmd_vel", 0.3)
    there.graph.run(3.0)
    (state,) = heard[-1].states
    assert state.collision1_name == "r::base_footprint::base_footprint_fixed_joint_lump__base_link_collision"
    assert state.collision2_name == "wall"
    assert state.contact_positions[0].x == pytest.approx(0.4, abs=0.01)


STATES = """<gazebo><plugin name="j" filename="libgazebo_ros_joint_state_publisher.so">
  <jointName>left_wheel, right_wheel</jointName>
  <updateRate>10</updateRate></plugin>
  <plugin name="p" filename="libgazebo_ros_p3d.so"><bodyName>laser</bodyName><topicName>truth</topicName>
    <frameName>map</frameName>
  <updateRate>10</updateRate></plugin></gazebo>"""


def test_joint_states_and_ground_truth(bench):
    there = bench()
    there.spawn(urdf(DIFF_DRIVE + STATES), "r", 1.0, 0.0, math.pi / 2)
    joints, truth = (there.hear("/r/joint_states", "sensor_msgs/JointState"), there.hear("/truth", "nav_msgs/Odometry"))
    there.drive("/cmd_vel", 0.1)
    there.graph.run(2.05)
    assert joints[-1].velocity == pytest.approx([2.0, 2.0])
    message = truth[-1]
    assert (message.header.frame_id, message.child_frame_id) == ("map", "laser")
    assert message.pose.pose.position.z == pytest.approx(0.2)
    assert message.twist.twist.linear.y == pytest.approx(0.1)


@pytest.mark.parametrize(
    ("extensions", "said"),
    [
        (
            DIFF_DRIVE.replace("diff_drive.so", "dif_drive.so"),
            ["dif_drive.so", "did you mean libgazebo_ros_diff_drive"],
        ),
        (LASER.replace("topicName", "topicname"), ["<topicname>", "did you mean topicName?"]),
        (
            '<gazebo><plugin name="control" filename="libgazebo_ros_control.so"/></gazebo>',
            ["the model 'r' goes on without a plugin", "libgazebo_ros_control.so"],
        ),
        (
            '<gazebo><plugin name="x" filename="libgazebo_ros_laser.so"/></gazebo>',
            ["is a sensor plugin", "which takes model plugins"],
        ),
    ],
)
def test_a_model_goes_on_without_plugins_and_tags_that_are_unknown(bench, capsys, extensions, said):
    assert bench().spawn(urdf(extensions), "r").success
    shown = "".join(capsys.readouterr())
    assert [part for part in said if part not in shown] == []


def test_a_model_that_goes_takes_its_topics_along_even_while_it_moves(bench):
    there = bench()
    there.spawn(urdf(DIFF_DRIVE + LASER + IMU.format(noise=0, more="") + STATES), "r", robot_namespace="r")
    there.drive("/r/cmd_vel", 0.2)
    there.graph.run(0.5)
    topics = {name for name, _ in there.graph.master.getTopicTypes("/x")[2]}
    assert {"/r/scan", "/r/odom", "/r/imu"} <= topics
    there.call("delete_model", "gazebo_msgs/DeleteModel", model_name="r")
    there.graph.run(0.5)
    published = {name for name, _ in there.graph.master.getPublishedTopics("/x", "")[2]}
    assert not {name for name in published if name.startswith("/r/") and name != "/r/cmd_vel"}
    assert there.spawn(
        urdf(DIFF_DRIVE + LASER + IMU.format(noise=0, more="") + STATES), "r", robot_namespace="r"
    ).success


def test_four_wheels_drive_and_turn_alike_on_each_side(bench):
    there = bench()
    there.spawn(husky("<broadcastTF>true</broadcastTF>"), "husky")
    odometry = there.hear("/odom", "nav_msgs/Odometry")
    transforms = there.hear("/tf", "tf2_msgs/TFMessage")
    there.drive("/cmd_vel", 0.5)
    there.graph.run(1.01)
    assert there.pose("husky") == pytest.approx((0.5, 0.0, 0.0), abs=0.03)
    model = there.server.world.model("husky")
    turns = {joint: model.joint(joint)[0] for joint in model.joints}
    assert list(turns.values()) == pytest.approx([there.pose("husky")[0] / 0.165] * 4, rel=1e-6)
    assert odometry[-1].pose.pose.position.x == pytest.approx(there.pose("husky")[0] + 0.1, abs=0.02)
    assert odometry[-1].pose.covariance[[0, 7, 35]] == pytest.approx([1e-4, 1e-4, 0.01])
    assert transforms[-1].transforms[0].child_frame_id == "base_link"
    there.drive("/cmd_vel", 0.0, 1.0)
    before = there.pose("husky")
    there.graph.run(1.0)
    x, y, heading = there.pose("husky")
    assert heading == pytest.approx(1.0, abs=0.03)
    # it turns about the middle of its four wheels
    assert (x + 0.1 * math.cos(heading), y + 0.1 * math.sin(heading)) == pytest.approx(
        (before[0] + 0.1, before[1]), abs=1e-6
    )
    for joint in model.joints:
        sign = -1 if "left" in joint else 1
        assert model.joint(joint)[1] == pytest.approx(sign * 0.2854 / 0.165, rel=1e-3)


def mounted(rpy):
    """The box on wheels with its laser mounted so."""
    return urdf().replace(
        '<child link="laser"/><origin xyz="0 0 0.2"/>', f'<child link="laser"/><origin xyz="0 0 0.2" rpy="{rpy}"/>'
    )


@pytest.mark.parametrize(
    ("rpy", "seen_at"),
    [("0 0 0", math.pi / 4), ("3.14159265 0 0", -math.pi / 4), ("0 3.14159265 3.14159265", -math.pi / 4)],
)
def test_a_laser_that_is_mounted_upside_down_sees_everything_mirrored(bench, rpy, seen_at):
    there = bench()
    there.spawn(box("thing", static=True), "thing", 2.0, 2.0)
    assert there.spawn(mounted(rpy), "r").success
    scans = there.hear("/scan", "sensor_msgs/LaserScan")
    there.graph.run(0.5)
    ranges, scan = np.array(scans[-1].ranges), scans[-1]
    angles = scan.angle_min + scan.angle_increment * np.arange(len(ranges))
    assert (scan.angle_min, scan.angle_max) == pytest.approx((-math.pi / 2, math.pi / 2))
    assert angles[np.isfinite(ranges)].mean() == pytest.approx(seen_at, abs=0.02)


def test_a_tilted_laser_measures_level_or_is_left_out(bench, capsys):
    there = bench()
    for i, (tilt, works) in enumerate([("0 0.05 0", True), ("0 0.5 0", False)]):
        assert there.spawn(mounted(tilt), f"r{i}", 3.0 * i, robot_namespace=f"n{i}").success
        scans = there.hear(f"/n{i}/scan", "sensor_msgs/LaserScan")
        there.graph.run(0.5)
        assert bool(scans) is works
        there.drive(f"/n{i}/cmd_vel", 0.2)
    there.graph.run(2.0)
    assert there.pose("r1")[0] > 3.1
    said = "".join(capsys.readouterr())
    assert "'r0/lidar' is tilted by 2.9 degrees" in said
    assert "'r1/lidar' is left out" in said
