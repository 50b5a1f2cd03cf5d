"""A script that asks, in a real JupyterLab: somebody types below the cell in which time passes."""

import pytest

pytestmark = pytest.mark.browser

ASK = """%%node ask.py
import rospy
rospy.init_node("ask")
rospy.sleep(1)
print("hello", input("who? "), "from the robot")"""
CELLS = ["%load_ext rosmini\n%roscore", ASK, "import rosmini\nrosmini.wait(2)"]


@pytest.mark.nightly
def test_what_is_typed_below_the_cell_is_what_the_script_reads(open_lab):
    lab = open_lab(CELLS)
    for number in range(len(CELLS)):
        lab.run(number)
    asked = lab.cells.nth(2).locator(".jp-Stdin-input")
    asked.wait_for()
    lab.says(2, "who?")
    asked.fill("Ada")
    asked.press("Enter")
    lab.says(2, "hello Ada from the robot")
