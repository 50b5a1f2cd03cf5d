"""Plugins of Gazebo and its ROS packages that rosmini lacks, with their purpose, for a warning."""

from __future__ import annotations

JOINTS = "it lets joints be moved from ROS; rosmini moves no joints but driven wheels"
WHEELS = (
    "it drives a model by cmd_vel; rosmini has libgazebo_ros_diff_drive.so, libgazebo_ros_skid_steer_drive.so and "
    "libgazebo_ros_planar_move.so"
)
CLOUD = "it publishes what a laser of several layers sees; rosmini's lasers have one, by libgazebo_ros_laser.so"
PLACE = "it measures where a model is on the Earth; libgazebo_ros_p3d.so tells its place in the world"
IMU = "it is an inertial measurement unit; rosmini has libgazebo_ros_imu.so and libgazebo_ros_imu_sensor.so"
CAMERA = "it is a camera; rosmini has libgazebo_ros_camera.so and libgazebo_ros_depth_camera.so"
DISTANCE = "it measures one distance; rosmini has libgazebo_ros_laser.so"
FORCE = "it measures or applies forces; the service /gazebo/apply_body_wrench applies them"

ABSENT = {
    **dict.fromkeys((
        "gazebo_ros_control", "gazebo_mimic_joint_plugin", "roboticsgroup_gazebo_mimic_joint_plugin",
        "roboticsgroup_upatras_gazebo_mimic_joint_plugin", "gazebo_ros_joint_trajectory",
        "gazebo_ros_joint_pose_trajectory", "gazebo_grasp_fix", "gazebo_ros_vacuum_gripper", "gazebo_ros_elevator",
        "gazebo_ros_harness", "KeysToJointsPlugin",
    ), JOINTS),
    **dict.fromkeys((
        "gazebo_ros_tricycle_drive", "gazebo_ros_ackermann_drive", "hector_gazebo_ros_diffdrive",
        "SkidSteerDrivePlugin", "DiffDrivePlugin", "gazebo_ros_force_based_move",
    ), WHEELS),
    **dict.fromkeys(("gazebo_ros_block_laser", "gazebo_ros_velodyne_laser", "gazebo_ros_velodyne_gpu_laser"), CLOUD),
    **dict.fromkeys((
        "hector_gazebo_ros_gps", "gazebo_ros_gps_sensor", "gazebo_ros_gps", "hector_gazebo_ros_magnetic",
        "hector_gazebo_ros_baro",
    ), PLACE),
    **dict.fromkeys(("hector_gazebo_ros_imu", "rotors_gazebo_imu_plugin", "gazebo_ros_accel"), IMU),
    **dict.fromkeys((
        "gazebo_ros_multicamera", "gazebo_ros_triggered_camera", "gazebo_ros_prosilica", "realsense_gazebo_plugin",
        "hector_gazebo_thermal_camera", "gazebo_ros_thermal_camera",
    ), CAMERA),
    **dict.fromkeys(("gazebo_ros_range", "hector_gazebo_ros_sonar", "gazebo_ros_sonar"), DISTANCE),
    **dict.fromkeys((
        "gazebo_ros_ft_sensor", "gazebo_ros_f3d", "gazebo_ros_force", "LiftDragPlugin", "BuoyancyPlugin",
    ), FORCE),
    "gazebo_ros_video": "it shows a video on a surface",
    "gazebo_ros_projector": "it throws a pattern of light",
    "gazebo_ros_hand_of_god": "it lets a tf frame drag a model; the topic /gazebo/set_model_state puts it elsewhere",
    "gazebo_ros_wheel_slip": "it lets wheels slip",
    "WheelSlipPlugin": "it lets wheels slip",
    "ActorPlugin": "it lets a person walk about; a <script> with a <trajectory> in an <actor> does so here too",
}  # fmt: skip
"""Purposes by the library's name, without lib and .so."""
