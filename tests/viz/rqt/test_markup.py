"""Panels as HTML: real controls with names, everything escaped, disabled without a kernel."""

from html.parser import HTMLParser

from rosmini.viz.rqt.markup import markup, page
from rosmini.viz.rqt.parts import Bar, Box, Control, Drawing, Row, Rows, Words

EVIL = '<b>"x"</b>&'
ALL = (
    Bar(
        (
            Control("c", "Choice", "choice", "b", ("a", "b")),
            Control("s", "Slider", "slider", 2.0, minimum=0.0, maximum=4.0),
            Control("w", "Whole", "number", 2.0, whole=True),
            Control("k", "Check", "check", True),
            Control("t", EVIL, "text", EVIL, problem=EVIL),
            Control("go", "Go", "button"),
        )
    ),
    Box(EVIL, (Rows((EVIL,), (Row((EVIL,), is_marked=True),), EVIL), Words(EVIL, is_bad=True))),
    Drawing("<svg></svg>", "a picture", "pick"),
)


class Elements(HTMLParser):
    def __init__(self, html):
        super().__init__()
        self.all = []
        self.feed(html)

    def handle_starttag(self, tag, attrs):
        self.all.append((tag, dict(attrs)))

    def of(self, *tags):
        return [attributes for tag, attributes in self.all if tag in tags]


def test_nothing_that_comes_from_a_graph_becomes_markup():
    assert Elements(markup(ALL)).of("b") == []


def test_a_page_without_a_kernel_is_disabled_and_says_so():
    still, live = (Elements(page("Title", ALL, live=live)) for live in (False, True))
    assert all("disabled" in control for control in still.of("input"))
    assert not any("disabled" in control for control in live.of("input"))
    assert "In a live notebook" in page("Title", ALL, live=False)
    assert still.of("div")[0]["aria-label"] == "Title"
