"""Panels of rqt in a real JupyterLab: real keys in Chromium, a live graph in a real kernel."""

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


def control(lab, number, key):
    return lab.cells.nth(number).locator(f"[data-key='{key}']")


def write(lab, number, key, text):
    control(lab, number, key).fill(text)
    control(lab, number, key).press("Enter")


@pytest.mark.nightly
def test_a_service_is_called_and_a_window_publishes_and_plots(open_lab):
    lab = open_lab(CELLS)
    lab.run(0)
    lab.run(1)
    write(lab, 1, "request/data", "1 < 2")
    control(lab, 1, "call").click()
    lab.cells.nth(1).locator(".rq-box", has_text="'lit'").wait_for()
    lab.run(2)
    lab.says(2, "asked [True]")

    lab.run(3)
    write(lab, 3, "1/topic", "/level")
    lab.cells.nth(3).locator("[data-key='1/type'][value='std_msgs/Float64']").wait_for()
    control(lab, 3, "1/add").click()
    write(lab, 3, "1/1/field/data", "7 + i")
    write(lab, 3, "1/1/rate", "20")
    control(lab, 3, "1/1/on").click()
    write(lab, 3, "2/field", "/level/data")
    control(lab, 3, "2/add").click()
    lab.cells.nth(3).locator(".rq-drawing svg").wait_for()
    lab.run(4)
    lab.says(4, "published True True")

    lab.run(5)
    lab.says(5, "closed")
    lab.cells.nth(3).locator(".rq-pill", has_text="was shut down").wait_for()
    assert control(lab, 3, "quit").is_disabled()
