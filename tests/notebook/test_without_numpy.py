"""The graph, its commands, turtlesim and Logo work where numpy and the other large packages are absent."""

import sys

from ..processes import run

ABSENT = ("PIL", "lz4", "matplotlib", "numba", "numpy", "pymunk", "scipy")

CELLS = [
    """%load_ext rosmini
import rosmini""",
    """%%node talker.py
import rospy
from std_msgs.msg import String

rospy.init_node("talker")
publisher = rospy.Publisher("chatter", String, queue_size=1)
rate = rospy.Rate(2)
while not rospy.is_shutdown():
    publisher.publish("hello")
    rate.sleep()
""",
    """%%node listener.py
import rospy
from std_msgs.msg import String
from std_srvs.srv import SetBool, SetBoolResponse

rospy.init_node("listener")
rospy.Subscriber("chatter", String, lambda message: print("heard", message.data))
rospy.Service("switch", SetBool, lambda request: SetBoolResponse(request.data, "done"))
rospy.set_param("~gain", [1, 2.5, "x"])
rospy.spin()
""",
    "rosmini.wait(2)",
    "%rosservice call /switch true",
    "%rosparam get /listener/gain",
    "%rosnode info /listener",
    "%rostopic echo -n 1 /chatter",
    "%rosnode kill talker",
    "%rosrun turtlesim turtlesim_node",
    "%rosservice call /turtle1/teleport_relative 2.0 0.0",
    "%rosservice call /spawn 1.0 2.0 0.0 leo",
    "%rostopic echo -n 1 /turtle1/color_sensor",
    "%rosnode kill turtlesim",
    "from rosmini.sim.logo import Logo\nLogo().run('repeat 4 [forward 50 right 90]  print pos')",
]

SCRIPT = f"""
import sys
from IPython.core.interactiveshell import InteractiveShell

class Absent:
    def find_spec(self, name, path=None, target=None):
        if name.partition(".")[0] in {ABSENT!r}:
            raise ModuleNotFoundError(f"No module named {{name!r}}", name=name)

sys.meta_path.insert(0, Absent())
shell = InteractiveShell.instance()
for cell in {CELLS!r}:
    shell.run_cell(cell).raise_error()
print("finished")
"""


def test_nodes_commands_turtlesim_and_logo_need_no_numpy(tmp_path):
    done = run([sys.executable, "-c", SCRIPT], cwd=tmp_path)
    assert done.returncode == 0, done.stderr
    assert "heard hello" in done.stdout
    assert "success: True" in done.stdout
    assert "r: 179\ng: 184\nb: 255" in done.stdout
    assert "finished" in done.stdout
