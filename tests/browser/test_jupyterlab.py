"""A live graph in a real JupyterLab: a button that publishes, between cells and while a cell is busy."""

import pytest

pytestmark = pytest.mark.browser

CELLS = [
    """
import threading, time
import ipywidgets
from rosmini import Graph
from rosmini.msgs.std_msgs.msg import String
graph = Graph(simulated=False)
talker, listener = graph.node("talker"), graph.node("listener")
pub = talker.publisher("chatter", String)
heard = []
def hear(message):
    heard.append(message.data)
    print(f"heard click {len(heard)}", flush=True)
listener.subscriber("chatter", String, hear)
pub.wait_for_subscribers()
drive = graph.live()
""",
    """
threads = []
def click(button):
    threads.append(threading.current_thread() is threading.main_thread())
    pub.publish("click")
button = ipywidgets.Button(description="Publish")
button.on_click(click)
# ipykernel 7.4 answers a comm where it was last used; others leave the choice to JupyterLab, which takes a subshell.
vars(button.comm).pop("_reply_subshell_id", None)
button
""",
    "graph.run(until=lambda: len(heard) == 2); print('driven', len(heard))",
    "while len(threads) < 3: time.sleep(0.01)\nprint('busy', len(heard))",
    "talker.sleep(0.1); print('in the end', len(heard), threads[1:])",
]


@pytest.mark.nightly
def test_a_button_publishes_between_cells_and_while_a_cell_is_busy(open_lab):
    lab = open_lab(CELLS)
    page = lab.page
    lab.run(0)
    lab.run(1)
    button = page.locator("button.jupyter-button", has_text="Publish")
    button.wait_for()
    button.click()
    lab.says(0, "heard click 1")  # no cell runs: in the cell that called live()
    lab.run(2)
    page.locator(".jp-Notebook-ExecutionIndicator[data-status='busy']").wait_for(state="attached")
    button.click()
    lab.says(2, "heard click 2")  # the cell that drives
    lab.says(2, "driven 2")
    lab.run(3)
    page.locator(".jp-Notebook-ExecutionIndicator[data-status='busy']").wait_for(state="attached")
    button.click()  # handled in a subshell thread, while the main thread neither drives nor comes back
    lab.says(3, "busy 2")
    lab.says(0, "heard click 3")
    lab.run(4)
    lab.says(4, "in the end 3 [False, False]")
