"""A script that asks, in a real JupyterLab: somebody types below the cell in which time passes."""

import re

import pytest

pytestmark = pytest.mark.browser

ASK = """%%node ask.py
import rospy
rospy.init_node("ask")
rospy.sleep(1)
print("hello", input("who? "), "from the robot")"""
CELLS = ["%load_ext rosmini\n%roscore", ASK, "import rosmini\nrosmini.wait(2)"]


@pytest.mark.nightly
def test_what_is_typed_below_the_cell_is_what_the_script_reads(open_in_lab, chromium, shared_tmp):
    page = chromium.new_page(viewport={"width": 1280, "height": 1000})
    page.goto(open_in_lab(CELLS))
    cells = page.locator(".jp-Notebook .jp-CodeCell")
    cells.nth(len(CELLS) - 1).wait_for()
    page.locator("#jp-main-statusbar", has_text="| Idle").wait_for()
    try:
        for number in range(len(CELLS)):
            cells.nth(number).locator(".jp-InputArea-editor").click()
            page.keyboard.press("Control+Enter")
            prompt = cells.nth(number).locator(".jp-InputPrompt", has_text=re.compile(r"\[[*\d]+\]"))
            prompt.first.wait_for()
        asked = cells.nth(2).locator(".jp-Stdin-input")
        asked.wait_for()
        cells.nth(2).locator(".jp-OutputArea-output", has_text="who?").first.wait_for()
        asked.fill("Ada")
        asked.press("Enter")
        cells.nth(2).locator(".jp-OutputArea-output", has_text="hello Ada from the robot").first.wait_for()
    finally:
        page.screenshot(path=shared_tmp / "node_jupyterlab.png", full_page=True)
        page.close()
