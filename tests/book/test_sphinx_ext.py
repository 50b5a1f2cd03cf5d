"""The book's Sphinx extension, on a small book of its own."""

from __future__ import annotations

import json
import re
from io import StringIO
from types import SimpleNamespace

import pytest

pytest.importorskip("sphinx")

from nbformat.v4 import new_code_cell, new_markdown_cell, new_notebook, new_output

from book.tools import notebooks
from book.tools.sphinx_ext import copy_viewer, describe_pictures, substitute
from rosmini.viz.embed import MESHCAT, STATIC, asset_path

PAGE = r"""# A page

Half is $\frac{1}{2}$.

$$
\dot\theta = \omega
$$ (eq:omega)

By {eq}`eq:omega` it turns.

> **On a real robot.** Type this:
>
> ```console
> $ rosnode list
> ```

<blockquote>

**On a real robot.** Two lines:

```console
$ rosnode list
$ rostopic list
```

</blockquote>

> **Summary**
>
> - All is well.

> **Bold** words begin this quote, which stays one.

> Plain words begin this one.

Names are `sensor_msgs/LaserScan` and `/tf`.

```{drawing} ros_parts
<a id="four-parts"></a>Figure 1: Four parts
& no more.
```

See [Figure 1](#four-parts) and [Table 1](#two-rows).

<a id="two-rows"></a>Table 1: Two *rows*.

| a | b |
|---|---|
| 1 | 2 |

```{stored} notebooks/stored a-robot
What the notebook stored
```

<details>
<summary>Solution</summary>

```python
print("solved")
```

</details>
"""

SVG = (
    '<svg aria-label="a"><path id="rm-1"/><path id="rm-12" clip-path="url(#rm-1)"/><use href="#rm-12"/><path{}/></svg>'
)
STORED = f"""<figure><b>A robot</b>{SVG.format(' id="rm-1"')}{SVG.format("")}</figure>"""


CONFIGURATION = (
    "extensions = ['myst_nb', 'sphinx_thebe', 'book.tools.sphinx_ext']\n"
    "html_math_renderer = 'mathml'\nmyst_enable_extensions = ['dollarmath']\nhtml_theme = 'sphinx_book_theme'\n"
    "exclude_patterns = ['notebooks']\nthebe_config = {'always_load': False}\nhtml_context = {'default_mode': 'auto'}\n"
)


def build(source, page):
    """Build a book of one page in `source`, and return the warnings."""
    from sphinx.application import Sphinx
    from sphinx.util.docutils import docutils_namespace

    (source / "conf.py").write_text(CONFIGURATION, encoding="utf-8")
    (source / "index.md").write_text(page, encoding="utf-8")
    warnings = StringIO()
    with docutils_namespace():
        app = Sphinx(
            source,
            source,
            source / "out",
            source / "doctrees",
            "html",
            status=None,
            warning=warnings,
            warningiserror=False,
        )
        app.build()
    return warnings.getvalue()


@pytest.fixture(scope="module")
def html(tmp_path_factory):
    source = tmp_path_factory.mktemp("source")
    cell = new_code_cell("show()", outputs=[new_output("display_data", {"text/html": STORED})])
    (source / "notebooks").mkdir()
    caption = new_markdown_cell('<a id="a-robot"></a>Figure 1: Its own caption')
    notebooks.write(new_notebook(cells=[cell, caption]), source / "notebooks" / "stored.ipynb")
    captions = new_markdown_cell(
        '<a id="its-picture"></a>Figure 1: A picture\n\n<a id="its-rows"></a>Table 1: Rows\n\n| a |\n|---|\n| 1 |'
    )
    python = {"name": "python", "pygments_lexer": "python"}
    chapter = new_notebook(cells=[cell, captions], metadata={"orphan": True, "language_info": python})
    notebooks.write(chapter, source / "chapter.ipynb")
    assert build(source, PAGE) == ""
    return source / "out"


@pytest.fixture(scope="module")
def page(html):
    return (html / "index.html").read_text(encoding="utf-8")


def test_formulas_are_mathml(page):
    inline, displayed = re.findall(r"<math.*?</math>", page)
    assert 'display="inline"' in inline
    assert "<mfrac><mrow><mn>1</mn></mrow><mrow><mn>2</mn></mrow></mfrac>" in inline
    assert 'display="block"' in displayed
    assert '<span class="eqno">(1)' in page
    assert 'href="#equation-eq-omega">(1)</a> it turns' in page


def test_quotes_that_say_so_become_boxes(page):
    boxes = re.findall(r'<div class="([^"]*)admonition">\s*<p class="admonition-title">(.*?)</p>', page)
    robot = ("real-robot box ", "On a real robot")
    assert boxes == [robot, robot, ("summary-box box ", "Summary")]
    assert "<p>Type this:</p>" in page


def test_a_box_between_tags_keeps_its_code(page):
    box = page.partition("<p>Two lines:</p>")[2].partition("Summary")[0]
    assert re.sub(r"<[^>]+>", "", box).strip().startswith("$ rosnode list\n$ rostopic list")
    assert "blockquote" not in box


def test_other_quotes_stay_quotes(page):
    quotes = re.findall(r"<blockquote>\s*<div><p>(.*?)</p>", page)
    assert quotes == ["<strong>Bold</strong> words begin this quote, which stays one.", "Plain words begin this one."]


def test_solutions_are_folded_with_their_code_highlighted(page):
    details = re.search(r"<details>(.*?)</details>", page, re.DOTALL)[1]
    assert "<summary>Solution</summary>" in details
    assert 'class="highlight-python' in details


def test_a_drawing_is_inline_with_its_caption_and_label(page):
    figure = re.search(r'<figure [^>]*id="four-parts">(.*?)</figure>', page, re.DOTALL)[1]
    assert 'aria-label="Four boxes' in figure
    assert "Figure 1: Four parts &amp; no more." in figure.partition("<figcaption>")[2]
    assert 'href="#four-parts"' in page


def test_a_table_has_its_caption_and_label(page):
    table = re.search(r'<table [^>]*id="two-rows">(.*?)</table>', page, re.DOTALL)[1]
    assert re.search(r"<caption>.*Table 1: Two <em>rows</em>", table, re.DOTALL)
    assert 'href="#two-rows"' in page


def test_a_table_that_follows_a_figure_has_its_own_caption(html):
    page = (html / "chapter.html").read_text(encoding="utf-8")
    assert re.findall(r'<figure class="align-default" id="([^"]*)"', page) == ["its-picture"]
    table = re.search(r'<table [^>]*id="its-rows">(.*?)</table>', page, re.DOTALL)[1]
    assert re.search(r"<caption>.*Table 1: Rows", table, re.DOTALL)


def test_a_stored_figure_is_shown_with_another_caption(page):
    assert "<b>A robot</b>" in page
    assert "What the notebook stored" in page
    assert "Its own caption" not in page


def test_long_names_break_after_a_slash_or_an_underscore(page):
    assert '<span class="pre">sensor_<wbr>msgs/<wbr>LaserScan</span>' in page
    assert '<span class="pre">/tf</span>' in page


def test_an_id_occurs_once_on_a_page(page):
    first, second = re.findall(r'<svg aria-label="a">.*?</svg>', page)
    assert first == SVG.format("")
    assert second == first.replace("rm-12", "rm-12-2").replace('rm-1"', 'rm-1-2"').replace("rm-1)", "rm-1-2)")


@pytest.mark.parametrize(("url", "text"), [("", "a copy of this repository"), ("https://example.org/r", "(https://")])
def test_the_address_of_the_repository_is_one_setting(url, text, tmp_path):
    config = SimpleNamespace(html_theme_options={"repository_url": url}, myst_substitutions={})
    substitute(SimpleNamespace(srcdir=tmp_path), config)
    assert text in config.myst_substitutions["repository_copy"]
    buttons = [shown for name, shown in config.html_theme_options.items() if name.endswith("_button")]
    assert buttons == [bool(url)] * 3


def test_a_cells_alternative_text_replaces_the_pictures_own():
    svg = '<svg aria-label="plot: 12 points"></svg>'
    outputs = [new_output("display_data", data) for data in ({"text/html": svg}, {"image/png": "iVBORw0KGgo="})]
    cell = new_code_cell("plot()", metadata={"alt": 'A "curve"'}, outputs=outputs)
    app = SimpleNamespace(env=SimpleNamespace(doc2path=lambda name: f"{name}.ipynb"))
    content = [json.dumps(new_notebook(cells=[cell]))]
    describe_pictures(app, "chapter", content)
    drawn, image = json.loads(content[0])["cells"][0]["outputs"]
    assert drawn["data"]["text/html"] == '<svg aria-label="A &quot;curve&quot;"></svg>'
    assert image["metadata"]["image/png"]["alt"] == 'A "curve"'


def test_thebe_is_silent(page):
    assert "THEBE_JS_URL" not in page
    assert "sphinx-thebe.js" not in page


def test_the_scripts_of_moving_pictures_are_there_to_be_loaded_and_no_page_begins_with_them(html, page):
    for script in STATIC.glob("*.js"):
        assert (html / "_static" / script.name).is_file()
        assert f'{script.name}"' not in page


def test_meshcats_viewer_is_copied_for_a_page_that_shows_something_in_it(html, tmp_path):
    assert not (html / "_static" / MESHCAT).exists()
    (tmp_path / "_static").mkdir()
    (tmp_path / "deep").mkdir()
    app = SimpleNamespace(outdir=tmp_path, builder=SimpleNamespace(format="html"))
    (tmp_path / "deep" / "a.html").write_text("globalThis.rosminiMeshcat.mount(host)", encoding="utf-8")
    copy_viewer(app, None)
    assert (tmp_path / "_static" / MESHCAT).read_bytes() == asset_path(MESHCAT).read_bytes()
    assert "license" in (tmp_path / "_static" / f"{MESHCAT}.LICENSE.txt").read_text(encoding="utf-8").lower()


def test_the_theme_writes_nothing_to_the_console(html):
    scripts = list((html / "_static").rglob("*.js"))
    assert scripts
    assert [path.name for path in scripts if "console.log(" in path.read_text(encoding="utf-8")] == []


def test_a_drawing_or_figure_that_does_not_exist_or_has_no_caption_is_refused(tmp_path):
    directives = (
        "{drawing} ros_part\nA caption.",
        "{drawing} ../logo-light\nA caption.",
        "{drawing} ros_parts",
        "{stored} notebooks/none a-robot\nA caption",
    )
    problems = build(tmp_path, "# A page\n\n" + "\n\n".join(f"```{each}\n```" for each in directives))
    for problem in (
        "there is no drawing ros_part; there are ",
        "there is no drawing ../logo-light",
        "Content block expected",
        "no figure a-robot",
    ):
        assert problem in problems
