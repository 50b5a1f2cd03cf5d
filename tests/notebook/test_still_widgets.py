"""Widgets of ipywidgets in the book: the same output in each run, and nothing that needs a kernel."""

import ipywidgets
import pytest

from rosmini.viz.embed import BOOK, VARIABLE


@pytest.fixture
def book_notebook(monkeypatch, request):
    monkeypatch.setenv(VARIABLE, BOOK)
    return request.getfixturevalue("notebook")


def test_buttons_are_a_form_in_the_book(book_notebook):
    row = ipywidgets.HBox([ipywidgets.Button(description=name) for name in ("ahead", "left")])
    speed = ipywidgets.FloatSlider(description="speed", value=0.2, max=0.22)
    data, _ = book_notebook.shell.display_formatter.format(ipywidgets.VBox([row, speed]))
    assert "widget-view" not in " ".join(data)
    assert data["text/plain"] == "ipywidgets: ahead, left, speed"
    assert data["text/html"].count("<button") == 2
    assert "disabled" in data["text/html"]


def test_interact_is_a_form_and_the_output_for_the_first_values(book_notebook):
    book_notebook.ok("from ipywidgets import interact\ndef show(r=0.6, s=5): print(f'r {r}, s {s}')")
    written = book_notebook.ok("_ = interact(show, r=(0.1, 1.0, 0.1), s=(1, 20))")
    assert written == "ipywidgets: r, s\nr 0.6, s 5\n"


def test_a_widget_that_has_no_form_is_named(book_notebook):
    data, _ = book_notebook.shell.display_formatter.format(ipywidgets.ColorPicker())
    assert "ColorPicker" in data["text/plain"]


def test_widgets_are_their_own_in_a_live_notebook(notebook):
    data, _ = notebook.shell.display_formatter.format(ipywidgets.Button(description="ahead"))
    assert "application/vnd.jupyter.widget-view+json" in data
