"""Modules of ROS that scripts import but rosmini lacks: their purpose, and alternatives."""

from __future__ import annotations

from rosmini.core.errors import RosminiError

_MASTER = "ask the Master: rosgraph.Master(rospy.get_name()).getSystemState(), lookupNode(name) and so on"
_ALONE = "take the lines that use it out, or run the script on real ROS"

_ABSENT = {
    "angles": (
        "does sums with angles",
        (
            "write math.remainder(a, math.tau) for normalize_angle(a), and math.remainder(b - a, math.tau) for "
            "shortest_angular_distance(a, b)"
        ),
    ),
    "bondpy": (
        "tells two nodes when the other one has gone",
        "publish a heartbeat, and look after it with a rospy.Timer",
    ),
    "camera_info_manager": (
        "loads and saves a camera's calibration",
        "fill a sensor_msgs.msg.CameraInfo from the YAML file with yaml.safe_load",
    ),
    "controller_manager": ("loads controllers of ros_control", _ALONE),
    "cv_bridge": (
        "turns images of ROS into arrays of OpenCV and back",
        (
            "write image = numpy.frombuffer(msg.data, numpy.uint8).reshape(msg.height, msg.width, -1), and for the "
            "way back sensor_msgs.msg.Image(height=h, width=w, encoding='bgr8', step=3 * w, data=image.tobytes())"
        ),
    ),
    "diagnostic_updater": (
        "publishes a node's health",
        "publish diagnostic_msgs.msg.DiagnosticArray on /diagnostics from a rospy.Timer",
    ),
    "dynamic_reconfigure.parameter_generator": ("makes modules of .cfg files", "see parameter_generator_catkin"),
    "dynamic_reconfigure.parameter_generator_catkin": (
        "describes parameters in .cfg files, which catkin_make turns into modules",
        "name the file in generate_dynamic_reconfigure_options() of CMakeLists.txt and run catkin_make, which reads it",
    ),
    "gazebo_ros": (
        "spawns models from Python",
        "call the service /gazebo/spawn_urdf_model with gazebo_msgs.srv.SpawnModel",
    ),
    "genmsg": (
        "reads message definitions and computes md5 sums when catkin builds",
        "take message._slot_types, message._full_text and message._md5sum",
    ),
    "genpy.generator": ("makes Python files of message definitions", "call genpy.dynamic.generate_dynamic(type, text)"),
    "image_geometry": (
        "projects points with a camera's calibration",
        "use the matrix itself: P = numpy.reshape(info.P, (3, 4)); u, v, w = P @ (x, y, z, 1); pixel = u / w, v / w",
    ),
    "image_transport": ("sends images compressed", "publish and subscribe sensor_msgs.msg.Image itself"),
    "kdl_parser_py": ("reads a URDF into PyKDL", "read it with rosmini.sim.urdf"),
    "laser_geometry": (
        "makes point clouds of laser scans",
        (
            "write angles = scan.angle_min + scan.angle_increment * numpy.arange(len(scan.ranges)), x = ranges * "
            "cos(angles), y = ranges * sin(angles), and sensor_msgs.point_cloud2.create_cloud_xyz32(scan.header, "
            "points)"
        ),
    ),
    "mavros": ("talks to flight controllers", _ALONE),
    "message_generation": (
        "makes message classes when catkin builds",
        "import from your_package.msg: rosmini reads the .msg files",
    ),
    "moveit_commander": ("plans and moves arms with MoveIt", _ALONE),
    "nodelet": ("loads nodelets of C++", "start nodes of their own"),
    "pcl_ros": (
        "works on point clouds with PCL, in C++",
        "read clouds with sensor_msgs.point_cloud2.read_points and use numpy",
    ),
    "PyKDL": (
        "has vectors, rotations and frames of Orocos KDL",
        "use tf.transformations: quaternion_matrix, euler_from_quaternion, concatenate_matrices",
    ),
    "resource_retriever": ("loads files by URL", "find files with rospkg.RosPack().get_path('package') and open them"),
    "ros_numpy": (
        "turns messages into numpy arrays and back",
        (
            "write numpy.frombuffer(msg.data, ...) for images, sensor_msgs.point_cloud2.read_points for clouds, and "
            "numpy.array([p.x, p.y, p.z]) for points"
        ),
    ),
    "rosbag.migration": (
        "brings old bags up to date with rules",
        "read the bag and write changed messages to a new one with rosbag.Bag",
    ),
    "rosbridge_library": ("speaks to web pages", _ALONE),
    "roscreate": ("makes packages of rosbuild", "make a catkin package: a folder with package.xml"),
    "rosgraph.impl": ("watches the whole graph", "ask rosgraph.Master(name).getSystemState()"),
    "rosgraph.network": ("knows addresses and headers of the wire", _ALONE),
    "rosgraph.xmlrpc": ("serves and calls XML-RPC", "ask rosgraph.Master, which is in the same process here"),
    "roslaunch.arg_dump": (
        "lists the arguments of launch files",
        "run `rosmini roslaunch --ros-args PACKAGE FILE`, which prints them",
    ),
    "roslaunch.pmon": (
        "starts and watches the processes of roslaunch",
        "start nodes with roslaunch.scriptapi.ROSLaunch: what launch() returns has is_alive() and stop()",
    ),
    "roslib.gentools": ("computes md5 sums of definitions", "take message._md5sum and message._full_text"),
    "roslib.launcher": ("changes Python's path by manifests", "call roslib.load_manifest, or nothing at all"),
    "roslib.manifest": ("reads manifest.xml of rosbuild", "read package.xml with catkin_pkg.package.parse_package"),
    "roslib.msgs": ("reads message definitions", "take message.__slots__, message._slot_types and message._full_text"),
    "roslib.rospack": ("calls rospack", "use rospkg.RosPack()"),
    "roslib.stacks": ("finds stacks of rosbuild", "use rospkg.RosPack()"),
    "rosmaster": ("is the Master's own program", "ask rosgraph.Master: the Master is in the same process here"),
    "rospy.impl": (
        "is the inside of rospy, its sockets and threads",
        "use the public functions of rospy; rosgraph.Master(rospy.get_name()) asks the Master",
    ),
    "rospy_message_converter": (
        "turns messages into dictionaries and back",
        "write yaml.safe_load(str(message)), and genpy.message.fill_message_args(message, [dictionary]) to go back",
    ),
    "rosserial": ("talks to Arduino boards", _ALONE),
    "rosserial_python": ("talks to Arduino boards", _ALONE),
    "roswtf": ("looks for what is wrong", _MASTER),
    "smach": (
        "builds state machines",
        (
            "write a dictionary of functions, each of which returns the name of the next state: while state: state = "
            "states[state]()"
        ),
    ),
    "smach_ros": (
        "builds state machines with actions and services",
        "see smach; call actions with actionlib.SimpleActionClient",
    ),
    "sound_play": ("plays sounds", _ALONE),
    "tf2_kdl": ("moves objects of PyKDL to other frames", "use tf2_geometry_msgs and messages of geometry_msgs"),
    "tf_conversions": (
        "converts between PyKDL and messages",
        "use tf.transformations, which has the same functions as tf_conversions.transformations",
    ),
    "urdf_parser_py": ("reads URDF", "read it with rosmini.sim.urdf"),
}
"""Purpose of each module, and the alternative, by name."""


class AbsentModule(RosminiError, ModuleNotFoundError):
    """A module of ROS that rosmini lacks."""


def absent_module(name: str) -> AbsentModule | None:
    """Return the error for an import of ``name``, a module or a submodule.

    Return None if it is not a ROS module known to be absent.
    """
    parts = name.split(".")
    known = next((".".join(parts[:end]) for end in range(1, len(parts) + 1) if ".".join(parts[:end]) in _ABSENT), None)
    if known is not None:
        what, instead = _ABSENT[known]
    elif name.startswith(("rqt_", "qt_gui", "python_qt_binding")):
        known = parts[0]
        what, instead = (
            "is a part of rqt",
            "look at the pictures that rosmini draws itself: graph.show(), bag.show(), buffer.show()",
        )
    else:
        return None
    return AbsentModule(
        f"rosmini has no module '{known}', which {what} on real ROS. Instead: {instead}. "
        "If you install a real one, it is imported.",
        name=name,
    )
