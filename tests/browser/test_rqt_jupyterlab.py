"""Panels of rqt in a real JupyterLab: real keys in Chromium, a live graph in a real kernel."""

import re

import pytest

pytestmark = pytest.mark.browser

CELLS = [
    """
%load_ext rosmini
import rosmini
from rosmini.msgs.std_msgs.msg import Float64
from rosmini.msgs.std_srvs.srv import SetBool
graph = rosmini.default_graph()
node = graph.node("lamp")
asked, heard = [], []
def switch(request):
    asked.append(request.data)
    return request.data, "lit" if request.data else "dark"
_ = node.service("switch", SetBool, switch)
_ = node.subscriber("/level", Float64, lambda message: heard.append(message.data))
""",
    "_ = %rqt_service_caller /switch",
    "print('asked', asked)",
    "opened = %rqt_gui rqt_publisher rqt_plot",
    "print('published', heard[0] >= 7, graph.is_live)",
    "opened.view.close(); print('closed')",
]


class Lab:
    """JupyterLab in a page, with the notebook open and its kernel idle."""

    def __init__(self, page, address):
        self.page = page
        page.goto(address)
        self.cells = page.locator(".jp-Notebook .jp-CodeCell")
        self.cells.nth(len(CELLS) - 1).wait_for()
        page.locator("#jp-main-statusbar", has_text="| Idle").wait_for()

    def run(self, number):
        cell = self.cells.nth(number)
        cell.locator(".jp-InputArea-editor").click()
        self.page.keyboard.press("Control+Enter")
        cell.locator(".jp-InputPrompt", has_text=re.compile(r"\[[\d]+\]")).first.wait_for()

    def says(self, number, text):
        self.cells.nth(number).locator(".jp-OutputArea-output", has_text=text).first.wait_for()

    def control(self, number, key):
        return self.cells.nth(number).locator(f"[data-key='{key}']")

    def write(self, number, key, text):
        self.control(number, key).fill(text)
        self.control(number, key).press("Enter")


@pytest.mark.nightly
def test_a_service_is_called_and_a_window_publishes_and_plots(open_in_lab, chromium, shared_tmp):
    page = chromium.new_page(viewport={"width": 1280, "height": 1800})
    try:
        lab = Lab(page, open_in_lab(CELLS))
        lab.run(0)
        lab.run(1)
        lab.write(1, "request/data", "1 < 2")
        lab.control(1, "call").click()
        lab.cells.nth(1).locator(".rq-box", has_text="'lit'").wait_for()
        lab.run(2)
        lab.says(2, "asked [True]")

        lab.run(3)
        lab.write(3, "1/topic", "/level")
        lab.cells.nth(3).locator("[data-key='1/type'][value='std_msgs/Float64']").wait_for()
        lab.control(3, "1/add").click()
        lab.write(3, "1/1/field/data", "7 + i")
        lab.write(3, "1/1/rate", "20")
        lab.control(3, "1/1/on").click()
        lab.write(3, "2/field", "/level/data")
        lab.control(3, "2/add").click()
        lab.cells.nth(3).locator(".rq-drawing svg").wait_for()
        lab.run(4)
        lab.says(4, "published True True")
        page.screenshot(path=shared_tmp / "rqt_jupyterlab.png", full_page=True)

        lab.run(5)
        lab.says(5, "closed")
        lab.cells.nth(3).locator(".rq-pill", has_text="was shut down").wait_for()
        assert lab.control(3, "quit").is_disabled()
    except Exception:
        page.screenshot(path=shared_tmp / "rqt_failed.png", full_page=True)
        raise
    finally:
        page.close()
