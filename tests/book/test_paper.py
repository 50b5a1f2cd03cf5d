"""The pages of the book, made ready for paper and e-readers."""

from __future__ import annotations

from bs4 import BeautifulSoup

from book.tools.paper import contents, read_sheets

DRAWING = '<svg viewBox="0 0 1 1"><clipPath id="a"/><g clip-path="url(#a)"><svg></svg></g></svg>'
PAGE = f"""<html><article class="bd-article"><section id="t"><h1>2.1. Topics &amp; messages</h1>
<script>1 < 2</script><div class="rosmini-still">{DRAWING}</div><div class="rosmini-moving" hidden></div>
<p>See <a href="other.html#there">there</a>, <a href="#t">above</a>, <a href="../absent.html">elsewhere</a>.</p>
<section id="ex"><h2>Exercise 1: stop<a class="headerlink" href="#ex">#</a></h2>
<details><summary>Hint</summary><p>Look.</p></details>
<details><summary>Solution</summary><p>Brake <b id="b">now</b>.</p></details></section>
<details class="hide"><summary><p class="collapsed admonition-title">Show</p></summary><pre>x = 1</pre></details>
<select><option>a</option><option selected>b</option></select><input value="0.5"><label>gain</label>
</section></article></html>"""
OTHER = '<article class="bd-article"><section id="u"><h1>Other</h1><p id="there">Here</p></section></article>'


def made(folder):
    (folder / "part").mkdir()
    (folder / "part" / "page.html").write_text(PAGE, encoding="utf-8")
    (folder / "part" / "other.html").write_text(OTHER, encoding="utf-8")
    return read_sheets(folder, {"part/page": "2. The graph", "part/other": "2. The graph"})


def test_scripts_go_and_stills_say_where_they_move(tmp_path):
    text = made(tmp_path).sheets[0].body
    assert "script" not in text
    assert "rosmini-moving" not in text
    assert "It moves in the HTML book: part/page.html" in text
    assert 'viewBox="0 0 1 1"' in text
    assert 'id="c0-a"' in text
    assert "url(#c0-a)" in text


def test_folds_are_open_and_solutions_stand_at_the_end_with_links_both_ways(tmp_path):
    page, _, solutions = made(tmp_path).sheets
    assert "details" not in page.body
    assert '<p class="fold-title">Hint</p><p>Look.</p>' in page.body
    assert "x = 1" in page.body
    assert "Brake" not in page.body
    assert '<a href="#c0-solution-1">Solution</a>' in page.body
    assert solutions.title == "Solutions to 2.1 Topics & messages"
    assert '<h2 id="c0-solution-1"><a href="#c0-ex">Exercise 1: stop</a></h2><p>Brake <b id="c0-b">now</b>.</p>' in (
        solutions.body
    )


def test_links_lead_to_sections_of_the_book_and_the_others_to_nothing(tmp_path):
    links = BeautifulSoup(made(tmp_path).sheets[0].body, "html.parser").find_all("a")
    assert [link.get("href") for link in links] == ["#c1-there", "#c0-t", None, "#c0-solution-1"]


def test_forms_become_text(tmp_path):
    soup = BeautifulSoup(made(tmp_path).sheets[0].body, "html.parser")
    assert [span.get_text() for span in soup.select("[class^=form]")] == ["b", "0.5", "gain"]


def test_the_contents_have_parts_chapters_and_sections(tmp_path):
    assert list(contents(made(tmp_path))) == [
        (0, "c0", "2. The graph"),
        (1, "c0", "2.1 Topics & messages"),
        (2, "c0-ex", "Exercise 1: stop"),
        (1, "c1", "Other"),
        (0, "s0", "Solutions"),
        (1, "s0", "Solutions to 2.1 Topics & messages"),
    ]
