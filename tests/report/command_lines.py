"""Every command line that the report prints, in its order, and where the tests type it.

A line is typed in a shell by what ``by`` names: a command line of `test_graph_commands`, a test or a fixture there or
in `test_shell`, or (after ``walk:``) a line of the walk in `tests/tools/test_catkin_make.py`. ``cell`` is what a reader
types in a cell instead, where that can be; lines that wait for something name it in ``waits``.
"""

from __future__ import annotations

from typing import NamedTuple

USE_CASES = "test_a_goal_and_exploration_on_stage"
NO_ROS = "no ROS is installed, so nothing is there to be sourced"
NETWORK = "the scripts of the tutorials are in rosmini: rosrun rospy_tutorials talker.py; tests fetch nothing"


class Line(NamedTuple):
    """One line, as it is printed."""

    chapter: str
    text: str
    by: str = ""
    """What types it in a shell."""
    cell: str = ""
    """What is typed in a cell."""
    says: str = ""
    """A regular expression for what the cell prints; it fails, and says this, if the line is a slip of the report."""
    waits: str = ""
    """Why it cannot be typed yet."""
    is_slip: bool = False


def slip(chapter: str, text: str, by: str, cell: str = "", says: str = "", waits: str = "") -> Line:
    """Return a line whose error names the right form."""
    return Line(chapter, text, by, cell, says, waits, is_slip=True)


LINES = (
    slip("3.3.1", "roscpp info [node]", "roscpp info /talker", "%roscpp info /talker", "rosnode"),
    slip("3.3.1", "roscpp kill [node]", "test_nodes_are_killed", "%roscpp kill /talker", "rosnode"),
    slip("3.3.1", "roscpp list", "roscpp list", "%roscpp list", "rosnode"),
    Line("3.3.1", "rosnode machine [machine_name]", "rosnode machine", "%rosnode machine", "."),
    Line("3.3.1", "rosnode ping", "rosnode ping -c 1 /talker", "%rosnode ping -c 1 /talker", "xmlrpc reply"),
    Line("3.3.1", "rosnode cleanup", "rosnode cleanup", "%rosnode cleanup", "^$"),
    slip(
        "3.3.3",
        "rosmmsg show [message]",
        "rosmmsg show example_pkg/Num",
        "%rosmmsg show std_msgs/String",
        "rosmsg",
    ),
    slip("3.3.3", "rosmmsg list", "rosmmsg show example_pkg/Num", "%rosmmsg list", "rosmsg"),
    slip(
        "3.3.3",
        "rosmmsg md5 [message]",
        "rosmmsg show example_pkg/Num",
        "%rosmmsg md5 std_msgs/String",
        "rosmsg",
    ),
    slip(
        "3.3.3",
        "rosmmsg package [package_name]",
        "rosmmsg show example_pkg/Num",
        "%rosmmsg package std_msgs",
        "rosmsg",
    ),
    slip(
        "3.3.3",
        "rosmmsg packages [package_1] [package_2]",
        "rosmmsg show example_pkg/Num",
        "%rosmmsg packages",
        "rosmsg",
    ),
    Line(
        "3.3.4",
        "rostopic bw /topic",
        "rostopic bw /chatter --duration 2.5",
        "%rostopic bw /chatter",
        "average: .*B/s",
    ),
    Line(
        "3.3.4",
        "rostopic echo /topic",
        "rostopic echo -n 1 /chatter",
        "%rostopic echo -n 1 /chatter",
        "data: .*hello",
    ),
    Line(
        "3.3.4",
        "rostopic find /message_type",
        "rostopic find std_msgs/String",
        "%rostopic find std_msgs/String",
        "^/chatter$",
    ),
    Line(
        "3.3.4",
        "rostopic hz /topic",
        "rostopic hz /chatter --duration 2.5",
        "%rostopic hz /chatter",
        "average rate: 10",
    ),
    Line(
        "3.3.4",
        "rostopic info /topic",
        "rostopic info /chatter",
        "%rostopic info /chatter",
        "Type: std_msgs/String",
    ),
    Line("3.3.4", "rostopic list", "rostopic list", "%rostopic list", "^/chatter$"),
    Line(
        "3.3.4",
        "rostopic pub /topic message.type args",
        "rostopic pub -1 /news std_msgs/String hello",
        "%rostopic pub -1 /news std_msgs/String hello",
        "publishing and latching message for",
    ),
    Line(
        "3.3.4",
        "rostopic type /topic",
        "rostopic type /chatter",
        "%rostopic type /chatter",
        "^std_msgs/String$",
    ),
    Line(
        "3.3.5", "rossrv", "rossrv show std_srvs/SetBool", "%rossrv show std_srvs/SetBool", "^bool success$"
    ),
    Line(
        "3.3.5",
        "rosservice call /service args",
        "rosservice call /switch true",
        "%rosservice call /switch true",
        'message: "on"',
    ),
    Line(
        "3.3.5",
        "rosservice find service_type",
        "rosservice find std_srvs/SetBool",
        "%rosservice find std_srvs/SetBool",
        "^/switch$",
    ),
    Line(
        "3.3.5",
        "rosservice info /services",
        "rosservice info /switch",
        "%rosservice info /switch",
        "Node: /talker",
    ),
    Line("3.3.5", "rosservice list", "rosservice list", "%rosservice list", "^/switch$"),
    Line(
        "3.3.5",
        "rosservice type /service",
        "rosservice type /switch",
        "%rosservice type /switch",
        "^std_srvs/SetBool$",
    ),
    Line(
        "3.3.5", "rosservice uri /service", "rosservice uri /switch", "%rosservice uri /switch", "^rosrpc://"
    ),
    Line(
        "3.3.6",
        "rosbag record [topic_1] [topic_2] -o [bag_name]",
        "test_a_bag_is_recorded_and_played",
        "%rosbag record /chatter -O house --duration 2",
        "",
    ),
    Line(
        "3.3.6", "rosbag play [bag_name]", "test_a_bag_is_recorded_and_played", "%rosbag play house.bag", ""
    ),
    Line("3.3.6", "rqt_bag", "test_pictures_are_written_as_pages", "%rqt_bag house.bag", ""),
    Line("3.6.1", "source /opt/ros/kinetic/setup.bash", waits=NO_ROS),
    Line("3.6.1", "mkdir -p ~/example_ws/src", "walk:mkdir -p example_ws/src"),
    Line("3.6.1", "cd ~/example_ws/", "walk:cd example_ws/", "%cd example_ws", ""),
    Line("3.6.1", "catkin_make", "walk:{catkin_make}", "%catkin_make", "0 built, 0 up to date, 0 failed"),
    Line("3.6.1", "source devel/setup.bash", "walk:. devel/setup.{shell}"),
    Line(
        "3.6.2",
        "catkin_create_pkg example_pkg std_msgs rospy roscpp",
        "walk:{catkin_create_pkg} example_pkg std_msgs rospy roscpp",
        "%catkin_create_pkg example_pkg std_msgs rospy roscpp",
        "Created file example_pkg/package.xml",
    ),
    Line("3.6.3", "mkdir msg", "walk:mkdir msg"),
    Line("3.6.3", 'echo "int64 num" > msg/Num.msg', 'walk:echo "int64 num" > msg/Num.msg'),
    slip(
        "3.6.3",
        "rosmmsg show example_pkg/Num",
        "rosmmsg show example_pkg/Num",
        "%rosmmsg show example_pkg/Num",
        "rosmsg",
    ),
    Line("3.6.4", "wget .../talker.py", waits=NETWORK),
    Line("3.6.4", "chmod +x talker.py", "walk:chmod +x src/example_pkg/scripts/talker.py"),
    Line("3.6.4", "wget .../listener.py", waits=NETWORK),
    Line("3.6.4", "chmod +x listener.py", "walk:chmod +x src/example_pkg/scripts/talker.py"),
    Line("3.6.4", "roscore", "shell", "%roscore", "ROS_MASTER_URI="),
    Line("3.6.4", "source ./devel/setup.bash", "walk:. ./devel/setup.{shell}"),
    slip(
        "3.6.4",
        "roslaunch example_pkg talker.py",
        "roslaunch example_pkg talker.py",
        "%roslaunch rospy_tutorials talker.py",
        "rosrun rospy_tutorials talker.py",
    ),
    slip(
        "3.6.4",
        "roslaunch example_pkg listener.py",
        "roslaunch example_pkg talker.py",
        "%roslaunch rospy_tutorials listener.py",
        "rosrun rospy_tutorials listener.py",
    ),
    Line("7.4", "export ROS_ROOT=/home/user/ros/ros", "test_the_environment"),
    Line("7.4", "export PATH=$ROS_ROOT/bin:$PATH", "test_the_environment"),
    Line("7.4", "export ROS_MASTER_URI=http://{IP_ADDRESS_PC}:11311/", "test_the_environment"),
    Line("7.4", "export ROS_HOSTNAME={IP_ADDRESS_CURRENT_PC}", "test_the_environment"),
    Line("7.4", "export PYTHONPATH=$PYTHONPATH:$ROS_ROOT/core/roslib/src", "test_the_environment"),
    Line("7.4", 'echo "export TURTLEBOT3_MODEL=burger"', "test_the_environment"),
    Line("7.5", "printenv | grep ROS", "test_the_environment"),
    Line("7.5", "source /opt/ros/kinetic/setup.bash", waits=NO_ROS),
    Line("8.2", "roscore", "shell"),
    slip(
        "8.2",
        "roslaunch turtlesim turtlesim_node",
        "roslaunch turtlesim turtlesim_node",
        "%roslaunch turtlesim turtlesim_node",
        "rosrun turtlesim turtlesim_node",
    ),
    Line("8.2", "rostopic list", "rostopic list"),
    slip(
        "8.2",
        "roslaunch turtlesim turtlesim_node --name:=my_turtle",
        "roslaunch example_pkg talker.py --name:=my_turtle",
        "%roslaunch turtlesim turtlesim_node --name:=my_turtle",
        "__name:=my_turtle",
    ),
    slip(
        "8.2",
        "roslaunch ping my_turtle",
        "roslaunch ping my_turtle",
        "%roslaunch ping my_turtle",
        "rosnode ping my_turtle",
    ),
    Line("8.2.1", "roscore", "shell"),
    slip(
        "8.2.1",
        "roslaunch turtlesim turtlesim_node",
        "roslaunch turtlesim turtlesim_node",
        "%roslaunch turtlesim turtlesim_node",
        "rosrun turtlesim turtlesim_node",
    ),
    slip(
        "8.2.1",
        "roslaunch turtlesim turtle_teleop_key",
        "roslaunch turtlesim turtle_teleop_key",
        "%roslaunch turtlesim turtle_teleop_key",
        "rosrun turtlesim turtle_teleop_key",
    ),
    Line("8.2.1", "rqt_graph", "test_pictures_are_written_as_pages", "%rqt_graph", ""),
    Line("8.2.1", "rostopic -h", "test_help", "%rostopic -h", "rostopic <verb>"),
    Line("8.2.2", "chmod u+x move.py", "walk:chmod +x src/example_pkg/scripts/talker.py"),
    Line("8.2.3", "export ROS_MASTER_URI=http://{IP_ADDRESS_OF_REMOTE_PC}:11311", "test_the_environment"),
    Line("8.2.3", "export ROS_HOSTNAME={IP_ADDRESS_CURRENT_PC}", "test_the_environment"),
    Line("8.2.3", "roscore", "shell"),
    slip(
        "8.2.3",
        "roslaunch turtlesim turtlesim_node __name:=master_turtle",
        "roslaunch turtlesim turtlesim_node",
        "%roslaunch turtlesim turtlesim_node __name:=master_turtle",
        "rosrun turtlesim turtlesim_node",
    ),
    slip(
        "8.2.3",
        "roslaunch turtlesim turtle_teleop_key",
        "roslaunch turtlesim turtle_teleop_key",
        "%roslaunch turtlesim turtle_teleop_key",
        "rosrun turtlesim turtle_teleop_key",
    ),
    slip(
        "8.2.3",
        "roslaunch turtlesim turtlesim_node __name:=node1_turtle",
        "roslaunch turtlesim turtlesim_node",
        "%roslaunch turtlesim turtlesim_node __name:=node1_turtle",
        "rosrun turtlesim turtlesim_node",
    ),
    Line("9.3", "roslaunch navigation_stage move_base_gmapping_5cm.launch", USE_CASES),
    Line("9.3", "roslaunch navigation_stage move_base.xml", USE_CASES),
    slip(
        "9.3",
        "roslaunch map_server map_saver -f my map",
        "roslaunch map_server map_saver -f my map",
        "%roslaunch map_server map_saver -f my map",
        "rosrun map_server map_saver",
    ),
    Line("9.4.1", "roslaunch navigation_stage move_base_gmapping_5cm.launch", USE_CASES),
    Line("9.4.1", "roslaunch navigation_stage move_base.xml", USE_CASES),
    slip(
        "9.4.1",
        "roslaunch frontier-exploration global_map.launch",
        "roslaunch frontier-exploration global_map.launch",
        "%roslaunch frontier-exploration global_map.launch",
        "frontier_exploration",
    ),
    Line("9.4.2", "roslaunch navigation_stage move_base_gmapping_5cm.launch", USE_CASES),
    Line("9.4.2", "roslaunch navigation_stage move_base.xml", USE_CASES),
    slip(
        "9.4.2",
        "roslaunch explore_lite global_map.launch",
        "roslaunch explore_lite global_map.launch",
        "%roslaunch explore_lite global_map.launch",
        "explore.launch",
    ),
    Line("9.4.3", "roslaunch turtlebot3_ds my_multi_turtlebot3.launch", "test_the_workspace_of_the_report"),
    Line(
        "9.4.3",
        "roslaunch turtlebot3_ds turtlebot3_teleop_key_tb3_0.launch",
        "test_the_workspace_of_the_report",
    ),
    Line(
        "9.4.3",
        "roslaunch turtlebot3_ds turtlebot3_teleop_key_tb3_1.launch",
        "test_the_workspace_of_the_report",
    ),
    Line(
        "9.5",
        "roslaunch turtlebot3_gazebo turtlebot3_world.launch",
        "test_one_turtlebot_explores",
        "%roslaunch turtlebot3_gazebo turtlebot3_world.launch model:=burger --check",
        "all is there",
    ),
    Line("9.5", "roslaunch turtlebot3_navigation move_base.launch", "test_one_turtlebot_explores"),
    Line(
        "9.5",
        "roslaunch turtlebot3_slam turtlebot3_slam.launch slam_methods:=gmapping",
        "test_one_turtlebot_explores",
    ),
    Line(
        "9.5",
        "roslaunch turtlebot3_slam turtlebot3_frontier_exploration.launch",
        "test_one_turtlebot_explores",
    ),
    Line("9.5", "roslaunch turtlebot3_teleop turtlebot3_teleop_key.launch", "test_one_turtlebot_explores"),
)
