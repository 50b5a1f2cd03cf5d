"""What goes between a panel and its page, with the page played by the test and the wall's clock set by it."""

from types import SimpleNamespace

import pytest

from rosmini.core.errors import RosminiError
from rosmini.viz.live.panel_link import REST, PanelLink
from rosmini.viz.rqt.publisher import MessagePublisher

from .pages import Page


class PanelPage(Page):
    """A page of a panel, which answers each sheet unless it is told otherwise."""

    def __init__(self, panel):
        self.panel, self.answers = panel, True
        super().__init__(panel.graph, lambda clock: PanelLink(panel, clock=clock), step=0.05, beat=0.5)

    def get(self, content, buffers=None):
        super().get(content, buffers)
        if self.answers and content["type"] == "sheet":
            self.say("seen")


@pytest.fixture
def page(graph):
    return PanelPage(MessagePublisher(graph))


def test_what_the_page_does_is_done_and_shown(page):
    page.say("set", key="add")
    page.run(0.1)
    assert list(page.panel.publications) == [1]
    assert page.lives == 1
    assert "publish /cmd_vel" in page.sent[0][0]["html"]


def test_a_sheet_is_sent_when_something_changed_and_else_a_sign_of_life(page):
    page.live()
    page.say("hello")
    page.run(0.5)
    assert page.kinds() == ["sheet"]
    page.run(3.0)
    assert set(page.kinds()[1:]) == {"alive"}
    page.panel.add("/x", "std_msgs/Float64")
    page.run(2 * page.panel.update_interval_s)
    assert page.kinds()[-1] == "sheet"


def test_a_panel_that_is_dear_to_draw_leaves_the_graph_most_of_its_time(page):
    """Drawing takes 0.4 s of the wall's: it is drawn a few times in ten seconds, not fifty."""
    page.live()
    drawn = []

    def markup(*, live):
        page.wall += 0.4
        drawn.append(page.graph.now().to_sec())
        return f"<p>{len(drawn)}</p>"

    page.panel.markup = markup
    page.say("hello")
    page.run(10)
    assert 5 <= len(drawn) <= 10 / (REST * 0.4) + 2


def test_a_slow_page_is_sent_no_sheet_before_it_has_answered_the_last(page):
    page.live()
    page.panel.markup = lambda *, live: f"<p>{page.graph.now()}</p>"
    page.answers = False
    page.say("hello")
    page.run(2)
    page.say("set", key="add")
    page.run(0.5)
    assert page.kinds() == ["sheet"]
    page.say("seen")
    page.run(2 * page.panel.update_interval_s)
    assert page.kinds() == ["sheet", "sheet"]
    page.run(4)
    assert 2 < len(page.kinds()) <= 4, "an answer that was lost does not stop the panel"


def test_nobody_looks_and_nothing_is_sent(page):
    page.live()
    page.say("hello")
    page.run(10, beats=False)
    before = len(page.sent)
    page.panel.add("/x", "std_msgs/Float64")
    page.run(2, beats=False)
    assert len(page.sent) == before
    page.run(1)
    assert len(page.sent) > before


def test_a_graph_that_stands_still_stays_so_until_something_is_done(page):
    page.say("hello")
    page.say("beat")
    assert page.kinds() == ["still", "still"]
    assert page.lives == 0
    page.say("start")
    assert page.lives == 1


def test_where_the_graph_cannot_go_on_by_itself_the_page_is_told(page):
    def live():
        raise RosminiError("no event loop")

    page.graph.live = live
    page.say("start")
    assert page.sent == [({"type": "refused", "text": "no event loop"}, [])]


def test_the_end_is_told(page):
    page.live()
    page.say("hello")
    page.run(0.1)
    page.panel.close()
    page.say("beat")
    told = page.sent[-1][0]
    assert told["type"] == "gone" and "/rqt_publisher" in told["text"]


@pytest.mark.parametrize(("reader", "display", "live"), [(True, "", True), (True, "book", False), (False, "", False)])
def test_a_reader_gets_a_widget_and_the_book_and_nbconvert_get_html(page, monkeypatch, reader, display, live):
    shell = SimpleNamespace(get_parent=lambda: {"content": {"allow_stdin": reader}})
    monkeypatch.setattr("rosmini.core.graph.notebook.kernel_shell", lambda: shell)
    monkeypatch.setenv("ROSMINI_DISPLAY", display)
    data, _ = page.panel._repr_mimebundle_()
    assert data["text/plain"] == page.panel.text
    assert ("application/vnd.jupyter.widget-view+json" in data) == live
    assert ("disabled" in data.get("text/html", "")) == (not live)
