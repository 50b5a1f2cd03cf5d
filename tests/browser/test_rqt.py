"""Panels of rqt in a page: real clicks and keys, with the kernel's side in this process."""

from pathlib import Path
from types import SimpleNamespace

import pytest

from rosmini import Graph
from rosmini.core.dynamic_reconfigure import Description, ParameterGroup, ReconfigurableParameter, Server
from rosmini.core.errors import RosminiError
from rosmini.msgs.std_msgs.msg import String
from rosmini.msgs.std_srvs.srv import SetBool
from rosmini.viz.embed import STATIC
from rosmini.viz.live.panel_link import SCRIPTS, PanelLink
from rosmini.viz.rqt.console import LogConsole
from rosmini.viz.rqt.graph import NodeGraph
from rosmini.viz.rqt.logger_level import LoggerLevel
from rosmini.viz.rqt.publisher import MessagePublisher
from rosmini.viz.rqt.reconfigure import DynamicReconfigure
from rosmini.viz.rqt.service_caller import ServiceCaller

from .test_keyboard import walk

pytestmark = pytest.mark.browser

BRIDGE = """(data) => {
  globalThis.outbox = [];
  const model = {
    get: () => data,
    on: (_, hear) => { model.hear = hear; },
    off: () => {},
    send: (content) => outbox.push(content),
  };
  globalThis.deliver = (messages) => { for (const content of messages) model.hear(content); };
  globalThis.leave = rosminiRqt.render({ model, el: document.getElementById("panel") });
}"""


class Opened:
    """A page with a panel, and the graph behind it. Nothing passes between them but in `pump`."""

    def __init__(self, page, panel):
        self.page, self.panel, self.graph = page, panel, panel.graph
        self.wall = 100.0
        self.graph.live = lambda: setattr(self.graph, "_live", SimpleNamespace(running=True, stop=lambda: None))
        self.link = PanelLink(panel, clock=lambda: self.wall)
        self.sent = []
        self.link.widget.send = lambda content, buffers=None: self.sent.append(content)
        page.clock.install(time=0)
        page.evaluate(BRIDGE, self.link.widget.data)
        self.pump()

    def say(self):
        """Let the page's messages arrive."""
        for content in self.page.evaluate("outbox.splice(0)"):
            self.link.receive(self.link.widget, content, [])

    def pump(self, seconds=0.25):
        """Let the page's messages arrive, time go on, and the answers arrive."""
        self.say()
        for _ in range(max(1, round(seconds / 0.05))):
            self.graph.run(0.05)
            self.wall += 0.05
        messages, self.sent[:] = list(self.sent), []
        self.page.evaluate("deliver", messages)
        self.page.clock.run_for(round(1000 * seconds))

    def control(self, key):
        return self.page.locator(f"[data-key='{key}']")

    def press(self, key):
        self.control(key).click()
        self.pump()

    def write(self, key, text):
        self.control(key).fill(text)
        self.control(key).press("Enter")
        self.pump()

    def choose(self, key, value):
        self.control(key).select_option(value)
        self.pump()

    @property
    def note(self):
        return self.page.locator(".rq-pill").inner_text()


@pytest.fixture
def show(chromium, watch, tmp_path):
    """Open a page with a panel; in the end it has to have said, raised and fetched nothing."""
    opened = []

    def open_page(panel, *, theme="light"):
        scripts = "".join(f'<script src="{(STATIC / name).as_uri()}"></script>' for name in SCRIPTS)
        page_file = Path(tmp_path, f"{len(opened)}.html")
        page_file.write_text(
            f'<!DOCTYPE html><html lang="en" data-theme="{theme}"><meta charset="utf-8"><title>panel</title>'
            f'<link rel="icon" href="data:,"><body style="margin:16px"><div id="panel"></div>{scripts}',
            encoding="utf-8",
        )
        context = chromium.new_context(viewport={"width": 900, "height": 1000})
        page = context.new_page()
        opened.append((context, watch(page)))
        page.goto(page_file.as_uri())
        return Opened(page, panel)

    yield open_page
    for context, watcher in opened:
        context.close()
        assert watcher.seen == []


@pytest.fixture
def graph():
    with Graph() as graph:
        node = graph.node("lamp")
        node.service("switch", SetBool, lambda request: (request.data, "on" if request.data else "off"))
        yield graph


def test_a_topic_is_added_filled_enabled_and_removed(show, graph):
    opened = show(MessagePublisher(graph))
    assert opened.note == "the graph stands still"
    opened.write("topic", "/text")
    opened.write("type", "std_msgs/String")
    opened.press("add")
    assert opened.note == "live"
    opened.write("1/field/data", "'n%d' % i")
    opened.write("1/rate", "10")
    opened.press("1/on")
    opened.pump(1.0)
    (row,) = opened.panel.publications.values()
    assert row.enabled
    assert row.count > 5
    opened.press("1/on")
    assert opened.page.get_by_text("messages").inner_text() == f"{row.count} messages"
    opened.control("1/remove").press("Enter")
    opened.pump()
    assert opened.control("1/on").count() == 0
    assert opened.page.evaluate("document.activeElement.dataset.key") == "add"  # not the top of the page


def test_what_is_typed_is_not_lost_while_the_panel_changes(show, graph):
    opened = show(MessagePublisher(graph))
    opened.press("add")
    opened.write("1/rate", "10")
    opened.press("1/on")
    field = opened.control("1/field/linear/x")
    field.fill("0.5 *")
    opened.pump(1.0)
    assert field.input_value() == "0.5 *"
    assert opened.page.evaluate("document.activeElement.dataset.key") == "1/field/linear/x"
    opened.page.keyboard.type(" i")
    opened.page.keyboard.press("Enter")
    opened.pump()
    (row,) = opened.panel.publications.values()
    assert row.fields.texts["linear/x"] == "0.5 * i"


def test_what_is_refused_is_said_and_the_old_value_comes_back(show, graph):
    opened = show(MessagePublisher(graph))
    opened.press("add")
    opened.write("1/rate", "-3")
    assert "is a number from 0 to 1000" in opened.page.locator(".rq-bad").inner_text()
    opened.control("topic").focus()
    opened.pump(1.0)
    assert opened.control("1/rate").input_value() == "1"


def test_a_service_is_called_with_keys_alone(show, graph):
    opened = show(ServiceCaller(graph))
    opened.choose("service", "/switch")
    opened.control("request/data").focus()
    opened.page.keyboard.press("Control+a")
    opened.page.keyboard.type("True")
    opened.page.keyboard.press("Enter")
    opened.pump()
    opened.control("call").focus()
    opened.page.keyboard.press("Enter")
    opened.pump()
    assert opened.page.get_by_role("group", name="Values of std_srvs/SetBoolResponse").is_visible()
    assert "'on'" in opened.page.locator("section.rq-box").last.inner_text()
    opened.page.evaluate("document.activeElement.blur()")
    assert walk(opened.page) == []


@pytest.mark.parametrize("theme", ["light", "dark"])
def test_a_level_is_chosen_and_each_control_has_a_name(show, graph, theme, shared_tmp):
    opened = show(LoggerLevel(graph), theme=theme)
    opened.choose("node", "/lamp")
    opened.page.get_by_role("combobox", name="level of rosout").select_option("Debug")
    opened.pump()
    assert opened.panel.loggers["rosout"] == "Debug"
    opened.page.screenshot(path=shared_tmp / f"rqt_logger_level_{theme}.png")
    names = opened.page.locator("[data-key]").evaluate_all(
        "all => all.map((one) => one.ariaLabel || one.textContent.trim())"
    )
    assert all(names)


def test_a_slider_is_moved_with_keys(show, graph):
    gain = ReconfigurableParameter("gain", "double", 0, "how strong", 0.5, 0.0, 2.0)
    server = Server(graph.node("robot"), Description(ParameterGroup("Default", parameters=(gain,))), lambda c, _: c)
    opened = show(DynamicReconfigure(graph, "/robot"))
    slider = opened.page.get_by_role("slider", name="gain (slider)")
    slider.focus()
    for _ in range(4):  # faster than the answers of the kernel
        opened.page.keyboard.press("ArrowRight")
        opened.page.evaluate("deliver", opened.sent)
        opened.sent.clear()
        opened.page.clock.run_for(1)
        opened.say()
        graph.run(0.01)
    opened.pump()
    opened.pump()
    assert server.config["gain"] == pytest.approx(0.508)
    assert opened.control("value/gain").input_value() == "0.508"


@pytest.mark.parametrize("theme", ["light", "dark"])
def test_a_click_on_a_node_highlights_it(show, graph, theme, shared_tmp):
    graph.node("talker").publisher("/chatter", String)
    graph.node("listener").subscriber("/chatter", String, lambda _: None)
    opened = show(NodeGraph(graph), theme=theme)
    opened.page.locator(".rm-node", has_text="/talker").click()
    opened.pump()
    assert opened.panel.options["highlight"] == "/talker"
    assert "/talker" in opened.page.locator(".rm-chosen").text_content()
    assert "/listener" in opened.page.locator(".rm-node.rm-out").text_content()
    opened.page.screenshot(path=shared_tmp / f"rqt_graph_{theme}.png")


def test_what_is_logged_appears(show, graph):
    opened = show(LogConsole(graph))
    opened.choose("level", "WARN")
    graph.nodes["/lamp"].logwarn("<i>hot</i>")
    opened.pump(0.5)
    assert "<i>hot</i>" in opened.page.get_by_role("group", name="Log messages").inner_text()


def test_why_a_message_was_refused_is_seen_until_the_next_click(show, graph):
    opened = show(LoggerLevel(graph))
    alert = opened.page.get_by_role("alert")

    def refuse():
        raise RosminiError("a live graph needs an event loop")

    start, opened.graph.live = opened.graph.live, refuse
    opened.press("refresh")
    opened.pump(1.0)
    assert "needs an event loop" in alert.inner_text()
    opened.graph.live = start
    opened.press("refresh")
    assert alert.is_hidden()
    assert opened.note == "live"


def test_an_ended_panel_is_disabled_and_says_why(show, graph):
    opened = show(LoggerLevel(graph))
    opened.choose("node", "/lamp")
    opened.panel.close()
    opened.page.clock.run_for(600)
    opened.pump()
    assert "/rqt_logger_level" in opened.note
    assert opened.control("refresh").is_disabled()


def test_a_silent_kernel_is_noticed(show, graph):
    opened = show(LoggerLevel(graph))
    opened.choose("node", "/lamp")
    opened.page.clock.run_for(4000)
    assert opened.note.startswith("waiting for the kernel")
    opened.pump()
    opened.pump(1.0)
    assert opened.note == "live"
