"""The walk of the first hours in the cells of a notebook: a workspace, a package, two scripts, and both running."""

import pytest

PACKAGE = """%%terminal --new
source /opt/ros/noetic/setup.bash
mkdir -p ~/example_ws/src
cd ~/example_ws/src
catkin_create_pkg example_pkg std_msgs rospy > /dev/null
mkdir example_pkg/scripts
cd example_pkg/scripts
"""
TALKER = """%%terminal
cat > talker.py << 'EOF'
#!/usr/bin/env python3
import rospy
from std_msgs.msg import String
rospy.init_node("talker")
pub = rospy.Publisher("chatter", String, queue_size=10)
rate = rospy.Rate(2)
while not rospy.is_shutdown():
    pub.publish("hello")
    rate.sleep()
EOF
cat > listener.py << 'EOF'
#!/usr/bin/env python3
import rospy
from std_msgs.msg import String
rospy.init_node("listener")
rospy.Subscriber("chatter", String, lambda message: print("heard", message.data))
rospy.spin()
EOF
chmod +x talker.py listener.py
cd ~/example_ws && catkin_make | tail -n 2
source devel/setup.bash
"""
RUN = """%%terminal
roscore
rosrun example_pkg talker.py
rosrun example_pkg listener.py
sleep 1.2
rosnode list | grep er
rosnode kill /talker > killed.txt && cat killed.txt
"""


def walk(notebook):
    written = [notebook.ok(each) for each in (PACKAGE, TALKER, RUN)]
    written.append(notebook.ok("%rosrun example_pkg talker.py\nimport rosmini\nrosmini.wait(1.2)"))
    return "".join(written)


def test_the_walk_and_run_all_twice(notebook):
    first = walk(notebook)
    assert "1 built, 0 up to date, 0 failed" in first
    assert first.count("heard hello") >= 3
    assert "/listener\n/talker\n$ rosnode kill" in first
    assert "killed\n" in first
    assert "/tmp" not in first
    assert walk(notebook) == first


CFG = """#!/usr/bin/env python3
PACKAGE = "drive"
from dynamic_reconfigure.parameter_generator_catkin import *
gen = ParameterGenerator()
gen.add("speed", double_t, 0, "Greatest speed, in m/s", 0.2, 0.0, 1.0)
exit(gen.generate(PACKAGE, "drive", "Drive"))
"""


@pytest.mark.parametrize("messages", [False, True])
def test_a_cell_imports_what_a_cfg_file_describes_as_it_was_built_last(notebook, messages):
    """`messages`: the package has a message, too, whose module is made in another way."""
    add = "mkdir msg\necho 'int32 num' > msg/Num.msg\n" if messages else ""
    cmake = "add_message_files(FILES Num.msg)\ngenerate_messages()\n" if messages else ""
    needs = "dynamic_reconfigure message_generation"
    notebook.ok(
        "%%terminal --new\nmkdir -p ~/ws/src\ncd ~/ws/src\n"
        f"catkin_create_pkg drive {needs} > /dev/null\ncd drive\nmkdir cfg\n{add}"
        f"cat > cfg/Drive.cfg << 'EOF'\n{CFG}EOF\nchmod +x cfg/Drive.cfg\ncat > CMakeLists.txt << 'EOF'\n"
        "cmake_minimum_required(VERSION 3.0.2)\nproject(drive)\n"
        f"find_package(catkin REQUIRED COMPONENTS {needs})\n{cmake}"
        "generate_dynamic_reconfigure_options(cfg/Drive.cfg)\ncatkin_package()\nEOF\n"
        "cd ~/ws && catkin_make > /dev/null\nsource devel/setup.bash\n"
    )
    read = "from drive.cfg import DriveConfig\nprint(DriveConfig.defaults)"
    assert "{'speed': 0.2}" in notebook.ok(read)
    notebook.ok(
        "%%terminal\ncat > src/drive/cfg/Drive.cfg << 'EOF'\n"
        f"{CFG.replace('0.2, 0.0', '0.3, 0.0')}EOF\ncatkin_make > /dev/null\n"
    )
    assert "{'speed': 0.3}" in notebook.ok(read)
    if messages:
        assert "num: 3" in notebook.ok("from drive.msg import Num\nprint(Num(num=3))")
