"""The book as one PDF."""

from __future__ import annotations

import os
import re

import pytest

from book.tools import build
from book.tools.build import BookError, find_chromium
from book.tools.paper import contents, listed_pages, read_sheets
from book.tools.pdf import document, fill_numbers, make_pdf, page_numbers
from rosmini.tools import main

from ..conftest import nightly

PAGES = ("book/intro", "notebooks/2_graph/20_topics_and_messages")


@pytest.fixture
def chromium():
    """The path of the browser; skips without one, and fails if ROSMINI_REQUIRE_BROWSER=1."""
    try:
        return find_chromium()
    except BookError:
        if os.environ.get("ROSMINI_REQUIRE_BROWSER") == "1":
            raise
        return pytest.skip("no Chromium")


def check(pdf, paper, width):
    """Each link has one target; the contents name increasing pages; the outline is complete; the paper has its size."""
    bodies = "".join(sheet.body for sheet in paper.sheets)
    ids = [*re.findall(r'\sid="([^"]+)"', bodies), *(sheet.key for sheet in paper.sheets)]
    assert len(ids) == len(set(ids))
    assert set(re.findall(r'\shref="#([^"]+)"', bodies)) <= set(ids)
    numbers = page_numbers(pdf)
    places = [numbers[key] for _, key, _ in contents(paper)]
    assert places == sorted(places)
    assert pdf.count(b"/Type /Page\n") >= places[-1] > len(paper.sheets)
    assert {round(float(box)) for box in re.findall(rb"/MediaBox \[0 0 ([\d.]+) ", pdf)} == {width}
    outline = re.findall(rb"/Title \(((?:[^()\\]|\\.)*)\)", pdf)
    assert len(outline) > len(list(contents(paper)))
    assert pdf.count(b"/Subtype /Link") > len(list(contents(paper)))


@pytest.mark.parametrize(("names", "size", "width"), [(PAGES, "letter", 612), *nightly((None, "a4", 595))])
def test_chapters_and_the_whole_book_are_printed(chromium, book_html, root, tmp_path, names, size, width):
    listed = listed_pages(root)
    paper = read_sheets(book_html, {name: listed[name] for name in names or listed})
    pdf = make_pdf(book_html, paper, tmp_path / "book.pdf", size=size).read_bytes()
    check(pdf, paper, width)
    assert names is None or page_numbers(pdf)["c0"] == 3  # after the cover and a page of contents


def test_the_numbers_of_pages_stand_in_the_contents_and_behind_links_to_solutions(book_html, root):
    paper = read_sheets(book_html, {PAGES[1]: listed_pages(root)[PAGES[1]]})
    text = fill_numbers(document(book_html, paper, "a4"), {"c0": 7, "c0-solution-1": 12})
    assert re.search(r'Topics and messages</a><i></i><b data-page="c0">7</b>', text)
    assert 'Solution</a>, page <b data-page="c0-solution-1">12</b>' in text


def test_the_error_without_chromium_says_what_to_install_before_the_build(monkeypatch, capsys):
    monkeypatch.setenv("ROSMINI_CHROMIUM", "/nowhere/chromium")
    monkeypatch.setattr(build, "build_book", lambda *args, **options: pytest.fail("the book was built"))
    assert main.main(["book", "--pdf"]) == 1
    assert "apt install chromium" in capsys.readouterr().err
