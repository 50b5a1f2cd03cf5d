"""Modules of ROS that scripts often import but rosmini lacks, and what to use instead."""

from __future__ import annotations

from rosmini.core.errors import RosminiError

_ABSENT = {
    "cv_bridge": (
        "write image = numpy.frombuffer(msg.data, numpy.uint8).reshape(msg.height, msg.width, -1), and for the "
        "way back sensor_msgs.msg.Image(height=h, width=w, encoding='bgr8', step=3 * w, data=image.tobytes())"
    ),
    "dynamic_reconfigure.parameter_generator_catkin": (
        "name the file in generate_dynamic_reconfigure_options() of CMakeLists.txt and run catkin_make, which reads it"
    ),
    "genmsg": "take message._slot_types, message._full_text and message._md5sum",
    "image_geometry": (
        "use the matrix itself: P = numpy.reshape(info.P, (3, 4)); u, v, w = P @ (x, y, z, 1); pixel = u / w, v / w"
    ),
    "laser_geometry": (
        "write angles = scan.angle_min + scan.angle_increment * numpy.arange(len(scan.ranges)), x = ranges * "
        "cos(angles), y = ranges * sin(angles), and sensor_msgs.point_cloud2.create_cloud_xyz32(scan.header, points)"
    ),
    "message_generation": "import from your_package.msg: rosmini reads the .msg files",
    "PyKDL": "use tf.transformations: quaternion_matrix, euler_from_quaternion, concatenate_matrices",
    "ros_numpy": (
        "write numpy.frombuffer(msg.data, ...) for images, sensor_msgs.point_cloud2.read_points for clouds, and "
        "numpy.array([p.x, p.y, p.z]) for points"
    ),
    "rosgraph.roslogging": "use rospy.loginfo and its like, or the module logging: logging.getLogger('rosout')",
    "roslaunch": "write the nodes in a launch file, and start it with the command roslaunch",
    "rosmsg": "take message._full_text and message._md5sum, or the command rosmsg",
    "rospy.impl": "use the public functions of rospy; rosgraph.Master(rospy.get_name()) asks the Master",
    "rospy_message_converter": (
        "write yaml.safe_load(str(message)), and genpy.message.fill_message_args(message, [dictionary]) to go back"
    ),
    "smach": (
        "write a dictionary of functions, each of which returns the name of the next state: while state: state = "
        "states[state]()"
    ),
    "tf_conversions": "use tf.transformations, which has the same functions as tf_conversions.transformations",
    "urdf_parser_py": "read it with rosmini.sim.urdf",
}
"""The alternative to each module, by name."""


class AbsentModule(RosminiError, ModuleNotFoundError):
    """A module of ROS that rosmini lacks."""


def absent_module(name: str) -> AbsentModule | None:
    """Return the error for an import of ``name``, a module or a submodule. Return None if no alternative is known."""
    parts = name.split(".")
    for end in range(1, len(parts) + 1):
        known = ".".join(parts[:end])
        if known in _ABSENT:
            return AbsentModule(
                f"rosmini has no module '{known}'. Instead: {_ABSENT[known]}. "
                "If you install a real one, it is imported.",
                name=name,
            )
    return None
