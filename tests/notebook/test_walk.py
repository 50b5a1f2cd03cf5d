"""The walk of the first hours in the cells of a notebook: a workspace, a package, two scripts, and both running."""

from __future__ import annotations

from typing import Any

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


def walk(notebook: Any) -> str:
    written = [notebook.ok(each) for each in (PACKAGE, TALKER, RUN)]
    written.append(notebook.ok("%rosrun example_pkg talker.py\nimport rosmini\nrosmini.wait(1.2)"))
    return "".join(written)


def test_the_walk_and_run_all_twice(notebook: Any) -> None:
    first = walk(notebook)
    assert "1 built, 0 up to date, 0 failed" in first
    assert first.count("heard hello") >= 3
    assert "/listener\n/talker\n$ rosnode kill" in first
    assert "killed\n" in first
    assert "/tmp" not in first
    assert walk(notebook) == first
