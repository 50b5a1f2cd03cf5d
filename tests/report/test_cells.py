"""The report's command lines typed into cells."""

import re

import pytest

from .command_lines import LINES

TALKER = """%%node talker.py
import rospy
from std_msgs.msg import String
from std_srvs.srv import SetBool, SetBoolResponse

rospy.init_node("talker")
chatter = rospy.Publisher("chatter", String, queue_size=10)
rospy.Service("switch", SetBool, lambda request: SetBoolResponse(True, "on"))
rate = rospy.Rate(10)
while not rospy.is_shutdown():
    chatter.publish("hello")
    rate.sleep()
"""


@pytest.mark.nightly
def test_the_lines_of_the_report_work_in_cells(notebook, tmp_path, monkeypatch):
    """Each prints what it should, or its error names the right form; in the order of the report, in one notebook."""
    (tmp_path / "example_ws" / "src").mkdir(parents=True)
    monkeypatch.chdir(tmp_path)
    monkeypatch.delenv("ROS_PACKAGE_PATH", raising=False)
    notebook.ok("%load_ext rosmini")
    notebook.ok("%roscore")
    notebook.ok(TALKER)
    wrong = []
    for line in LINES:
        if line.cell and line.text != "roscore":
            error, written = notebook.run(line.cell)
            if "rosbag record" in line.cell:
                notebook.ok("import rosmini\nrosmini.wait(3)")
            if (error is not None) != line.is_slip or not re.search(line.says, written, re.MULTILINE):
                wrong.append(f"{line.cell}: {written}")
    assert not wrong, "\n===\n".join(wrong)
    assert "ROS_MASTER_URI=" in notebook.ok("%roscore")
