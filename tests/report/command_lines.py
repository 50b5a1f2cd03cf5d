"""Every command line that the report prints, in its order, and where the tests type it.

A line is typed in a shell by what ``by`` names: a command line of `test_graph_commands`, a test or a fixture there or
in `test_shell`, or (after ``walk:``) a line of the walk in `tests/tools/test_catkin_make.py`. ``cell`` is what a reader
types in a cell instead, where that can be; lines that wait for something name it in ``waits``.
"""

from __future__ import annotations

from typing import NamedTuple

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


TABLE = """
# 3.3.1
! roscpp info [node] ; roscpp info /talker ; % ; rosnode
! roscpp kill [node] ; test_nodes_are_killed ; %roscpp kill /talker ; rosnode
! roscpp list ; = ; % ; rosnode
rosnode machine [machine_name] ; rosnode machine ; % ; .
rosnode ping ; rosnode ping -c 1 /talker ; % ; xmlrpc reply
rosnode cleanup ; = ; % ; ^$
# 3.3.3
! rosmmsg show [message] ; rosmmsg show example_pkg/Num ; %rosmmsg show std_msgs/String ; rosmsg
! rosmmsg list ; rosmmsg show example_pkg/Num ; %rosmmsg list ; rosmsg
! rosmmsg md5 [message] ; rosmmsg show example_pkg/Num ; %rosmmsg md5 std_msgs/String ; rosmsg
! rosmmsg package [package_name] ; rosmmsg show example_pkg/Num ; %rosmmsg package std_msgs ; rosmsg
! rosmmsg packages [package_1] [package_2] ; rosmmsg show example_pkg/Num ; %rosmmsg packages ; rosmsg
# 3.3.4
rostopic bw /topic ; rostopic bw /chatter --duration 2.5 ; %rostopic bw /chatter ; average: .*B/s
rostopic echo /topic ; rostopic echo -n 1 /chatter ; % ; data: .*hello
rostopic find /message_type ; rostopic find std_msgs/String ; % ; ^/chatter$
rostopic hz /topic ; rostopic hz /chatter --duration 2.5 ; %rostopic hz /chatter ; average rate: 10
rostopic info /topic ; rostopic info /chatter ; % ; Type: std_msgs/String
rostopic list ; = ; % ; ^/chatter$
rostopic pub /topic message.type args ; rostopic pub -1 /news std_msgs/String hello ; % ; \
    publishing and latching message for
rostopic type /topic ; rostopic type /chatter ; % ; ^std_msgs/String$
# 3.3.5
rossrv ; rossrv show std_srvs/SetBool ; % ; ^bool success$
rosservice call /service args ; rosservice call /switch true ; % ; message: "on"
rosservice find service_type ; rosservice find std_srvs/SetBool ; % ; ^/switch$
rosservice info /services ; rosservice info /switch ; % ; Node: /talker
rosservice list ; = ; % ; ^/switch$
rosservice type /service ; rosservice type /switch ; % ; ^std_srvs/SetBool$
rosservice uri /service ; rosservice uri /switch ; % ; ^rosrpc://
# 3.3.6
rosbag record [topic_1] [topic_2] -o [bag_name] ; test_a_bag_is_recorded_and_played ; \
    %rosbag record /chatter -O house --duration 2 ;
rosbag play [bag_name] ; test_a_bag_is_recorded_and_played ; %rosbag play house.bag ;
rqt_bag ; test_pictures_are_written_as_pages ; %rqt_bag house.bag ;
# 3.6.1
source /opt/ros/kinetic/setup.bash
mkdir -p ~/example_ws/src ; walk:mkdir -p example_ws/src
cd ~/example_ws/ ; walk:cd example_ws/ ; %cd example_ws ;
catkin_make ; walk:{catkin_make} ; %catkin_make ; 0 built, 0 up to date, 0 failed
source devel/setup.bash ; walk:. devel/setup.{shell}
# 3.6.2
catkin_create_pkg example_pkg std_msgs rospy roscpp ; walk:{catkin_create_pkg} example_pkg std_msgs rospy roscpp ; \
    %catkin_create_pkg example_pkg std_msgs rospy roscpp ; Created file example_pkg/package.xml
# 3.6.3
mkdir msg ; walk:mkdir msg
echo "int64 num" > msg/Num.msg ; walk:echo "int64 num" > msg/Num.msg
! rosmmsg show example_pkg/Num ; = ; % ; rosmsg
# 3.6.4
wget .../talker.py
chmod +x talker.py ; walk:chmod +x src/example_pkg/scripts/talker.py
wget .../listener.py
chmod +x listener.py ; walk:chmod +x src/example_pkg/scripts/talker.py
roscore ; shell ; %roscore ; ROS_MASTER_URI=
source ./devel/setup.bash ; walk:. ./devel/setup.{shell}
! roslaunch example_pkg talker.py ; = ; %roslaunch rospy_tutorials talker.py ; rosrun rospy_tutorials talker.py
! roslaunch example_pkg listener.py ; roslaunch example_pkg talker.py ; %roslaunch rospy_tutorials listener.py ; \
    rosrun rospy_tutorials listener.py
# 7.4
export ROS_ROOT=/home/user/ros/ros ; test_the_environment
export PATH=$ROS_ROOT/bin:$PATH ; test_the_environment
export ROS_MASTER_URI=http://{IP_ADDRESS_PC}:11311/ ; test_the_environment
export ROS_HOSTNAME={IP_ADDRESS_CURRENT_PC} ; test_the_environment
export PYTHONPATH=$PYTHONPATH:$ROS_ROOT/core/roslib/src ; test_the_environment
echo "export TURTLEBOT3_MODEL=burger" ; test_the_environment
# 7.5
printenv | grep ROS ; test_the_environment
source /opt/ros/kinetic/setup.bash
# 8.2
roscore ; shell
! roslaunch turtlesim turtlesim_node ; = ; % ; rosrun turtlesim turtlesim_node
rostopic list ; =
! roslaunch turtlesim turtlesim_node --name:=my_turtle ; roslaunch example_pkg talker.py --name:=my_turtle ; \
    %roslaunch turtlesim turtlesim_node --name:=my_turtle ; __name:=my_turtle
! roslaunch ping my_turtle ; = ; % ; rosnode ping my_turtle
# 8.2.1
roscore ; shell
! roslaunch turtlesim turtlesim_node ; = ; % ; rosrun turtlesim turtlesim_node
! roslaunch turtlesim turtle_teleop_key ; = ; % ; rosrun turtlesim turtle_teleop_key
rqt_graph ; test_pictures_are_written_as_pages ; %rqt_graph ;
rostopic -h ; test_help ; %rostopic -h ; rostopic <verb>
# 8.2.2
chmod u+x move.py ; walk:chmod +x src/example_pkg/scripts/talker.py
# 8.2.3
export ROS_MASTER_URI=http://{IP_ADDRESS_OF_REMOTE_PC}:11311 ; test_the_environment
export ROS_HOSTNAME={IP_ADDRESS_CURRENT_PC} ; test_the_environment
roscore ; shell
! roslaunch turtlesim turtlesim_node __name:=master_turtle ; roslaunch turtlesim turtlesim_node ; \
    %roslaunch turtlesim turtlesim_node __name:=master_turtle ; rosrun turtlesim turtlesim_node
! roslaunch turtlesim turtle_teleop_key ; = ; % ; rosrun turtlesim turtle_teleop_key
! roslaunch turtlesim turtlesim_node __name:=node1_turtle ; roslaunch turtlesim turtlesim_node ; \
    %roslaunch turtlesim turtlesim_node __name:=node1_turtle ; rosrun turtlesim turtlesim_node
# 9.3
roslaunch navigation_stage move_base_gmapping_5cm.launch ; test_a_goal_and_exploration_on_stage
roslaunch navigation_stage move_base.xml ; test_a_goal_and_exploration_on_stage
! roslaunch map_server map_saver -f my map ; = ; % ; rosrun map_server map_saver
# 9.4.1
roslaunch navigation_stage move_base_gmapping_5cm.launch ; test_a_goal_and_exploration_on_stage
roslaunch navigation_stage move_base.xml ; test_a_goal_and_exploration_on_stage
! roslaunch frontier-exploration global_map.launch ; = ; % ; frontier_exploration
# 9.4.2
roslaunch navigation_stage move_base_gmapping_5cm.launch ; test_a_goal_and_exploration_on_stage
roslaunch navigation_stage move_base.xml ; test_a_goal_and_exploration_on_stage
! roslaunch explore_lite global_map.launch ; = ; % ; explore.launch
# 9.4.3
roslaunch turtlebot3_ds my_multi_turtlebot3.launch ; test_the_workspace_of_the_report
roslaunch turtlebot3_ds turtlebot3_teleop_key_tb3_0.launch ; test_the_workspace_of_the_report
roslaunch turtlebot3_ds turtlebot3_teleop_key_tb3_1.launch ; test_the_workspace_of_the_report
# 9.5
roslaunch turtlebot3_gazebo turtlebot3_world.launch ; test_one_turtlebot_explores ; \
    %roslaunch turtlebot3_gazebo turtlebot3_world.launch model:=burger --check ; all is there
roslaunch turtlebot3_navigation move_base.launch ; test_one_turtlebot_explores
roslaunch turtlebot3_slam turtlebot3_slam.launch slam_methods:=gmapping ; test_one_turtlebot_explores
roslaunch turtlebot3_slam turtlebot3_frontier_exploration.launch ; test_one_turtlebot_explores
roslaunch turtlebot3_teleop turtlebot3_teleop_key.launch ; test_one_turtlebot_explores
"""
"""Below the number of each section: the line; ``by``, or = if it is typed as printed; ``cell``, or % if it is ``by`` as
a magic; and what the cell prints. ! marks a slip of the report."""

WAITS = {"source /opt/ros/": NO_ROS, "wget ": NETWORK}


def _lines():
    chapter = ""
    for row in TABLE.strip().splitlines():
        if row.startswith("# "):
            chapter = row[2:]
            continue
        text, by, cell, says = ([each.strip() for each in row.split(";")] + [""] * 3)[:4]
        is_slip, text = text.startswith("! "), text.removeprefix("! ")
        by = text if by == "=" else by
        cell = f"%{by}" if cell == "%" else cell
        waits = next((why for start, why in WAITS.items() if text.startswith(start)), "")
        yield Line(chapter, text, by, cell, says, waits, is_slip)


LINES = tuple(_lines())
