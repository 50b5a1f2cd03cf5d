"""The built book fetches nothing from elsewhere, names no local address, and has a text for every picture."""

from __future__ import annotations

import re

import pytest
import yaml

from book.tools import notebooks
from book.tools.pages import ASKS, OWN, page_problems, script_problems, site_problems
from rosmini.viz.embed import MESHCAT, STATIC, asset_path, embed


def toc_pages(root):
    toc = yaml.safe_load((root / "book" / "_toc.yml").read_text(encoding="utf-8"))
    return [toc["root"], *(chapter["file"] for part in toc["parts"] for chapter in part["chapters"])]


def test_the_book_is_built_with_warnings_as_errors(book_html, root):
    for page in toc_pages(root):
        assert (book_html / f"{page}.html").is_file(), page


def test_every_notebook_is_in_the_contents(root):
    listed = {page for page in toc_pages(root) if page.startswith("notebooks/")}
    assert listed == {
        path.relative_to(root).with_suffix("").as_posix() for path in (root / "notebooks").rglob("*.ipynb")
    }


def test_chapters_have_the_number_of_their_part_and_place(book_html, root):
    toc = yaml.safe_load((root / "book" / "_toc.yml").read_text(encoding="utf-8"))
    numbered = [part["chapters"] for part in toc["parts"] if part.get("numbered")]
    for part, chapters in enumerate(numbered, start=1):
        for place, chapter in enumerate(chapters, start=1):
            text = (book_html / f"{chapter['file']}.html").read_text(encoding="utf-8")
            assert f'<h1><span class="section-number">{part}.{place}. </span>' in text


def test_old_addresses_lead_to_pages(book_html, root):
    config = yaml.safe_load((root / "book" / "_config.yml").read_text(encoding="utf-8"))
    for old, new in config["sphinx"]["config"]["redirects"].items():
        assert new in (book_html / f"{old}.html").read_text(encoding="utf-8")
        assert (book_html / old).parent.joinpath(new).is_file()


def test_the_page_of_contents_introduces_the_parts_and_pages_in_their_order(root):
    toc = yaml.safe_load((root / "book" / "_toc.yml").read_text(encoding="utf-8"))
    text = (root / "book" / "contents.md").read_text(encoding="utf-8")
    assert re.findall(r"^## (.+)$", text, re.MULTILINE) == [part["caption"] for part in toc["parts"]]
    linked = [f"book/{name}" if name[0] != "/" else name[1:] for name in re.findall(r"\{doc\}`[^<`]+<([^>`]+)>`", text)]
    listed = [page for page in toc_pages(root)[1:] if page != "book/contents"]
    assert sorted(linked) == sorted(listed)
    chapters = [page for page in listed if page.startswith("notebooks/")]
    assert [page for page in linked if page.startswith("notebooks/")] == chapters


def test_the_cover_leads_to_the_first_steps_and_is_light(book_html, root):
    text = (book_html / "book" / "intro.html").read_text(encoding="utf-8")
    assert re.search(r'class="right-next"\s+href="\.\./notebooks/1_start/10_first_steps\.html"', text)
    scripts = set(re.findall(r"rosmini-[a-z-]+\.js", text))
    own = [STATIC / name for name in scripts] + [STATIC / "rosmini.css", root / "book" / "static" / "book.css"]
    assert "rosmini-pad.js" in scripts
    assert MESHCAT not in text
    assert len(text) + sum(path.stat().st_size for path in own) < 400_000


def test_a_downloaded_notebook_says_how_to_get_what_it_needs(book_html, root):
    for path in sorted((root / "notebooks").rglob("*.ipynb")):
        first = notebooks.read(book_html / "_sources" / path.relative_to(root)).cells[0]
        assert "uv run rosmini lab" in first.source
        assert path.name in first.source


def test_every_prose_page_is_in_the_contents(root):
    pages = (path.relative_to(root) for path in (root / "book").rglob("*.md") if "_build" not in path.parts)
    assert {page.with_suffix("").as_posix() for page in pages} <= set(toc_pages(root))


def test_nothing_in_the_pages_comes_from_elsewhere(book_html):
    assert list(site_problems(book_html)) == []


def test_no_page_has_the_scripts_that_jupyter_book_loads_from_the_network(book_html):
    for path in book_html.rglob("*.html"):
        text = path.read_text(encoding="utf-8")
        for unwanted in ("MathJax", "mathjax@", "require.min.js", "require.js", "THEBE_JS_URL", "html-manager"):
            assert unwanted not in text, f"{path}: {unwanted}"


@pytest.mark.parametrize(
    ("html", "problem"),
    [
        ('<script src="https://cdn.example/x.js"></script>', "script src from elsewhere: https://cdn.example/x.js"),
        ('<script src="//cdn.example/x.js"></script>', "script src from elsewhere: //cdn.example/x.js"),
        ('<script>import("https://cdn.example/x.mjs")</script>', "a script from elsewhere: https://cdn.example/x.mjs"),
        (
            '<link rel="stylesheet" href="http://cdn.example/x.css">',
            "link href from elsewhere: http://cdn.example/x.css",
        ),
        (
            "<style>@font-face {src: url('https://fonts.example/a.woff2')}</style>",
            "a style from elsewhere: https://fonts.example/a.woff2",
        ),
        ("<style>@import '//fonts.example/a.css';</style>", "a style from elsewhere: //fonts.example/a.css"),
        ('<img alt="a map" src="https://example.org/a.png">', "img src from elsewhere: https://example.org/a.png"),
        (
            '<iframe title="t" src="http://127.0.0.1:7000/"></iframe>',
            "iframe src from elsewhere: http://127.0.0.1:7000/",
        ),
        ('<iframe title="t" src="http://127.0.0.1:7000/"></iframe>', "a local address in iframe src"),
        ("<p>open http://127.0.0.1:7000 now</p>", "a local address in the text: open http://127.0.0.1:7000 now"),
        ('<img src="a.png">', "an image without a text: a.png"),
        ('<img src="a.png" alt=" ">', "an image without a text: a.png"),
        ('<img src="a.png" alt="a.png">', "an image without a text: a.png"),
        ("<p id='a'>1</p><p id='a'>2</p>", "an id twice: a (p)"),
        ("<svg class='graph'><path d='M0 0'/></svg>", "a drawing without a text: svg graph"),
        ('<iframe src="a.html"></iframe>', "a frame without a title: a.html"),
        (
            (
                '<iframe title="t" srcdoc="&lt;script src=&quot;https://cdn.example/x.js&quot;&gt;'
                '&lt;/script&gt;"></iframe>'
            ),
            "in a frame: script src from elsewhere: https://cdn.example/x.js",
        ),
    ],
)
def test_what_the_gate_refuses(html, problem):
    assert problem in page_problems(html)


@pytest.mark.parametrize(
    "html",
    [
        '<p>See <a href="https://wiki.ros.org">the wiki</a>.</p>',
        '<link rel="canonical" href="https://example.org/">',
        '<img src="a.png" alt="a map">',
        '<img src="data:image/png;base64,AAAA" alt="a map">',
        "<svg><title>two nodes</title><g><svg><path/></svg></g></svg>",
        '<svg role="img" aria-label="two nodes" xmlns="http://www.w3.org/2000/svg"></svg>',
        '<math xmlns="http://www.w3.org/1998/Math/MathML"><mi>x</mi></math>',
        '<script src="../_static/x.js"></script><style>a {background: url("../a.svg")}</style>',
    ],
)
def test_what_the_gate_accepts(html):
    assert page_problems(html) == []


def moving(number, **options):
    given = {"title": "t", "alt": "a", "height": 1, "fallback_html": "<p>still</p>"} | options
    return embed(["rosmini-meshcat.js"], "rosminiMeshcat.mount", {"number": number}, **given)


def test_six_three_dimensional_pictures_are_a_page_and_seven_are_too_many():
    pictures = [moving(number, book=True) for number in range(7)]
    assert page_problems("".join(pictures[:6])) == []
    assert page_problems("".join(pictures)) == ["7 three-dimensional pictures, over 6"]


def test_the_live_form_is_not_for_the_book():
    assert any("live form" in problem for problem in page_problems(moving(0, book=False)))


def test_what_a_page_loads_has_to_be_there(tmp_path):
    (tmp_path / "_static").mkdir()
    (tmp_path / "a.html").write_text(moving(0, book=True), encoding="utf-8")
    missing = [re.findall(r"[\w-]+(?:\.\w+)+", problem) for problem in site_problems(tmp_path)]
    assert missing == [["a.html", MESHCAT], ["a.html", "rosmini-meshcat.js"]]
    (tmp_path / "_static" / "rosmini-meshcat.js").write_text("fetch('https://example.org/a')", encoding="utf-8")
    (tmp_path / "_static" / MESHCAT).write_text("", encoding="utf-8")
    assert list(site_problems(tmp_path)) == [
        "_static/rosmini-meshcat.js: names https://example.org/a",
        "_static/rosmini-meshcat.js: uses fetch",
    ]


def test_one_script_of_the_book_asks_one_address(root):
    scripts = {path.name: path.read_text(encoding="utf-8") for path in (root / "book" / "static").glob("*.js")}
    assert scripts.keys() == OWN
    assert {name for name, text in scripts.items() if script_problems(text)} == ASKS.keys()
    for name, address in ASKS.items():
        assert script_problems(scripts[name], asks=address) == []
        assert script_problems("fetch('https://example.org/')", asks=address) == ["names https://example.org/"]


def test_the_scripts_of_moving_pictures_ask_nobody_for_anything():
    for path in STATIC.glob("*.js"):
        assert script_problems(path.read_text(encoding="utf-8")) == [], path.name
    assert script_problems(asset_path(MESHCAT).read_text(encoding="utf-8"), ours=False) == []


@pytest.mark.parametrize(
    ("script", "problem"),
    [
        ("new WebSocket('ws://localhost:7000')", "names this machine"),
        ("const a = 'http://127.0.0.1:7000/static/'", "names this machine"),
        ("import('./x.js')", "uses import"),
        ("viewer.connect()", "uses connect"),
        ("open(`ws://${location.host}`)", "names ws://${location.host}"),
        ("new XMLHttpRequest()", "uses XMLHttpRequest"),
        ("a = `//${'https://cdn.example/x'}`", "names https://cdn.example/x"),
    ],
)
def test_what_the_gate_refuses_in_a_script(script, problem):
    assert problem in script_problems(script)
